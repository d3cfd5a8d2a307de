// The fragment of a rendering to trace, and a report on its pixel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
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

// The fragment of an effect's picture to trace.

struct TracedEffect {
  TracedPixel pixel;
  const HardwareProfile* profile = nullptr;  // that the effect was drawn with
};

// Draws the effect file and probes the pixel X,Y of its picture, counted from the top left. The rectangles that passes
// draw count as one more object, whose polygons come after those of the mesh. `allow_outside` as in EffectReadOptions.
// `given`: the profile of --profile, or nullptr. `defines`: as ProgramFlags::defines. Reports what `ninebit draw`
// reports, and a pixel outside of the picture.
[[nodiscard]] Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel, bool allow_outside,
                                              const CommonFlags& common, const HardwareProfile* given,
                                              const std::vector<std::string>& defines);

}  // namespace ninebit::tools
