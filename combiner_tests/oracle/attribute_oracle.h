// A slow and naive model of what a fragment reads besides its colour: the fog factor and texture coordinates. Its only
// job is to judge the library's.
//
// It is written from chapter 3.4 to 3.6 and 3.10 of the OpenGL 1.3 specification, from NV_point_sprite, and from what
// pictures of an NV2A show of fog functions, point sprites and cylinder wrap. It shares no code with what it judges: of
// the library's headers it includes those of plain data, for the state and the sampler as the question.
#pragma once

#include <array>
#include <vector>

#include "combiner_tests/oracle/raster_oracle.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/sampler.h"

namespace ninebit::oracle {

struct AttributeVertex {
  WindowVertex position{};
  float w = 1;
  std::array<float, 4> coordinate{0, 0, 0, 1};  // s, t, r, q of one unit
  float fog = 0;                                // factor or coordinate
};

struct Attributes {
  std::array<long double, 4> coordinate{};
  long double fog = 0;
};

// Those of a point, line or triangle of one to three vertices at the pixel's centre; of a line, at the foot of the
// perpendicular from it. `unit` is the one whose coordinates the vertices have.
[[nodiscard]] Attributes attributes_at(const PipelineState& state, const Sampler& sampler, std::size_t unit,
                                       const std::vector<AttributeVertex>& primitive, int px, int py);

// The lowest and the highest byte that a fog factor may be where x is so uncertain, and the factor as floats are.
[[nodiscard]] std::array<int, 2> fog_bytes(const HardwareProfile& profile, const Fog& fog, long double x,
                                           long double error);

}  // namespace ninebit::oracle
