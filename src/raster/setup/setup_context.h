// The values of a draw call that setting up its primitives needs.
#pragma once

#include <algorithm>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"
#include "src/raster/setup/clip.h"
#include "src/raster/setup/polygon_offset.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

struct SetupContext {
  // `viewport` has pixels; `drawn` are those that may be drawn: the target's within viewport and scissor.
  // `corners`: whether fragments take more from their primitives than depths and flat colours.
  SetupContext(const PipelineState& state, const PixelRect& viewport, const PixelBox& drawn_pixels,
               DepthStencilFormat format, bool corners, const SampleShift& shift = {})
      : window(state, viewport, format, shift),
        guard{window.guard_x(), window.guard_y()},
        drawn(drawn_pixels),
        counter_clockwise_is_front(state.front_face == FrontFace::counter_clockwise),
        cull_front(state.cull_face == CullFace::front || state.cull_face == CullFace::front_and_back),
        cull_back(state.cull_face == CullFace::back || state.cull_face == CullFace::front_and_back),
        front_mode(state.front_mode),
        back_mode(state.back_mode),
        point_eighths(eighths_of(state.point_size)),
        line_eighths(eighths_of(state.line_width)),
        point_shape(state.profile.point_shape),
        line_shape(state.line_smooth ? LineShape::rectangles : state.profile.line_shape.value),
        smooth_polygons(state.polygon_smooth),
        smooth_lines(state.line_smooth),
        offset(state.polygon_offset),
        offset_rule{state.profile.polygon_offset_slope, state.profile.polygon_offset_fraction},
        needs_corners(corners) {}

  [[nodiscard]] bool is_front(bool counter_clockwise) const { return counter_clockwise == counter_clockwise_is_front; }
  [[nodiscard]] bool is_culled(bool front) const { return front ? cull_front : cull_back; }
  [[nodiscard]] PolygonMode mode(bool front) const { return front ? front_mode : back_mode; }
  [[nodiscard]] bool is_offset(PolygonMode m) const {
    return m == PolygonMode::fill ? offset.fill : m == PolygonMode::line ? offset.line : offset.point;
  }
  // Whether polygons are filled, whatever their facing.
  [[nodiscard]] bool fills() const { return front_mode == PolygonMode::fill && back_mode == PolygonMode::fill; }
  // The offset of primitives that have none: 0.
  [[nodiscard]] SetupOffset no_offset() const {
    return window.depth().is_real() ? SetupOffset(0.0F) : SetupOffset(0, window.depth().cuts());
  }
  // The pixels that may be drawn whose centres, at 16 i + 8, the box in 1/16 pixel holds.
  [[nodiscard]] PixelBounds pixels_in(int left, int low, int right, int high) const {
    return {static_cast<std::int16_t>(std::max((left + 7) >> 4, drawn.left)),
            static_cast<std::int16_t>(std::max((low + 7) >> 4, drawn.bottom)),
            static_cast<std::int16_t>(std::min((right - 8) >> 4, drawn.right - 1)),
            static_cast<std::int16_t>(std::min((high - 8) >> 4, drawn.top - 1))};
  }

  WindowTransform window;
  GuardBand guard;
  PixelBox drawn;
  bool counter_clockwise_is_front;
  bool cull_front;
  bool cull_back;
  PolygonMode front_mode;
  PolygonMode back_mode;
  int point_eighths;  // size
  int line_eighths;   // width
  PointShape point_shape;
  LineShape line_shape;
  bool smooth_polygons;
  bool smooth_lines;
  PolygonOffset offset;
  OffsetRule offset_rule;
  bool needs_corners;
};

}  // namespace ninebit
