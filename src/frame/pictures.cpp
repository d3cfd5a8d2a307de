#include "ninebit/frame/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/frame/packed_map.h"

namespace ninebit {
namespace {

// A visible colour for each code number. Steps of the golden ratio put neighbouring numbers far apart on the circle of
// hues, and three brightnesses separate hues that come close again.
std::array<std::uint8_t, 3> hue_of(std::uint32_t number) {
  if (number == 0) return {0, 0, 0};
  const double hue = std::fmod(static_cast<double>(number) * 0.6180339887498949, 1.0) * 6.0;
  const double value = 255.0 - 45.0 * (number % 3);
  const double low = value * 0.25;
  const auto ramp = [&](double offset) {
    const double h = std::fmod(hue + offset, 6.0);
    const double level = std::clamp(std::fabs(h - 3.0) - 1.0, 0.0, 1.0);
    return static_cast<std::uint8_t>(low + (value - low) * level + 0.5);
  };
  return {ramp(0.0), ramp(4.0), ramp(2.0)};
}

}  // namespace

Image8 surface_picture(const Surface& surface, int channels) {
  const int width = surface.width(), height = surface.height();
  Image8 image{width, height, channels, {}};
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  const auto count = static_cast<std::size_t>(channels);
  image.pixels.resize(rows * columns * count);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < count; ++c) {
      const std::uint8_t* const from = &surface.color(static_cast<int>(c))[row * columns];
      std::uint8_t* const to = &image.pixels[(rows - 1 - row) * columns * count + c];
      for (std::size_t x = 0; x < columns; ++x) to[x * count] = from[x];
    }
  }
  return image;
}

Image8 color_picture(const Rendering& rendering) {
  return surface_picture(rendering.frame, 3);
}

Image8 stencil_picture(const Rendering& rendering) {
  const int width = rendering.frame.width(), height = rendering.frame.height();
  Image8 image{width, height, 1, {}};
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  image.pixels.resize(rows * columns);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* const from = &rendering.frame.stencil()[row * columns];
    std::uint8_t* const to = &image.pixels[(rows - 1 - row) * columns];
    for (std::size_t x = 0; x < columns; ++x) to[x] = from[x] != 0 ? 255 : 0;
  }
  return image;
}

Image8 index_cross_picture(const Rendering& rendering) {
  ColorBytes last{};  // most texels have the code of the one before
  std::array<std::uint8_t, 3> hue = hue_of(rendering.codes.number(last));
  return cube_cross(rendering.index_map.front().size, [&](std::size_t face, std::size_t texel) {
    const ColorBytes code = rendering.index_map[face].texel(texel);
    if (code != last) hue = hue_of(rendering.codes.number(last = code));
    return hue;
  });
}

Image8 averaged(const Image8& image, int n) {
  Image8 out{image.width / n, image.height / n, image.channels, {}};
  const auto channels = static_cast<std::size_t>(image.channels),
             row = channels * static_cast<std::size_t>(image.width);
  const auto side = static_cast<std::size_t>(n);
  const std::uint32_t count = static_cast<std::uint32_t>(side * side);
  for (std::size_t y = 0; y < static_cast<std::size_t>(out.height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(out.width); ++x) {
      for (std::size_t c = 0; c < channels; ++c) {
        std::uint32_t sum = count / 2;
        for (std::size_t v = 0; v < side; ++v) {
          for (std::size_t u = 0; u < side; ++u) {
            sum += image.pixels[(y * side + v) * row + (x * side + u) * channels + c];
          }
        }
        out.pixels.push_back(static_cast<std::uint8_t>(sum / count));
      }
    }
  }
  return out;
}

Image8 as_shown(Image8 image, const Rendering& rendering, int n) {
  const bool of_frame = image.width == rendering.frame.width() && image.height == rendering.frame.height();
  return of_frame && n > 1 ? averaged(image, n) : std::move(image);
}

}  // namespace ninebit
