// Vectors whose new elements nobody clears, because they are written at once.
#pragma once

#include <vector>

#include "ninebit/raster/plane_samples.h"

namespace ninebit {

// Of plain data: resize() leaves what it adds without a value.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace ninebit
