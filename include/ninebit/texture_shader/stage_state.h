// The four texture-shader stages before the combiners, with OpenGL's defaults (NV_texture_shader, NV_texture_shader2)
// and what the NV2A's registers add. Plain data: nothing here is checked.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_operation.h"

namespace NINEBIT_PUBLIC ninebit {

// The number of stages, and of texture units, of the NV20 class.
inline constexpr int kTextureStages = 4;

// How a dot product reads the texel of an earlier stage, by the NV2A's numbers of NV097_SET_DOT_RGBMAPPING. R, G, B, A
// are its bytes, s8() and s16() two's complement, H = 256 A + R, L = 256 G + B.
enum class DotMapping : std::uint8_t {
  zero_to_one,          // (R, G, B) / 255; GL_UNSIGNED_IDENTITY_NV
  minus1_to_1_d3d,      // ((R, G, B) - 128) / 127; GL_EXPAND_NORMAL_NV by this mapping is assumed
  minus1_to_1_gl,       // (2 s8(R, G, B) + 1) / 255
  minus1_to_1,          // s8(R, G, B) / 127; signed textures of OpenGL
  hilo_1,               // (H / 65535, L / 65535, 1); GL_HILO_NV
  hilo_hemisphere_d3d,  // the chip refuses it
  hilo_hemisphere_gl,   // the chip refuses it
  hilo_hemisphere       // s16(H, L) / 32767, and what is left of a unit vector; GL_SIGNED_HILO_NV
};

// A component of CULL_FRAGMENT: which coordinates are killed (rule 42). NaN never is.
enum class CullMode : std::uint8_t {
  kills_negative,     // below 0; GL_GEQUAL, the default
  kills_not_negative  // 0 and above; GL_LESS
};

// The unit of depths that DOT_PRODUCT_DEPTH_REPLACE computes.
enum class DepthUnit : std::uint8_t {
  window,  // 0 to 1, as in OpenGL
  codes    // codes of the depth buffer, as on the NV2A
};

// Whose rules decide whether a stage is consistent.
enum class StageRules : std::uint8_t {
  open_gl,  // NV_texture_shader's: the formats of textures must suit the operations that read them
  nv2a      // the chip's: an operation reads the bytes of any format
};

// One stage.
struct TextureStage {
  TextureOperation operation = TextureOperation::none;  // GL_SHADER_OPERATION_NV
  int previous = 0;  // GL_PREVIOUS_TEXTURE_INPUT_NV: the stage whose texel is read, 0 to this stage - 1
  DotMapping mapping = DotMapping::zero_to_one;  // of a dot product
  std::array<CullMode, 4> cull{};                // GL_CULL_MODES_NV, of s, t, r, q
  // GL_OFFSET_TEXTURE_MATRIX_NV: s += [0] ds + [2] dt, t += [1] ds + [3] dt. The NV2A's registers
  // SET_BUMP_ENV_MAT + 0, 4, 8, 12 are [0], [1], [3], [2].
  std::array<float, 4> matrix{1.0F, 0.0F, 0.0F, 1.0F};
  float scale = 1.0F;                           // GL_OFFSET_TEXTURE_SCALE_NV, of the luminance
  float bias = 0.0F;                            // GL_OFFSET_TEXTURE_BIAS_NV, added to it
  std::array<float, 3> eye{0.0F, 0.0F, -1.0F};  // GL_CONST_EYE_NV, of the constant-eye reflection
  friend constexpr bool operator==(const TextureStage&, const TextureStage&) = default;
};

// All stages.
struct TextureShaderState {
  bool enabled = false;                      // GL_TEXTURE_SHADER_NV; if off, units work as in plain OpenGL
  StageRules rules = StageRules::open_gl;    // of consistency
  DepthUnit depth_unit = DepthUnit::window;  // of replaced depths
  // NV097_SET_CONTROL0: from YUV to RGB, of every stage that reads a texture; of others assumed.
  bool converts_yuv = false;
  std::array<TextureStage, kTextureStages> stage{};  // in the order of the units
  friend constexpr bool operator==(const TextureShaderState&, const TextureShaderState&) = default;
};

// The state with the defaults for everything that its operations do not read, such as the matrix of a plain texture.
// Operations that are not enumerators stay as they are.
[[nodiscard]] TextureShaderState only_used(const TextureShaderState& state);

// Whether stages do only what units do without them: they are not enabled, or all read their own textures.
[[nodiscard]] bool only_reads_textures(const TextureShaderState& stages);

}  // namespace ninebit
