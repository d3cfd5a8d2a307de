#include "ninebit/raster/surface.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "src/raster/surface/color_words.h"

namespace ninebit {
namespace {

constexpr std::uint32_t kNoPrimitive = 0xFFFFFFFF;

}  // namespace

std::size_t next_plane_offset() {
  // 13 lines farther each time, modulo 64: neither the same place nor the next line soon again.
  constexpr std::size_t kLine = 64, kLines = 64, kStep = 13;
  static std::atomic<std::size_t> next = 0;
  return next.fetch_add(kStep, std::memory_order_relaxed) % kLines * kLine;
}

Surface::Surface(int width, int height, SurfaceFormat format)
    : width_(width),
      height_(height),
      format_(format.depth_stencil),
      color_format_(format.color),
      samples_(format.samples) {
  const std::size_t count = static_cast<std::size_t>(width * sample_columns(samples_)) *
                            static_cast<std::size_t>(height * sample_rows(samples_));
  const ClearValues start;
  const auto make = [&]<class T>(PlaneSamples<T>& samples, T value, bool undrawn) {
    if (undrawn) {
      samples = undrawn_samples<T>(count);
    } else {
      samples.resize(count, value);
    }
  };
  const std::array<std::uint8_t, 4> color = stored_color(color_format_, start.color);
  for (std::size_t i = 0; i < 4; ++i) make(color_[i], color[i], format.undrawn);
  make(depth_, depth_code(format_, start.depth), format.undrawn);
  // clear() writes the stencil bits and keeps the others. A byte with other bits therefore needs a value here.
  const bool clear_fills_bytes = stencil_bits(format_) == 8;
  if (stencil_bits(format_) > 0) {
    make(stencil_, stencil_value(format_, start.stencil), format.undrawn && clear_fills_bytes);
  }
  if (format.with_primitive) primitive_.resize(count, kNoPrimitive);
}

Result<Surface> Surface::make(int width, int height, SurfaceFormat format) {
  const int columns = sample_columns(format.samples), rows = sample_rows(format.samples);
  if (width < 1 || height < 1 || width > kMaxSurfaceSize / columns || height > kMaxSurfaceSize / rows) {
    const char* const unit = columns == 1 ? " pixels" : " pixels with several samples";
    return Diagnostic{.message = "a surface of " + std::to_string(width) + "x" + std::to_string(height) + unit +
                                 " is out of range; each side must be from 1 to " + std::to_string(kMaxSurfaceSize) +
                                 (columns == 1 ? "" : " samples")};
  }
  return Surface(width, height, format);
}

RenderTarget Surface::target() {
  RenderTarget target;
  target.width = width_;
  target.height = height_;
  target.samples = samples_;
  target.color_format = color_format_;
  target.format = format_;
  const int stride = width_ * sample_columns(samples_);
  for (std::size_t i = 0; i < 4; ++i) target.color[i] = {color_[i].data(), stride};
  target.depth = {depth_.data(), stride};
  if (!stencil_.empty()) target.stencil = {stencil_.data(), stride};
  if (!primitive_.empty()) {
    target.outputs.push_back(
        {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{primitive_.data(), stride}});
  }
  return target;
}

void Surface::fill(const ClearValues& values) {
  const std::array<std::uint8_t, 4> color = stored_color(color_format_, values.color);
  for (std::size_t i = 0; i < 4; ++i) std::fill(color_[i].begin(), color_[i].end(), color[i]);
  std::fill(depth_.begin(), depth_.end(), depth_code(format_, values.depth));
  std::fill(stencil_.begin(), stencil_.end(), stencil_value(format_, values.stencil));
  std::fill(primitive_.begin(), primitive_.end(), kNoPrimitive);
}

}  // namespace ninebit
