// Colours that lie in words of RGBA.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ninebit/raster/surface.h"

namespace ninebit {

// Whether the planes of red, green, blue and alpha are there and the bytes of words in memory, red the lowest.
template <class T>
bool are_words(const std::array<Plane<T>, 4>& planes) {
  bool words = std::endian::native == std::endian::little && planes[0];
  for (std::size_t k = 0; k < 4; ++k) {
    words =
        words && planes[k].step == 4 && planes[k].stride == planes[0].stride && planes[k].data == planes[0].data + k;
  }
  return words;
}

// Clear values as the planes hold them.

// A window depth clamped to [0, 1], as the nearest code, halves up. NaN becomes 0. In floating-point formats, `one` is
// PipelineState::float_depth_one; in W buffers the depth is a share of the largest w.
[[nodiscard]] std::uint32_t depth_code(DepthStencilFormat format, double depth, std::optional<float> one = {});

// The low bits of a stencil value.
[[nodiscard]] std::uint8_t stencil_value(DepthStencilFormat format, int stencil);

}  // namespace ninebit
