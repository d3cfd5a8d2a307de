// Where a run of fragments finds its texels, and how these are weighed, in SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/sampler.h"

namespace ninebit {

// A level of a texture and how its texels are counted: `stride` from one row to the next.
struct LaneLevel {
  bool cube = false;
  int width = 1;
  int height = 1;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  std::int32_t stride = 0;
};

using LaneIntegers = std::array<std::int32_t, kBatchSize>;

using LaneWords = std::array<std::uint32_t, kBatchSize>;

// Of each fragment y × stride + x, and the face: 0 where there is but one.
struct NearestLanes {
  alignas(64) LaneIntegers offset;
  alignas(64) LaneIntegers face;
  bool one_face;  // all fragments read face[0]
};

// Of LINEAR four texels: two neighbours in s, then the two above them; `u` and `v` weigh the second in s and in t.
struct LinearLanes {
  alignas(64) std::array<LaneIntegers, 4> offset;
  alignas(64) LaneIntegers face, u, v;
  bool one_face;
};

// The texels that cube_coordinate and nearest_texel select for the first `count` coordinates, 1 to kBatchSize. There
// are kBatchSize of each, of whatever value.
void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to);

// The same with linear_texels, for any mode but Wrap::clamp, whose border is no texel.
void find_linear(const LaneLevel& level, int weight_bits, const std::array<const float*, 3>& at, std::size_t count,
                 LinearLanes& to);

// The words of the texels that find_nearest selects: y × stride + x words from where their face begins, so many words
// after an aligned one. Of up to kMostLanes fragments at a time all are read and written.
inline constexpr std::size_t kMostLanes = 64;
using FaceWords = std::array<std::int32_t, 16>;
void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const std::uint8_t* first,
                         const FaceWords& face_word, std::size_t count, std::uint32_t* to);

// One byte of each of `count` words, the lowest being byte 0.
void split_words(const LaneWords& words, int byte, std::size_t count, s9* to);

// The weighed sum of the texels' bytes, rounded to nearest, halves up, for all lanes of the `count` and some beyond.
using CornerBytes = std::array<std::array<s9, kBatchSize>, 4>;
void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, int weight_bits, std::size_t count,
                  std::array<s9, kBatchSize>& to);

}  // namespace ninebit
