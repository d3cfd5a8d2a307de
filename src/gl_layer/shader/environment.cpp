#include "src/gl_layer/shader/environment.h"

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/shader/texture_formats.h"

namespace ninebit::gl_layer {
namespace {

GLenum environment_value(GLenum pname) {
  GLint value = 0;
  found_driver.GetTexEnviv(GL_TEXTURE_ENV, pname, &value);
  return static_cast<GLenum>(value);
}

BaseFormat base_format(StageTarget of) {
  const GLenum target = gl_target(of);
  if (target == GL_NONE) return BaseFormat::rgba;
  const auto bits = [&](GLenum pname) { return base_level_value(target, pname); };
  if (bits(GL_TEXTURE_INTENSITY_SIZE) != 0) return BaseFormat::intensity;
  const bool has_alpha = bits(GL_TEXTURE_ALPHA_SIZE) != 0;
  if (bits(GL_TEXTURE_LUMINANCE_SIZE) != 0) return has_alpha ? BaseFormat::luminance_alpha : BaseFormat::luminance;
  if (bits(GL_TEXTURE_RED_SIZE) == 0 && has_alpha) return BaseFormat::alpha;
  return has_alpha ? BaseFormat::rgba : BaseFormat::rgb;
}

EnvironmentCombine combine_of(GLenum function, GLenum source, GLenum operand, GLenum scale) {
  EnvironmentCombine combine{.function = environment_value(function)};
  for (GLenum i = 0; i < 3; ++i) {
    combine.sources[i] = environment_value(source + i);
    combine.operands[i] = environment_value(operand + i);
  }
  found_driver.GetTexEnvfv(GL_TEXTURE_ENV, scale, &combine.scale);
  return combine;
}

std::string source_name(GLenum source, std::size_t unit) {
  switch (source) {
    case GL_CONSTANT:
      return "gl_TextureEnvColor[" + std::to_string(unit) + ']';
    case GL_PRIMARY_COLOR:
      return "gl_Color";
    case GL_PREVIOUS:
      return "color";
    default:
      break;
  }
  if (source >= GL_TEXTURE0 && source < GL_TEXTURE0 + kLayerUnits) unit = source - GL_TEXTURE0;
  return "unit" + std::to_string(unit);
}

std::string argument(const EnvironmentCombine& combine, std::size_t i, std::size_t unit, bool is_rgb) {
  const std::string name = source_name(combine.sources[i], unit);
  const GLenum operand = combine.operands[i];
  const bool is_alpha = !is_rgb || operand == GL_SRC_ALPHA || operand == GL_ONE_MINUS_SRC_ALPHA;
  const bool is_inverted = operand == GL_ONE_MINUS_SRC_COLOR || operand == GL_ONE_MINUS_SRC_ALPHA;
  std::string value = is_alpha ? name + ".a" : name + ".rgb";
  if (is_inverted) value = "(1.0 - " + value + ')';
  return is_rgb && is_alpha ? "vec3(" + value + ')' : value;
}

std::string combined(const EnvironmentCombine& combine, std::size_t unit, bool is_rgb) {
  const auto a = [&](std::size_t i) { return argument(combine, i, unit, is_rgb); };
  switch (combine.function) {
    case GL_REPLACE:
      return a(0);
    case GL_ADD:
      return a(0) + " + " + a(1);
    case GL_ADD_SIGNED:
      return a(0) + " + " + a(1) + " - 0.5";
    case GL_SUBTRACT:
      return a(0) + " - " + a(1);
    case GL_INTERPOLATE:
      return "mix(" + a(1) + ", " + a(0) + ", " + a(2) + ')';
    case GL_DOT3_RGB:
    case GL_DOT3_RGBA:
      return "vec3(4.0 * dot(" + a(0) + " - 0.5, " + a(1) + " - 0.5))";
    default:
      return a(0) + " * " + a(1);
  }
}

std::string scaled(const std::string& value, float scale) {
  return scale == 1.0F ? value : '(' + value + ") * " + std::to_string(scale);
}

std::string combine_line(const Environment& environment, std::size_t unit) {
  const std::string rgb = combined(environment.rgb, unit, true);
  const std::string alpha =
      environment.rgb.function == GL_DOT3_RGBA ? rgb + ".r" : combined(environment.alpha, unit, false);
  return "vec4(" + scaled(rgb, environment.rgb.scale) + ", " + scaled(alpha, environment.alpha.scale) + ')';
}

// The new colour; empty: it stays. OpenGL 1.3, tables 3.22 to 3.24.
std::string environment_value_of(const Environment& environment, std::size_t unit) {
  const std::string t = "unit" + std::to_string(unit);
  const BaseFormat format = environment.format;
  const bool has_color = format != BaseFormat::alpha;
  const bool has_alpha = format != BaseFormat::luminance && format != BaseFormat::rgb;
  const bool is_intensity = format == BaseFormat::intensity;
  const std::string kept_alpha = has_alpha ? "color.a * " + t + ".a" : "color.a";
  const auto result = [&](const std::string& rgb, const std::string& alpha) {
    return "vec4(" + (has_color ? rgb : "color.rgb") + ", " + alpha + ')';
  };
  switch (environment.mode) {
    case GL_REPLACE:
      return result(t + ".rgb", has_alpha ? t + ".a" : "color.a");
    case GL_MODULATE:
      return result("color.rgb * " + t + ".rgb", kept_alpha);
    case GL_DECAL:
      return result(has_alpha ? "mix(color.rgb, " + t + ".rgb, " + t + ".a)" : t + ".rgb", "color.a");
    case GL_BLEND: {
      const std::string constant = "gl_TextureEnvColor[" + std::to_string(unit) + ']';
      return result("mix(color.rgb, " + constant + ".rgb, " + t + ".rgb)",
                    is_intensity ? "mix(color.a, " + constant + ".a, " + t + ".a)" : kept_alpha);
    }
    case GL_ADD:
      return result("color.rgb + " + t + ".rgb", is_intensity ? "color.a + " + t + ".a" : kept_alpha);
    case GL_COMBINE:
      return combine_line(environment, unit);
    default:
      return "";
  }
}

}  // namespace

Environment read_environment(StageTarget target) {
  Environment environment{.mode = environment_value(GL_TEXTURE_ENV_MODE), .format = base_format(target)};
  switch (environment.mode) {
    case GL_REPLACE:
    case GL_MODULATE:
    case GL_DECAL:
    case GL_BLEND:
    case GL_ADD:
      break;
    case GL_COMBINE:
      environment.rgb = combine_of(GL_COMBINE_RGB, GL_SOURCE0_RGB, GL_OPERAND0_RGB, GL_RGB_SCALE);
      environment.alpha = combine_of(GL_COMBINE_ALPHA, GL_SOURCE0_ALPHA, GL_OPERAND0_ALPHA, GL_ALPHA_SCALE);
      break;
    default:
      log_once("texture shaders: the texture environment mode " + std::to_string(environment.mode) +
               " is unsupported; the unit leaves the colour as it is");
      environment.mode = 0;
  }
  return environment;
}

std::string environment_lines(const ShaderInputs& inputs) {
  std::string text = "  vec4 color = gl_Color;\n";
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string value = environment_value_of((*inputs.environments)[i], i);
    if (!value.empty()) text += "  color = clamp(" + value + ", 0.0, 1.0);\n";
  }
  if (inputs.color_sum) text += "  color.rgb = min(color.rgb + secondary_color.rgb, 1.0);\n";
  if (inputs.fog != FogFactor::off) text += "  color.rgb = mix(gl_Fog.color.rgb, color.rgb, fog_factor);\n";
  return text;
}

}  // namespace ninebit::gl_layer
