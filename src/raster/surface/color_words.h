// Colours that lie in words of RGBA.
#pragma once

#include <array>
#include <bit>
#include <cstddef>

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

}  // namespace ninebit
