#include "src/raster/draw/pixel_probe.h"

namespace ninebit {

PixelProbe::PixelProbe(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units,
                       const RenderTarget& target, FragmentProbe& probe)
    : real_(target),
      probe_(probe),
      target_(planes_of_one_row()),
      context_(state, arrays, units, target_, true),
      batch_(context_) {}

// A plane if the draw has one.
RenderTarget PixelProbe::planes_of_one_row() {
  RenderTarget target;
  target.width = real_.width;
  target.height = real_.height;
  target.color_format = real_.color_format;
  target.format = real_.format;
  const auto row = [&](auto& samples, const auto& real) -> std::remove_cvref_t<decltype(real)> {
    if (!real) return {};
    samples.resize(static_cast<std::size_t>(real_.width));
    return {samples.data(), 0};
  };
  for (std::size_t i = 0; i < 4; ++i) target.color[i] = row(color_[i], real_.color[i]);
  target.depth = row(depth_, real_.depth);
  target.stencil = row(stencil_, real_.stencil);
  return target;
}

void PixelProbe::meet_planes() {
  const auto take_over = [&](const auto& real, const auto& own) {
    if (real) own.at(probe_.x, probe_.y) = real.at(probe_.x, probe_.y);
  };
  for (std::size_t i = 0; i < 4; ++i) take_over(real_.color[i], target_.color[i]);
  take_over(real_.depth, target_.depth);
  take_over(real_.stencil, target_.stencil);
}

void PixelProbe::run(const SetupBlock& block, std::span<const std::uint32_t> indices) {
  const PixelBox pixel{probe_.x, probe_.y, probe_.x + 1, probe_.y + 1};
  for (const std::uint32_t& index : indices) {
    draw_in_tile(context_, pixel, block, {&index, 1}, &batch_);
    if (batch_.size() == 0) continue;
    const std::uint32_t depth = target_.depth ? target_.depth.at(probe_.x, probe_.y) : 0;
    const std::uint8_t stencil = target_.stencil ? target_.stencil.at(probe_.x, probe_.y) : std::uint8_t{0};
    ProbedFragment& probed = probe_.fragments.emplace_back(batch_.run_alone());
    probed.stored_depth = depth;
    probed.stored_stencil = stencil;
  }
}

std::deque<PixelProbe> pixel_probes(const PipelineState& state, const VertexArrays& arrays,
                                    std::span<const TextureUnit> units, const RenderTarget& target) {
  std::deque<PixelProbe> probes;
  if (target.probes == nullptr) return probes;
  for (FragmentProbe& probe : *target.probes) probes.emplace_back(state, arrays, units, target, probe);
  return probes;
}

}  // namespace ninebit
