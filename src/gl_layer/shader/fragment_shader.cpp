#include "src/gl_layer/shader/fragment_shader.h"

#include <algorithm>

#include "ninebit/language/glsl.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/gl_layer/shader/environment.h"

namespace ninebit::gl_layer {
namespace {

bool is_depth(TexelKind kind) {
  return kind == TexelKind::depth || kind == TexelKind::depth_in_alpha;
}

bool is_signed(TexelKind kind) {
  return kind == TexelKind::signed_color || kind == TexelKind::signed_rgb_unsigned_alpha;
}

bool is_for_stages(TexelKind kind) {
  return kind == TexelKind::hilo || kind == TexelKind::signed_hilo || kind == TexelKind::dsdt ||
         kind == TexelKind::dsdt_mag;
}

bool is_comparison(TexelKind kind) {
  return kind == TexelKind::comparison || kind == TexelKind::comparison_in_alpha;
}

// "2D", "Cube", …; empty for a unit that samples no texture.
std::string dimension_of(StageTarget target) {
  constexpr std::array kNames{"", "1D", "2D", "2DRect", "3D", "Cube"};
  return kNames[static_cast<std::size_t>(target)];
}

bool can_compare(StageTarget target) {
  return target != StageTarget::three_dimensional && target != StageTarget::cube_map;
}

bool compares(const UnitInput& unit) {
  return is_comparison(unit.kind) && can_compare(unit.target);
}

std::string sampler_of(std::size_t i) {
  return "ninebit_texture" + std::to_string(i);
}

// The texel of a unit: fixed functions divide by q, except for cube maps.
std::string sample(const UnitInput& unit, std::size_t i) {
  const std::string dimension = dimension_of(unit.target), coordinates = "gl_TexCoord[" + std::to_string(i) + ']';
  const std::string sampler = sampler_of(i);
  if (compares(unit)) return "shadow" + dimension + "Proj(" + sampler + ", " + coordinates + ')';
  if (unit.target == StageTarget::cube_map) return "textureCube(" + sampler + ", " + coordinates + ".xyz)";
  return "texture" + dimension + "Proj(" + sampler + ", " + coordinates + ')';
}

// The same at the coordinates `at`, which a stage has computed.
std::string sample_at(const UnitInput& unit, std::size_t i) {
  const std::string dimension = dimension_of(unit.target);
  if (compares(unit)) {
    // The chip compares codes of the texture's format; a driver may compare floats.
    std::string at = "at";
    if (unit.depth_bits > 0 && unit.depth_bits <= 24) {
      const std::string largest = std::to_string((1 << unit.depth_bits) - 1) + ".0";
      at = "vec3(at.xy, round(clamp(at.z, 0.0, 1.0) * " + largest + ") / " + largest + ')';
    }
    return "shadow" + dimension + '(' + sampler_of(i) + ", " + at + ')';
  }
  constexpr std::array kComponents{"", ".x", ".xy", ".xy", ".xyz", ".xyz"};
  return "texture" + dimension + '(' + sampler_of(i) + ", at" + kComponents[static_cast<std::size_t>(unit.target)] +
         ')';
}

std::string sampler_type(const UnitInput& unit) {
  return "sampler" + dimension_of(unit.target) + (compares(unit) ? "Shadow" : "");
}

// Moves the depth of a texel to where the combiners have it.
std::string depth_line(const UnitInput& unit, const std::string& name) {
  const bool in_alpha = unit.kind == TexelKind::depth_in_alpha || unit.kind == TexelKind::comparison_in_alpha;
  const std::string depth = name + (in_alpha ? ".a" : ".r");
  if (is_depth(unit.kind)) return "  " + name + " = vec4(0.0, 0.0, 0.0, " + depth + ");\n";
  return is_comparison(unit.kind) ? "  " + name + " = vec4(" + depth + ");\n" : "";
}

// The lines that set texelI.
std::string texel_lines(const UnitInput& unit, std::size_t i) {
  const std::string name = "texel" + std::to_string(i);
  const std::string line = "  vec4 " + name + " = " + sample(unit, i) + ";\n" + depth_line(unit, name);
  return unit.kind == TexelKind::dsdt_mag_intensity ? line + "  " + name + " = vec4(0.0, 0.0, 0.0, " + name + ".a);\n"
                                                    : line;
}

// The bytes of a texel in the places where stages read them (texture.h).
std::string bytes_of(TexelKind kind) {
  constexpr const char* kSigned = "ivec4(floor(clamp(v, -1.0, 1.0) * 127.0 + 0.5)) & 255";
  switch (kind) {
    case TexelKind::signed_color:
      return kSigned;
    case TexelKind::signed_rgb_unsigned_alpha:
      return "ivec4(ivec3(floor(clamp(v.rgb, -1.0, 1.0) * 127.0 + 0.5)) & 255, "
             "int(floor(clamp(v.a, 0.0, 1.0) * 255.0 + 0.5)))";
    case TexelKind::hilo:
      return "ninebit_words(ivec2(floor(clamp(v.rg, 0.0, 1.0) * 65535.0 + 0.5)))";
    case TexelKind::signed_hilo:
      return "ninebit_words(ivec2(floor(clamp(v.rg, -1.0, 1.0) * 32767.0 + 0.5)) & 65535)";
    case TexelKind::dsdt:
      return "(ivec4(floor(clamp(vec4(0.0, v.gr, 0.0), -1.0, 1.0) * 127.0 + 0.5))) & 255";
    case TexelKind::dsdt_mag:
      return "ivec4(int(floor(clamp(v.b, 0.0, 1.0) * 255.0 + 0.5)), "
             "ivec2(floor(clamp(v.gr, -1.0, 1.0) * 127.0 + 0.5)) & 255, 0)";
    case TexelKind::dsdt_mag_intensity:
      return "ivec4(int(floor(clamp(v.b, 0.0, 1.0) * 255.0 + 0.5)), "
             "ivec2(floor(clamp(v.gr, -1.0, 1.0) * 127.0 + 0.5)) & 255, int(floor(clamp(v.a, 0.0, 1.0) * 255.0 + "
             "0.5)))";
    default:
      return "ivec4(floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5))";
  }
}

// The function that the stages call for a unit's texel.
std::string texel_function(const UnitInput& unit, std::size_t i) {
  return "\nivec4 ninebit_stages_texel" + std::to_string(i) + "(vec3 at) {\n  vec4 v = " + sample_at(unit, i) + ";\n" +
         depth_line(unit, "v") + "  return " + bytes_of(unit.kind) + ";\n}\n";
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

// Two words of 16 bits as a texel: H = 256 A + R, L = 256 G + B.
constexpr const char* kWords =
    "\nivec4 ninebit_words(ivec2 v) { return ivec4(v.x & 255, v.y >> 8, v.y & 255, v.x >> 8); }\n";

// The conversions between floats in [0, 1], or [-1, 1], and codes (fixed9.h, initial_registers.h).
std::string conversions(const HardwareProfile& profile) {
  const int shift = profile.byte_shift;
  const std::string down = shift == 0 ? "" : " >> " + std::to_string(shift);
  std::string text =
      "\nivec4 ninebit_codes(vec4 v) {\n  return ivec4(floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5))" + down + ";\n}\n";
  text += "\nivec4 ninebit_signed_codes(vec4 v) {\n  return max((2 * ivec4(floor(clamp(v, -1.0, 1.0) * 127.0 + 0.5)))" +
          down + ", " + std::to_string(profile.lowest.value) + ");\n}\n";
  text += "\nint ninebit_fog_code(float factor) {\n";
  text += profile.fog_byte.value == StageByte::nearest
              ? "  return int(floor(clamp(factor, 0.0, 1.0) * 255.0 + 0.5))"
              : "  return (255 * (int(clamp(factor, 0.0, 4095.0 / 4096.0) * 4096.0) + 1) >> 12)";
  text += down + ";\n}\n\nvec4 ninebit_color(ivec4 codes) {\n";
  if (shift != 0) {
    text += "  codes = ivec4(greaterThanEqual(codes, ivec4(" + std::to_string(profile.one.value) + "))) * 255 +\n" +
            "          ivec4(lessThan(codes, ivec4(" + std::to_string(profile.one.value) + "))) * ((codes << " +
            std::to_string(shift) + ") | (codes >> " + std::to_string(8 - 2 * shift) + "));\n";
  }
  return text + "  return vec4(codes) / 255.0;\n}\n";
}

// The lines that set textureI, the codes of the units, by texture shaders.
std::string stage_lines(const TextureShaderProgram& stages) {
  std::string text = "  ivec4 texture0, texture1, texture2, texture3;\n  float stage_depth;\n";
  text +=
      "  if (ninebit_stages(gl_TexCoord[0], gl_TexCoord[1], gl_TexCoord[2], gl_TexCoord[3],\n"
      "                     texture0, texture1, texture2, texture3, stage_depth)) discard;\n";
  const bool replaces = std::any_of(stages.stage.begin(), stages.stage.end(), [](const ProgramTextureStage& stage) {
    return stage.state.operation == TextureOperation::dot_product_depth_replace && stage.inconsistent.empty();
  });
  return replaces ? text + "  gl_FragDepth = clamp(stage_depth, 0.0, 1.0);\n" : text;
}

// The same by fixed functions.
std::string unit_lines(const HardwareProfile& profile, const ShaderInputs& inputs) {
  std::string texels, codes;
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const UnitInput& unit = inputs.units[i];
    const std::string index = std::to_string(i);
    codes += "  ivec4 texture" + index + " = ";
    if (unit.target == StageTarget::none) {
      codes += "ivec4(0, 0, 0, " + code_of_byte(profile, profile.disabled_texture_alpha) + ");\n";
      continue;
    }
    if (is_for_stages(unit.kind)) {
      codes += "ivec4(0);\n";  // HILO and DSDT texels are not colours
      texels += "  vec4 texel" + index + " = vec4(0.0);\n";
      continue;
    }
    texels += texel_lines(unit, i);
    codes += (is_signed(unit.kind) ? "ninebit_signed_codes(texel" : "ninebit_codes(texel") + index + ");\n";
    if (unit.kind == TexelKind::signed_rgb_unsigned_alpha) {
      codes += "  texture" + index + ".a = ninebit_codes(texel" + index + ").a;\n";
    }
  }
  return texels + codes;
}

// The inputs, into the colour buffers after the first.
std::string input_lines(const HardwareProfile& profile, const ShaderInputs& inputs) {
  std::string text =
      "  gl_FragData[0] = color;\n  gl_FragData[1] = gl_Color;\n  gl_FragData[2] = secondary_color;\n"
      "  gl_FragData[3] = vec4(gl_Fog.color.rgb, fog_factor);\n";
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string index = std::to_string(i);
    std::string texel = "texel" + index;
    if (inputs.stages) {
      texel = "vec4(texture" + index + ") / " + std::to_string(profile.one.value) + ".0";
    } else if (inputs.units[i].target == StageTarget::none) {
      texel = "vec4(0.0)";
    }
    text += "  gl_FragData[" + std::to_string(4 + i) + "] = " + texel + ";\n";
  }
  return text;
}

// The lines that set `color` by the combiners.
std::string combiner_lines(const HardwareProfile& profile, const ShaderInputs& inputs) {
  std::string text = "  ivec4 secondary = ninebit_codes(secondary_color);\n";
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    text += "  secondary.a = " + std::to_string(profile.one.value) + ";\n";
  }
  text += "  ivec4 fog = ninebit_codes(gl_Fog.color);\n  fog.a = ";
  text += inputs.fog == FogFactor::off ? code_of_byte(profile, profile.fog_alpha_without_fog)
                                       : "ninebit_fog_code(fog_factor)";
  const bool has_texture0 = inputs.stages || inputs.units[0].target != StageTarget::none;
  text += ";\n  int spare0_alpha = ";
  text += has_texture0 ? "texture0.a" : code_of_byte(profile, profile.spare0_alpha_without_texture0);
  text +=
      ";\n  vec4 color = ninebit_color(ninebit_combine(ninebit_codes(gl_Color), secondary, fog,\n"
      "      texture0, texture1, texture2, texture3, spare0_alpha));\n";
  return text;
}

// The same by texture environments.
std::string unit_colors(const HardwareProfile& profile) {
  std::string text;
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string index = std::to_string(i);
    text += "  vec4 unit" + index + " = vec4(texture" + index + ") / " + std::to_string(profile.one.value) + ".0;\n";
  }
  return text;
}

std::string main_function(const HardwareProfile& profile, const ShaderInputs& inputs) {
  std::string text = "\nvoid main() {\n";
  text += inputs.stages ? stage_lines(*inputs.stages) : unit_lines(profile, inputs);
  text += "  float fog_factor = clamp(" + fog_factor(inputs.fog) + ", 0.0, 1.0);\n";
  text += std::string("  vec4 secondary_color = ") + (inputs.secondary ? "gl_SecondaryColor" : "vec4(0.0)") + ";\n";
  text += inputs.environments ? unit_colors(profile) + environment_lines(inputs) : combiner_lines(profile, inputs);
  return text + (inputs.write_inputs ? input_lines(profile, inputs) : "  gl_FragColor = color;\n") + "}\n";
}

}  // namespace

Result<std::string> fragment_shader(const Program& program, const HardwareProfile& profile,
                                    const ShaderInputs& inputs) {
  const auto combine = emit_glsl_with_uniform_constants(program, GlslVersion::glsl_130);
  if (!combine) return combine.error();
  const std::size_t head = combine->find('\n') + 1;
  std::string text = combine->substr(0, head), units, functions;
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const UnitInput& unit = inputs.units[i];
    if (unit.target == StageTarget::none) continue;
    if (unit.target == StageTarget::rectangle && text.size() == head) {
      text += "#extension GL_ARB_texture_rectangle : enable\n";
    }
    units += "uniform " + sampler_type(unit) + ' ' + sampler_of(i) + ";\n";
    if (inputs.stages) functions += texel_function(unit, i);
  }
  if (inputs.stages) {
    const auto stages = emit_glsl_texture_shader(*inputs.stages, profile, StageNumbers::uniform, "ninebit_stages");
    if (!stages) return stages.error();
    units += *stages + kWords + functions;
  }
  return text + combine->substr(head) + '\n' + units + conversions(profile) + main_function(profile, inputs);
}

}  // namespace ninebit::gl_layer
