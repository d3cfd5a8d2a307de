// Where NEAREST finds the texels of a run of fragments, in SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/sampler.h"

namespace ninebit {

// Level 0 of a texture and how its texels are counted: `stride` from one row to the next.
struct NearestLevel {
  bool cube = false;
  int width = 1;
  int height = 1;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  std::int32_t stride = 0;
};

// Of each fragment y × stride + x, and the face: 0 where there is but one.
struct NearestTexels {
  alignas(64) std::array<std::int32_t, kBatchSize> offset;
  alignas(64) std::array<std::int32_t, kBatchSize> face;
  bool one_face;  // all fragments read face[0]
};

// The texels that cube_coordinate and nearest_texel select for the first `count` coordinates, 1 to kBatchSize.
void find_nearest_texels(const NearestLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                         NearestTexels& to);

}  // namespace ninebit
