#include "src/tools/compare/compare_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ninebit/frame/pictures.h"
#include "ninebit/image/image_io.h"
#include "src/shadow/ground_truth/cause_plane.h"
#include "src/system/hashing/base64.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/picture_hashes.h"

namespace ninebit::tools {

namespace {

Status judge_row(const std::string& name, const Rendering& rendering, const RenderSettings& settings,
                 const GroundTruthScene& rays, const Progress& progress, ComparedRow& row) {
  if (!rendering.evidence) return {};
  const auto truth = measure(rays, settings, rendering, progress);
  if (!truth) return truth.error();
  ComparedErrors errors{.false_lit = truth->false_lit, .false_shadowed = truth->false_shadowed};
  for (const ErrorCause cause : causes_of(*rendering.evidence)) {
    errors.by_cause.emplace_back(name_of(cause), truth->by_cause[static_cast<std::size_t>(cause)]);
  }
  Image8 causes = cause_plane(*truth, settings.width, settings.height);
  auto plane = encode_png(causes);
  if (!plane) return plane.error();
  give_picture("wrong " + name, std::move(causes));
  row.wrong = std::move(*plane);
  row.errors = std::move(errors);
  return {};
}

Json errors_of_row(const ComparedErrors& errors) {
  Json by_cause = Json::object();
  for (const auto& [cause, count] : errors.by_cause) by_cause[cause] = count;
  return {{"wrong", errors.false_lit + errors.false_shadowed},
          {"false_lit", errors.false_lit},
          {"false_shadowed", errors.false_shadowed},
          {"by_cause", std::move(by_cause)}};
}

// The most texture units that a pass reads which marks shadows; null if it is computed in floats, or if there is none.
Json comparison_units(const std::vector<DrawnPass>& drawn) {
  std::optional<int> most;
  for (const DrawnPass& pass : drawn) {
    if (!pass.marks_shadows) continue;
    if (!pass.texture_units) return {};
    most = std::max(most.value_or(0), *pass.texture_units);
  }
  return most ? Json(*most) : Json();
}

Json row_json(const ComparedPoint& point, const ComparedRow& row) {
  Json varied = Json::object(), hashes = Json::object();
  for (const auto& [flag, value] : point.varied) varied[flag] = value;
  for (const auto& [name, hash] : row.hashes) hashes[name] = hash;
  Json out{{"name", point.name},
           {"technique", point.scene.technique},
           {"profile", point.common.profile},
           {"varied", std::move(varied)}};
  if (!row.refused.empty()) {
    out["refused"] = row.refused;
    return out;
  }
  out["pixels"] = {{"background", row.background}, {"lit", row.lit}, {"shadowed", row.shadowed}};
  out["errors"] = row.errors ? errors_of_row(*row.errors) : Json();
  const PassTimes& pass = row.times;
  out["time_ms"] = {{"transform", pass.transform},     {"maps", pass.maps},
                    {"camera", pass.camera},           {"compare", pass.compare},
                    {"shade", pass.lit + pass.shadow}, {"total", total_ms(pass)}};
  out["texture_units"] = comparison_units(row.drawn);
  out["passes"] = row.drawn.size();
  out["drawn"] = Json::array();
  for (const DrawnPass& drawn : row.drawn) out["drawn"].push_back(drawn.name);
  out["map_bytes"] = row.map_bytes;
  out["hash"] = std::move(hashes);
  return out;
}

}  // namespace

double total_ms(const PassTimes& times) {
  return times.transform + times.maps + times.camera + times.compare + times.lit + times.shadow;
}

Result<ComparedRow> compared_row(const ComparedPoint& point, const Scene& scene, const GroundTruthScene& rays,
                                 const Progress& progress) {
  ComparedRow row;
  RenderSettings settings = settings_of(point.scene, point.common);
  settings.evidence = true;
  const auto part = [&](double from, double share) {
    return [&progress, from, share](std::string_view pass, double done) { return progress(pass, from + share * done); };
  };
  {
    const auto judged = render_scene(point.scene, scene, settings, part(0.0, 0.4));
    if (!judged && judged.error().fault != Fault::invalid_input) return judged.error();
    if (!judged) {
      row.refused = judged.error().message;
      return row;
    }
    if (Status done = judge_row(point.name, *judged, settings, rays, part(0.4, 0.3), row); !done) return done.error();
  }
  // Rendered again, because keeping the evidence takes time of its own.
  settings.evidence = false;
  const auto rendering = render_scene(point.scene, scene, settings, part(0.7, 0.3));
  if (!rendering) return rendering.error();
  row.background = rendering->background;
  row.lit = rendering->lit;
  row.shadowed = rendering->shadowed;
  row.times = rendering->times;
  row.drawn = rendering->drawn;
  row.map_bytes = rendering->map_bytes;
  row.hashes = picture_hashes(*rendering);
  Image8 picture = color_picture(*rendering);
  auto color = encode_png(picture);
  if (!color) return color.error();
  give_picture("color " + point.name, std::move(picture));
  row.color = std::move(*color);
  return row;
}

Json compare_json(const CompareFlags& flags, const Comparison& comparison) {
  Json rows = Json::array(), left_out = Json::array();
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    rows.push_back(row_json(comparison.compared.points[i], comparison.rows[i]));
  }
  for (const LeftOut& one : comparison.compared.left_out) {
    left_out.push_back({{"technique", one.technique}, {"reason", one.reason}});
  }
  return {{"command", "compare"},
          {"version", NINEBIT_VERSION},
          {"profile", flags.common.profile},
          {"scene", flags.scene.file},
          {"triangles", comparison.triangles},
          {"size", {comparison.width, comparison.height}},
          {"light", comparison.light},
          {"vary", flags.vary},
          {"rows", std::move(rows)},
          {"left_out", std::move(left_out)},
          {"ignored", comparison.ignored}};
}

namespace {

std::string picture_url(const std::string& png) {
  return "data:image/png;base64," + base64(png);
}

// The page's data without the character '<', so that nothing in it can end a <script> element.
std::string page_json(const CompareFlags& flags, const Comparison& comparison) {
  Json data = compare_json(flags, comparison);
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparedRow& row = comparison.rows[i];
    if (!row.color.empty()) data["rows"][i]["color"] = picture_url(row.color);
    if (!row.wrong.empty()) data["rows"][i]["wrong_pixels"] = picture_url(row.wrong);
  }
  data["causes"] = Json::array();
  for (std::size_t cause = 0; cause < kErrorCauses; ++cause) {
    data["causes"].push_back(name_of(static_cast<ErrorCause>(cause)));
  }
  std::string text;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";  // in JSON, '<' occurs only in strings
    } else {
      text += c;
    }
  }
  return text;
}

// A module without its lines of imports: on the page all modules are one.
std::string without_imports(std::string_view module) {
  std::string text;
  while (!module.empty()) {
    const std::size_t end = std::min(module.find('\n'), module.size() - 1) + 1;
    if (!module.starts_with("import ")) text += module.substr(0, end);
    module.remove_prefix(end);
  }
  return text;
}

}  // namespace

std::string compare_page(const CompareFlags& flags, const Comparison& comparison) {
  // The policy makes browsers refuse all external resources.
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" href=\"data:,\">\n"
      "<title>Comparison – ninebit</title>\n<style>\n";
  page += kCompareStyle;
  page += "</style>\n</head>\n<body>\n<noscript>This page needs JavaScript. report.json has its figures.</noscript>\n";
  page += fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n<script type=\"module\">\n",
                      page_json(flags, comparison));
  page += kPictureSwipe;
  page += kSortableTable;
  page += kWrongPixels;
  page += without_imports(kCompareScript);
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace ninebit::tools
