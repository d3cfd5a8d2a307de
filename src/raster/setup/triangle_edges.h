// Coverage and depth of a triangle, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "src/raster/rules/one_fragment.h"
#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/pixel_span.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/surface/floor_divider.h"

namespace ninebit {

// A triangle's edge functions and depth plane at pixel centres. Edge i lies opposite corner i; its function is twice
// the area of the triangle that the edge and the point make, positive inside, in square sixteenths of a pixel.
class TriangleEdges {
 public:
  explicit TriangleEdges(const SetupPrimitive& t) : TriangleEdges(t, t.x_q4(), t.y_q4()) {}

  [[nodiscard]] std::array<std::int64_t, 3> at(int x, int y) const {
    std::array<std::int64_t, 3> e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = origin_[i] + step_x_[i] * x + step_y_[i] * y;
    return e;
  }
  void step_right(std::array<std::int64_t, 3>& e) const {
    for (std::size_t i = 0; i < 3; ++i) e[i] += step_x_[i];
  }
  [[nodiscard]] bool inside(const std::array<std::int64_t, 3>& e) const {
    return e[0] >= threshold_[0] && e[1] >= threshold_[1] && e[2] >= threshold_[2];
  }

  // The depth plane with the triangle's fraction, cut (rules 20 and 28). Within the triangle the plane lies between the
  // corners' depths.
  [[nodiscard]] std::uint32_t z24(const std::array<std::int64_t, 3>& e) const {
    const std::int64_t wide = e[0] * triangle_.z24[0] + e[1] * triangle_.z24[1] + e[2] * triangle_.z24[2];
    return static_cast<std::uint32_t>(divide_(wide + fraction_));
  }

  // How many coverage samples of a pixel lie inside, whose edge functions these are.
  [[nodiscard]] int samples_inside(const std::array<std::int64_t, 3>& e) const {
    int inside_count = 0;
    for (const CoverageSample& sample : kCoverageSamples) {
      std::array<std::int64_t, 3> at_sample;
      for (std::size_t i = 0; i < 3; ++i) {
        at_sample[i] = e[i] + step_x_[i] / 16 * sample.x_q4 + step_y_[i] / 16 * sample.y_q4;
      }
      inside_count += inside(at_sample) ? 1 : 0;
    }
    return inside_count;
  }
  // Narrows [first, last] to the pixels of row y inside the triangle; false: there are none.
  [[nodiscard]] bool span(int y, int& first, int& last) const {
    const std::array<std::int64_t, 3> e = at(0, y);
    std::int64_t low = first, high = last;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!keep_inside(e[i] - threshold_[i], step_x_[i], low, high)) return false;
    }
    first = static_cast<int>(low);
    last = static_cast<int>(high);
    return low <= high;
  }

  // The sum of the edge functions.
  [[nodiscard]] std::int64_t area() const { return area_; }
  [[nodiscard]] std::int64_t step_x(std::size_t i) const { return step_x_[i]; }
  [[nodiscard]] std::int64_t step_y(std::size_t i) const { return step_y_[i]; }
  // An edge function below it is outside.
  [[nodiscard]] int threshold(std::size_t i) const { return threshold_[i]; }
  // 1 / the sum of the edge functions.
  [[nodiscard]] double inverse_area() const { return divide_.inverse; }

 private:
  using Positions = std::array<std::int32_t, 3>;
  static std::int32_t sign(std::int64_t v) { return v < 0 ? -1 : v > 0 ? 1 : 0; }
  static std::int64_t area_of(const Positions& x, const Positions& y) {
    return static_cast<std::int64_t>(x[1] - x[0]) * (y[2] - y[0]) -
           static_cast<std::int64_t>(y[1] - y[0]) * (x[2] - x[0]);
  }

  TriangleEdges(const SetupPrimitive& t, const Positions& x, const Positions& y)
      : triangle_(t), area_(area_of(x, y)), fraction_(t.fraction_of(area_)), divide_(area_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      const std::int64_t dx = x[b] - x[a], dy = y[b] - y[a];
      step_x_[i] = -dy * 16;
      step_y_[i] = dx * 16;
      // At the centre of pixel (0, 0); the rule is in rules/top_left.inl.
      origin_[i] = dx * (8 - y[a]) - dy * (8 - x[a]);
      threshold_[i] = one_fragment::top_left_sign(one_fragment::Numbers(), sign(dx), sign(dy)) < 0 ? 0 : 1;
    }
  }

  const SetupPrimitive& triangle_;
  std::int64_t area_, fraction_;
  FloorDivider divide_;
  std::array<std::int64_t, 3> step_x_, step_y_, origin_;
  std::array<int, 3> threshold_;
};

}  // namespace ninebit
