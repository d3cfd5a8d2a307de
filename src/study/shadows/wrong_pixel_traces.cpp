#include "src/study/shadows/wrong_pixel_traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace ninebit {
namespace {

constexpr int kMostOfCause = 3;

}  // namespace

std::vector<WrongPixelTrace> worst_traces(const GroundTruth& truth, int width, int height, const std::string& picture) {
  std::vector<WrongPixelTrace> traces;
  for (const WorstPixel& pixel : worst_pixels(truth, width, height, kMostOfCause)) {
    const int y = height - 1 - pixel.y;
    traces.push_back({{pixel.x, y, fmt::format("{} --pixel {},{} --ground-truth", picture, pixel.x, y)}, pixel});
  }
  return traces;
}

std::vector<WrongPixelTrace> first_of_causes(const std::vector<WrongPixelTrace>& worst) {
  std::vector<WrongPixelTrace> first;
  std::unique_copy(worst.begin(), worst.end(), std::back_inserter(first),
                   [](const WrongPixelTrace& a, const WrongPixelTrace& b) { return a.pixel.cause == b.pixel.cause; });
  return first;
}

std::vector<std::pair<std::string, StudyValue>> fields_of(const WrongPixelTrace& trace) {
  return {{"cause", std::string(name_of(trace.pixel.cause))},
          {"x", std::int64_t{trace.x}},
          {"y", std::int64_t{trace.y}},
          {"radius", std::int64_t{trace.pixel.radius}},
          {"command", trace.command}};
}

}  // namespace ninebit
