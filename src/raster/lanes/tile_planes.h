// One tile of a target, held in a form that vectors of fragments can be drawn into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/raster/surface.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

inline constexpr std::size_t kTilePixels = std::size_t{kTileSize} * kTileSize;

// Row by row, the lowest first, whether or not the target reaches so far. A vector that starts in the last row may
// reach beyond it, and into three more.
struct TilePlanes {
  static constexpr std::size_t kWords = kTilePixels + 3 * kTileSize + 16;
  alignas(64) std::array<std::uint32_t, kWords> depth_stencil{};  // depth code × 256 + stencil value
  alignas(64) std::array<std::uint32_t, kWords> color{};          // red in the lowest byte, alpha in the highest
  alignas(64) std::array<std::uint32_t, kWords> owner{};          // see LaneTile::knows_owners
};

// The farthest depth code in each block of 8 × 8 pixels of a tile, or one beyond it.
struct FarthestDepths {
  static constexpr int kBlock = 8, kBlocks = kTileSize / kBlock;
  alignas(64) std::array<std::uint32_t, std::size_t{kBlocks} * kBlocks> code;

  // Whether all pixels of a region of the tile, both ends included, are nearer than `depth`.
  [[nodiscard]] bool are_nearer(int left, int bottom, int right, int top, std::uint32_t depth) const {
    for (int y = bottom / kBlock; y <= top / kBlock; ++y) {
      for (int x = left / kBlock; x <= right / kBlock; ++x) {
        if (code[static_cast<std::size_t>(y * kBlocks + x)] >= depth) return false;
      }
    }
    return true;
  }
};

// A row of samples in each of the target's planes, and how far it is from there to the next.
struct TileRow {
  Plane<std::uint32_t> depth;
  Plane<std::uint8_t> stencil;
  std::array<Plane<std::uint8_t>, 4> color;

  void move_up() {
    depth.data += depth.stride;
    stencil.data += stencil.stride;
    for (Plane<std::uint8_t>& plane : color) plane.data += plane.stride;
  }
};

}  // namespace ninebit
