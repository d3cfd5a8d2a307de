// The inputs of the layer's fragment shader besides the combiners' program: chosen by OpenGL's state at a draw call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ninebit/texture_shader/stage_program.h"

namespace ninebit::gl_layer {

// The texture units that combiners can read.
inline constexpr std::size_t kLayerUnits = kTextureStages;

// The kind of a texture's values. Depth textures enter the combiners by a rule of their own; GL_DEPTH_TEXTURE_MODE,
// which is ignored, decides where GLSL finds the depth. Formats of NV_texture_shader are stored in the driver's signed
// ones (texture_formats.h).
enum class TexelKind : std::uint8_t {
  color,
  depth,
  depth_in_alpha,
  comparison,
  comparison_in_alpha,
  signed_color,               // red, green, blue, alpha in two's complement
  signed_rgb_unsigned_alpha,  // also where there is no alpha, which is 1
  hilo,                       // 16 bits in red and green
  signed_hilo,
  dsdt,               // in red and green
  dsdt_mag,           // in red, green, blue
  dsdt_mag_intensity  // in red, green, blue, alpha
};

// OpenGL's base formats, by which a texture environment reads a texel.
enum class BaseFormat : std::uint8_t { alpha, luminance, luminance_alpha, intensity, rgb, rgba };

// One half of GL_COMBINE, as OpenGL's enumerants.
struct EnvironmentCombine {
  unsigned function = 0;
  std::array<unsigned, 3> sources{}, operands{};
  float scale = 1.0F;
  friend bool operator==(const EnvironmentCombine&, const EnvironmentCombine&) = default;
};

// A unit's texture environment.
struct Environment {
  unsigned mode = 0;  // GL_TEXTURE_ENV_MODE; 0: the unit leaves the colour as it is
  BaseFormat format = BaseFormat::rgba;
  EnvironmentCombine rgb{}, alpha{};  // of GL_COMBINE
  friend bool operator==(const Environment&, const Environment&) = default;
};

struct UnitInput {
  StageTarget target = StageTarget::none;  // of the texture that is read; none: no texture is enabled
  TexelKind kind = TexelKind::color;
  int depth_bits = 0;  // of depth textures
  friend bool operator==(const UnitInput&, const UnitInput&) = default;
};

enum class FogFactor : std::uint8_t { off, linear, exp, exp2 };

struct ShaderInputs {
  std::array<UnitInput, kLayerUnits> units{};
  // Texture shaders, if they are enabled; without the numbers that are uniforms.
  std::optional<TextureShaderProgram> stages{};
  // The texture environments, which take the place of the combiners where these are disabled.
  std::optional<std::array<Environment, kLayerUnits>> environments{};
  bool color_sum = false;  // with environments: the secondary colour is added
  FogFactor fog = FogFactor::off;
  bool secondary = true;      // false: lighting with a single colour, which leaves the secondary colour 0
  bool write_inputs = false;  // the inputs go to the colour buffers after the first
  friend bool operator==(const ShaderInputs&, const ShaderInputs&) = default;
};

}  // namespace ninebit::gl_layer
