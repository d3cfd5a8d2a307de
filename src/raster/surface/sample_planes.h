// The samples of a target with several for each pixel, one after the other as targets of one sample (rule 48).
#pragma once

#include <span>

#include "ninebit/raster/surface.h"

namespace ninebit {

// How far window positions move, in sixteenths of a pixel, so that pixel centres come to lie at a sample's places.
struct SampleShift {
  int x_q4 = 0;
  int y_q4 = 0;
};

// A sample: its place in the pixel's samples in memory, the lowest row first, and in the pixel.
struct SamplePlace {
  int column = 0, row = 0;
  SampleShift shift{};
};

// The samples of a pixel.
[[nodiscard]] std::span<const SamplePlace> sample_places(SampleMode mode);

// The planes of one sample, as a target of one sample for each pixel.
[[nodiscard]] RenderTarget planes_of_sample(const RenderTarget& target, const SamplePlace& sample);

}  // namespace ninebit
