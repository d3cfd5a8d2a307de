#include "src/raster/draw/draw_scratch.h"

#include <cstddef>
#include <utility>

namespace ninebit {
namespace {

thread_local std::unique_ptr<DrawScratch> kept;

// The memory that a thread keeps: enough for meshes of some million triangles.
constexpr std::size_t kMostBytes = std::size_t{48} << 20;

std::size_t bytes_of(const DrawScratch& scratch) {
  std::size_t bytes = scratch.packed.capacity() * sizeof(PackedVertex);
  for (const BinnedBlock& b : scratch.blocks) {
    bytes += b.setup.primitives.capacity() * sizeof(SetupPrimitive) +
             b.setup.corners.capacity() * sizeof(SetupCorners) + b.setup.weights.capacity() * sizeof(glm::mat3) +
             (b.tile.capacity() + b.indices.capacity() + b.first.capacity()) * sizeof(std::uint32_t);
  }
  return bytes;
}

}  // namespace

ScratchLease::ScratchLease() : scratch_(std::move(kept)) {
  if (!scratch_) scratch_ = std::make_unique<DrawScratch>();
}

ScratchLease::~ScratchLease() {
  if (!kept && bytes_of(*scratch_) <= kMostBytes) kept = std::move(scratch_);
}

}  // namespace ninebit
