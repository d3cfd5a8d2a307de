// Depth in [0, 1] packed into bytes, as shaders of three.js and of other engines do it.
//
// GLSL before 3.00 has no integers to shift, so a depth is split into digits in floats, in base 256 or 255. But a byte
// n of a texture reads n / 255, not n / 256: a packing is accurate if it takes that into account. The functions compute
// in float32, in the shaders' order of operations; a dot product is summed from red to alpha, which GLSL leaves open.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// How the texels of a shadow map hold a depth in [0, 1]: as a code of 24 or 16 bits, or packed.
enum class DepthEncoding : std::uint8_t { d24, d16, rgba8_fract, rgba8_mod, rgba8_256over255, rgba8_modf };
// How a component becomes a byte, and a byte a component.
enum class ChannelStorage : std::uint8_t { round, truncate, floor_256, half };

// A storage in words; stored_component() and read_component() compute it.
struct StorageRule {
  ChannelStorage storage;    // the storage
  std::string_view name;     // "round"
  std::string_view help;     // "components rounded to bytes"
  std::string_view formula;  // the byte of component v, and what byte n reads as
  std::string_view source;   // where it is found
};

// All storages, in the order of the enum.
[[nodiscard]] std::span<const StorageRule> storage_rules();

// "round", "truncate", "floor-256", "half".
[[nodiscard]] std::string_view name_of(ChannelStorage storage);

// Red, green, blue, alpha as the shader writes them. A component that rounding, an added half or depth 1 moves out of
// [0, 1] is clamped when it is stored. Components that a packing does not use are 0.
using DepthComponents = std::array<float, 4>;
using DepthBytes = std::array<std::uint8_t, 4>;

// A way to split a depth into components and to join them again.
struct DepthPacking {
  std::string_view name;                           // "rgba8-fract"
  std::string_view formula;                        // the components of depth d, and the depth of components c
  std::string_view source;                         // where it is found
  int channels;                                    // bytes used: 2 (red and green) to 4
  bool red_is_highest;                             // the first component is the most significant; otherwise the last
  DepthComponents (*pack)(float depth);            // depth is in [0, 1]
  float (*unpack)(const DepthComponents& stored);  // components as a texture returns them, each n / 255
  // read_depth() of store_depth() of each depth, into as many values of `back`, which lie elsewhere: many at once.
  void (*round_trips)(std::span<const float> depths, ChannelStorage storage, std::span<float> back);
};

// All packings: those of three.js, the oldest first, then those of base 255, then other ones. Four of the first are
// those of --depth-encoding.
[[nodiscard]] std::span<const DepthPacking> depth_packings();

// The packing of that name, or nullptr.
[[nodiscard]] const DepthPacking* find_depth_packing(std::string_view name);

// The packing of an encoding; nullptr for d24 and d16, which need none.
[[nodiscard]] const DepthPacking* depth_packing(DepthEncoding encoding);

// The byte that a texture of eight bits a channel stores for a component, clamped to [0, 1]: times 255 (floor_256:
// 255.999) without rounding, then truncated, or rounded to the nearest whole number, halves up (round and half). NaN
// gives 0.
[[nodiscard]] constexpr std::uint8_t stored_component(float component, ChannelStorage storage) {
  const float above = component > 0.0F ? component : 0.0F, v = above < 1.0F ? above : 1.0F;
  const double scale = storage == ChannelStorage::floor_256 ? 255.999 : 255.0;
  const bool rounded = storage == ChannelStorage::round || storage == ChannelStorage::half;
  return static_cast<std::uint8_t>(static_cast<int>(static_cast<double>(v) * scale + (rounded ? 0.5 : 0.0)));
}

// The value that a shader reads from byte n: n / 255 in float32; with half, that rounded to eleven significant bits,
// ties to even, as a 16-bit float has them.
[[nodiscard]] constexpr float read_component(std::uint8_t byte, ChannelStorage storage) {
  const float value = static_cast<float>(static_cast<int>(byte)) / 255.0F;
  if (storage != ChannelStorage::half) return value;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>((bits + 0xFFFU + (bits >> 13 & 1U)) & ~0x1FFFU);
}

// A depth's bytes in a texture, and the depth that a shader reads from them. Bytes beyond packing.channels are 0.
[[nodiscard]] DepthBytes store_depth(const DepthPacking& packing, float depth, ChannelStorage storage);
[[nodiscard]] float read_depth(const DepthPacking& packing, const DepthBytes& bytes, ChannelStorage storage);

}  // namespace ninebit
