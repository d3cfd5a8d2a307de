// The fragment of an effect's picture to trace.
#pragma once

#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "src/tools/trace/trace_pixel.h"

namespace ninebit::tools {

struct TracedEffect {
  TracedPixel pixel;
  const HardwareProfile* profile = nullptr;  // that the effect was drawn with
};

// Draws the effect file and probes the pixel X,Y of its picture, counted from the top left. The rectangles that passes
// draw count as one more object, whose polygons come after those of the mesh. `allow_outside` as in EffectReadOptions.
// `given`: the profile of --profile, or nullptr. Reports what `ninebit draw` reports, and a pixel outside of the
// picture.
[[nodiscard]] Result<TracedEffect> draw_pixel(const std::string& file, const std::string& pixel, bool allow_outside,
                                              const CommonFlags& common, const HardwareProfile* given);

}  // namespace ninebit::tools
