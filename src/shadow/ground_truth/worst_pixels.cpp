// Which wrong pixels are worth a look.
#include <algorithm>
#include <array>
#include <cstdlib>

#include "ninebit/shadow/ground_truth.h"

namespace ninebit {
namespace {

constexpr int kApart = 8;  // parts of the picture's sides

// For each pixel the distance to the nearest pixel of another cause, or outside, in steps to any of eight neighbours:
// two passes over the picture find it exactly.
std::vector<int> radii_of(const std::vector<ErrorCause>& cause, int width, int height) {
  std::vector<int> radius(cause.size());
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const auto reach = [&](int x, int y, int to_x, int to_y) {
    const bool is_inside = to_x >= 0 && to_y >= 0 && to_x < width && to_y < height;
    const bool is_same = is_inside && cause[index(to_x, to_y)] == cause[index(x, y)];
    return is_same ? radius[index(to_x, to_y)] + 1 : 1;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      radius[index(x, y)] = std::min(
          {reach(x, y, x - 1, y), reach(x, y, x - 1, y - 1), reach(x, y, x, y - 1), reach(x, y, x + 1, y - 1)});
    }
  }
  for (int y = height - 1; y >= 0; --y) {
    for (int x = width - 1; x >= 0; --x) {
      radius[index(x, y)] = std::min({radius[index(x, y)], reach(x, y, x + 1, y), reach(x, y, x + 1, y + 1),
                                      reach(x, y, x, y + 1), reach(x, y, x - 1, y + 1)});
    }
  }
  return radius;
}

}  // namespace

std::vector<WorstPixel> worst_pixels(const GroundTruth& truth, int width, int height, int most) {
  const std::vector<int> radius = radii_of(truth.cause, width, height);
  std::array<std::vector<WorstPixel>, kErrorCauses> found;
  for (int round = 0; round < most; ++round) {
    std::array<WorstPixel, kErrorCauses> best{};
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const auto cause = static_cast<std::size_t>(truth.cause[i]);
        if (truth.cause[i] == ErrorCause::none || radius[i] <= best[cause].radius) continue;
        const auto is_near = [&](const WorstPixel& other) {
          return std::abs(x - other.x) * kApart < width && std::abs(y - other.y) * kApart < height;
        };
        if (std::any_of(found[cause].begin(), found[cause].end(), is_near)) continue;
        best[cause] = {truth.cause[i], x, y, radius[i]};
      }
    }
    for (std::size_t cause = 0; cause < kErrorCauses; ++cause) {
      if (best[cause].radius > 0) found[cause].push_back(best[cause]);
    }
  }
  std::vector<WorstPixel> all;
  for (const auto& of_cause : found) all.insert(all.end(), of_cause.begin(), of_cause.end());
  return all;
}

}  // namespace ninebit
