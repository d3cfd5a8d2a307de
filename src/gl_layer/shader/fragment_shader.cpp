#include "src/gl_layer/shader/fragment_shader.h"

#include "ninebit/language/glsl.h"

namespace ninebit::gl_layer {
namespace {

bool is_depth(TexelKind kind) {
  return kind == TexelKind::depth || kind == TexelKind::depth_in_alpha;
}

bool is_comparison(TexelKind kind) {
  return kind == TexelKind::comparison || kind == TexelKind::comparison_in_alpha;
}

// "2D", "Cube", …; empty for a unit that samples no texture.
std::string dimension_of(UnitSource source) {
  switch (source) {
    case UnitSource::texture_1d:
      return "1D";
    case UnitSource::texture_2d:
      return "2D";
    case UnitSource::texture_rectangle:
      return "2DRect";
    case UnitSource::texture_3d:
      return "3D";
    case UnitSource::texture_cube_map:
      return "Cube";
    default:
      return {};
  }
}

bool can_compare(UnitSource source) {
  return source != UnitSource::texture_3d && source != UnitSource::texture_cube_map;
}

// The texel of a unit: fixed functions divide by q, except for cube maps.
std::string sample(const UnitInput& unit, const std::string& index) {
  const std::string dimension = dimension_of(unit.source), coordinates = "gl_TexCoord[" + index + ']';
  const std::string sampler = "ninebit_texture" + index;
  if (is_comparison(unit.kind) && can_compare(unit.source)) {
    return "shadow" + dimension + "Proj(" + sampler + ", " + coordinates + ')';
  }
  if (unit.source == UnitSource::texture_cube_map) return "textureCube(" + sampler + ", " + coordinates + ".xyz)";
  return "texture" + dimension + "Proj(" + sampler + ", " + coordinates + ')';
}

std::string sampler_type(const UnitInput& unit) {
  const bool compares = is_comparison(unit.kind) && can_compare(unit.source);
  return "sampler" + dimension_of(unit.source) + (compares ? "Shadow" : "");
}

// The lines that set texelI.
std::string texel_lines(const UnitInput& unit, std::size_t i) {
  const std::string index = std::to_string(i), name = "texel" + index;
  const std::string coordinates = "gl_TexCoord[" + index + ']';
  if (dimension_of(unit.source).empty()) {
    if (unit.source == UnitSource::pass_through) return "  vec4 " + name + " = " + coordinates + ";\n";
    std::string lines;
    if (unit.source == UnitSource::cull_fragment) {
      for (std::size_t c = 0; c < 4; ++c) {
        lines +=
            "  if (" + coordinates + '.' + "xyzw"[c] + (unit.cull_if_less[c] ? " >= 0.0" : " < 0.0") + ") discard;\n";
      }
    }
    return lines + "  vec4 " + name + " = vec4(0.0);\n";
  }
  std::string lines = "  vec4 " + name + " = " + sample(unit, index) + ";\n";
  const bool in_alpha = unit.kind == TexelKind::depth_in_alpha || unit.kind == TexelKind::comparison_in_alpha;
  const std::string depth = name + (in_alpha ? ".a" : ".r");
  if (is_depth(unit.kind)) lines += "  " + name + " = vec4(0.0, 0.0, 0.0, " + depth + ");\n";
  if (is_comparison(unit.kind)) lines += "  " + name + " = vec4(" + depth + ");\n";
  return lines;
}

std::string fog_factor(FogFactor fog) {
  switch (fog) {
    case FogFactor::linear:
      return "(gl_Fog.end - gl_FogFragCoord) * gl_Fog.scale";
    case FogFactor::exp:
      return "exp(-gl_Fog.density * gl_FogFragCoord)";
    case FogFactor::exp2:
      return "exp(-(gl_Fog.density * gl_FogFragCoord) * (gl_Fog.density * gl_FogFragCoord))";
    case FogFactor::off:
      break;
  }
  return "1.0";
}

std::string code_of_byte(const HardwareProfile& profile, int byte) {
  return std::to_string(static_cast<int>(from_byte(profile, static_cast<std::uint8_t>(byte))));
}

// The conversions between floats in [0, 1] and codes (fixed9.h).
std::string conversions(const HardwareProfile& profile) {
  const int shift = profile.byte_shift;
  const std::string down = shift == 0 ? "" : " >> " + std::to_string(shift);
  std::string text =
      "\nivec4 ninebit_codes(vec4 v) {\n  return ivec4(floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5))" + down + ";\n}\n";
  text += "\nint ninebit_fog_code(float factor) {\n  return int(floor(clamp(factor, 0.0, 1.0) * 255.0";
  if (profile.fog_narrowing.value == Narrowing::nearest_halves_up) text += " + 0.5";
  text += "))" + down + ";\n}\n\nvec4 ninebit_color(ivec4 codes) {\n";
  if (shift != 0) {
    text += "  codes = ivec4(greaterThanEqual(codes, ivec4(" + std::to_string(profile.one.value) + "))) * 255 +\n" +
            "          ivec4(lessThan(codes, ivec4(" + std::to_string(profile.one.value) + "))) * ((codes << " +
            std::to_string(shift) + ") | (codes >> " + std::to_string(8 - 2 * shift) + "));\n";
  }
  return text + "  return vec4(codes) / 255.0;\n}\n";
}

std::string main_function(const HardwareProfile& profile, const ShaderInputs& inputs) {
  std::string text = "\nvoid main() {\n";
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    if (inputs.units[i].source != UnitSource::disabled) text += texel_lines(inputs.units[i], i);
  }
  text += "  float fog_factor = clamp(" + fog_factor(inputs.fog) + ", 0.0, 1.0);\n";
  text += std::string("  vec4 secondary_color = ") + (inputs.secondary ? "gl_SecondaryColor" : "vec4(0.0)") + ";\n";
  text += "  ivec4 secondary = ninebit_codes(secondary_color);\n";
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    text += "  secondary.a = " + std::to_string(profile.one.value) + ";\n";
  }
  text += "  ivec4 fog = ninebit_codes(gl_Fog.color);\n  fog.a = ";
  text += inputs.fog == FogFactor::off ? code_of_byte(profile, profile.fog_alpha_without_fog)
                                       : "ninebit_fog_code(fog_factor)";
  text += ";\n";
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string index = std::to_string(i);
    text += "  ivec4 texture" + index + " = ";
    text += inputs.units[i].source == UnitSource::disabled
                ? "ivec4(0, 0, 0, " + code_of_byte(profile, profile.disabled_texture_alpha) + ");\n"
                : "ninebit_codes(texel" + index + ");\n";
  }
  text += "  int spare0_alpha = ";
  text += inputs.units[0].source == UnitSource::disabled ? code_of_byte(profile, profile.spare0_alpha_without_texture0)
                                                         : "texture0.a";
  text +=
      ";\n  vec4 color = ninebit_color(ninebit_combine(ninebit_codes(gl_Color), secondary, fog,\n"
      "      texture0, texture1, texture2, texture3, spare0_alpha));\n";
  if (!inputs.write_inputs) return text + "  gl_FragColor = color;\n}\n";
  text +=
      "  gl_FragData[0] = color;\n  gl_FragData[1] = gl_Color;\n  gl_FragData[2] = secondary_color;\n"
      "  gl_FragData[3] = vec4(gl_Fog.color.rgb, fog_factor);\n";
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string texel =
        inputs.units[i].source == UnitSource::disabled ? "vec4(0.0)" : "texel" + std::to_string(i);
    text += "  gl_FragData[" + std::to_string(4 + i) + "] = " + texel + ";\n";
  }
  return text + "}\n";
}

}  // namespace

Result<std::string> fragment_shader(const Program& program, const HardwareProfile& profile,
                                    const ShaderInputs& inputs) {
  const auto combine = emit_glsl_with_uniform_constants(program, GlslVersion::glsl_130);
  if (!combine) return combine.error();
  const std::size_t head = combine->find('\n') + 1;
  std::string text = combine->substr(0, head), samplers;
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const UnitInput& unit = inputs.units[i];
    if (dimension_of(unit.source).empty()) continue;
    if (unit.source == UnitSource::texture_rectangle && text.size() == head) {
      text += "#extension GL_ARB_texture_rectangle : enable\n";
    }
    samplers += "uniform " + sampler_type(unit) + " ninebit_texture" + std::to_string(i) + ";\n";
  }
  return text + combine->substr(head) + '\n' + samplers + conversions(profile) + main_function(profile, inputs);
}

}  // namespace ninebit::gl_layer
