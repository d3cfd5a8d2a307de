// Reads the passes of an effect.
#include "src/effect/effect_reader.h"
#include "src/language/json/json_texture_shader.h"

namespace ninebit::effect_detail {
namespace {

using json::Type;
using json::Value;

constexpr double kHuge = 1e12;

// Three colours in [0, 1].
void read_fog(EffectReader& read, const Value& value, EffectFog& fog) {
  if (!read.reader().object(value, {"factor", "color"})) return;
  read.with(value, "factor", [&](const Value& v) { read.parsed(v, &parse_fog, fog); });
  read.with(value, "color", [&](const Value& v) { read.bytes(v, fog.color); });
}

void read_matrix(EffectReader& read, const Value& value, glm::mat4& matrix) {
  if (value.type != Type::array || value.children.size() != 4) {
    return read.reader().fault(value.offset, "matrix must be an array of four rows of four numbers");
  }
  for (int row = 0; row < 4; ++row) {
    std::array<float, 4> n{};
    if (read.reals(value.children[static_cast<std::size_t>(row)], 4, -kHuge, kHuge, n, Numbers::moving) == 0) return;
    for (int column = 0; column < 4; ++column) matrix[column][row] = n[static_cast<std::size_t>(column)];
  }
}

void read_units(EffectReader& read, const Value& value, std::array<EffectUnit, kEffectUnits>& units) {
  if (value.type != Type::array || value.children.size() > kEffectUnits) {
    return read.reader().fault(value.offset, "units must be an array of at most 4 texture units");
  }
  for (std::size_t i = 0; i < value.children.size(); ++i) {
    const Value& unit = value.children[i];
    if (unit.type == Type::null) continue;
    if (!read.reader().object(unit, {"texture", "coordinates", "matrix"})) continue;
    if (json::Reader::find(unit, "texture") == nullptr) {
      read.reader().fault(unit.offset, "the key \"texture\" is missing; use null for a unit that is off");
    }
    read.with(unit, "texture", [&](const Value& v) { read.text(v, units[i].texture); });
    read.with(unit, "coordinates",
              [&](const Value& v) { read.parsed(v, &parse_coordinate_source, units[i].coordinates); });
    read.with(unit, "matrix", [&](const Value& v) { read_matrix(read, v, units[i].coordinates.matrix); });
  }
}

void read_constant_pair(EffectReader& read, const Value& value, EffectConstants::Pair& constants) {
  const auto color = [&](const Value& v, std::optional<ColorF>& into) {
    ColorF n{};
    if (read.reals(v, 4, 0.0, 1.0, n, Numbers::moving) != 0) into = n;
  };
  read.with(value, "const0", [&](const Value& v) { color(v, constants[0]); });
  read.with(value, "const1", [&](const Value& v) { color(v, constants[1]); });
}

void read_constants(EffectReader& read, const Value& value, EffectConstants& constants) {
  if (!read.reader().object(value, {"const0", "const1", "combiners"})) return;
  read_constant_pair(read, value, constants.global);
  read.with(value, "combiners", [&](const Value& list) {
    if (list.type != Type::array || list.children.size() > constants.of_combiner.size()) {
      return read.reader().fault(list.offset, "combiners must be an array of at most 8 general combiners");
    }
    for (std::size_t i = 0; i < list.children.size(); ++i) {
      const Value& combiner = list.children[i];
      if (combiner.type == Type::null || !read.reader().object(combiner, {"const0", "const1"})) continue;
      read_constant_pair(read, combiner, constants.of_combiner[i]);
    }
  });
}

void read_clear(EffectReader& read, const Value& value, EffectClear& clear) {
  if (!read.reader().object(value, {"color", "depth", "stencil"})) return;
  read.with(value, "color", [&](const Value& v) {
    clear.color = true;
    read.bytes(v, clear.values.color);
  });
  read.with(value, "depth", [&](const Value& v) {
    clear.depth = true;
    float depth = 1.0F;
    read.real(v, 0.0, 1.0, depth);
    clear.values.depth = static_cast<double>(depth);
  });
  read.with(value, "stencil", [&](const Value& v) {
    clear.stencil = true;
    read.reader().integer(v, 0, 255, clear.values.stencil);
  });
}

void read_stencil(EffectReader& read, const Value& value, StencilTest& test) {
  if (!read.reader().object(value, {"function", "reference", "mask", "write_mask", "fail", "depth_fail", "pass"})) {
    return;
  }
  test.enabled = true;
  StencilFace& face = test.front;
  const auto operation = [&](std::string_view key, StencilOperation& into) {
    read.with(value, key, [&](const Value& v) { read.word(v, kStencilOperations, "stencil operation", into); });
  };
  read.with(value, "function",
            [&](const Value& v) { read.word(v, kCompareFunctions, "comparison function", face.function); });
  read.with(value, "reference", [&](const Value& v) { read.reader().integer(v, 0, 255, face.reference); });
  read.with(value, "mask", [&](const Value& v) { read.byte(v, face.mask); });
  read.with(value, "write_mask", [&](const Value& v) { read.byte(v, face.write_mask); });
  operation("fail", face.fail);
  operation("depth_fail", face.depth_fail);
  operation("pass", face.depth_pass);
}

void read_depth(EffectReader& read, const Value& value, DepthTest& test) {
  if (value.type == Type::null) {
    test.enabled = false;
    return;
  }
  if (!read.reader().object(value, {"function", "write"})) return;
  test.enabled = true;
  read.with(value, "function",
            [&](const Value& v) { read.word(v, kCompareFunctions, "comparison function", test.function); });
  read.with(value, "write", [&](const Value& v) { read.reader().boolean(v, test.write); });
}

void read_alpha_test(EffectReader& read, const Value& value, AlphaTest& test) {
  if (!read.reader().object(value, {"function", "reference"})) return;
  test.enabled = true;
  read.with(value, "function",
            [&](const Value& v) { read.word(v, kCompareFunctions, "comparison function", test.function); });
  read.with(value, "reference", [&](const Value& v) { read.byte(v, test.reference); });
}

void read_blend(EffectReader& read, const Value& value, Blend& blend) {
  if (!read.reader().object(value, {"source", "destination", "equation", "color"})) return;
  blend.enabled = true;
  read.with(value, "source", [&](const Value& v) { read.word(v, kBlendFactors, "blend factor", blend.source); });
  read.with(value, "destination",
            [&](const Value& v) { read.word(v, kBlendFactors, "blend factor", blend.destination); });
  read.with(value, "equation",
            [&](const Value& v) { read.word(v, kBlendEquations, "blend equation", blend.equation); });
  read.with(value, "color", [&](const Value& v) { read.bytes(v, blend.color); });
}

// "rgba", "rgb", "a", …, or "none".
void read_color_mask(EffectReader& read, const Value& value, std::array<bool, 4>& mask) {
  std::string text;
  read.text(value, text);
  if (text.empty()) return;
  mask = {false, false, false, false};
  if (text == "none") return;
  for (const char c : text) {
    const std::size_t component = std::string_view("rgba").find(c);
    if (component == std::string_view::npos || mask[component]) {
      return read.reader().fault(value.offset, json::in_quotes(text) +
                                                   " is not a colour mask; expected the letters of the components "
                                                   "that are written, such as rgb, or none");
    }
    mask[component] = true;
  }
}

void read_polygon_offset(EffectReader& read, const Value& value, PolygonOffset& offset) {
  std::array<float, 2> n{};
  if (read.reals(value, 2, -kHuge, kHuge, n) == 0) return;
  offset.fill = offset.line = offset.point = true;
  offset.factor = n[0];
  offset.units = n[1];
}

// How polygons are drawn; both faces alike.
void read_polygons(EffectReader& read, const Value& value, PipelineState& state) {
  read.with(value, "polygon_mode", [&](const Value& v) {
    read.word(v, kPolygonModes, "polygon mode", state.front_mode);
    state.back_mode = state.front_mode;
  });
  read.with(value, "point_size", [&](const Value& v) { read.real(v, 0.0, 64.0, state.point_size); });
  read.with(value, "line_width", [&](const Value& v) { read.real(v, 0.125, 64.0, state.line_width); });
  read.with(value, "polygon_smooth", [&](const Value& v) { read.reader().boolean(v, state.polygon_smooth); });
  read.with(value, "line_smooth", [&](const Value& v) { read.reader().boolean(v, state.line_smooth); });
  read.with(value, "polygon_stipple",
            [&](const Value& v) { read.parsed(v, &parse_polygon_stipple, state.polygon_stipple.emplace()); });
  read.with(value, "polygon_offset", [&](const Value& v) { read_polygon_offset(read, v, state.polygon_offset); });
}

void read_fragment_state(EffectReader& read, const Value& value, PipelineState& state) {
  read.with(value, "shade", [&](const Value& v) { read.word(v, kShadeModels, "shade model", state.shade_model); });
  read.with(value, "cull", [&](const Value& v) { read.word(v, kCullFaces, "face to cull", state.cull_face); });
  read.with(value, "color_mask", [&](const Value& v) { read_color_mask(read, v, state.color_mask); });
  if (const Value* const depth = json::Reader::find(value, "depth")) read_depth(read, *depth, state.depth_test);
  read.with(value, "alpha_test", [&](const Value& v) { read_alpha_test(read, v, state.alpha_test); });
  read.with(value, "stencil", [&](const Value& v) { read_stencil(read, v, state.stencil_test); });
  read.with(value, "blend", [&](const Value& v) { read_blend(read, v, state.blend); });
}

// Checked for the effect's profile, or for the NV2A, which has all operations; rasterize() checks another one.
void read_stages(EffectReader& read, const Value& value, const Effect& effect, TextureShaderState& into) {
  const HardwareProfile* const own = find_profile(effect.profile);
  const json::PlacedTextureShader stages = json::read_texture_shader(value, read.reader());
  json::check_texture_shader(stages, own != nullptr ? *own : profiles::nv2a, read.reader());
  into = stages.state;
}

}  // namespace

EffectPass read_pass(EffectReader& read, const Value& value, const Effect& effect) {
  EffectPass pass;
  if (!read.reader().object(value, {"name",          "draw",       "view",           "target",      "program",
                                    "constants",     "units",      "texture_shader", "primary",     "secondary",
                                    "fog",           "clear",      "shade",          "cull",        "color_mask",
                                    "depth",         "alpha_test", "stencil",        "blend",       "polygon_mode",
                                    "point_size",    "line_width", "polygon_smooth", "line_smooth", "polygon_stipple",
                                    "polygon_offset"})) {
    return pass;
  }
  pass.geometry = !effect.scene.mesh.empty() ? EffectGeometry::mesh : EffectGeometry::rectangle;
  read.with(value, "draw", [&](const Value& v) { read.word(v, kGeometries, "geometry", pass.geometry); });
  pass.state.depth_test.enabled = pass.geometry == EffectGeometry::mesh;
  read.with(value, "name", [&](const Value& v) { read.text(v, pass.name); });
  read.with(value, "view", [&](const Value& v) { read.word(v, kViews, "view", pass.view); });
  read.with(value, "target", [&](const Value& v) { read.text(v, pass.target); });
  read.with(value, "program", [&](const Value& v) {
    read.text(v, pass.program);
    read.check_file(v, pass.program);
  });
  read.with(value, "constants", [&](const Value& v) { read_constants(read, v, pass.constants); });
  read.with(value, "units", [&](const Value& v) { read_units(read, v, pass.units); });
  read.with(value, "texture_shader", [&](const Value& v) { read_stages(read, v, effect, pass.state.texture_shader); });
  read.with(value, "primary", [&](const Value& v) { read.parsed(v, &parse_color_source, pass.primary); });
  read.with(value, "secondary", [&](const Value& v) { read.parsed(v, &parse_color_source, pass.secondary); });
  read.with(value, "fog", [&](const Value& v) { read_fog(read, v, pass.fog); });
  read.with(value, "clear", [&](const Value& v) { read_clear(read, v, pass.clear); });
  read_polygons(read, value, pass.state);
  read_fragment_state(read, value, pass.state);
  return pass;
}

}  // namespace ninebit::effect_detail
