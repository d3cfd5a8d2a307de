// From clip coordinates to the window: perspective division, viewport, snapping, window depth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "src/raster/setup/window_depth.h"

namespace ninebit {

struct WindowVertex {
  std::int32_t x_q4 = 0;
  std::int32_t y_q4 = 0;
  std::uint32_t z24 = 0;
  float inv_w = 0.0F;
};

// Pixels, right and top exclusive.
struct PixelBox {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;
  [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
};

// The constants of the transformation, for code that transforms several vertices at a time.
struct WindowScale {
  float guard_x, guard_y;  // see WindowTransform
  float half_width, half_height;
  float centre_x, centre_y;
  float steps;  // of the subpixel grid in a pixel
  int to_q4;
  double depth_half, depth_middle;  // (far - near) / 2, (near + far) / 2
};

class WindowTransform {
 public:
  // `viewport` has pixels.
  WindowTransform(const PipelineState& state, const PixelRect& viewport, DepthStencilFormat format);

  // How far the guard band reaches, in multiples of the view volume: window positions stay within 8,192 pixels of the
  // viewport's centre.
  [[nodiscard]] float guard_x() const { return scale_.guard_x; }
  [[nodiscard]] float guard_y() const { return scale_.guard_y; }
  [[nodiscard]] const WindowScale& scale() const { return scale_; }
  [[nodiscard]] const WindowDepth& depth() const { return depth_; }

  // Truncates toward zero to the subpixel grid (rule 21); rounds depth to nearest.
  [[nodiscard]] WindowVertex operator()(const glm::vec4& clip) const;

 private:
  WindowScale scale_;
  WindowDepth depth_;
};

inline WindowVertex WindowTransform::operator()(const glm::vec4& clip) const {
  WindowVertex v;
  v.inv_w = 1.0F / clip.w;
  // Where clipping has cancelled large coordinates, its rounding can leave a corner beyond the guard band.
  const float x = std::clamp(clip.x * v.inv_w, -scale_.guard_x, scale_.guard_x);
  const float y = std::clamp(clip.y * v.inv_w, -scale_.guard_y, scale_.guard_y);
  v.x_q4 = static_cast<std::int32_t>((x * scale_.half_width + scale_.centre_x) * scale_.steps) * scale_.to_q4;
  v.y_q4 = static_cast<std::int32_t>((y * scale_.half_height + scale_.centre_y) * scale_.steps) * scale_.to_q4;
  v.z24 = depth_.z24_of(static_cast<double>(clip.z) / static_cast<double>(clip.w) * scale_.depth_half +
                        scale_.depth_middle);
  return v;
}

}  // namespace ninebit
