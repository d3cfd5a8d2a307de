// The commands that explain a picture's wrong pixels, ready to copy.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/study/report.h"

namespace ninebit {

// A wrong pixel of a drawn picture, and its trace.
struct WrongPixelTrace : PictureTrace {
  WorstPixel pixel;
};

// The worst pixels of each cause. `picture`: `ninebit trace` with the flags that draw the picture.
[[nodiscard]] std::vector<WrongPixelTrace> worst_traces(const GroundTruth& truth, int width, int height,
                                                        const std::string& picture);

// The first of each cause.
[[nodiscard]] std::vector<WrongPixelTrace> first_of_causes(const std::vector<WrongPixelTrace>& worst);

// One in JSON: cause, x, y, radius, command.
[[nodiscard]] std::vector<std::pair<std::string, StudyValue>> fields_of(const WrongPixelTrace& trace);

}  // namespace ninebit
