#include "src/tools/render/render_answer.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "src/system/number_list.h"
#include "src/tools/common/index_order.h"
#include "src/tools/common/picture_hashes.h"
#include "src/tools/common/technique_flags.h"
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

Json errors_json(const ShadowEvidence& evidence, const GroundTruth& truth) {
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
  if (flags.ground_truth) text += error_line(r, done.truth);
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
  if (done.truth) out["errors"] = errors_json(*r.evidence, *done.truth);
  return out;
}

}  // namespace ninebit::tools
