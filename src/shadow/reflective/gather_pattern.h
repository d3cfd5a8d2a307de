// Where around its place in a reflective shadow map a pixel takes pixel lights, and how much each of them counts.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/shadow/settings.h"

namespace ninebit {

// Offsets in the unit disc, to be multiplied by the kernel's radius.
struct GatherPattern {
  SamplePattern kind = SamplePattern::poisson;
  std::vector<float> x, y;
  // Of polar: of each sample, the square of its radius. Of poisson empty: the weight is the square of the offset's x
  // after the pattern has been turned at the pixel.
  std::vector<float> weight{};

  // The sum of all weights; of poisson its mean over all turns.
  [[nodiscard]] double total_weight() const;
};

// A pattern of settings.samples samples. The same on every machine: integers, square roots and products alone.
//
// poisson: each point is the best of some random candidates in the disc, the one farthest from all points before it, on
// a grid of 2^-15. polar: the Hammersley points (i + 1/2) / n and the radical inverse of i as radius and angle.
[[nodiscard]] GatherPattern make_pattern(const ReflectiveSettings& settings);

// Cosine and sine of the angle by which a pixel turns the Poisson disk: a hash of its window coordinates, so that it
// stays the same from frame to frame. Equally likely in all directions.
[[nodiscard]] glm::vec2 pixel_turn(std::uint32_t x, std::uint32_t y);

}  // namespace ninebit
