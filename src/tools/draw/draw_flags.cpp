#include "src/tools/draw/draw_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/effect/generated_meshes.h"
#include "src/effect/effect_words.h"
#include "src/system/number_list.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {

namespace {

using effect_detail::kSamplerWords;

// A validator from a parser of effects.
template <class T>
CLI::Validator parses(Result<T> (*parse)(std::string_view)) {
  return CLI::Validator(
      [parse](std::string& text) {
        const auto parsed = parse(text);
        return parsed ? std::string() : parsed.error().message;
      },
      "");
}

CLI::Validator sets_sampler(Status (*parse)(std::string_view, Sampler&)) {
  return CLI::Validator(
      [parse](std::string& text) {
        Sampler sampler;
        const Status parsed = parse(text, sampler);
        return parsed ? std::string() : parsed.error().message;
      },
      "");
}

// The flags of the scene that were given.
void set_scene(const DrawFlags& flags, EffectScene& scene) {
  SceneSetup& setup = scene.setup;
  if (!flags.mesh.empty()) scene.mesh = flags.mesh;
  if (const auto up = up_axis_of(flags.up)) scene.up = up;
  if (const auto p = point_of(flags.camera)) setup.camera = p;
  if (const auto p = point_of(flags.look_at)) setup.look_at = p;
  if (const auto p = point_of(flags.light)) setup.light = p;
  if (const auto p = point_of(flags.light_target)) setup.light_target = p;
  if (flags.fov) setup.fov_degrees = static_cast<float>(*flags.fov);
  if (flags.spot_angle) setup.spot_degrees = static_cast<float>(*flags.spot_angle);
  if (!flags.light_type.empty()) {
    setup.light_kinds = {.point = flags.light_type == "point",
                         .spot = flags.light_type == "spot",
                         .directional = flags.light_type == "directional"};
  }
  if (flags.floor.empty()) return;
  setup.floor = flags.floor == "none"   ? FloorChoice::none
                : flags.floor == "auto" ? FloorChoice::automatic
                                        : FloorChoice::at_height;
  if (setup.floor == FloorChoice::at_height) setup.floor_height = numbers<float>(flags.floor, ',')->at(0);
}

void set_picture(const DrawFlags& flags, Effect& effect) {
  if (const auto format = effect_detail::value_of(effect_detail::kColorFormatWords, flags.color_format)) {
    effect.color_format = *format;
  }
  if (!flags.depth_stencil.empty()) {
    effect.depth_stencil = *effect_detail::value_of(effect_detail::kDepthStencilFormats, flags.depth_stencil);
  }
  if (flags.size.empty()) return;
  const auto size = *numbers<int>(flags.size, 'x');
  effect.width = size[0];
  effect.height = size[1];
}

Status add_unit(const DrawFlags& flags, std::size_t unit, Effect& effect, EffectPass& pass) {
  if (flags.textures[unit].empty()) {
    for (const CLI::Option* const option : flags.unit_options[unit]) {
      if (option->count() == 0) continue;
      return Diagnostic{.message = fmt::format("{} requires --tex{}", option->get_name(), unit)};
    }
    return {};
  }
  EffectTexture texture = parse_texture_source(flags.textures[unit]).value();
  if (!texture.target.empty()) {
    return Diagnostic{.message = fmt::format("--tex{} {}: only effect files have targets", unit, flags.textures[unit])};
  }
  texture.name = fmt::format("tex{}", unit);
  set_sampler(flags, unit, texture.sampler);
  pass.units[unit].texture = texture.name;
  if (!flags.coordinates[unit].empty()) {
    pass.units[unit].coordinates = parse_coordinate_source(flags.coordinates[unit]).value();
  }
  effect.textures.push_back(std::move(texture));
  return {};
}

void set_constants(const DrawFlags& flags, EffectConstants& constants) {
  for (std::size_t i = 0; i < 2; ++i) {
    for (const std::string& text : flags.constants[i]) {
      const auto [combiner, color] = split_constant(text);
      const auto n = *numbers<float>(color, ',');
      const ColorF value{n[0], n[1], n[2], n[3]};
      if (combiner.empty()) {
        constants.global[i] = value;
      } else {
        constants.of_combiner[static_cast<std::size_t>(combiner[0] - '0')][i] = value;
      }
    }
  }
}

void add_polygon_flags(CLI::App& verb, DrawFlags& flags) {
  std::vector<std::string> modes;
  for (const auto& [mode, value] : effect_detail::kPolygonModes) modes.emplace_back(mode);
  verb.add_option("--polygon-mode", flags.polygon_mode, "Draw polygons filled, as outlines or corners (default: fill)")
      ->check(CLI::IsMember(modes));
  verb.add_option("--point-size", flags.point_size, "Size of points (default: 1)")
      ->type_name("PIXELS")
      ->check(real_in_range(0.0, 64.0));
  verb.add_option("--line-width", flags.line_width, "Width of lines (default: 1)")
      ->type_name("PIXELS")
      ->check(real_in_range(0.125, 64.0));
  verb.add_flag("--polygon-smooth", flags.polygon_smooth,
                "Multiply alpha by the part of the pixel that a polygon covers");
  verb.add_flag("--line-smooth", flags.line_smooth, "Multiply alpha by the part of the pixel that a line covers");
  verb.add_option("--polygon-stipple", flags.polygon_stipple,
                  "Pixels of polygons to draw: rows of a pattern that is repeated, as 10,01")
      ->type_name("ROWS")
      ->check(parses(&parse_polygon_stipple));
}

void set_polygons(const DrawFlags& flags, PipelineState& state) {
  if (const auto mode = effect_detail::value_of(effect_detail::kPolygonModes, flags.polygon_mode)) {
    state.front_mode = state.back_mode = *mode;
  }
  if (flags.point_size) state.point_size = static_cast<float>(*flags.point_size);
  if (flags.line_width) state.line_width = static_cast<float>(*flags.line_width);
  state.polygon_smooth = flags.polygon_smooth;
  state.line_smooth = flags.line_smooth;
  if (!flags.polygon_stipple.empty()) state.polygon_stipple = parse_polygon_stipple(flags.polygon_stipple).value();
}

void add_pass_flags(CLI::App& verb, DrawFlags& flags) {
  const std::size_t before = verb.get_options().size();
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    const std::string unit = std::to_string(i);
    verb.add_option("--tex" + unit, flags.textures[i],
                    "Texture " + unit +
                        ": a picture or DDS file, six pictures, normalize-cube:N, checker:N, gradient, "
                        "falloff, or normals:FILE")
        ->type_name("FILE|BUILTIN")
        ->check(parses(&parse_texture_source));
    std::vector<CLI::Option*>& needs_texture = flags.unit_options[i];
    for (std::size_t k = 0; k < kSamplerWords.size(); ++k) {
      const effect_detail::SamplerWord& word = kSamplerWords[k];
      std::string name(word.key);
      std::replace(name.begin(), name.end(), '_', '-');
      needs_texture.push_back(verb.add_option("--" + name + unit, flags.samplers[i][k], std::string(word.help))
                                  ->type_name(std::string(word.type))
                                  ->check(sets_sampler(word.parse)));
    }
    needs_texture.push_back(verb.add_option("--border-color" + unit, flags.border_colors[i],
                                            "Border colour of wrap modes clamp and clamp-to-border")
                                ->type_name("R,G,B,A")
                                ->check(sets_sampler(&parse_border_color)));
    needs_texture.push_back(
        verb.add_flag("--border-texels" + unit, flags.border_texels[i],
                      "The picture holds the texture's border: it has twice its sides, 16 at least"));
    needs_texture.push_back(verb.add_option("--coord" + unit, flags.coordinates[i], "Texture coordinates (default: uv)")
                                ->type_name("SOURCE")
                                ->check(parses(&parse_coordinate_source)));
  }
  verb.add_option("--primary", flags.primary, "Primary colour (default: white)")
      ->type_name("SOURCE")
      ->check(parses(&parse_color_source));
  verb.add_option("--secondary", flags.secondary, "Secondary colour (default: black)")
      ->type_name("SOURCE")
      ->check(parses(&parse_color_source));
  verb.add_option("--fog", flags.fog,
                  "Fog factor: mesh, linear:START,END, exp:DENSITY, exp2:DENSITY, or registers-FUNCTION:BIAS,SLOPE")
      ->type_name("FACTOR")
      ->check(parses(&parse_fog));
  verb.add_option("--fog-color", flags.fog_color, "Fog colour")->type_name("R,G,B")->check(checked_by(&check_rgb));
  for (std::size_t i = 0; i < 2; ++i) {
    verb.add_option("--const" + std::to_string(i), flags.constants[i],
                    "Constant colour, instead of the program's; of one general combiner with its number before it. "
                    "Can be repeated")
        ->type_name("[COMBINER:]R,G,B,A")
        ->allow_extra_args(false)
        ->check(checked_by(&check_constant));
  }
  verb.add_option("--blend", flags.blend, "Blending, as src_alpha,one_minus_src_alpha")
      ->type_name("SOURCE,DESTINATION[,EQUATION]")
      ->check(parses(&parse_blend));
  verb.add_option("--alpha-test", flags.alpha_test, "Alpha test, as greater,127")
      ->type_name("FUNCTION,REFERENCE")
      ->check(parses(&parse_alpha_test));
  verb.add_option("--depth", flags.depth, "Depth test (default: less for a mesh, none for the rectangle)")
      ->type_name("FUNCTION|none")
      ->check(parses(&parse_depth));
  verb.add_option("--cull", flags.cull, "Faces to cull")->check(CLI::IsMember({"none", "back", "front"}));
  verb.add_option("--color-mask", flags.color_mask, "Components to write (default: rgba)")
      ->type_name("LETTERS")
      ->check(parses(&parse_color_mask));
  add_polygon_flags(verb, flags);
  const std::vector<CLI::Option*> all = verb.get_options();
  flags.pass_options.assign(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
}

}  // namespace

void set_sampler(const DrawFlags& flags, std::size_t unit, Sampler& sampler) {
  for (std::size_t i = 0; i < kSamplerWords.size(); ++i) {
    const std::string& text = flags.samplers[unit][i];
    if (!text.empty()) (void)kSamplerWords[i].parse(text, sampler);
  }
  if (!flags.border_colors[unit].empty()) (void)parse_border_color(flags.border_colors[unit], sampler);
  sampler.border_texels = flags.border_texels[unit];
}

std::vector<CLI::Option*> add_moment_flags(CLI::App& verb, EffectMoment& moment) {
  return {verb.add_option("--time", moment.time, "Time of the picture, for effect files that move (default: 0)")
              ->type_name("SECONDS")
              ->check(checked_by(&check_seconds)),
          verb.add_option("--frame", moment.frame, "Number of the picture, for effect files that move (default: 0)")
              ->type_name("N")
              ->check(checked_by(&check_frame))};
}

std::vector<std::string> unused_moment(const std::vector<CLI::Option*>& options, bool moves, const std::string& file) {
  std::vector<std::string> warnings;
  for (const CLI::Option* const option : options) {
    if (moves || option->count() == 0) continue;
    warnings.push_back(
        fmt::format("{} has no effect: no number of {} depends on time or frame", option->get_name(), printable(file)));
  }
  return warnings;
}

void add_draw_flags(CLI::App& verb, DrawFlags& flags) {
  verb.add_option("--size", flags.size,
                  "Picture size in pixels (default: that of the first picture that the rectangle shows; else 512x512)")
      ->type_name("WxH")
      ->check(checked_by(&check_size));
  std::vector<std::string> color_formats;
  for (const ColorFormatFacts& facts : kColorFormats) color_formats.emplace_back(facts.name);
  verb.add_option("--color-format", flags.color_format, "Format of the picture's colours (default: a8r8g8b8)")
      ->check(CLI::IsMember(color_formats));
  std::vector<std::string> formats;
  for (const DepthStencilLayout& layout : kDepthStencilLayouts) formats.emplace_back(layout.name);
  verb.add_option("--depth-stencil", flags.depth_stencil, "Depth and stencil format of the picture (default: d24s8)")
      ->check(CLI::IsMember(formats));
  verb.add_option("--mesh", flags.mesh, "Mesh to draw: a scene file, sphere:N, torus:N, plane:N or cube")
      ->type_name("FILE|BUILTIN")
      ->check(checked_by(&check_file_name));
  add_up_flag(verb, flags.up);
  verb.add_flag("--allow-outside", flags.allow_outside,
                "Also read files that the effect or scene names outside of its folder");
  flags.moment_options = add_moment_flags(verb, flags.moment);
  add_pass_flags(verb, flags);
  const auto point = [&](const char* flag, std::string& text, const char* help) {
    verb.add_option(flag, text, help)->type_name("X,Y,Z")->check(checked_by(&check_point));
  };
  point("--camera", flags.camera, "Camera position");
  point("--look-at", flags.look_at, "Point to look at");
  verb.add_option("--fov", flags.fov, "Vertical field of view, in degrees")
      ->type_name("DEGREES")
      ->check(checked_by(&check_fov));
  point("--light", flags.light, "Light position");
  verb.add_option("--light-type", flags.light_type, "Kind of light (default: point)")
      ->check(CLI::IsMember({"point", "spot", "directional"}));
  point("--light-target", flags.light_target, "Target of a spot or directional light");
  verb.add_option("--spot-angle", flags.spot_angle,
                  "Opening angle of a spot light, in degrees (default: what holds all that the camera sees, or 90 with "
                  "--light-target)")
      ->type_name("DEGREES")
      ->check(checked_by(&check_spot_angle));
  verb.add_option("--floor", flags.floor, "Floor below the mesh (default: none)")
      ->type_name("auto|none|HEIGHT")
      ->check(checked_by(&check_floor));
  add_profile_option(verb, "--difference", flags.difference,
                     "Also write where and how much the picture differs on the same chip with exact combiners "
                     "(arithmetic), or under another profile",
                     kArithmetic);
  verb.add_flag("--layers", flags.layers, "Also write every register of every pass to an EXR file");
  verb.add_option("--only", flags.only, "Write only these files (default: all): picture,difference,layers")
      ->type_name("LIST")
      ->check(list_of({"picture", "difference", "layers"}));
}

Result<Effect> effect_of(const DrawFlags& flags) {
  Effect effect;
  EffectPass pass{.name = "draw"};
  set_picture(flags, effect);
  effect.scene.setup.floor = FloorChoice::none;
  set_scene(flags, effect.scene);
  for (const auto& [flag, text] : {std::pair{"--floor", &flags.floor}, std::pair{"--up", &flags.up}}) {
    if (!flags.mesh.empty() || text->empty()) continue;
    return Diagnostic{.message = fmt::format("{} has no effect without --mesh; expected a mesh", flag)};
  }
  pass.program = flags.file;
  pass.geometry = effect.scene.mesh.empty() ? EffectGeometry::rectangle : EffectGeometry::mesh;
  pass.state.depth_test.enabled = pass.geometry == EffectGeometry::mesh;
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (Status added = add_unit(flags, i, effect, pass); !added) return added.error();
  }
  set_constants(flags, pass.constants);
  if (!flags.primary.empty()) pass.primary = parse_color_source(flags.primary).value();
  if (!flags.secondary.empty()) pass.secondary = parse_color_source(flags.secondary).value();
  if (!flags.fog.empty()) pass.fog = parse_fog(flags.fog).value();
  if (!flags.fog_color.empty()) {
    const auto n = *numbers<float>(flags.fog_color, ',');
    for (std::size_t c = 0; c < 3; ++c) pass.fog.color[c] = static_cast<std::uint8_t>(n[c] * 255.0F + 0.5F);
  }
  if (!flags.blend.empty()) pass.state.blend = parse_blend(flags.blend).value();
  if (!flags.alpha_test.empty()) pass.state.alpha_test = parse_alpha_test(flags.alpha_test).value();
  if (!flags.depth.empty()) pass.state.depth_test = parse_depth(flags.depth).value();
  if (!flags.cull.empty()) pass.state.cull_face = *effect_detail::value_of(effect_detail::kCullFaces, flags.cull);
  if (!flags.color_mask.empty()) pass.state.color_mask = parse_color_mask(flags.color_mask).value();
  set_polygons(flags, pass.state);
  effect.passes.push_back(std::move(pass));
  if (const auto faults = check_effect(effect); !faults.empty()) return Diagnostic{.message = faults[0].message};
  return effect;
}

bool writes(const DrawFlags& flags, std::string_view name) {
  return flags.only.empty() || ("," + flags.only + ",").find("," + std::string(name) + ",") != std::string::npos;
}

Status check_files(const DrawFlags& flags) {
  if (flags.only.empty()) return {};
  if (writes(flags, "difference") && flags.difference.name.empty())
    return Diagnostic{.message = "--only difference requires --difference"};
  if (writes(flags, "layers") && !flags.layers) return Diagnostic{.message = "--only layers requires --layers"};
  return {};
}

Status override_effect(const DrawFlags& flags, Effect& effect) {
  for (const CLI::Option* const option : flags.pass_options) {
    if (option->count() == 0) continue;
    return Diagnostic{.message = fmt::format("{} has no effect with an effect file; expected the flags of the size, "
                                             "colour and depth formats, mesh, camera and light",
                                             option->get_name())};
  }
  set_picture(flags, effect);
  if (!flags.mesh.empty()) {
    effect.scene.mesh = is_generated_mesh(flags.mesh) ? flags.mesh : std::filesystem::absolute(flags.mesh).string();
  }
  DrawFlags scene = flags;
  scene.mesh.clear();
  set_scene(scene, effect.scene);
  return {};
}

namespace {

// Parses the given count of numbers from 0 to 1.
std::string check_color(const std::string& text, std::size_t count) {
  const auto n = numbers<float>(text, ',');
  bool valid = n && n->size() == count;
  if (valid) {
    for (const float x : *n) valid = valid && x >= 0.0F && x <= 1.0F;
  }
  return valid ? "" : fmt::format("'{}' is not a colour; expected {} numbers from 0 to 1", text, count);
}

}  // namespace

std::pair<std::string_view, std::string> split_constant(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {{}, std::string(text)};
  return {text.substr(0, colon), std::string(text.substr(colon + 1))};
}

std::string check_constant(const std::string& text) {
  const auto [combiner, color] = split_constant(text);
  const bool numbered = combiner.size() == 1 && combiner[0] >= '0' && combiner[0] < '0' + kMaxGeneralCombiners;
  if (text.find(':') != std::string::npos && !numbered) {
    return fmt::format("'{}' is not a general combiner; expected 0 to {}", combiner, kMaxGeneralCombiners - 1);
  }
  return check_color(color, 4);
}
std::string check_rgb(const std::string& text) {
  return check_color(text, 3);
}

namespace {

std::vector<std::string> comma_words(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace

Result<Blend> parse_blend(std::string_view text) {
  using namespace effect_detail;
  const auto words = comma_words(std::string(text));
  Blend blend{.enabled = true};
  const auto source = value_of(kBlendFactors, words[0]);
  const auto destination = value_of(kBlendFactors, words.size() > 1 ? words[1] : "");
  const auto equation = value_of(kBlendEquations, words.size() > 2 ? words[2] : "add");
  if (!source || !destination || !equation || words.size() > 3) {
    return Diagnostic{.message = fmt::format("'{}' is not a blend; expected SOURCE,DESTINATION[,EQUATION] with the "
                                             "factors {}, and the equation {}",
                                             text, effect_detail::list_of(kBlendFactors),
                                             effect_detail::list_of(kBlendEquations))};
  }
  blend.source = *source;
  blend.destination = *destination;
  blend.equation = *equation;
  return blend;
}

Result<AlphaTest> parse_alpha_test(std::string_view text) {
  using namespace effect_detail;
  const auto words = comma_words(std::string(text));
  const auto function = value_of(kCompareFunctions, words[0]);
  const auto reference = words.size() == 2 ? numbers<int>(words[1], ',') : std::nullopt;
  if (!function || !reference || reference->at(0) < 0 || reference->at(0) > 255) {
    return Diagnostic{.message = fmt::format("'{}' is not an alpha test; expected FUNCTION,REFERENCE with {}, and a "
                                             "reference from 0 to 255",
                                             text, effect_detail::list_of(kCompareFunctions))};
  }
  return AlphaTest{true, *function, static_cast<std::uint8_t>(reference->at(0))};
}

Result<DepthTest> parse_depth(std::string_view text) {
  if (text == "none") return DepthTest{};
  const auto function = effect_detail::value_of(effect_detail::kCompareFunctions, text);
  if (function) return DepthTest{.enabled = true, .function = *function};
  return Diagnostic{.message = fmt::format("'{}' is not a depth test; expected none, {}", text,
                                           effect_detail::list_of(effect_detail::kCompareFunctions))};
}

Result<std::array<bool, 4>> parse_color_mask(std::string_view text) {
  std::array<bool, 4> mask{};
  bool valid = !text.empty();
  for (const char c : text == "none" ? "" : text) {
    const std::size_t component = std::string_view("rgba").find(c);
    valid = valid && component != std::string_view::npos;
    if (valid) mask[component] = true;
  }
  if (valid) return mask;
  return Diagnostic{.message = fmt::format("'{}' is not a colour mask; expected letters of rgba, or none", text)};
}

}  // namespace ninebit::tools
