#include "src/shadow/frame/cube_cross.h"

#include <algorithm>

namespace ninebit {
namespace {

constexpr std::size_t kLargestFace = 1024;
constexpr std::uint8_t kAround = 24;

}  // namespace

Image8 cube_cross(int size,
                  const std::function<std::array<std::uint8_t, 3>(std::size_t face, std::size_t texel)>& color) {
  constexpr std::array<std::array<std::size_t, 2>, 6> place{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  const auto texels = static_cast<std::size_t>(size);
  const std::size_t n = std::min(texels, kLargestFace), stride = texels / n;
  Image8 image{static_cast<int>(4 * n), static_cast<int>(3 * n), 3, {}};
  image.pixels.assign(12 * n * n * 3, kAround);
  for (std::size_t face = 0; face < 6; ++face) {
    const std::size_t left = place[face][0] * n, top = place[face][1] * n;
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t x = 0; x < n; ++x) {
        const auto rgb = color(face, (y * texels + x) * stride);
        std::copy(rgb.begin(), rgb.end(),
                  image.pixels.begin() + static_cast<std::ptrdiff_t>(((top + y) * 4 * n + left + x) * 3));
      }
    }
  }
  return image;
}

}  // namespace ninebit
