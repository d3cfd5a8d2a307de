#include "src/raster/tile.h"

#include <algorithm>
#include <array>

#include "src/raster/edges_and_depth.h"

namespace ninebit {

void draw_in_tile(const DrawContext& context, const TileRect& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, bool flat_result, FragmentBatch& batch) {
  const FragmentOperations& operations = context.operations;
  for (const std::uint32_t index : indices) {
    const SetupTriangle& t = block.triangles[index];
    const EdgesAndDepth plane(t);
    const auto [x_low, x_high] = std::minmax({t.x_q4[0], t.x_q4[1], t.x_q4[2]});
    const auto [y_low, y_high] = std::minmax({t.y_q4[0], t.y_q4[1], t.y_q4[2]});
    const int left = std::max(tile.left, (x_low + 7) >> 4), right = std::min(tile.right - 1, (x_high - 8) >> 4);
    const int bottom = std::max(tile.bottom, (y_low + 7) >> 4), top = std::min(tile.top - 1, (y_high - 8) >> 4);
    const bool narrow = right - left < 8;  // testing each pixel costs less than dividing for the span
    const ColorBytes color = flat_result ? flat_color(context.arrays, t.primitive) : ColorBytes{};
    for (int y = bottom; y <= top; ++y) {
      int first = left, last = right;
      if (!narrow && !plane.span(y, first, last)) continue;
      std::array<std::int64_t, 3> e = plane.at(first, y);
      for (int x = first; x <= last; ++x, plane.step_right(e)) {
        if (narrow && !plane.inside(e)) continue;
        const Fragment fragment{x, y, plane.z24(e), t.primitive};
        if (operations.is_lost_early(fragment)) continue;
        if (flat_result) {
          operations.apply(fragment, color);
        } else {
          batch.push(fragment, t, block, e);
        }
      }
    }
  }
}

}  // namespace ninebit
