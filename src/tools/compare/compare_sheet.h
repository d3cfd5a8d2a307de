// `ninebit compare --sheet`: all compared pictures with captions and counts as one picture.
#pragma once

#include "src/tools/compare/compare_points.h"

namespace ninebit::tools {

// Reports a sheet that is larger than a PNG may be. Needs no rendering.
[[nodiscard]] Status check_sheet(const Comparison& comparison);

// Each picture has its name above it; below are its wrong pixels, if it was judged, and their counts. The rows have
// their pictures (compared_row).
[[nodiscard]] Image8 compare_sheet(const CompareFlags& flags, const Comparison& comparison);

}  // namespace ninebit::tools
