#include "ninebit/raster/surface.h"

#include <algorithm>

namespace ninebit {

Surface::Surface(int width, int height, bool with_primitive) : width_(width), height_(height) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (auto& plane : color_) plane.resize(count);
  depth_.resize(count, kMaxDepthZ24);
  stencil_.resize(count);
  if (with_primitive) primitive_.resize(count, 0xFFFFFFFF);
}

Result<Surface> Surface::make(int width, int height, bool with_primitive) {
  if (width < 1 || height < 1 || width > kMaxSurfaceSize || height > kMaxSurfaceSize) {
    return Diagnostic{.message = "a surface of " + std::to_string(width) + "x" + std::to_string(height) +
                                 " pixels cannot be drawn; each side goes from 1 to " +
                                 std::to_string(kMaxSurfaceSize)};
  }
  return Surface(width, height, with_primitive);
}

RenderTarget Surface::target() {
  RenderTarget target;
  target.width = width_;
  target.height = height_;
  for (std::size_t i = 0; i < 4; ++i) target.color[i] = {color_[i].data(), width_};
  target.depth_z24 = {depth_.data(), width_};
  target.stencil = {stencil_.data(), width_};
  if (!primitive_.empty()) target.primitive = {primitive_.data(), width_};
  return target;
}

void Surface::clear(const ClearValues& values) {
  for (std::size_t i = 0; i < 4; ++i) std::fill(color_[i].begin(), color_[i].end(), values.color[i]);
  std::fill(depth_.begin(), depth_.end(), values.depth_z24);
  std::fill(stencil_.begin(), stencil_.end(), values.stencil);
  std::fill(primitive_.begin(), primitive_.end(), values.primitive);
}

}  // namespace ninebit
