// A shadow map packed into bytes and read as floats, as three.js' shaders did it; beyond the hardware.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ninebit/frame/depth_packing.h"
#include "ninebit/frame/rendering.h"
#include "ninebit/image/image_io.h"

namespace ninebit {

class PackedMap {
 public:
  // Packs the codes of a depth surface of size² texels. Texels that still hold `cleared` become white, as three.js
  // clears its maps. The planes go into `maps` as packed_depth, which must outlive this.
  PackedMap(const DepthPacking& packing, ChannelStorage storage, int size, std::span<const std::uint32_t> codes,
            std::uint32_t cleared, std::deque<Layer>& maps);

  // The largest change that packing made to a drawn depth, in the range [0, 1].
  [[nodiscard]] double largest_error() const { return largest_error_; }

  // The memory of its texels.
  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const auto& plane : bytes_) sum += plane.size();
    return sum;
  }

  // The depth that a shader reads at the nearest texel; s and t are from 0 to 1.
  [[nodiscard]] float depth_at(float s, float t) const;

 private:
  const DepthPacking* packing_;
  ChannelStorage storage_;
  int size_;
  std::array<std::span<std::uint8_t>, 4> bytes_;
  double largest_error_ = 0.0;
};

// Cube maps as pictures.

// Six faces of size × size texels as a cross of 4 × 3 faces: +Y on top, then -X +Z +X -Z, -Y below; texel t = 0 on top
// as the extension's faces have it. color(face, texel) returns the three bytes of a texel, numbered row by row, of a
// face in the order of CubeFace. Faces above 1,024 texels a side show only every second, fourth, … texel.
template <class Color>
[[nodiscard]] Image8 cube_cross(int size, const Color& color) {
  constexpr std::size_t kLargestFace = 1024;
  constexpr std::uint8_t kAround = 24;
  constexpr std::array<std::array<std::size_t, 2>, 6> kPlace{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  const auto texels = static_cast<std::size_t>(size);
  const std::size_t n = std::min(texels, kLargestFace), stride = texels / n;
  Image8 image{static_cast<int>(4 * n), static_cast<int>(3 * n), 3, {}};
  image.pixels.assign(12 * n * n * 3, kAround);
  for (std::size_t face = 0; face < 6; ++face) {
    const std::size_t left = kPlace[face][0] * n, top = kPlace[face][1] * n;
    for (std::size_t y = 0; y < n; ++y) {
      std::uint8_t* to = &image.pixels[((top + y) * 4 * n + left) * 3];
      for (std::size_t x = 0; x < n; ++x) {
        for (const std::uint8_t byte : color(face, (y * texels + x) * stride)) *to++ = byte;
      }
    }
  }
  return image;
}

// Surfaces store their lowest row first, pictures their highest.

// The index in a picture of sample i of a plane of the same size.
[[nodiscard]] inline std::size_t upright_index(std::size_t i, int width, int height) {
  const auto row = static_cast<std::size_t>(width);
  return (static_cast<std::size_t>(height) - 1 - i / row) * row + i % row;
}

}  // namespace ninebit
