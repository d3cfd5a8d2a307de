// A technique's wrong pixels against the ground truth, over a grid of its settings.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// The axes of a grid; one without values stays at what the settings say. A point is drawn for each combination, the
// first axis changing slowest.
struct ShadowGrid {
  std::vector<int> map_sizes{};                    // techniques with a map
  std::vector<IndexFormat> index_formats{};        // index-cube and light-cookie
  std::vector<IndexScope> index_scopes{};          // likewise
  std::vector<int> index_steps{};                  // likewise
  std::vector<DepthCubeBits> depth_bits{};         // depth-cube
  std::vector<float> biases{};                     // likewise, in world units
  std::vector<DepthEncoding> encodings{};          // shadow-map
  std::vector<OffsetArguments> polygon_offsets{};  // likewise
};

// Offsets to look for the best one among: factors from 0 to 4 with units from 0 to 65536, no offset at all the first.
[[nodiscard]] std::span<const OffsetArguments> offsets_to_search();

// A unit for each point of the grid, with one row: the settings, what was drawn, what of it is wrong and why. Settings
// that the technique refuses (more polygons than codes) have a row without counts that says why.
//
// The scene has exactly one camera and one light, as for Technique::render, which the settings, the profile among them,
// are for; `question` names both, and the grid. Reports an axis that the technique does not know, a technique that
// draws no shadows, and what GroundTruthScene::make reports.
[[nodiscard]] Result<std::unique_ptr<Study>> make_shadow_sweep(StudyQuestion question, Scene scene,
                                                               const Technique& technique,
                                                               const RenderSettings& settings, const ShadowGrid& grid);

}  // namespace ninebit
