// The fragment of a rendering to trace, and a report on its pixel.
#pragma once

#include <optional>
#include <string>

#include "src/effect/traced_pixel.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Renders the scene and probes the pixel, which must be inside the picture. The traced fragment is the one that decided
// the result of deciding_pass(); without a program it is traced only if `other_program` replaces it.
[[nodiscard]] Result<TracedPixel> render_pixel(const SceneFlags& flags, const CommonFlags& common, int x, int y,
                                               bool other_program);

[[nodiscard]] std::string pixel_text(const TracedPixel& pixel);

// One fragment of it: "polygon 3 of object 1 'torus': depth … against stored …, written".
[[nodiscard]] std::string fragment_text(const TracedPixel& pixel, const ProbedFragment& fragment);

}  // namespace ninebit::tools
