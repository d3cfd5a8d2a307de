// The inputs of the layer's fragment shader besides the combiners' program: chosen by OpenGL's state at a draw call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ninebit::gl_layer {

// The texture units that combiners can read.
inline constexpr std::size_t kLayerUnits = 4;

// GL_SHADER_OPERATION_NV: those of NV_texture_shader that depend on no other unit.
enum class ShaderOperation : std::uint8_t {
  none,
  texture_1d,
  texture_2d,
  texture_rectangle,
  texture_3d,
  texture_cube_map,
  pass_through,
  cull_fragment
};

// Where a unit's register comes from.
enum class UnitSource : std::uint8_t {
  disabled,  // no texture is enabled: the profile's value
  zero,      // NV_texture_shader's GL_NONE
  texture_1d,
  texture_2d,
  texture_rectangle,
  texture_3d,
  texture_cube_map,
  pass_through,  // the texture coordinates
  cull_fragment  // zero, or no fragment
};

// The kind of a texture's values. Depth textures enter the combiners by a rule of their own; GL_DEPTH_TEXTURE_MODE,
// which is ignored, decides where GLSL finds the depth.
enum class TexelKind : std::uint8_t { color, depth, depth_in_alpha, comparison, comparison_in_alpha };

struct UnitInput {
  UnitSource source = UnitSource::disabled;
  TexelKind kind = TexelKind::color;
  std::array<bool, 4> cull_if_less{};  // of cull_fragment
  friend bool operator==(const UnitInput&, const UnitInput&) = default;
};

enum class FogFactor : std::uint8_t { off, linear, exp, exp2 };

struct ShaderInputs {
  std::array<UnitInput, kLayerUnits> units{};
  FogFactor fog = FogFactor::off;
  bool secondary = true;      // false: lighting with a single colour, which leaves the secondary colour 0
  bool write_inputs = false;  // the inputs go to the colour buffers after the first
  friend bool operator==(const ShaderInputs&, const ShaderInputs&) = default;
};

}  // namespace ninebit::gl_layer
