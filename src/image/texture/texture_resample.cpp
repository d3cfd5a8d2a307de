// The kind of embedded pictures, and pictures whose sides are not powers of two.
#include <algorithm>
#include <array>
#include <cstdint>

#include "src/image/texture/texture_file.h"
#include "src/raster/texture/resample.h"

namespace ninebit::image_detail {

void resample_to_powers_of_two(FileTexture& texture) {
  for (std::vector<TextureSamples>& levels : texture.faces) ninebit::resample_to_powers_of_two(levels[0]);
}

const char* extension_of_bytes(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg{0xFF, 0xD8, 0xFF};
  const auto starts = [&](const auto& with) {
    return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
  };
  if (starts(kPng)) return ".png";
  return starts(kJpeg) ? ".jpg" : nullptr;
}

}  // namespace ninebit::image_detail
