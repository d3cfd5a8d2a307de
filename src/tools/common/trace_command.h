// The commands that explain wrong pixels, ready to copy.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "src/study/shadows/wrong_pixel_traces.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// The given ones of these options as arguments, but for the technique and those that `reads` rejects.
[[nodiscard]] std::vector<std::string> given_arguments(const CommonFlags& common, std::span<CLI::Option* const> options,
                                                       const std::function<bool(const std::string&)>& reads);

// The worst pixels of each cause in a rendering with these settings. `arguments`: the flags of `render` that drew it,
// without the scene and the size.
[[nodiscard]] std::vector<WrongPixelTrace> worst_traces(const SceneFlags& scene, const RenderSettings& settings,
                                                        std::span<const std::string> arguments,
                                                        const GroundTruth& truth);

// [{cause, x, y, radius, command}]
[[nodiscard]] Json worst_json(const std::vector<WrongPixelTrace>& worst);

// A line for the worst pixel of each cause; empty if none is wrong.
[[nodiscard]] std::string worst_text(const std::vector<WrongPixelTrace>& worst);

}  // namespace ninebit::tools
