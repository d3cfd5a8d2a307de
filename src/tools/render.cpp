// `ninebit render`: a scene's shadows, drawn by one of the techniques.
#include <fmt/format.h>

#include <chrono>
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

double milliseconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

int render(const RenderFlags& flags) {
  using Clock = std::chrono::steady_clock;
  const ThreadLimit limit(flags.common.threads);
  RenderSettings settings = settings_of(flags.scene, flags.common);
  if (!flags.pick.empty()) {
    if (flags.scene.technique != "index-cube") {
      return wrong_usage(
          fmt::format("--pick needs the indices of technique index-cube, not {}", flags.scene.technique));
    }
    const auto pixel = window_pixel("--pick", flags.pick, settings);
    if (!pixel) return wrong_usage(pixel.error().message);
    settings.pick = *pixel;
  }
  settings.evidence = flags.ground_truth;

  const auto start = Clock::now();
  std::optional<ProgressLine> line(std::in_place, flags.common.quiet);
  line->step("loading", 0.0);
  const auto scene = load_scene(flags.scene, settings, flags.common.quiet);
  if (!scene) return line.reset(), report(scene.error());
  // Before the work, so that a folder that cannot be written into costs nobody a long rendering.
  auto files = StagedFiles::open(flags.folder);
  if (!files) return line.reset(), report(files.error());
  const auto loaded = Clock::now();

  const double judging = flags.ground_truth ? 0.4 : 0.0;
  const auto progress = [&](std::string_view pass, double done) {
    return line->step(pass, 0.1 + (0.8 - judging) * done);
  };
  auto rendering = render_scene(flags.scene, *scene, settings, progress);
  if (!rendering) return line.reset(), report(rendering.error());
  std::optional<GroundTruth> truth;
  if (flags.ground_truth) {
    const auto further = [&](std::string_view pass, double done) { return line->step(pass, 0.5 + judging * done); };
    auto judged = judge(*scene, settings, *rendering, further);
    if (!judged) return line.reset(), report(judged.error());
    truth = std::move(*judged);
  }

  const auto rendered = Clock::now();
  if (!line->step("writing", 0.9)) return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
  if (Status written = write_rendering(*rendering, *files); !written) return line.reset(), report(written.error());
  if (!line->step("writing", 1.0)) return line.reset(), report({.message = "interrupted", .fault = Fault::cancelled});
  if (Status committed = files->commit(); !committed) return line.reset(), report(committed.error());
  const auto end = Clock::now();
  line.reset();

  Json names = Json::array();
  for (const auto& file : files->files()) {
    names.push_back(file.string());
    if (!flags.common.quiet) say_written(file);
  }
  const Rendering& r = *rendering;
  if (!flags.common.json) {
    if (!flags.common.quiet) {
      say(fmt::format("{} triangles; pixels: {} lit, {} shadowed, {} background; {:.0f} ms\n", scene->triangles.size(),
                      r.lit, r.shadowed, r.background, milliseconds(end - start)));
      if (flags.ground_truth) say(error_line(r, truth));
    }
    return r.picked ? answer(text_of(flags, *scene, *r.picked)) : kDone;
  }
  Json out{{"command", "render"},
           {"version", NINEBIT_VERSION},
           {"technique", flags.scene.technique},
           {"profile", flags.common.profile},
           {"scene", flags.scene.file},
           {"triangles", scene->triangles.size()},
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
            {{"load", milliseconds(loaded - start)},
             {"transform", r.times.transform},
             {"maps", r.times.maps},
             {"camera", r.times.camera},
             {"compare", r.times.compare},
             {"shade", r.times.lit + r.times.shadow},
             {"write", milliseconds(end - rendered)},
             {"total", milliseconds(end - start)}}},
           {"facts", facts(r)},
           {"files", std::move(names)},
           {"hash", hashes(r)}};
  if (r.picked) out["pick"] = json_of(flags, *scene, *r.picked);
  if (truth) out["errors"] = errors(*r.evidence, *truth);
  return answer(out);
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
