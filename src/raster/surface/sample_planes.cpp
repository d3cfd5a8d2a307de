#include "src/raster/surface/sample_planes.h"

#include <array>
#include <variant>

namespace ninebit {
namespace {

// A centre lies 8 sixteenths to the right of its pixel's left side and above its lower one.
constexpr SampleShift kCentre{}, kUpperLeft{8, -8}, kUpperMiddle{0, -8}, kLeftMiddle{8, 0};

constexpr std::array<SamplePlace, 1> kOne{{{0, 0, kCentre}}};
constexpr std::array<SamplePlace, 2> kTwo{{{0, 0, kUpperLeft}, {1, 0, kCentre}}};
constexpr std::array<SamplePlace, 4> kFour{
    {{0, 1, kUpperLeft}, {1, 1, kUpperMiddle}, {0, 0, kLeftMiddle}, {1, 0, kCentre}}};

}  // namespace

std::span<const SamplePlace> sample_places(SampleMode mode) {
  switch (mode) {
    case SampleMode::center_corner_2:
      return kTwo;
    case SampleMode::square_offset_4:
      return kFour;
    case SampleMode::center_1:
      break;
  }
  return kOne;
}

RenderTarget planes_of_sample(const RenderTarget& target, const SamplePlace& sample) {
  const int columns = sample_columns(target.samples), rows = sample_rows(target.samples);
  const auto move = [&](auto& plane) {
    if (!plane) return;
    plane.data = &plane.at(sample.column, sample.row);
    plane.step *= columns;
    plane.stride *= rows;
  };
  RenderTarget planes = target;
  planes.samples = SampleMode::center_1;
  for (auto& plane : planes.color) move(plane);
  move(planes.depth);
  move(planes.stencil);
  for (OutputPlane& output : planes.outputs) {
    std::visit(move, output.plane);
    move(output.owner);
  }
  return planes;
}

}  // namespace ninebit
