#include "src/study/report/report_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace ninebit {
namespace {

constexpr int kLargestMap = 4096;

// Colours at equal intervals from 0 to an end, from light to dark.
constexpr std::array kWarm{Rgb{255, 255, 255}, Rgb{253, 219, 199}, Rgb{244, 165, 130},
                           Rgb{214, 96, 77},   Rgb{178, 24, 43},   Rgb{103, 0, 31}};
constexpr std::array kCold{Rgb{255, 255, 255}, Rgb{209, 229, 240}, Rgb{146, 197, 222},
                           Rgb{67, 147, 195},  Rgb{33, 102, 172},  Rgb{5, 48, 97}};
constexpr std::array kAmber{Rgb{255, 255, 255}, Rgb{254, 227, 145}, Rgb{254, 175, 66},
                            Rgb{233, 111, 22},  Rgb{164, 58, 4},    Rgb{72, 24, 8}};

// The colour at share_255 / 255 of the way, in integer arithmetic, so that every machine rounds alike.
Rgb between(std::span<const Rgb> stops, std::size_t share_255) {
  const std::size_t scaled = share_255 * (stops.size() - 1);
  const std::size_t lower = std::min(scaled / 255, stops.size() - 2);
  const int part = static_cast<int>(scaled - lower * 255);
  const auto mix = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>((from * (255 - part) + to * part + 127) / 255);
  };
  const Rgb a = stops[lower], b = stops[lower + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

ColorRamp ramp_of(std::span<const Rgb> below, std::span<const Rgb> above) {
  ColorRamp ramp;
  for (std::size_t i = 0; i <= 255; ++i) {
    ramp[255 - i] = between(below, i);
    ramp[255 + i] = between(above, i);
  }
  return ramp;
}

}  // namespace

std::string css_color(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

const ColorRamp& color_ramp(const HeatMap& map) {
  static const ColorRamp two_sided = ramp_of(kCold, kWarm);
  static const ColorRamp one_sided = ramp_of(kAmber, kAmber);
  return map.low < 0.0F ? two_sided : one_sided;
}

Rgb color_of(const HeatMap& map, float value) {
  if (std::isnan(value)) return kNoValue;
  double share = 0.0;
  if (map.low < 0.0F) {
    const double end = value < 0.0F ? -static_cast<double>(map.low) : static_cast<double>(map.high);
    share = end > 0.0 ? static_cast<double>(value) / end : 0.0;
  } else if (map.high > map.low) {
    share = (static_cast<double>(value) - static_cast<double>(map.low)) /
            (static_cast<double>(map.high) - static_cast<double>(map.low));
    share = std::max(share, 0.0);
  }
  return color_ramp(map)[static_cast<std::size_t>(255.0 + std::floor(std::clamp(share, -1.0, 1.0) * 255.0 + 0.5))];
}

Status check_size(const HeatMap& map) {
  if (map.width < 1 || map.height < 1 || map.width > kLargestMap || map.height > kLargestMap ||
      map.values.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height)) {
    return Diagnostic{fmt::format("the heat map \"{}\" has {} values; expected {} x {}, with sides of 1 to {}",
                                  map.title, map.values.size(), map.width, map.height, kLargestMap)};
  }
  const auto fits = [](const std::vector<double>& values, int side) {
    return values.empty() || values.size() == static_cast<std::size_t>(side);
  };
  if (!fits(map.x_values, map.width) || !fits(map.y_values, map.height)) {
    return Diagnostic{fmt::format("the heat map \"{}\" has {} and {} coordinates; expected {} and {}, or none",
                                  map.title, map.x_values.size(), map.y_values.size(), map.width, map.height)};
  }
  return {};
}

Result<Image8> picture_of(const HeatMap& map, int least_side) {
  if (const Status status = check_size(map); !status) return status.error();
  const int factor = std::max(1, least_side / std::max(map.width, map.height));
  Image8 image{map.width * factor, map.height * factor, 3, {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb color =
          color_of(map, map.values[static_cast<std::size_t>(y / factor) * static_cast<std::size_t>(map.width) +
                                   static_cast<std::size_t>(x / factor)]);
      image.pixels.insert(image.pixels.end(), {color.r, color.g, color.b});
    }
  }
  return image;
}

}  // namespace ninebit
