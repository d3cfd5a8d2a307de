// What the texture tests share: textures of random texels, coordinates and derivatives near what matters.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "combiner_tests/oracle/texture_oracle.h"
#include "combiner_tests/raster/support.h"
#include "ninebit/raster/sampler.h"

namespace ninebit::test {

inline constexpr std::array kInternalFormats{
    InternalFormat::alpha8,  InternalFormat::luminance8, InternalFormat::luminance8_alpha8, InternalFormat::intensity8,
    InternalFormat::rgb8,    InternalFormat::rgba8,      InternalFormat::depth16,           InternalFormat::depth24,
    InternalFormat::rgba16f, InternalFormat::rgba32f};
// Those that texture-shader stages alone read.
inline constexpr std::array kStageFormats{InternalFormat::hilo16, InternalFormat::dsdt8, InternalFormat::dsdt8_mag8,
                                          InternalFormat::dsdt8_mag8_intensity8};
inline constexpr std::array kMinFilters{MinFilter::nearest,
                                        MinFilter::linear,
                                        MinFilter::nearest_mipmap_nearest,
                                        MinFilter::linear_mipmap_nearest,
                                        MinFilter::nearest_mipmap_linear,
                                        MinFilter::linear_mipmap_linear};
inline constexpr std::array kMagFilters{MagFilter::nearest, MagFilter::linear};
inline constexpr std::array kWraps{Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge, Wrap::mirrored_repeat,
                                   Wrap::clamp_to_border};

[[nodiscard]] inline bool is_depth(InternalFormat format) {
  return format == InternalFormat::depth16 || format == InternalFormat::depth24;
}
[[nodiscard]] inline bool is_real(InternalFormat format) {
  return format == InternalFormat::rgba16f || format == InternalFormat::rgba32f;
}

// 3D textures have up to eight layers. Every level of every face has texels of its own, so that a wrong level or face
// shows.
[[nodiscard]] Texture random_texture(Random& random, TextureTarget target, InternalFormat format, int width, int height,
                                     bool with_levels);

// Levels of one luminance each, from size × size texels on.
[[nodiscard]] Texture texture_of_levels(int size, const std::vector<std::uint8_t>& values);

// A cube map whose texels say where they are: x, y, face.
[[nodiscard]] Texture cube_of_places(int size);

// One float on, beside or far from the edges and middles of texels.
[[nodiscard]] float random_coordinate(Random& random, int size);

// One change of a coordinate: from far less than a texel to more than the texture, 0, infinite, no number.
[[nodiscard]] float random_change(Random& random);

// The question for the oracle, without coordinates.
[[nodiscard]] oracle::TextureQuestion texture_question(const HardwareProfile& profile, const Texture& texture,
                                                       const Sampler& sampler);

// Coordinates of some fragments, and the arrays that view them.
struct CoordinateArrays {
  std::array<std::vector<float>, 3> value, dx, dy;
  void push(const std::array<float, 3>& v, const std::array<float, 3>& x = {}, const std::array<float, 3>& y = {});
  [[nodiscard]] std::size_t size() const { return value[0].size(); }
  [[nodiscard]] TextureCoordinates view(std::size_t first = 0) const;
};

// Register codes of a run of fragments, by component.
struct CodeArrays {
  explicit CodeArrays(std::size_t count);
  std::array<std::vector<s9>, 4> plane;
  [[nodiscard]] std::array<s9*, 4> at(std::size_t first = 0);
  [[nodiscard]] Rgba9 of(std::size_t i) const { return {plane[0][i], plane[1][i], plane[2][i], plane[3][i]}; }
};

// One fragment's texel, with derivatives of 0.
[[nodiscard]] Texel texel_at(const TextureSampler& sampler, const std::array<float, 3>& coordinate,
                             const std::array<float, 3>& dx = {}, const std::array<float, 3>& dy = {});

}  // namespace ninebit::test
