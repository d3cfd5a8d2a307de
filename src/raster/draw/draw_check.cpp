#include "src/raster/draw/draw_check.h"

#include <algorithm>

#include "src/raster/setup/arrays_check.h"
#include "src/raster/surface/target_check.h"

namespace ninebit {

PixelRect viewport_of(const PipelineState& state, const RenderTarget& target) {
  return state.viewport.value_or(PixelRect{0, 0, target.width, target.height});
}

PixelBox drawn_pixels(const PipelineState& state, const RenderTarget& target) {
  const PixelRect viewport = viewport_of(state, target), scissor = scissored(state, target);
  return {std::max(viewport.x, scissor.x), std::max(viewport.y, scissor.y),
          std::min(viewport.x + viewport.width, scissor.x + scissor.width),
          std::min(viewport.y + viewport.height, scissor.y + scissor.height)};
}

Status check_draw(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units,
                  const RenderTarget& target) {
  if (Status checked = check_target(state, target); !checked) return checked;
  if (Status checked = check_state(state, target); !checked) return checked;
  if (Status checked = check_arrays(state, arrays, units); !checked) return checked;
  return check_output_attributes(target, arrays);
}

Status check_units(const DrawContext& context) {
  for (std::size_t unit = 0; unit < context.samplers.size(); ++unit) {
    const auto reads = [&](int k) { return context.stages && context.stages->reads(static_cast<int>(unit), k); };
    if (!context.samplers[unit] && !reads(0) && !reads(1) && !reads(2)) continue;
    if (Status checked = check_coordinates(context.arrays, unit); !checked) return checked;
  }
  return {};
}

}  // namespace ninebit
