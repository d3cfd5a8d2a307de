// From a texture coordinate to the texels around it, along one axis of one level.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ninebit/raster/sampler.h"

namespace ninebit {

inline constexpr int kBorderTexel = -1;

// floor() of what fits 63 bits, without a call.
inline std::int64_t floor_of(double value) {
  const auto cut = static_cast<std::int64_t>(value);
  return cut - (static_cast<double>(cut) > value ? 1 : 0);
}

// An axis of an image: its texels, how many of them a coordinate of 1 stands for, and its wrap mode. `size` is a power
// of two unless `scale` is 1; then the mode clamps.
struct TextureAxis {
  int size = 1;
  int scale = 1;
  Wrap wrap = Wrap::repeat;
};

// s in texels, brought into the range that the wrap mode allows; for repeat only near enough for integers to take its
// remainder. Exact, but for values so close to a texel's edge that no rounding rule tells them from it: a float times a
// power of two fits a double.
inline double wrapped_position(float s, const TextureAxis& axis) {
  constexpr float kEvenFrom = 0x1p24F;  // from here on floats are even integers: places where a texture begins
  if (std::isnan(s)) s = 0.0F;
  const double n = axis.size, at = static_cast<double>(s) * axis.scale;
  switch (axis.wrap) {
    case Wrap::repeat:
      return std::fabs(s) >= kEvenFrom ? 0.0 : at;
    case Wrap::clamp:
      return std::clamp(at, 0.0, n);
    case Wrap::clamp_to_edge:
      return std::clamp(at, 0.5, n - 0.5);
    case Wrap::clamp_to_border:
      return std::clamp(at, -1.0, n + 1.0);
    case Wrap::mirrored_repeat: {
      if (std::fabs(s) >= kEvenFrom) return 0.5;
      const double phase = at - 2.0 * n * static_cast<double>(floor_of(at / (2.0 * n)));
      return std::clamp(phase > n ? 2.0 * n - phase : phase, 0.5, n - 0.5);
    }
  }
  return 0.5;
}

// A texel, or the border outside.
inline int texel_or_border(std::int64_t texel, int size) {
  return texel >= 0 && texel < size ? static_cast<int>(texel) : kBorderTexel;
}

// Images with border texels (rule 52) hold as many around the texture's beginning.
inline constexpr int kStoredBorder = 4;

// NEAREST: the texel that holds s; the end of the range belongs to the last one.
inline int nearest_texel(float s, const TextureAxis& axis) {
  const double u = wrapped_position(s, axis);
  if (axis.wrap == Wrap::repeat) return static_cast<int>(floor_of(u) & (axis.size - 1));
  if (axis.wrap == Wrap::clamp_to_border) return texel_or_border(floor_of(u), axis.size);
  return std::min(static_cast<int>(u), axis.size - 1);
}

// LINEAR: two neighbours, either of which may be kBorderTexel, and the second's weight in 1/2^bits.
struct LinearTexels {
  int first = 0;
  int second = 0;
  std::uint32_t weight = 0;
};
inline LinearTexels linear_texels(float s, const TextureAxis& axis, const FilterRules& rules) {
  const int size = axis.size;
  const int bits = rules.weight_bits;
  const std::int64_t one = std::int64_t{1} << bits;
  const double scaled = wrapped_position(s, axis) * static_cast<double>(one);
  // A sum with a number just below 0 would round.
  const std::int64_t fixed =
      rules.cuts_weights ? floor_of(scaled) - one / 2 : floor_of(scaled + 0.5 * static_cast<double>(1 - one));
  const std::int64_t first = fixed >> bits;
  const auto weight = static_cast<std::uint32_t>(fixed & (one - 1));
  switch (axis.wrap) {
    case Wrap::repeat:
      return {static_cast<int>(first & (size - 1)), static_cast<int>((first + 1) & (size - 1)), weight};
    case Wrap::clamp:
      return {static_cast<int>(first), first + 1 < size ? static_cast<int>(first + 1) : kBorderTexel, weight};
    case Wrap::clamp_to_border:
      return {texel_or_border(first, size), texel_or_border(first + 1, size), weight};
    case Wrap::clamp_to_edge:
    case Wrap::mirrored_repeat:
      break;
  }
  return {static_cast<int>(first), static_cast<int>(std::min<std::int64_t>(first + 1, size - 1)), weight};
}

// The texels of an image with a border of its own, by their places in the image. `axis` is the texture's; the image
// has twice as many texels. Linear filters read the border like texels: assumed.
inline LinearTexels bordered_texels(float s, const TextureAxis& axis, bool linear, const FilterRules& rules) {
  const auto stored = [&](std::int64_t texel) {
    return static_cast<int>(std::clamp<std::int64_t>(texel + kStoredBorder, 0, 2 * std::int64_t{axis.size} - 1));
  };
  if (axis.wrap != Wrap::clamp_to_border) {
    LinearTexels inner = linear ? linear_texels(s, axis, rules) : LinearTexels{.first = nearest_texel(s, axis)};
    const auto move = [&](int texel) { return texel == kBorderTexel ? kBorderTexel : stored(texel); };
    return {move(inner.first), move(inner.second), inner.weight};
  }
  if (std::isnan(s)) s = 0.0F;
  const double n = axis.size, at = std::clamp(static_cast<double>(s) * n, -2.0 * n - 16.0, 3.0 * n);
  if (!linear) return {.first = stored(floor_of(at))};
  const std::int64_t one = std::int64_t{1} << rules.weight_bits;
  const double scaled = at * static_cast<double>(one);
  const std::int64_t fixed =
      rules.cuts_weights ? floor_of(scaled) - one / 2 : floor_of(scaled + 0.5 * static_cast<double>(1 - one));
  const std::int64_t first = fixed >> rules.weight_bits;
  return {stored(first), stored(first + 1), static_cast<std::uint32_t>(fixed & (one - 1))};
}

}  // namespace ninebit
