#include <algorithm>
#include <cmath>

#include "ninebit/raster/rasterizer.h"
#include "src/raster/surface/color_words.h"
#include "src/raster/surface/depth_numbers.h"
#include "src/raster/surface/sample_planes.h"
#include "src/raster/surface/target_check.h"

namespace ninebit {
namespace {

template <class T>
void fill(const PixelRect& rect, const Plane<T>& plane, T value) {
  if (!plane) return;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    if (plane.step == 1) {
      std::fill_n(plane.row(y) + rect.x, rect.width, value);
      continue;
    }
    for (int x = rect.x; x < rect.x + rect.width; ++x) plane.at(x, y) = value;
  }
}

void fill_masked(const PixelRect& rect, const Plane<std::uint8_t>& plane, unsigned value, unsigned mask) {
  if (mask == 0xFF) return fill(rect, plane, static_cast<std::uint8_t>(value));
  if (!plane || mask == 0) return;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width; ++x) {
      std::uint8_t& stored = plane.at(x, y);
      stored = static_cast<std::uint8_t>((stored & ~mask) | (value & mask));
    }
  }
}

}  // namespace

std::uint32_t depth_code(DepthStencilFormat format, double depth, std::optional<float> one) {
  if (!(depth > 0.0)) return 0;
  if (layout_of(format).exponent_bits > 0) {
    const DepthNumbers numbers(format, Narrowing::nearest_halves_up);
    const bool has_one = one && !layout_of(format).is_w;
    return numbers.code(std::min(depth, 1.0) * (has_one ? static_cast<double>(*one) : numbers.largest()));
  }
  const std::uint32_t largest = max_depth(format);
  if (depth >= 1.0) return largest;
  const double below = std::floor(depth * largest);
  // The rounded product may equal a half that the exact product does not reach; the sum within fma is exact.
  const bool up = std::fma(depth, static_cast<double>(largest), -(below + 0.5)) >= 0.0;
  return static_cast<std::uint32_t>(below) + (up ? 1 : 0);
}

std::uint8_t stencil_value(DepthStencilFormat format, int stencil) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(stencil) & ((1U << stencil_bits(format)) - 1));
}

Status clear(const PipelineState& state, ClearBuffers buffers, const ClearValues& values, RenderTarget& target) {
  if (target.samples == SampleMode::center_1) {
    if (Status checked = check_target(state, target); !checked) return checked;
  } else {
    if (Status checked = check_samples(state, target); !checked) return checked;
    const RenderTarget first = planes_of_sample(target, sample_places(target.samples)[0]);
    if (Status checked = check_target(state, first); !checked) return checked;
  }
  // All samples of a pixel, which lie side by side.
  const PixelRect pixels = scissored(state, target);
  const int columns = sample_columns(target.samples), rows = sample_rows(target.samples);
  const PixelRect rect{pixels.x * columns, pixels.y * rows, pixels.width * columns, pixels.height * rows};
  if (buffers.color) {
    const std::array<std::uint8_t, 4> color = stored_color(target.color_format, values.color);
    for (std::size_t i = 0; i < 4; ++i) {
      if (state.color_mask[i]) fill(rect, target.color[i], color[i]);
    }
  }
  if (buffers.depth && state.depth_test.write) {
    fill(rect, target.depth, depth_code(target.format, values.depth, state.float_depth_one));
  }
  if (buffers.stencil) {
    const unsigned writable = state.stencil_test.front.write_mask & ((1U << stencil_bits(target.format)) - 1);
    fill_masked(rect, target.stencil, stencil_value(target.format, values.stencil), writable);
  }
  return {};
}

}  // namespace ninebit
