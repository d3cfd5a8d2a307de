// The causes of wrong pixels as one byte a pixel, as pages read them.
#pragma once

#include "ninebit/shadow/ground_truth.h"

namespace ninebit {

// Grey, the top row first: 0, or the number of the ErrorCause, plus 128 if the pixel is falsely lit.
[[nodiscard]] Image8 cause_plane(const GroundTruth& truth, int width, int height);

}  // namespace ninebit
