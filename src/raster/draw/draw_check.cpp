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

Status check_call(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units,
                  const RenderTarget& target) {
  if (Status checked = check_target(state, target); !checked) return checked;
  if (Status checked = check_state(state, target); !checked) return checked;
  if (Status checked = check_arrays(state, arrays, units); !checked) return checked;
  return check_output_attributes(target, arrays);
}

bool has_one_w(const glm::mat4& m, const VertexArrays& arrays) {
  return !arrays.positions.empty() && m[0][3] == 0.0F && m[1][3] == 0.0F && m[2][3] == 0.0F;
}

Status check_w(const PipelineState& state, bool one_w, const RenderTarget& target) {
  const DepthStencilLayout& layout = layout_of(target.format);
  if (!layout.is_w || !state.depth_test.enabled || !one_w) return {};
  return Diagnostic{.message = "the W buffer " + std::string(layout.name) +
                               " needs a perspective view, but this matrix gives every vertex the same w"};
}

Status check_units(const DrawContext& context) {
  if (context.stages && context.stages->replaces_depth() && context.depth.is_real()) {
    return Diagnostic{.message = "texture-shader stages cannot replace depths of the floating-point and W buffers"};
  }
  for (std::size_t unit = 0; unit < context.samplers.size(); ++unit) {
    const auto reads = [&](int k) { return context.stages && context.stages->reads(static_cast<int>(unit), k); };
    if (!context.samplers[unit] && !reads(0) && !reads(1) && !reads(2)) continue;
    if (Status checked = check_coordinates(context.arrays, unit); !checked) return checked;
  }
  return {};
}

}  // namespace ninebit
