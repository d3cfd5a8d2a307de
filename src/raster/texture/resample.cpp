#include "src/raster/texture/resample.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace ninebit {
namespace {

// Where a target sample reads: between `first` and `second`, with `weight` / 256 of the second.
struct ResampleTap {
  std::size_t first = 0, second = 0;
  std::int64_t weight = 0;
};

std::vector<ResampleTap> taps_of(std::int64_t source, std::int64_t target) {
  std::vector<ResampleTap> taps(static_cast<std::size_t>(target));
  for (std::int64_t i = 0; i < target; ++i) {
    // In units of 1/256 sample: floor(((2i + 1) source / (2 target) - 1/2) 256 + 1/2), with one division.
    const std::int64_t doubled = (2 * i + 1) * source * 256 - 255 * target;  // over 2 target; may be negative
    const std::int64_t at = std::clamp<std::int64_t>(doubled >= 0 ? doubled / (2 * target) : 0, 0, (source - 1) * 256);
    const auto first = static_cast<std::size_t>(at / 256);
    taps[static_cast<std::size_t>(i)] = {first, std::min(first + 1, static_cast<std::size_t>(source - 1)), at % 256};
  }
  return taps;
}

std::uint8_t mix_taps(std::uint8_t a, std::uint8_t b, std::int64_t weight) {
  return static_cast<std::uint8_t>((a * (256 - weight) + b * weight + 128) / 256);
}

float mix_taps(float a, float b, std::int64_t weight) {
  return a + (b - a) * (static_cast<float>(weight) / 256.0F);
}

template <class T>
std::vector<T> resampled_plane(const std::vector<T>& samples, const std::array<std::size_t, 2>& from,
                               const std::array<std::size_t, 2>& to) {
  const std::vector<ResampleTap> columns =
      taps_of(static_cast<std::int64_t>(from[0]), static_cast<std::int64_t>(to[0]));
  const std::vector<ResampleTap> rows = taps_of(static_cast<std::int64_t>(from[1]), static_cast<std::int64_t>(to[1]));
  const std::size_t planes = samples.size() / (from[0] * from[1]);
  std::vector<T> wide(planes * to[0] * from[1]);
  for (std::size_t row = 0; row < planes * from[1]; ++row) {
    for (std::size_t x = 0; x < to[0]; ++x) {
      const ResampleTap& tap = columns[x];
      wide[row * to[0] + x] =
          mix_taps(samples[row * from[0] + tap.first], samples[row * from[0] + tap.second], tap.weight);
    }
  }
  std::vector<T> out(planes * to[0] * to[1]);
  for (std::size_t row = 0; row < planes * to[1]; ++row) {
    const ResampleTap& tap = rows[row % to[1]];
    const std::size_t plane = row / to[1] * from[1];
    for (std::size_t x = 0; x < to[0]; ++x) {
      out[row * to[0] + x] =
          mix_taps(wide[(plane + tap.first) * to[0] + x], wide[(plane + tap.second) * to[0] + x], tap.weight);
    }
  }
  return out;
}

}  // namespace

void resample_to_powers_of_two(TextureSamples& image) {
  const std::array<std::size_t, 2> from{static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height)};
  const std::array<std::size_t, 2> to{std::bit_ceil(from[0]), std::bit_ceil(from[1])};
  if (auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.samples)) *bytes = resampled_plane(*bytes, from, to);
  if (auto* floats = std::get_if<std::vector<float>>(&image.samples)) *floats = resampled_plane(*floats, from, to);
  image.width = static_cast<int>(to[0]);
  image.height = static_cast<int>(to[1]);
}

}  // namespace ninebit
