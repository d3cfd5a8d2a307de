// From clip coordinates to the window: perspective division, viewport, snapping, window depth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "src/raster/window_depth.h"

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

class WindowTransform {
 public:
  // `viewport` has pixels.
  WindowTransform(const PipelineState& state, const PixelRect& viewport, DepthStencilFormat format);

  // How far the guard band reaches, in multiples of the view volume: window positions stay within 8,192 pixels of the
  // viewport's centre.
  [[nodiscard]] float guard_x() const { return guard_x_; }
  [[nodiscard]] float guard_y() const { return guard_y_; }
  [[nodiscard]] const WindowDepth& depth() const { return depth_; }

  // Truncates toward zero to the subpixel grid (rule 21); rounds depth to nearest.
  [[nodiscard]] WindowVertex operator()(const glm::vec4& clip) const;

 private:
  float guard_x_, guard_y_;
  float half_width_, half_height_;
  float centre_x_, centre_y_;
  float steps_;  // of the subpixel grid in a pixel
  int to_q4_;
  double depth_half_, depth_middle_;  // (far - near) / 2, (near + far) / 2
  WindowDepth depth_;
};

inline WindowVertex WindowTransform::operator()(const glm::vec4& clip) const {
  WindowVertex v;
  v.inv_w = 1.0F / clip.w;
  // Where clipping has cancelled large coordinates, its rounding can leave a corner beyond the guard band.
  const float x = std::clamp(clip.x * v.inv_w, -guard_x_, guard_x_);
  const float y = std::clamp(clip.y * v.inv_w, -guard_y_, guard_y_);
  v.x_q4 = static_cast<std::int32_t>((x * half_width_ + centre_x_) * steps_) * to_q4_;
  v.y_q4 = static_cast<std::int32_t>((y * half_height_ + centre_y_) * steps_) * to_q4_;
  v.z24 = depth_.z24_of(static_cast<double>(clip.z) / static_cast<double>(clip.w) * depth_half_ + depth_middle_);
  return v;
}

}  // namespace ninebit
