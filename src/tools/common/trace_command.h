// The commands that explain wrong pixels, ready to copy.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// The given ones of these options as arguments, but for the technique and those that `reads` rejects.
[[nodiscard]] std::vector<std::string> given_arguments(const CommonFlags& common, std::span<CLI::Option* const> options,
                                                       const std::function<bool(const std::string&)>& reads);

// A wrong pixel of a drawn picture, and `ninebit trace … --ground-truth` of it.
struct WrongPixelTrace {
  WorstPixel pixel;
  int x = 0, y = 0;  // counted from the top left
  std::string command;
};

// The worst pixels of each cause in a rendering with these settings. `arguments`: the flags of `render` that drew it,
// without the scene and the size.
[[nodiscard]] std::vector<WrongPixelTrace> worst_traces(const SceneFlags& scene, const RenderSettings& settings,
                                                        std::span<const std::string> arguments,
                                                        const GroundTruth& truth);

// [{cause, x, y, radius, command}]
[[nodiscard]] Json json_of(std::span<const WrongPixelTrace> worst);

// A line for the worst pixel of each cause; empty if none is wrong.
[[nodiscard]] std::string text_of(std::span<const WrongPixelTrace> worst);

}  // namespace ninebit::tools
