#include "src/tools/render/render_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <system_error>
#include <utility>
#include <variant>

#include "ninebit/frame/pictures.h"
#include "ninebit/shadow/picture_files.h"
#include "src/system/number_list.h"
#include "src/system/stream.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/picture_hashes.h"
#include "src/tools/common/technique_flags.h"
#include "src/tools/common/trace_command.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

Json hash_json(const Rendering& rendering) {
  Json out = Json::object();
  for (auto& [name, hash] : picture_hashes(rendering)) out[name] = hash;
  return out;
}

Json facts_json(const Rendering& rendering) {
  Json out = Json::object();
  for (const Fact& fact : rendering.facts) {
    std::visit([&](const auto& value) { out[fact.name] = value; }, fact.value);
  }
  return out;
}

// Numbers count from 1, as in layers.exr.
Json pick_json(const RenderFlags& flags, const Scene& scene, const PickedIndex& picked) {
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

std::vector<std::pair<std::string, std::uint64_t>> errors_by_cause(const ShadowEvidence& evidence,
                                                                   const GroundTruth& truth) {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  for (const ErrorCause cause : causes_of(evidence)) {
    counts.emplace_back(name_of(cause), truth.by_cause[static_cast<std::size_t>(cause)]);
  }
  return counts;
}

// The samples are those of a picture that is drawn so large, with --supersample.
std::vector<WrongPixelTrace> worst_of(const RenderFlags& flags, const FinishedRender& done) {
  std::vector<std::string> arguments =
      given_arguments(flags.common, flags.scene_options, [](const std::string& flag) { return flag != "--size"; });
  arguments.insert(arguments.begin(), "--technique=" + flags.scene.technique);
  return worst_traces(flags.scene, done.settings, arguments, *done.truth);
}

Json errors_json(const RenderFlags& flags, const FinishedRender& done) {
  const GroundTruth& truth = *done.truth;
  Json by_cause = Json::object();
  for (const auto& [cause, count] : errors_by_cause(*done.rendering->evidence, truth)) by_cause[cause] = count;
  return {{"false_lit", truth.false_lit},
          {"false_shadowed", truth.false_shadowed},
          {"by_cause", std::move(by_cause)},
          {"worst", worst_json(worst_of(flags, done))}};
}

std::string error_lines(const RenderFlags& flags, const FinishedRender& done) {
  const std::optional<GroundTruth>& truth = done.truth;
  if (!truth) return "ground truth: not applicable, no shadows were drawn\n";
  std::string causes;
  for (const auto& [cause, count] : errors_by_cause(*done.rendering->evidence, *truth)) {
    if (count != 0) causes += fmt::format("{}{} {}", causes.empty() ? ": " : ", ", count, cause);
  }
  const std::string worst = worst_text(worst_of(flags, done));
  return fmt::format("ground truth: {} pixels falsely lit, {} falsely shadowed{}\n{}{}", truth->false_lit,
                     truth->false_shadowed, causes, worst.empty() ? "" : "why, in the middle of the largest patches:\n",
                     worst);
}

Json index_json(const RenderSettings& settings, const Rendering& rendering) {
  Json out{{"format", name_of(settings.index.format)},
           {"scope", name_of(settings.index.scope)},
           {"step", settings.index.step},
           {"used", rendering.codes_used},
           {"capacity", rendering.codes.capacity()},
           {"scales", name_of(settings.index.scales)}};
  add_order(out, rendering.index_order);
  return out;
}

Json time_json(const FinishedRender& done) {
  const PassTimes& pass = done.rendering->times;
  return {{"load", done.load_ms},   {"transform", pass.transform}, {"maps", pass.maps},
          {"camera", pass.camera},  {"compare", pass.compare},     {"shade", pass.lit + pass.shadow},
          {"write", done.write_ms}, {"total", done.total_ms}};
}

}  // namespace

std::string summary_text(const RenderFlags& flags, const FinishedRender& done) {
  const Rendering& r = *done.rendering;
  std::string text = fmt::format("{} triangles; pixels: {} lit, {} shadowed, {} background; {:.0f} ms\n",
                                 done.scene->triangles.size(), r.lit, r.shadowed, r.background, done.total_ms);
  text += order_text(r.index_order);
  if (flags.ground_truth) text += error_lines(flags, done);
  return text;
}

std::string pick_text(const RenderFlags& flags, const FinishedRender& done) {
  const PickedIndex& picked = *done.rendering->picked;
  if (!picked.object) return fmt::format("pixel {}: background\n", flags.pick);
  const std::string part = picked.polygon   ? fmt::format("polygon {} of ", *picked.polygon + 1)
                           : picked.section ? fmt::format("section {} of ", *picked.section + 1)
                                            : "";
  return fmt::format("pixel {}: index {}, {}object {} '{}'{}\n", flags.pick, picked.number, part, *picked.object + 1,
                     printable(done.scene->objects[*picked.object].name),
                     picked.polygon ? "" : "; the index does not identify a single polygon");
}

Json render_json(const RenderFlags& flags, const FinishedRender& done) {
  const Rendering& r = *done.rendering;
  Json names = Json::array();
  for (const auto& file : done.files) names.push_back(file.string());
  Json out{{"command", "render"},
           {"version", NINEBIT_VERSION},
           {"technique", flags.scene.technique},
           {"profile", flags.common.profile},
           {"scene", flags.scene.file},
           {"triangles", done.scene->triangles.size()},
           {"size", {done.settings.width / flags.supersample, done.settings.height / flags.supersample}},
           {"supersample", flags.supersample},
           {"map_size", done.settings.map_size},
           {"settings", settings_json(flags.scene.technique, done.settings)},
           {"index", index_json(done.settings, r)},
           {"pixels", {{"background", r.background}, {"lit", r.lit}, {"shadowed", r.shadowed}}},
           {"time_ms", time_json(done)},
           {"facts", facts_json(r)},
           {"ignored", done.ignored},
           {"files", std::move(names)},
           {"hash", hash_json(r)}};
  for (const auto& [file, hash] : done.frames) out["frames"].push_back({{"file", file}, {"color", hash}});
  if (r.picked) out["pick"] = pick_json(flags, *done.scene, *r.picked);
  if (done.truth) out["errors"] = errors_json(flags, done);
  return out;
}

namespace {

constexpr std::size_t kLargestManifest = std::size_t{1} << 20;
constexpr std::size_t kMostNames = 10'000;

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string stem_of(const std::string& name) {
  return name.substr(0, name.rfind('.'));
}

// A name of a file in the folder itself.
bool is_plain(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

}  // namespace

Result<std::vector<std::string>> chosen_files(const Rendering& rendering, const std::string& only) {
  if (only.empty()) return file_names(rendering, NamedFiles::unasked);
  const std::vector<std::string> names = file_names(rendering, NamedFiles::all);
  std::vector<std::string> chosen;
  for (std::size_t start = 0; start <= only.size();) {
    const std::size_t end = std::min(only.find(',', start), only.size());
    const std::string stem = only.substr(start, end - start);
    const std::size_t before = chosen.size();
    for (const std::string& name : names) {
      if (stem_of(name) == stem && !is_in(chosen, name)) chosen.push_back(name);
    }
    const bool known = std::any_of(names.begin(), names.end(), [&](const auto& name) { return stem_of(name) == stem; });
    if (chosen.size() == before && !known) {
      std::vector<std::string> stems;
      for (const std::string& name : names) {
        if (!is_in(stems, stem_of(name))) stems.push_back(stem_of(name));
      }
      return Diagnostic{.message = fmt::format("--only: '{}' is not a file of this rendering; expected {}", stem,
                                               fmt::join(stems, ", "))};
    }
    start = end + 1;
  }
  return chosen;
}

std::vector<std::string> earlier_files(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path path = folder / kManifest;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) return {};
  if (std::filesystem::file_size(path, error) > kLargestManifest || error) return {};
  const std::string text = posix::read_file(path, kLargestManifest, error);
  const nlohmann::json manifest = nlohmann::json::parse(text, nullptr, false);
  if (!manifest.is_object() || manifest.value("ninebit", nlohmann::json()) != "render") return {};
  const auto files = manifest.find("files");
  if (files == manifest.end() || !files->is_array() || files->size() > kMostNames) return {};
  std::vector<std::string> names;
  for (const nlohmann::json& name : *files) {
    if (!name.is_string() || !is_plain(name.get<std::string>())) return {};
    names.push_back(name.get<std::string>());
  }
  return names;
}

Status write_manifest(const std::vector<std::string>& names, StagedFiles& files) {
  const nlohmann::ordered_json manifest{{"ninebit", "render"}, {"version", 1}, {"files", names}};
  std::ofstream out(files.stage(kManifest), std::ios::binary);
  out << manifest.dump(2) << '\n' << std::flush;
  if (out) return {};
  return Diagnostic{
      .message = "cannot be written", .file = files.files().back().string(), .fault = Fault::cannot_write};
}

std::vector<std::filesystem::path> remove_earlier(const std::filesystem::path& folder,
                                                  const std::vector<std::string>& earlier,
                                                  const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> removed;
  for (const std::string& name : earlier) {
    if (is_in(names, name) || name == kManifest) continue;
    const std::filesystem::path path = folder / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) continue;
    if (std::filesystem::remove(path, error)) removed.push_back(path);
  }
  return removed;
}

namespace {

glm::vec3 turned_about_y(const glm::vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const glm::dvec3 d(v);
  return glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

}  // namespace

Camera turned(const Camera& camera, int number, int count) {
  if (number == 0) return camera;
  const double angle = 2.0 * std::numbers::pi * number / count;
  Camera out = camera;
  out.position = camera.look_at + turned_about_y(camera.position - camera.look_at, angle);
  out.up = turned_about_y(camera.up, angle);
  return out;
}

Status draw_turntable(const RenderFlags& flags, StagedFiles* files, const Progress& step, FinishedRender& done) {
  Scene scene = *done.scene;
  const Camera first = scene.cameras[0];
  const int digits = flags.turntable > 1000 ? 4 : 3;
  for (int i = 0; i < flags.turntable; ++i) {
    scene.cameras[0] = turned(first, i, flags.turntable);
    const auto progress = [&](std::string_view, double share) {
      return step(fmt::format("frame {} of {}", i + 1, flags.turntable), (i + share) / flags.turntable);
    };
    auto rendering = render_scene(flags.scene, scene, done.settings, progress);
    if (!rendering) return rendering.error();
    const std::string name = fmt::format("color_{:0{}}.png", i, digits);
    Image8 picture = averaged(color_picture(*rendering), flags.supersample);
    const Status written = files != nullptr ? write_png(files->stage(name), picture) : Status();
    if (!written) {
      Diagnostic fault = written.error();
      fault.file = files->files().back().string();
      return fault;
    }
    give_picture("frames", std::move(picture));
    done.frames.push_back({name, picture_hashes(*rendering)[0].second});
    if (i == 0) done.rendering.emplace(std::move(*rendering));
  }
  return {};
}

}  // namespace ninebit::tools
