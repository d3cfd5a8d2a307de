// Memory that one draw call leaves to the next.
#pragma once

#include <memory>
#include <vector>

#include "src/raster/draw/tile_work.h"
#include "src/raster/setup/tile_bins.h"
#include "src/raster/setup/vertex_transform.h"
#include "src/raster/surface/raw_vector.h"

namespace ninebit {

struct DrawScratch {
  RawVector<PackedVertex> packed;
  std::vector<BinnedBlock> blocks;
  TileWork work;
};

// The calling thread's scratch, as long as the lease lives. A thread that waits within a draw may begin another draw,
// which gets its own scratch.
class ScratchLease {
 public:
  ScratchLease();
  ~ScratchLease();
  ScratchLease(const ScratchLease&) = delete;
  ScratchLease& operator=(const ScratchLease&) = delete;
  [[nodiscard]] DrawScratch& operator*() const { return *scratch_; }
  [[nodiscard]] DrawScratch* operator->() const { return scratch_.get(); }

 private:
  std::unique_ptr<DrawScratch> scratch_;
};

}  // namespace ninebit
