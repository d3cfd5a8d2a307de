// The surfaces that an effect draws into.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/effect/effect.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"

namespace ninebit {

// The picture, which is target 0, and the effect's own targets.
class EffectTargets {
 public:
  // Reports what Surface::make reports.
  [[nodiscard]] Status allocate(const Effect& effect);

  // A target's content before the first pass is colour 0, depth 1, stencil 0. It is filled in when it is needed:
  // start() forgets what all surfaces hold, take_start() says whether a target holds nothing yet, and takes it that the
  // caller clears it; fill_start() fills those that hold nothing.
  void start();
  [[nodiscard]] bool take_start(std::size_t number);
  void fill_start(std::size_t number);

  [[nodiscard]] std::size_t count() const { return targets_.size(); }
  [[nodiscard]] bool has(std::string_view name) const;
  [[nodiscard]] std::size_t number_of(std::string_view name) const;  // of a known name
  [[nodiscard]] std::span<Surface> faces(std::size_t number) { return targets_[number].faces; }
  [[nodiscard]] std::span<const Surface> faces(std::size_t number) const { return targets_[number].faces; }
  [[nodiscard]] bool is_cube(std::size_t number) const { return targets_[number].faces.size() == 6; }
  [[nodiscard]] float aspect(std::size_t number) const;  // width / height

  // A view of the target that a texture reads; it reads what is drawn later. Reports what check_texture reports.
  [[nodiscard]] Result<Texture> texture(const EffectTexture& texture);

 private:
  struct Target {
    std::string name;
    InternalFormat format;
    std::vector<Surface> faces{};
    bool holds_nothing = true;
  };
  std::vector<Target> targets_{};
};

// The clear before a pass, as part of its draw; empty if it is done here: that of some planes, or of several samples
// for each pixel. `is_first`: the target holds nothing yet. Reports what clear() reports.
[[nodiscard]] Result<std::optional<ClearValues>> clear_before_pass(const EffectClear& clear,
                                                                   const HardwareProfile& profile, RenderTarget& target,
                                                                   bool is_first);

}  // namespace ninebit
