// From clip coordinates to the window: perspective division, viewport, snapping, window depth.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "src/raster/rules/one_fragment.h"
#include "src/raster/surface/depth_numbers.h"
#include "src/raster/surface/sample_planes.h"

namespace ninebit {

// Window depth in 24 bits: the depth codes of a target's format, with as many fraction bits as are left. Formats that
// hold floating-point numbers or w have real numbers instead, which become codes at each fragment.

class WindowDepth {
 public:
  // `narrowing` is that of depths on primitives, to codes; `one` is PipelineState::float_depth_one.
  constexpr WindowDepth(DepthStencilFormat format, Narrowing narrowing, std::optional<float> one = {})
      : layout_(layout_of(format)),
        numbers_(format, narrowing),
        one_(one ? static_cast<double>(*one) : numbers_.largest()),
        fraction_bits_(24 - depth_bits(format)),
        half_(narrowing == Narrowing::toward_zero ? 0 : (1 << fraction_bits_) >> 1),
        cuts_(narrowing == Narrowing::toward_zero),
        max_z24_(std::int64_t{max_depth(format)} << fraction_bits_) {}

  // One step of the format, and the depth 1.
  [[nodiscard]] constexpr std::int64_t step_z24() const { return std::int64_t{1} << fraction_bits_; }
  [[nodiscard]] constexpr std::int64_t max_z24() const { return max_z24_; }
  [[nodiscard]] constexpr int fraction_bits() const { return fraction_bits_; }
  // Added to z24 by code() before it drops the fraction bits.
  [[nodiscard]] constexpr int half() const { return half_; }
  // Whether depths on primitives are cut; else they are rounded to nearest, halves up.
  [[nodiscard]] constexpr bool cuts() const { return cuts_; }

  // Whether depths are real numbers, and whether these are w.
  [[nodiscard]] constexpr bool is_real() const { return !layout_.is_fixed_z(); }
  [[nodiscard]] constexpr bool is_w() const { return layout_.is_w; }
  // The number of window depth 1 in a floating-point format.
  [[nodiscard]] constexpr double one() const { return one_; }

  // A vertex's depth as primitives hold it: z24_of(depth), or the bits of a float, which is the depth in [0, 1] or 1/w.
  [[nodiscard]] std::uint32_t corner_of(double depth, float inv_w) const {
    if (!is_real()) return z24_of(depth);
    if (is_w()) return std::bit_cast<std::uint32_t>(inv_w);
    return std::bit_cast<std::uint32_t>(depth > 0.0 ? static_cast<float>(std::min(depth, 1.0)) : 0.0F);
  }

  // The code of a real number (rules 50 and 51); depths are cut or rounded as on primitives.
  [[nodiscard]] std::uint32_t code_of_number(double number) const { return numbers_.code(number); }
  [[nodiscard]] constexpr const DepthNumbers& numbers() const { return numbers_; }

  // A vertex's depth in [0, 1], rounded to nearest, halves up; clamped, NaN becomes 0.
  [[nodiscard]] constexpr std::uint32_t z24_of(double depth) const {
    const auto largest = static_cast<double>(max_z24_);
    const double z = depth * largest + 0.5;
    if (!(z > 0.0)) return 0;
    return z >= largest ? static_cast<std::uint32_t>(max_z24_) : static_cast<std::uint32_t>(z);
  }

  // The code that is compared and stored. |offset_z24| is at most 2^25.
  [[nodiscard]] std::uint32_t code(std::uint32_t z24, std::int32_t offset_z24) const {
    return static_cast<std::uint32_t>(one_fragment::depth_code(one_fragment::Numbers(), static_cast<std::int32_t>(z24),
                                                               offset_z24, static_cast<std::int32_t>(max_z24_),
                                                               fraction_bits_, half_));
  }

 private:
  DepthStencilLayout layout_;
  DepthNumbers numbers_;
  double one_;
  int fraction_bits_, half_;
  bool cuts_;
  std::int64_t max_z24_;
};

struct WindowVertex {
  std::int32_t x_q4 = 0;
  std::int32_t y_q4 = 0;
  std::uint32_t z24 = 0;  // WindowDepth::corner_of()
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
  float steps;                      // of the subpixel grid in a pixel
  int to_q4_bits;                   // a step of the grid is 2^this sixteenths
  SampleShift shift;                // after snapping
  double depth_half, depth_middle;  // (far - near) / 2, (near + far) / 2
};

class WindowTransform {
 public:
  // `viewport` has pixels.
  WindowTransform(const PipelineState& state, const PixelRect& viewport, DepthStencilFormat format,
                  const SampleShift& shift = {});

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
  const int to_q4 = 1 << scale_.to_q4_bits;
  // Where clipping has cancelled large coordinates, its rounding can leave a corner beyond the guard band.
  const float x = std::clamp(clip.x * v.inv_w, -scale_.guard_x, scale_.guard_x);
  const float y = std::clamp(clip.y * v.inv_w, -scale_.guard_y, scale_.guard_y);
  v.x_q4 =
      static_cast<std::int32_t>((x * scale_.half_width + scale_.centre_x) * scale_.steps) * to_q4 + scale_.shift.x_q4;
  v.y_q4 =
      static_cast<std::int32_t>((y * scale_.half_height + scale_.centre_y) * scale_.steps) * to_q4 + scale_.shift.y_q4;
  v.z24 = depth_.corner_of(
      static_cast<double>(clip.z) / static_cast<double>(clip.w) * scale_.depth_half + scale_.depth_middle, v.inv_w);
  return v;
}

}  // namespace ninebit
