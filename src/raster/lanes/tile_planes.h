// One tile of a render target, held in words that vectors of fragments can be drawn into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/raster/surface.h"
#include "src/raster/setup/window_transform.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

inline constexpr std::size_t kTilePixels = std::size_t{kTileSize} * kTileSize;

// A word for each pixel, row by row, the lowest row first, whether or not the target reaches that far. The words behind
// them are for vectors: one that starts in the last row may reach beyond it, and into three more rows.
inline constexpr std::size_t kTileWords = kTilePixels + 3 * kTileSize + 16;
using TileWords = std::array<std::uint32_t, kTileWords>;

// The planes of a target that a tile holds, and those that it is written back to.
struct TileContents {
  bool depth = false;
  bool stencil = false;
  bool writes_depth = false;
  bool writes_stencil = false;
  std::array<bool, 4> color{};       // held and written back
  bool draws_depth_stencil = false;  // true if a pass writes depth or stencil
  bool clears = false;  // true if tiles begin with clear values: all planes are held, and written but for a depth that
                        // is discarded
  bool is_sample = false;  // true if the samples between the target's are others of the same pixels

  [[nodiscard]] bool has_color() const { return color[0] || color[1] || color[2] || color[3]; }
};

// How a row's samples lie in the target's planes.
enum class RowForm : std::uint8_t {
  side_by_side,  // or colours in words, as they lie in the tile
  streamed,      // the same, and whole rows are stored past the caches
  every_second,  // those between are not the target's; vectors write them back
  scattered      // vectors cannot read and write them
};

// The tile's planes: large. The target must outlive them.
struct TilePlanes {
  TilePlanes(const RenderTarget& render_target, const TileContents& planes);

  // Makes this the tile in which `drawn` lies: the pixels that are taken over and written back.
  void move_to(const PixelBox& drawn);

  const RenderTarget& target;
  const TileContents contents;
  const bool colors_are_words;  // true if the target's colours lie in memory as they do here
  const RowForm form;           // of the planes that the tile holds

  PixelBox pixels{};         // the pixels that may be drawn
  int left = 0, bottom = 0;  // the tile's lowest corner
  // True once depth and stencil have been filled with clear values that no pass changes: they serve the next tiles,
  // too.
  bool keeps_depth_stencil = false;

  alignas(64) TileWords depth_stencil{};  // depth code × 256 + stencil value
  alignas(64) TileWords color{};          // red in the lowest byte, alpha in the highest
};

// Reads the pixels that may be drawn from the target.
void load_tile(TilePlanes& tile);

// Fills the tile with clear values. Prefetches the target's cache lines, which store_tile will write.
void fill_tile(TilePlanes& tile, const ClearValues& values);

// Writes the pixels that may be drawn to the target.
void store_tile(const TilePlanes& tile);

// The farthest depth code in each block of 8 × 8 pixels of a tile, or a farther one.
struct FarthestDepths {
  static constexpr int kBlock = 8, kBlocks = kTileSize / kBlock;
  // True during a pass that uses `code`: found when the pass began, and no depth has become farther since.
  bool are_known = false;
  alignas(64) std::array<std::uint32_t, std::size_t{kBlocks} * kBlocks> code;

  // True if all pixels of a region of the tile, both ends included, are nearer than `depth`.
  [[nodiscard]] bool are_nearer(int left, int bottom, int right, int top, std::uint32_t depth) const {
    for (int y = bottom / kBlock; y <= top / kBlock; ++y) {
      for (int x = left / kBlock; x <= right / kBlock; ++x) {
        if (code[static_cast<std::size_t>(y * kBlocks + x)] >= depth) return false;
      }
    }
    return true;
  }
};

// Sets `to.code` from the tile's depths.
void find_farthest(const TilePlanes& tile, FarthestDepths& to);

}  // namespace ninebit
