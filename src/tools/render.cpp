// `ninebit render`: a scene's shadows, drawn by one of the techniques.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/pictures.h"
#include "src/tools/common/number_list.h"
#include "src/tools/common/picture_hashes.h"
#include "src/tools/common/pixel_flag.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct RenderFlags {
  CommonFlags common;
  SceneFlags scene;
  std::string folder;
  std::string pick;
  bool ground_truth = false;
};

int wrong_usage(const std::string& message) {
  say_error(fmt::format("{} (see: ninebit render --help)", message));
  return kWrongUsage;
}

Json hashes(const Rendering& rendering) {
  Json out = Json::object();
  for (auto& [name, hash] : picture_hashes(rendering)) out[name] = hash;
  return out;
}

Json facts(const Rendering& rendering) {
  Json out = Json::object();
  for (const Fact& fact : rendering.facts) {
    std::visit([&](const auto& value) { out[fact.name] = value; }, fact.value);
  }
  return out;
}

// Numbers count from 1, as in layers.exr.
Json json_of(const RenderFlags& flags, const Scene& scene, const PickedIndex& picked) {
  const auto from_1 = [](const std::optional<std::uint32_t>& number) { return number ? Json(*number + 1) : Json(); };
  const auto at = *numbers<int>(flags.pick, ',');
  return {{"x", at[0]},
          {"y", at[1]},
          {"index", picked.number},
          {"polygon", from_1(picked.polygon)},
          {"section", from_1(picked.section)},
          {"object", from_1(picked.object)},
          {"object_name", picked.object ? Json(scene.objects[*picked.object].name) : Json()}};
}

std::string text_of(const RenderFlags& flags, const Scene& scene, const PickedIndex& picked) {
  if (!picked.object) return fmt::format("pixel {}: background\n", flags.pick);
  const std::string what = picked.polygon   ? fmt::format("polygon {} of ", *picked.polygon + 1)
                           : picked.section ? fmt::format("section {} of ", *picked.section + 1)
                                            : "";
  return fmt::format("pixel {}: index {}, {}object {} '{}'{}\n", flags.pick, picked.number, what, *picked.object + 1,
                     printable(scene.objects[*picked.object].name),
                     picked.polygon ? "" : "; the index does not tell which polygon");
}

// Judges the rendering and shows what is wrong; empty where the technique drew no shadows.
Result<std::optional<GroundTruth>> judge(const Scene& scene, const RenderSettings& settings, Rendering& rendering,
                                         const Progress& progress) {
  if (!rendering.evidence) return std::optional<GroundTruth>();
  const auto rays = GroundTruthScene::make(scene);
  if (!rays) return rays.error();
  auto truth = measure(*rays, settings, rendering, progress);
  if (!truth) return truth.error();
  add_ground_truth(rendering, settings, *truth);
  return std::optional(std::move(*truth));
}

std::vector<std::pair<std::string, std::uint64_t>> errors_by_cause(const ShadowEvidence& evidence,
                                                                   const GroundTruth& truth) {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  for (const ErrorCause cause : causes_of(evidence)) {
    counts.emplace_back(name_of(cause), truth.by_cause[static_cast<std::size_t>(cause)]);
  }
  return counts;
}

Json errors(const ShadowEvidence& evidence, const GroundTruth& truth) {
  Json by_cause = Json::object();
  for (const auto& [cause, count] : errors_by_cause(evidence, truth)) by_cause[cause] = count;
  return {{"false_lit", truth.false_lit}, {"false_shadowed", truth.false_shadowed}, {"by_cause", std::move(by_cause)}};
}

std::string error_line(const Rendering& rendering, const std::optional<GroundTruth>& truth) {
  if (!truth) return "ground truth: not applicable, no shadows were drawn\n";
  std::string causes;
  for (const auto& [cause, count] : errors_by_cause(*rendering.evidence, *truth)) {
    if (count != 0) causes += fmt::format("{}{} {}", causes.empty() ? ": " : ", ", count, cause);
  }
  return fmt::format("ground truth: {} pixels falsely lit, {} falsely shadowed{}\n", truth->false_lit,
                     truth->false_shadowed, causes);
}

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

// What one run of the verb loads, draws and writes.
struct RenderRun {
  RenderSettings settings;
  Scene scene;
  std::optional<Rendering> rendering;
  std::optional<GroundTruth> truth;
  std::vector<std::filesystem::path> files;
  Clock::duration load{}, write{}, total{};
};

Status step(ProgressLine& line, std::string_view pass, double done) {
  if (line.step(pass, done)) return {};
  return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
}

// Draws the loaded scene; with --ground-truth, judges each pixel.
Status draw(const RenderFlags& flags, RenderRun& run, ProgressLine& line) {
  const double judging = flags.ground_truth ? 0.4 : 0.0;
  const auto progress = [&](std::string_view pass, double done) {
    return line.step(pass, 0.1 + (0.8 - judging) * done);
  };
  auto rendering = render_scene(flags.scene, run.scene, run.settings, progress);
  if (!rendering) return rendering.error();
  run.rendering.emplace(std::move(*rendering));
  if (!flags.ground_truth) return {};
  const auto further = [&](std::string_view pass, double done) { return line.step(pass, 0.5 + judging * done); };
  auto judged = judge(run.scene, run.settings, *run.rendering, further);
  if (!judged) return judged.error();
  run.truth = std::move(*judged);
  return {};
}

Status load_draw_and_write(const RenderFlags& flags, RenderRun& run, ProgressLine& line) {
  const auto start = Clock::now();
  line.step("loading", 0.0);
  auto scene = load_scene(flags.scene, run.settings, flags.common.quiet);
  if (!scene) return scene.error();
  run.scene = std::move(*scene);
  // Opened before the drawing: a folder that is not writable must not cost a long rendering.
  auto files = StagedFiles::open(flags.folder);
  if (!files) return files.error();
  const auto loaded = Clock::now();

  if (Status drawn = draw(flags, run, line); !drawn) return drawn;

  const auto rendered = Clock::now();
  if (Status go_on = step(line, "writing", 0.9); !go_on) return go_on;
  if (Status written = write_rendering(*run.rendering, *files); !written) return written;
  if (Status go_on = step(line, "writing", 1.0); !go_on) return go_on;
  if (Status committed = files->commit(); !committed) return committed;
  const auto end = Clock::now();

  run.files = files->files();
  run.load = loaded - start;
  run.write = end - rendered;
  run.total = end - start;
  return {};
}

int print_text(const RenderFlags& flags, const RenderRun& run) {
  const Rendering& r = *run.rendering;
  if (!flags.common.quiet) {
    say(fmt::format("{} triangles; pixels: {} lit, {} shadowed, {} background; {:.0f} ms\n", run.scene.triangles.size(),
                    r.lit, r.shadowed, r.background, milliseconds(run.total)));
    if (flags.ground_truth) say(error_line(r, run.truth));
  }
  return r.picked ? answer(text_of(flags, run.scene, *r.picked)) : kDone;
}

int print_json(const RenderFlags& flags, const RenderRun& run) {
  const Rendering& r = *run.rendering;
  const RenderSettings& settings = run.settings;
  Json names = Json::array();
  for (const auto& file : run.files) names.push_back(file.string());
  Json out{{"command", "render"},
           {"version", NINEBIT_VERSION},
           {"technique", flags.scene.technique},
           {"profile", flags.common.profile},
           {"scene", flags.scene.file},
           {"triangles", run.scene.triangles.size()},
           {"size", {settings.width, settings.height}},
           {"map_size", settings.map_size},
           {"index",
            {{"format", name_in(kIndexFormats, settings.index.format)},
             {"scope", name_in(kIndexScopes, settings.index.scope)},
             {"step", settings.index.step},
             {"used", r.codes_used},
             {"capacity", r.codes.capacity()}}},
           {"pixels", {{"background", r.background}, {"lit", r.lit}, {"shadowed", r.shadowed}}},
           {"time_ms",
            {{"load", milliseconds(run.load)},
             {"transform", r.times.transform},
             {"maps", r.times.maps},
             {"camera", r.times.camera},
             {"compare", r.times.compare},
             {"shade", r.times.lit + r.times.shadow},
             {"write", milliseconds(run.write)},
             {"total", milliseconds(run.total)}}},
           {"facts", facts(r)},
           {"files", std::move(names)},
           {"hash", hashes(r)}};
  if (r.picked) out["pick"] = json_of(flags, run.scene, *r.picked);
  if (run.truth) out["errors"] = errors(*r.evidence, *run.truth);
  return answer(out);
}

int render(const RenderFlags& flags) {
  const ThreadLimit limit(flags.common.threads);
  RenderRun run;
  run.settings = settings_of(flags.scene, flags.common);
  if (!flags.pick.empty()) {
    if (flags.scene.technique != "index-cube") {
      return wrong_usage(
          fmt::format("--pick needs the indices of technique index-cube, not {}", flags.scene.technique));
    }
    const auto pixel = window_pixel("--pick", flags.pick, run.settings);
    if (!pixel) return wrong_usage(pixel.error().message);
    run.settings.pick = *pixel;
  }
  run.settings.evidence = flags.ground_truth;

  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  const Status done = load_draw_and_write(flags, run, *line);
  line.reset();
  if (!done) return report(done.error());
  if (!flags.common.quiet) {
    for (const auto& file : run.files) say_written(file);
  }
  return flags.common.json ? print_json(flags, run) : print_text(flags, run);
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("render", "Draw a scene's shadows");
  verb->footer(
      "Examples:\n"
      "  ninebit render scenes/index_room.gltf -o out\n"
      "  ninebit render bunny.obj -o out --light 2,4,3 --index-step 1 --layers --json");
  auto flags = std::make_shared<RenderFlags>();
  add_common_flags(*verb, flags->common);
  add_scene_file(*verb, "scene", flags->scene)->required();
  verb->add_option("-o,--output", flags->folder, "Folder to write into; made if missing")->required()->type_name("DIR");
  add_scene_flags(*verb, flags->scene);
  verb->add_flag("--layers", flags->scene.settings.layers, "Write layers.exr with every intermediate value");
  add_pixel_flag(*verb, "--pick", flags->pick, "Tell which polygon and object is seen at this pixel, by its index");
  verb->add_flag("--ground-truth", flags->ground_truth, "Judge each pixel by rays: errors, their causes, error.png");
  verb->callback([flags, &exit_code] { exit_code = render(*flags); });
}

}  // namespace ninebit::tools
