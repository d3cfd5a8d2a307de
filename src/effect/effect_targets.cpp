#include "src/effect/effect_targets.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/raster/rasterizer.h"
#include "src/effect/effect_inputs.h"
#include "src/effect/effect_words.h"

namespace ninebit {

Status EffectTargets::allocate(const Effect& effect) {
  std::vector<EffectTarget> all{{.name = std::string(kPictureTarget),
                                 .cube = false,
                                 .width = effect.width,
                                 .height = effect.height,
                                 .color_format = effect.color_format,
                                 .depth_stencil = effect.depth_stencil}};
  all.insert(all.end(), effect.targets.begin(), effect.targets.end());
  for (const EffectTarget& from : all) {
    Target target{.name = from.name, .format = from.format};
    for (std::size_t f = 0; f < (from.cube ? 6U : 1U); ++f) {
      auto surface =
          Surface::make(from.width, from.height,
                        {.depth_stencil = from.depth_stencil, .color = from.color_format, .samples = from.samples});
      if (!surface) return fault_in("target " + effect_detail::in_quotes(from.name), surface.error());
      target.faces.push_back(std::move(*surface));
    }
    targets_.push_back(std::move(target));
  }
  return {};
}

void EffectTargets::start() {
  for (Target& target : targets_) target.holds_nothing = true;
}

bool EffectTargets::take_start(std::size_t number) {
  return std::exchange(targets_[number].holds_nothing, false);
}

void EffectTargets::fill_start(std::size_t number) {
  if (!take_start(number)) return;
  for (Surface& face : targets_[number].faces) face.fill({});
}

bool EffectTargets::has(std::string_view name) const {
  return number_of(name) < targets_.size();
}

std::size_t EffectTargets::number_of(std::string_view name) const {
  const auto found =
      std::find_if(targets_.begin(), targets_.end(), [&](const Target& target) { return target.name == name; });
  return static_cast<std::size_t>(found - targets_.begin());
}

float EffectTargets::aspect(std::size_t number) const {
  const Surface& face = targets_[number].faces[0];
  return static_cast<float>(face.width()) / static_cast<float>(face.height());
}

Result<Texture> EffectTargets::texture(const EffectTexture& texture) {
  Target& target = targets_[number_of(texture.target)];
  std::vector<TextureImage> images;
  for (Surface& face : target.faces) {
    const RenderTarget planes = face.target();
    TextureImage image{.width = face.width() * sample_columns(face.samples()),
                       .height = face.height() * sample_rows(face.samples())};
    if (texture.origin == TextureOrigin::target_depth) {
      image.planes = std::array<Plane<const std::uint32_t>, 4>{
          Plane<const std::uint32_t>{planes.depth.data, planes.depth.stride, planes.depth.step}};
    } else {
      std::array<Plane<const std::uint8_t>, 4> bytes;
      for (std::size_t c = 0; c < 4; ++c)
        bytes[c] = {planes.color[c].data, planes.color[c].stride, planes.color[c].step};
      image.planes = bytes;
    }
    images.push_back(std::move(image));
  }
  const bool is_16_bit = target.faces[0].format() == DepthStencilFormat::d16;
  const InternalFormat format = texture.origin == TextureOrigin::target_color ? target.format
                                : is_16_bit                                   ? InternalFormat::depth16
                                                                              : InternalFormat::depth24;
  Texture view = texture_view(format, images);
  if (Status checked = check_texture(view); !checked) {
    return fault_in("texture " + effect_detail::in_quotes(texture.name), checked.error());
  }
  return view;
}

Result<std::optional<ClearValues>> clear_before_pass(const EffectClear& c, const HardwareProfile& profile,
                                                     RenderTarget& target, bool is_first) {
  const bool has_stencil = stencil_bits(target.format) > 0;
  const bool clears_all = is_first || (c.color && c.depth && (c.stencil || !has_stencil));
  ClearValues values;
  if (c.color) values.color = c.values.color;
  if (c.depth) values.depth = c.values.depth;
  if (c.stencil) values.stencil = c.values.stencil;
  if (clears_all && target.samples == SampleMode::center_1) return std::optional(values);
  if (clears_all || c.color || c.depth || c.stencil) {
    PipelineState everything;
    everything.profile = profile;
    Status cleared =
        clear(everything, {clears_all || c.color, clears_all || c.depth, (clears_all || c.stencil) && has_stencil},
              values, target);
    if (!cleared) return cleared.error();
  }
  return std::optional<ClearValues>();
}

}  // namespace ninebit
