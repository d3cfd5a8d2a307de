// A rendering judged by rays, rows of pixels at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "src/shadow/ground_truth/ground_truth_rays.h"

namespace ninebit {

// Reports a rendering that cannot be judged with these settings.
[[nodiscard]] Status check_rendering(const RenderSettings& settings, const Rendering& rendering);

class Judge {
 public:
  // The rendering was made with these settings, and check_rendering accepts it. All three must outlive the judge.
  Judge(const GroundTruthScene::Rays& rays, const RenderSettings& settings, const Rendering& rendering);

  // Judges rows [first, last), counted from the lowest.
  void judge_rows(int first, int last);

  // One pixel with all that is known of it.
  [[nodiscard]] JudgedPixel judged(int x, int y) const;

  // Whether the light, a spot, reaches each point that the picture shows: for the camera it is a point light then.
  [[nodiscard]] bool spot_holds_picture() const;

  // The truth about all rows, after all of them were judged once. The judge is empty then.
  [[nodiscard]] GroundTruth finish();

 private:
  void judge_pixel(int x, int y, std::vector<RayCrossing>& between);
  [[nodiscard]] bool turns_away(const Corners& triangle) const;
  [[nodiscard]] bool outside_spot(const glm::dvec3& point) const;

  const GroundTruthScene::Rays& rays_;
  const Scene& scene_;
  const Light& light_;
  const RenderSettings& settings_;
  const Rendering& rendering_;
  PixelRays pixel_rays_;
  glm::dmat4 spot_{1.0};
  GroundTruth truth_;
};

// Why a pixel's shadow is wrong.

// One wrong pixel.
struct WrongPixel {
  bool lit;                              // lit and should be in shadow; otherwise the reverse
  std::uint32_t own;                     // the triangle that it shows
  std::uint32_t fetched;                 // ShadowEvidence::fetched there; 0 without a map
  std::span<const RayCrossing> between;  // the triangles between it and the light
};

[[nodiscard]] ErrorCause cause_of(const Scene& scene, const ShadowEvidence& evidence, const WrongPixel& pixel);

// The causes of wrong pixels as one byte a pixel, as pages read them.

// Grey, the top row first: 0, or the number of the ErrorCause, plus 128 if the pixel is falsely lit.
[[nodiscard]] Image8 cause_plane(const GroundTruth& truth, int width, int height);

}  // namespace ninebit
