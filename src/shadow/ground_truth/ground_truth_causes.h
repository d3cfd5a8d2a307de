// Why a pixel's shadow is wrong.
#pragma once

#include <cstdint>
#include <span>

#include "ninebit/shadow/ground_truth.h"
#include "src/shadow/ground_truth/ground_truth_rays.h"

namespace ninebit {

// One wrong pixel.
struct WrongPixel {
  bool lit;                              // lit and should be in shadow; otherwise the reverse
  std::uint32_t own;                     // the triangle that it shows
  std::uint32_t fetched;                 // ShadowEvidence::fetched there; 0 without a map
  std::span<const RayCrossing> between;  // the triangles between it and the light
};

[[nodiscard]] ErrorCause cause_of(const Scene& scene, const ShadowEvidence& evidence, const WrongPixel& pixel);

}  // namespace ninebit
