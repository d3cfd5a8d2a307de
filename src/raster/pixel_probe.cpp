#include "src/raster/pixel_probe.h"

#include "src/raster/edges_and_depth.h"

namespace ninebit {

PixelProbe::PixelProbe(const DrawContext& draw, FragmentProbe& probe)
    : real_(draw.target),
      probe_(probe),
      target_(planes_of_one()),
      operations_(draw.state, target_),
      context_{draw.state, draw.arrays, draw.textures, target_, operations_, draw.initial},
      batch_(context_) {}

// A plane where the draw has one.
RenderTarget PixelProbe::planes_of_one() {
  RenderTarget target;
  target.width = target.height = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (real_.color[i]) target.color[i] = {&color_[i], 1};
  }
  if (real_.depth_z24) target.depth_z24 = {&depth_z24_, 1};
  if (real_.stencil) target.stencil = {&stencil_, 1};
  if (real_.primitive) target.primitive = {&primitive_, 1};
  return target;
}

void PixelProbe::meet_planes() {
  for (std::size_t i = 0; i < 4; ++i) {
    if (real_.color[i]) color_[i] = real_.color[i].at(probe_.x, probe_.y);
  }
  if (real_.depth_z24) depth_z24_ = real_.depth_z24.at(probe_.x, probe_.y);
  if (real_.stencil) stencil_ = real_.stencil.at(probe_.x, probe_.y);
  if (real_.primitive) primitive_ = real_.primitive.at(probe_.x, probe_.y);
}

void PixelProbe::run(const SetupBlock& block, std::span<const std::uint32_t> indices) {
  for (const std::uint32_t index : indices) {
    const SetupTriangle& t = block.triangles[index];
    const EdgesAndDepth plane(t);
    const std::array<std::int64_t, 3> e = plane.at(probe_.x, probe_.y);
    if (!plane.inside(e)) continue;
    const std::uint32_t stored_z24 = depth_z24_;
    const std::uint8_t stored_stencil = stencil_;
    ProbedFragment& probed =
        probe_.fragments.emplace_back(batch_.run_alone({0, 0, plane.z24(e), t.primitive}, t, block, e));
    probed.stored_z24 = stored_z24;
    probed.stored_stencil = stored_stencil;
  }
}

}  // namespace ninebit
