// How texture units read textures: wrapping, filtering, levels of detail, depth comparison (OpenGL 1.3 and 1.4, 3.8).
//
// Where OpenGL leaves a choice, these are assumptions about the hardware:
//
// - A coordinate is held exactly until it is narrowed once: to a whole texel (NEAREST, downwards), or to 1/2^b texel
//   (LINEAR, as profile.texture_weight_narrowing says), where b is profile.texture_weight_bits.
// - The weights of LINEAR have b fraction bits, and so has the weight between two levels. Bytes and depth codes are
//   blended in whole numbers: along s, then along t, then between levels. A blend of two is rounded to nearest, halves
//   up, or only the whole sum is (profile.texture_filter_rounding). Floats are summed in doubles, in a fixed order,
//   texels of weight 0 left out.
// - Level of detail: rho² = max(ux² + vx², uy² + vy²) in doubles, with ux = width × ds/dx and so on; a sum that is NaN
//   counts as 0.
//   lambda = log2(rho²) / 2, rounded down to 1/256: the exponent, and that of the mantissa's 128th power, seven
//   squarings. The bias, narrowed to 1/256 as
//   profile.texture_bias_narrowing says (rule 26), is added. For cube maps, ds/dx is 0.5 × (dsc/dx - (sc / |ma|) ×
//   d|ma|/dx) / |ma|, in doubles, on the face that the fragment's own direction selects.
// - The weight between two levels is the fraction of lambda, cut to b bits.
// - A coordinate that is NaN reads as 0; infinity as the end of the range it is clamped to, or 0 where it repeats.
// - Linear filters of 3D textures blend along r after t; layers are found like rows.
// - Rectangles are only clamped: a wrap mode that repeats counts as clamp_to_edge, their default.
// - A border's byte is read like a texel's, in two's complement where the texel is.
// - No filter reads across the faces of a cube map: each is wrapped as a texture of its own.
// - Depth comparison (rule 29): r is clamped to [0, 1] and rounded to the nearest depth code, halves up; NaN counts as
//   0. Filters weigh the results, 0 or 255, not the depths.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// The filter for minification: within a level, then between levels.
enum class MinFilter : std::uint8_t {
  nearest,
  linear,
  nearest_mipmap_nearest,
  linear_mipmap_nearest,
  nearest_mipmap_linear,
  linear_mipmap_linear
};
// The filter for magnification.
enum class MagFilter : std::uint8_t { nearest, linear };
// The texel for a coordinate outside of [0, 1]. With a linear filter, clamp mixes in the border colour;
// clamp_to_border is that colour outside, with any filter.
enum class Wrap : std::uint8_t { repeat, clamp, clamp_to_edge, mirrored_repeat, clamp_to_border };
// GL_TEXTURE_COMPARE_FUNC, in GL's order: a texel is 1 if `r function depth` holds, else 0; none reads the depth
// itself.
enum class DepthComparison : std::uint8_t { none, never, less, equal, lequal, greater, notequal, gequal, always };

// The effect on a texel whose word is the colour key's, by Direct3D's words of the Xbox (rule 54).
enum class ColorKeyOperation : std::uint8_t {
  disable,
  alpha,  // its alpha is 0
  rgba,   // all its components are 0
  kill    // the fragment is not drawn, whether or not the program reads the texel
};

// Texels of rgba8 equal the key in all 32 bits, those of rgb8 in red, green and blue.
struct ColorKey {
  ColorKeyOperation operation = ColorKeyOperation::disable;  // what becomes of such texels
  std::uint32_t key = 0;                                     // 0xAARRGGBB
};

// A texture object's parameters and the unit's bias, with GL's defaults.
struct Sampler {
  MinFilter min_filter = MinFilter::nearest_mipmap_linear;  // for minification
  MagFilter mag_filter = MagFilter::linear;                 // for magnification
  Wrap wrap_s = Wrap::repeat;                               // of s
  Wrap wrap_t = Wrap::repeat;                               // of t
  Wrap wrap_r = Wrap::repeat;                               // of r, of 3D textures
  // Clamped to [0, 1] and stored as the texture's format would: luminance, intensity and depth from red.
  std::array<float, 4> border_color{};
  DepthComparison comparison = DepthComparison::none;  // of depth textures; ignored for others
  float lod_bias = 0.0F;                               // EXT_texture_lod_bias; clamped to [-15, 15], NaN counts as 0
  // Components red, green, blue, alpha whose bytes are two's complement: filtered as such, and doubled in a register
  // (rule 15). Of hilo16, alpha's flag is of HI and green's of LO.
  std::array<bool, 4> is_signed{};
  // The NV2A's. The images hold a border around their texels (rule 52): an image of 2n texels, 16 at least, is a
  // texture of n, whose texel i is stored at i + 4. Where clamp_to_border leaves the texture, it reads that border.
  bool border_texels = false;
  // For s and t: if the mode is repeat, triangles and lines take the shorter way around the texture (rule 53).
  std::array<bool, 2> cylinder_wrap{};
  ColorKey color_key{};  // of nearest texels of rgba8 and rgb8
};

// Reports what a sampler's border texels and colour key cannot be combined with. The texture has passed check_texture.
[[nodiscard]] Status check_sampler(const Texture& texture, const Sampler& sampler);

// Which of s and t wrap around a cylinder (rule 53).
[[nodiscard]] constexpr std::array<bool, 2> cylinder_of(const Sampler& sampler) {
  return {sampler.cylinder_wrap[0] && sampler.wrap_s == Wrap::repeat,
          sampler.cylinder_wrap[1] && sampler.wrap_t == Wrap::repeat};
}

// Which bytes of a texture's texels are two's complement: those that the sampler says, and ds and dt.
[[nodiscard]] std::array<bool, 4> signed_components(const Texture& texture, const Sampler& sampler);

// The sampler for index maps: the nearest texel of level 0.
inline constexpr Sampler kNearestSampler{.min_filter = MinFilter::nearest,
                                         .mag_filter = MagFilter::nearest,
                                         .wrap_s = Wrap::clamp_to_edge,
                                         .wrap_t = Wrap::clamp_to_edge};

// The coordinates of a run of fragments, after any division by q: s, t and r, each one float per fragment. Differences
// to the next fragment in x and y are read if a sampler needs_derivatives(); r is read if it needs_r(), its differences
// for cube maps and 3D textures.
struct TextureCoordinates {
  std::array<const float*, 3> value{};  // of the fragments
  std::array<const float*, 3> dx{};     // to the fragment on the right
  std::array<const float*, 3> dy{};     // to the fragment above
  bool one_change = false;              // dx and dy have one value each, for all fragments
};

// The reader of a sampler's texels.
enum class TexelUse : std::uint8_t {
  registers,  // the combiners: codes
  stages      // texture-shader stages: bytes, signed ones in two's complement, and all that the format stores
};

// How linear filters weigh and round; see HardwareProfile.
struct FilterRules {
  int weight_bits = 8;             // fraction bits of weights
  bool cuts_weights = false;       // cut to these bits; else rounded to nearest, halves up
  bool rounds_each_blend = false;  // along s, along t and between levels; else the whole sum once
};

// A texture with its sampler state, prepared once per draw. The texture must outlive it. A fragment's result does not
// depend on the run that it is in.
class TextureSampler {
 public:
  // Empty if the texture is incomplete for the filter: the unit is then off. The texture must pass check_texture.
  [[nodiscard]] static std::optional<TextureSampler> make(const HardwareProfile& profile, const Texture& texture,
                                                          const Sampler& sampler, TexelUse use = TexelUse::registers);

  // Whether the level of detail is needed: the two filters differ, or there are mip-maps.
  [[nodiscard]] bool needs_derivatives() const { return needs_derivatives_; }

  // Whether r is read, and with derivatives its differences.
  [[nodiscard]] bool needs_r() const { return cube_ || volume_ || comparison_ != DepthComparison::none; }

  // Whether fragments may be killed by the colour key, and whether fragment i is.
  [[nodiscard]] bool kills() const { return sampler_.color_key.operation == ColorKeyOperation::kill; }
  [[nodiscard]] bool kills(const TextureCoordinates& at, std::size_t i) const;

  // Whether codes may be negative.
  [[nodiscard]] bool gives_signed_codes() const { return decodes_; }

  // Whether s, t and r are divided by q: true except for cube maps.
  [[nodiscard]] bool divides_by_q() const { return !cube_; }

  // The base internal format that texel_codes reads: depth_comparison with a comparison, rgba if a key clears alpha.
  [[nodiscard]] TextureFormat format() const { return format_; }

  // The codes that texel_codes gives for `count` fragments, to codes[component][fragment], or bytes for stages. Depth
  // without comparison is rounded to a byte; floats are clamped to [0, 1] and rounded to one, NaN giving 0. `killed`:
  // where to store 1 for fragments that the colour key kills; the others keep what is there.
  void sample(const TextureCoordinates& at, std::size_t count, const std::array<s9*, 4>& codes,
              std::uint8_t* killed = nullptr) const;

  // The bytes of fragment i's filtered texel, as a stage reads them.
  [[nodiscard]] Bytes4 bytes(const TextureCoordinates& at, std::size_t i) const;

  // Fragment i's filtered texel, as sample() takes it, of a texture without signed components.
  [[nodiscard]] Texel texel(const TextureCoordinates& at, std::size_t i) const;

  // The same as red, green, blue, alpha in floats, as texel_codes orders them: bytes as n / 255, depth codes as
  // fractions of the largest, each filtered before it is divided; float formats neither clamped nor rounded to a byte.
  [[nodiscard]] std::array<float, 4> color(const TextureCoordinates& at, std::size_t i) const;

 private:
  TextureSampler() = default;
  struct Taps;      // a fragment's texels with their weights
  struct Filtered;  // their weighted sum
  template <class Read>
  [[nodiscard]] std::uint32_t weigh_codes(const Taps& taps, const Read& read) const;
  template <class Read>
  [[nodiscard]] double weigh_reals(const Taps& taps, const Read& read) const;
  [[nodiscard]] Filtered filter(const TextureCoordinates& at, std::size_t i) const;
  [[nodiscard]] Filtered weigh(const Taps& taps, float r) const;
  void weigh_words(const Taps& taps, Filtered& to) const;
  class ByteSampler;  // the fast path for bytes
  [[nodiscard]] bool is_keyed(const Texel& texel) const;
  [[nodiscard]] std::uint32_t key_bits() const;  // the bits of a colour key that are compared
  void find_sources(const HardwareProfile& profile, TexelUse use);
  void decode(std::size_t count, const std::array<s9*, 4>& codes) const;

  const Texture* texture_ = nullptr;
  Sampler sampler_;
  TextureFormat format_ = TextureFormat::rgb;
  DepthComparison comparison_ = DepthComparison::none;
  bool cube_ = false;
  bool volume_ = false;
  bool rectangle_ = false;
  bool decodes_ = false;  // bytes of signed components become codes
  std::array<bool, 4> is_signed_{};
  int lowest_ = 0;  // code of a register
  bool needs_derivatives_ = false;
  int last_level_ = 0;
  int lod_bias_q8_ = 0;
  FilterRules filter_rules_;
  int byte_shift_ = 0;
  std::uint32_t max_depth_ = 0;
  std::array<std::uint32_t, 4> border_code_{};
  // The texel component that each register component reads; -1: the constant beside it (0 or 1.0).
  std::array<int, 4> source_{};
  std::array<s9, 4> constant_{};
  std::shared_ptr<const ByteSampler> byte_sampler_;  // empty: this texture has no fast path
};

}  // namespace ninebit
