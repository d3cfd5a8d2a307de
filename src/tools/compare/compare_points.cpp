#include "src/tools/compare/compare_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "ninebit/frame/pictures.h"
#include "ninebit/image/image_io.h"
#include "ninebit/numerics/profile_fields.h"
#include "src/shadow/ground_truth/judge.h"
#include "src/system/nearest_name.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/given_pictures.h"
#include "src/tools/common/picture_hashes.h"
#include "src/tools/common/technique_flags.h"
#include "src/tools/trace/trace_page.h"

namespace ninebit::tools {
namespace {

// Varied like a flag: this chip, and the same chip with exact combiners.
constexpr const char* kArithmeticFlag = "arithmetic";
constexpr std::string_view kExact = "exact";

// One --vary.
struct VariedFlag {
  std::string flag;  // without dashes
  std::vector<std::string> values;
};

std::vector<std::string> flags_to_vary() {
  std::vector<std::string> names{"technique", "profile", kArithmeticFlag};
  for (const TechniqueSetting& setting : technique_settings()) names.emplace_back(setting.name);
  return names;
}

// The values of the flag's list: separated by semicolons if they contain commas; whole numbers may have ranges.
std::vector<std::string> values_of(const std::string& flag, std::string_view list) {
  const TechniqueSetting* const setting = find_technique_setting(flag);
  if (setting == nullptr) return items_of(list);
  const bool has_commas = setting->numbers > 1 || setting->kind == SettingKind::files;
  const auto range = setting->kind == SettingKind::whole ? whole_numbers_in(list) : std::nullopt;
  if (!range) return items_of(list, has_commas ? ';' : ',');
  std::vector<std::string> values;
  for (const int n : *range) values.push_back(std::to_string(n));
  return values;
}

[[noreturn]] void refuse_vary(const std::string& text, const std::string& why) {
  throw CLI::ValidationError(fmt::format("--vary {}: {}", text, why));
}

VariedFlag varied_flag(const std::string& text) {
  const std::size_t equals = text.find('=');
  std::string flag = text.substr(0, equals);
  flag.erase(0, std::min(flag.find_first_not_of('-'), flag.size()));
  const std::vector<std::string> known = flags_to_vary();
  if (equals == std::string::npos || equals + 1 == text.size()) {
    refuse_vary(text, "expected FLAG=VALUE,VALUE, such as index-step=1,2,3");
  }
  if (std::find(known.begin(), known.end(), flag) == known.end()) {
    refuse_vary(text, fmt::format("'{}' cannot be varied; expected one of {}{}", flag, fmt::join(known, ", "),
                                  did_you_mean(flag, known)));
  }
  VariedFlag varied{flag, values_of(flag, std::string_view(text).substr(equals + 1))};
  for (auto value = varied.values.begin(); value != varied.values.end(); ++value) {
    if (value->empty()) refuse_vary(text, "a value is empty; expected a value before and after each separator");
    if (std::find(varied.values.begin(), value, *value) != value) {
      refuse_vary(text, fmt::format("'{}' is given twice; expected each value once", *value));
    }
    if (flag == kArithmeticFlag && *value != kExact && *value != "chip") {
      refuse_vary(text, fmt::format("'{}' is not an arithmetic; expected chip or exact", *value));
    }
  }
  return varied;
}

std::vector<VariedFlag> varied_flags(const CompareFlags& flags) {
  std::vector<VariedFlag> all;
  for (const std::string& text : flags.vary) {
    VariedFlag varied = varied_flag(text);
    for (const VariedFlag& other : all) {
      if (other.flag == varied.flag) refuse_vary(text, "this flag is varied twice; expected one list");
    }
    for (const CLI::Option* option : flags.scene_options) {
      if (option->get_name() == "--" + varied.flag && option->count() > 0) {
        refuse_vary(text, fmt::format("--{} is also given; expected one of them", varied.flag));
      }
    }
    all.push_back(std::move(varied));
  }
  return all;
}

// Parses the flags as `render` does. Throws CLI::ParseError.
ComparedPoint parse_point(std::vector<std::string> arguments) {
  ComparedPoint point;
  CLI::App verb;
  add_common_flags(verb, point.common);
  add_scene_file(verb, "scene", point.scene);
  add_scene_flags(verb, point.scene);
  point.arguments = arguments;
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the end
  verb.parse(arguments);
  return point;
}

void complete_point(const CompareFlags& flags, const LightKinds& kinds, ComparedPoint& point) {
  point.scene.file = flags.scene.file;
  point.scene.allow_outside = flags.scene.allow_outside;
  point.scene.up = flags.scene.up;
  point.scene.light_kinds = kinds;
}

// A technique that has no support for a spot light, but for a point light.
bool takes_only_point(std::string_view technique) {
  const Technique* const found = find_technique(technique);
  return found != nullptr && found->lights.point && !found->lights.spot;
}

std::string_view technique_of(const std::vector<std::string>& arguments) {
  constexpr std::string_view kFlag = "--technique=";
  for (const std::string& argument : arguments) {
    if (argument.starts_with(kFlag)) return std::string_view(argument).substr(kFlag.size());
  }
  return {};
}

// A flag that a point light does not read.
bool is_of_beam(const std::string& argument) {
  return argument.starts_with("--light-type=") || argument.starts_with("--light-target=") ||
         argument.starts_with("--spot-angle=");
}

ComparedPoint varied_point(const CompareFlags& flags, const LightKinds& kinds, const std::vector<VariedFlag>& varied,
                           std::size_t number, std::vector<std::string> arguments) {
  std::vector<std::pair<std::string, std::string>> values;
  for (auto flag = varied.rbegin(); flag != varied.rend(); ++flag) {
    values.emplace_back(flag->flag, flag->values[number % flag->values.size()]);
    number /= flag->values.size();
  }
  std::reverse(values.begin(), values.end());
  std::vector<std::string> words;
  bool exact = false;
  for (const auto& [flag, value] : values) {
    if (flag == kArithmeticFlag) {
      exact = value == kExact;
    } else {
      arguments.push_back(fmt::format("--{}={}", flag, value));
    }
    words.push_back(flag == "technique" ? value : fmt::format("{} {}", flag, value));
  }
  const std::string name = fmt::format("{}", fmt::join(words, ", "));
  const bool may_be_spot = flags.scene.light_type.empty() || flags.scene.light_type == "spot";
  const bool as_point = may_be_spot && !kinds.point && takes_only_point(technique_of(arguments));
  if (as_point) std::erase_if(arguments, is_of_beam);
  try {
    ComparedPoint point = parse_point(std::move(arguments));
    point.as_point = as_point;
    point.exact = exact;
    point.name = name;
    point.varied = std::move(values);
    return point;
  } catch (const CLI::ParseError& error) {
    throw CLI::ValidationError(fmt::format("--vary {}: {}", fmt::join(flags.vary, " --vary "), error.what()));
  }
}

std::size_t pixels_of_size(const CompareFlags& flags) {
  const RenderSettings settings = settings_of(flags.scene, flags.common);
  return static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
}

}  // namespace

RenderSettings settings_of(const ComparedPoint& point) {
  RenderSettings settings = settings_of(point.scene, point.common);
  if (point.exact) settings.profile = with_exact_combiners(settings.profile);
  return settings;
}

const char* light_kind_name(LightKind kind) {
  return kind == LightKind::point ? "point" : kind == LightKind::spot ? "spot" : "directional";
}

LightKinds light_kinds_of(const CompareFlags& flags) {
  LightKinds kinds{.point = true, .spot = true, .directional = true};
  if (flags.vary.empty()) return kinds;
  std::vector<std::string> names{flags.scene.technique};
  for (const VariedFlag& varied : varied_flags(flags)) {
    if (varied.flag == "technique") names = varied.values;
  }
  for (const std::string& name : names) {
    const Technique* technique = find_technique(name);
    if (technique == nullptr) continue;  // varied_points reports it
    kinds.point = kinds.point && technique->lights.point;
    kinds.spot = kinds.spot && technique->lights.spot;
    kinds.directional = kinds.directional && technique->lights.directional;
  }
  if (kinds.point || kinds.spot || kinds.directional) return kinds;
  const auto takes_spot = [](const std::string& name) {
    const Technique* const technique = find_technique(name);
    return technique == nullptr || technique->lights.spot || technique->lights.point;
  };
  if (std::all_of(names.begin(), names.end(), takes_spot)) return {.point = false, .spot = true, .directional = false};
  throw CLI::ValidationError(
      fmt::format("--vary technique={}: no kind of light is supported by all of them; expected techniques that share "
                  "one",
                  fmt::join(names, ",")));
}

ComparedPoints varied_points(const CompareFlags& flags) {
  const LightKinds kinds = light_kinds_of(flags);
  const std::vector<VariedFlag> varied = varied_flags(flags);
  std::size_t count = 1;
  for (const VariedFlag& flag : varied) {
    count *= flag.values.size();
    if (count <= kMostCompared && count * pixels_of_size(flags) <= kMostComparedPixels) continue;
    throw CLI::ValidationError(
        fmt::format("--vary {}: more than {} pictures, or {} pixels in all of them; expected fewer values or a "
                    "smaller --size",
                    fmt::join(flags.vary, " --vary "), kMostCompared, kMostComparedPixels));
  }
  std::vector<std::string> arguments =
      given_arguments(flags.common, flags.scene_options, [](const std::string&) { return true; });
  const bool names_technique =
      std::any_of(varied.begin(), varied.end(), [](const VariedFlag& flag) { return flag.flag == "technique"; });
  if (!names_technique) arguments.push_back("--technique=" + flags.scene.technique);
  ComparedPoints all;
  for (std::size_t i = 0; i < count; ++i) {
    all.points.push_back(varied_point(flags, kinds, varied, i, arguments));
    complete_point(flags, kinds, all.points.back());
  }
  return all;
}

Result<bool> spot_holds_picture(const CompareFlags& flags, const Scene& scene) {
  RenderSettings settings = settings_of(flags.scene, flags.common);
  settings.evidence = true;
  const auto rendering = find_technique("shadow-volume")->render(scene, settings, {});  // it supports every light
  if (!rendering) return rendering.error();
  const auto rays = GroundTruthScene::make(scene);
  if (!rays) return rays.error();
  return Judge(rays->rays(), settings, *rendering).spot_holds_picture();
}

Result<ComparedPoints> technique_points(const CompareFlags& flags, LightKind light, bool holds_picture) {
  const LightKinds kinds{.point = light == LightKind::point,
                         .spot = light == LightKind::spot,
                         .directional = light == LightKind::directional};
  ComparedPoints all;
  for (const Technique& technique : techniques()) {
    const std::string name(technique.name);
    const bool as_point = light == LightKind::spot && takes_only_point(name);
    if (!technique.lights.has(light) && !(as_point && holds_picture)) {
      all.left_out.push_back({name, fmt::format("no support for a {} light{}", light_kind_name(light),
                                                as_point ? " that does not reach all of the picture" : "")});
      continue;
    }
    if (name == "light-cookie" && flags.scene.cookie.empty()) {
      all.left_out.push_back({name, "requires --cookie FILE"});
      continue;
    }
    SceneFlags own = flags.scene;
    own.technique = name;
    std::vector<std::string> arguments = given_arguments(
        flags.common, flags.scene_options, [&](const std::string& flag) { return reads_flag(own, flag); });
    arguments.push_back("--technique=" + name);
    if (as_point) std::erase_if(arguments, is_of_beam);
    try {
      all.points.push_back(parse_point(std::move(arguments)));
      all.points.back().as_point = as_point;
    } catch (const CLI::ParseError& error) {
      return Diagnostic{.message = error.what()};
    }
    all.points.back().name = name;
    complete_point(flags, kinds, all.points.back());
  }
  for (const CLI::Option* option : flags.scene_options) {
    const auto reads = [&](const ComparedPoint& point) { return reads_flag(point.scene, option->get_name()); };
    if (option->count() == 0 || std::any_of(all.points.begin(), all.points.end(), reads)) continue;
    return Diagnostic{.message = fmt::format("{}: none of the compared techniques reads it; expected flags that one of "
                                             "them reads, or another --light-type",
                                             option->get_name())};
  }
  return all;
}

namespace {

// The flags of the point, without the size; the kind of light is said, as `trace` would choose it by the technique
// alone.
std::vector<std::string> traced_arguments(const ComparedPoint& point, const Light& light) {
  std::vector<std::string> arguments;
  for (const std::string& argument : point.arguments) {
    const bool is_replaced = point.as_point && argument.starts_with("--light=");
    if (!argument.starts_with("--size=") && !is_replaced) arguments.push_back(argument);
  }
  if (point.as_point) {
    arguments.push_back(fmt::format("--light={},{},{}", light.position.x, light.position.y, light.position.z));
  }
  if (point.scene.light_type.empty()) arguments.push_back(fmt::format("--light-type={}", light_kind_name(light.kind)));
  return arguments;
}

// Adds what the commands print for the page.
Status add_trace_texts(CompareFlags::Traces wanted, const ComparedPoint& point, const Scene& scene,
                       const GroundTruthScene& rays, const Progress& progress, std::vector<WrongPixelTrace>& worst) {
  if (wanted == CompareFlags::Traces::none) return {};
  RenderSettings settings = settings_of(point);
  std::vector<WrongPixelTrace*> traced;
  ErrorCause last = ErrorCause::none;
  for (WrongPixelTrace& one : worst) {
    const bool is_first = one.pixel.cause != last;
    last = one.pixel.cause;
    if (!is_first && wanted != CompareFlags::Traces::all) continue;
    traced.push_back(&one);
    settings.pixels.emplace_back(one.pixel.x, one.pixel.y);
  }
  if (traced.empty()) return {};
  auto texts = judged_pixel_texts(point.scene, point.common, scene, settings, rays, progress);
  if (!texts) return texts.error();
  for (std::size_t i = 0; i < traced.size(); ++i) traced[i]->text = std::move((*texts)[i]);
  return {};
}

Status judge_row(const CompareFlags& flags, const ComparedPoint& point, const Scene& scene, const Rendering& rendering,
                 const RenderSettings& settings, const GroundTruthScene& rays, const Progress& progress,
                 ComparedRow& row) {
  if (!rendering.evidence) return {};
  const auto truth = measure(rays, settings, rendering, progress);
  if (!truth) return truth.error();
  ComparedErrors errors{.false_lit = truth->false_lit, .false_shadowed = truth->false_shadowed};
  for (const ErrorCause cause : causes_of(*rendering.evidence)) {
    errors.by_cause.emplace_back(name_of(cause), truth->by_cause[static_cast<std::size_t>(cause)]);
  }
  // No flag of `trace` gives a chip exact combiners, so such a picture has no command.
  if (!point.exact) {
    errors.worst = worst_traces(point.scene, settings, traced_arguments(point, scene.lights[0]), *truth);
  }
  Image8 causes = cause_plane(*truth, settings.width, settings.height);
  auto plane = encode_png(causes);
  if (!plane) return plane.error();
  give_picture("wrong " + point.name, std::move(causes));
  row.wrong = std::move(*plane);
  if (!flags.sheet.empty()) row.error_picture = error_picture(rendering, *truth);
  row.errors = std::move(errors);
  return {};
}

Json errors_of_row(const ComparedErrors& errors) {
  Json by_cause = Json::object();
  for (const auto& [cause, count] : errors.by_cause) by_cause[cause] = count;
  return {{"wrong", errors.false_lit + errors.false_shadowed},
          {"false_lit", errors.false_lit},
          {"false_shadowed", errors.false_shadowed},
          {"by_cause", std::move(by_cause)},
          {"worst", worst_json(errors.worst)}};
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
  out["light"] = light_kind_name(row.light);
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

Result<ComparedRow> compared_row(const CompareFlags& flags, const ComparedPoint& point, const Scene& scene,
                                 const GroundTruthScene& rays, const Progress& progress) {
  ComparedRow row{.light = scene.lights[0].kind};
  RenderSettings settings = settings_of(point);
  settings.evidence = true;
  const auto part = [&](double from, double share) {
    return [&progress, from, share](std::string_view pass, double done) { return progress(pass, from + share * done); };
  };
  {
    const auto judged = render_scene(point.scene, scene, settings, part(0.0, 0.3));
    if (!judged && judged.error().fault != Fault::invalid_input) return judged.error();
    if (!judged) {
      row.refused = judged.error().message;
      return row;
    }
    if (Status done = judge_row(flags, point, scene, *judged, settings, rays, part(0.3, 0.25), row); !done) {
      return done.error();
    }
  }
  if (row.errors) {
    const auto traces = [whole = part(0.55, 0.2)](std::string_view, double done) { return whole("traces", done); };
    Status added = add_trace_texts(flags.traces, point, scene, rays, traces, row.errors->worst);
    if (!added) return added.error();
  }
  // Rendered again, because keeping the evidence takes time of its own.
  settings.evidence = false;
  const auto rendering = render_scene(point.scene, scene, settings, part(0.75, 0.25));
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
  if (!flags.sheet.empty()) row.picture = picture;
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

}  // namespace ninebit::tools
