// The sample pattern: where a pixel takes pixel lights from the reflective shadow map, and their weights.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/frame/settings.h"

namespace ninebit {

// Offsets in the unit disc, to be multiplied by the kernel's radius.
struct GatherPattern {
  SamplePattern kind = SamplePattern::poisson;
  std::vector<float> x, y;
  // polar: the square of each sample's radius. poisson: empty, because the weight is the square of the offset's x after
  // the pattern has been rotated at the pixel.
  std::vector<float> weight{};

  // The sum of all weights; for poisson, its mean over all rotations.
  [[nodiscard]] double total_weight() const;
};

// A pattern of settings.samples samples. It is the same on every machine: it is made with integers, square roots and
// products only.
//
// poisson: on a grid of 2^-15, each point is the random candidate in the disc that is farthest from all points before
// it. polar: the Hammersley points (i + 1/2) / n and the radical inverse of i as radius and angle.
[[nodiscard]] GatherPattern make_pattern(const ReflectiveSettings& settings);

// Cosine and sine of the angle by which a pixel rotates the Poisson disk: a hash of its window coordinates, so that it
// stays the same from frame to frame. All directions are equally likely.
[[nodiscard]] glm::vec2 pixel_turn(std::uint32_t x, std::uint32_t y);

}  // namespace ninebit
