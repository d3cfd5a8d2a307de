// A batch of fragments on its way through interpolation, textures, combiners and fragment operations.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "ninebit/combiner/evaluate.h"
#include "src/raster/fragment/fragment_stages.h"
#include "src/raster/lanes/lane_fragments.h"
#include "src/raster/lanes/tile_planes.h"

namespace ninebit {

struct LanePass;

// The values that a pass computes for a batch. One object serves all batches of the pass.
struct LaneBatch {
  template <class T>
  using Lanes = LaneFragments::Lanes<T>;

  int left = 0, bottom = 0;                            // of the tile
  alignas(64) Lanes<std::uint32_t> color;              // as in TilePlanes: primary, then the combiners' result
  alignas(64) std::array<Lanes<float>, 3> coordinate;  // of a texture
  // The changes of the vertices' shares and of the coordinates to the fragment on the right and to the one above, if
  // the draw needs_texture_changes.
  struct Changes {
    alignas(64) std::array<Lanes<float>, 3> share, coordinate;
  };
  Changes dx, dy;
  alignas(64) Lanes<float> weight_sum;     // of the weights before they were divided by it
  bool has_constants = false;              // true once constant registers have been filled
  std::unique_ptr<FragmentStages> stages;  // if they are enabled
  RegisterBatch registers;
  OutputBatch out;
  Lanes<std::uint8_t> keyed;  // if the draw kills_by_key: 1 for a fragment that is killed, else 0
};

// Draws a batch of a pass that gathers fragments. Of fragments that were gathered whatever the stencil value, draws
// those that pass the stencil test.
void draw_batch(TilePlanes& tile, const LanePass& pass, LaneFragments& fragments);

}  // namespace ninebit
