// Depth in [0, 1] packed into bytes, as three.js' shaders did it, release by release.
//
// GLSL before 3.00 has no integers to shift, so a depth is split into base-256 digits in floats. But a byte n of a
// texture reads n / 255, not n / 256: a packing is accurate if it takes that into account. The functions compute in
// float32, in the shaders' order of operations; a dot product is summed from red to alpha, which GLSL leaves open.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// How the texels of a shadow map hold a depth in [0, 1]: as a code of 24 or 16 bits, or packed.
enum class DepthEncoding : std::uint8_t { d24, d16, rgba8_fract, rgba8_mod, rgba8_256over255, rgba8_modf };
enum class ChannelStorage : std::uint8_t { round, truncate };  // how a component becomes a byte

// Red, green, blue, alpha as the shader writes them: in [0, 1], except one component of rgba8-256over255 that is
// 256/255 at depth 1. Components that a packing does not use are 0.
using DepthComponents = std::array<float, 4>;
using DepthBytes = std::array<std::uint8_t, 4>;

// A way to split a depth into components and to join them again.
struct DepthPacking {
  std::string_view name;                           // "rgba8-fract"
  std::string_view releases;                       // of three.js
  int channels;                                    // bytes used: 2 (red and green) to 4
  bool red_is_highest;                             // the first component is the most significant; otherwise the last
  DepthComponents (*pack)(float depth);            // depth is in [0, 1]
  float (*unpack)(const DepthComponents& stored);  // components as a texture returns them, each n / 255
  // read_depth() of store_depth() of each depth, into as many values of `back`, which lie elsewhere: faster than one by
  // one.
  void (*round_trips)(std::span<const float> depths, ChannelStorage storage, std::span<float> back);
};

// All packings, the oldest first: the four of --depth-encoding, and the shorter variants of the last two.
[[nodiscard]] std::span<const DepthPacking> depth_packings();

// The packing of that name, or nullptr.
[[nodiscard]] const DepthPacking* find_depth_packing(std::string_view name);

// The packing of an encoding; nullptr for d24 and d16, which need none.
[[nodiscard]] const DepthPacking* depth_packing(DepthEncoding encoding);

// The byte that a texture of eight bits a channel stores for a component: clamped to [0, 1], times 255 without
// rounding, then rounded to the nearest whole number, halves up, or truncated. NaN gives 0.
[[nodiscard]] constexpr std::uint8_t stored_component(float component, ChannelStorage storage) {
  if (!(component > 0.0F)) return 0;
  if (component >= 1.0F) return 255;
  return static_cast<std::uint8_t>(static_cast<double>(component) * 255.0 +
                                   (storage == ChannelStorage::round ? 0.5 : 0.0));
}

// The value that a shader reads from byte n: n / 255 in float32.
[[nodiscard]] constexpr float read_component(std::uint8_t byte) {
  return static_cast<float>(byte) / 255.0F;
}

// A depth's bytes in a texture, and the depth that a shader reads from them. Bytes beyond packing.channels are 0.
[[nodiscard]] DepthBytes store_depth(const DepthPacking& packing, float depth, ChannelStorage storage);
[[nodiscard]] float read_depth(const DepthPacking& packing, const DepthBytes& bytes);

}  // namespace ninebit
