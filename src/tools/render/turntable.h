// `ninebit render --turntable`: pictures from all around.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/image/staged_files.h"
#include "src/tools/render/render_answer.h"

namespace ninebit::tools {

// The most frames of --turntable.
inline constexpr int kMostFrames = 3600;

// The camera of frame `number` of `count`: turned about the vertical axis through the point that it looks at, counter-
// clockwise as seen from above. Frame 0 is the camera itself.
[[nodiscard]] Camera turned(const Camera& camera, int number, int count);

// Renders the frames of --turntable and stages color_000.png and so on. The light stays where it is. The rendering of
// frame 0 stays in `done`. Without `files` the pictures go to the host alone. `step` is called with the share of the
// work that is done; false ends it.
[[nodiscard]] Status draw_turntable(const RenderFlags& flags, StagedFiles* files, const Progress& step,
                                    FinishedRender& done);

}  // namespace ninebit::tools
