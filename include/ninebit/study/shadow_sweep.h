// The wrong pixels of a technique, compared with the ground truth, over a grid of its settings.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/frame/technique_settings.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/technique.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// An axis of a grid: a setting of technique_settings() that has a flag for sweeps.
struct ShadowAxis {
  std::string_view setting;           // its name: "index-step"
  std::vector<std::string> values{};  // as in flags: "2", "neighbour", "1.125,16"
};

// The axes of a grid, each of another setting. Other settings keep their values. A point is drawn for each combination;
// the first axis changes slowest.
using ShadowGrid = std::vector<ShadowAxis>;

// Polygon offsets for a search: factors from 0 to 4 with units from 0 to 65536. The first is no offset.
[[nodiscard]] std::span<const OffsetArguments> offsets_to_search();

// What `ninebit trace --ground-truth` prints of each of settings.pixels, of the picture with these settings: one text
// for each, in their order.
using TraceTexts =
    std::function<Result<std::vector<std::string>>(const RenderSettings& settings, const Progress& progress)>;

// One unit with one row for each point of the grid: the settings, the counts of drawn and wrong pixels, and the causes.
// Settings that the technique refuses (more polygons than codes) give a row with the reason and without counts. The
// order of indices and the scales have columns only if the grid sweeps them or the settings change them.
//
// The report has the pictures of the best and the worst point. If `question` names the scene's file, it also has the
// commands that explain wrong pixels there, in rows of the table "worst":
//   point, cause, x, y, radius, command   up to three pixels of a cause (worst_pixels); y counted from the top
// Study::draw adds the texts that these commands print, for the page, unless `traces` is empty. `allow_outside`: the
// commands may read textures outside of the scene's folder.
//
// The scene has exactly one camera and one light. The settings, including the profile, are passed to Technique::render;
// `question` names the scene, the settings and the grid. Reports an axis that does not apply to the technique, a
// value that the setting does not allow, a technique that draws no shadows, and the errors of GroundTruthScene::make.
[[nodiscard]] Result<std::unique_ptr<Study>> make_shadow_sweep(StudyQuestion question, Scene scene,
                                                               const Technique& technique,
                                                               const RenderSettings& settings, const ShadowGrid& grid,
                                                               TraceTexts traces = {}, bool allow_outside = false);

}  // namespace ninebit
