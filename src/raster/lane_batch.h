// Fragments of one tile, gathered until there are enough for one run of the combiners. No two of them share a pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/evaluate.h"
#include "src/raster/setup_primitive.h"
#include "src/raster/tile_planes.h"

namespace ninebit {

struct LaneBatch {
  static constexpr std::size_t kSlack = 64;  // vectors are stored whole beyond the last fragment
  static constexpr std::size_t kRoom = kBatchSize + kSlack;
  template <class T>
  using Lanes = std::array<T, kRoom>;

  // Fragments of one primitive, from `first` on.
  struct Run {
    const SetupPrimitive* primitive = nullptr;
    const SetupBlock* block = nullptr;
    std::size_t first = 0;
  };

  // Fragments side by side in a row of the tile, at most a vector of them.
  struct Span {
    std::uint16_t place;  // of the first one's pixel in TilePlanes
    std::uint8_t count;
    std::uint16_t first;  // fragment
  };

  std::size_t count = 0;
  std::size_t runs = 0;
  std::size_t spans = 0;
  std::array<Span, kBatchSize> span;                   // all fragments, in their order
  std::array<Run, kBatchSize + 1> run;                 // one more than there are: its `first` is `count`
  std::array<std::uint64_t, kTileSize> occupied{};     // a bit for each pixel of a row that has a fragment here
  alignas(64) Lanes<std::uint32_t> place;              // of the pixel in TilePlanes
  alignas(64) Lanes<std::uint32_t> depth;              // codes
  alignas(64) std::array<Lanes<float>, 3> weight;      // of the vertices: first edge function / w, then their shares
  alignas(64) Lanes<std::uint32_t> color;              // as in TilePlanes: primary, then what leaves the combiners
  alignas(64) std::array<Lanes<float>, 3> coordinate;  // of a texture
  bool has_constants = false;                          // whether constant registers have been filled
  RegisterBatch registers;
  OutputBatch out;
};

}  // namespace ninebit
