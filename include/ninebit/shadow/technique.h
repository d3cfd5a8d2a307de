// The interface of all shadow techniques, and the table of them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "ninebit/frame/rendering.h"
#include "ninebit/frame/settings.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"

namespace NINEBIT_PUBLIC ninebit {

// A shadow technique: an entry of the table techniques().
struct Technique {
  std::string_view name;     // for `ninebit render --technique`
  std::string_view summary;  // one line
  LightKinds lights;         // the kinds that it supports
  // The scene has exactly one camera and one light of these kinds (complete_scene). Reports settings out of range and
  // scenes that the technique cannot draw.
  Result<Rendering> (*render)(const Scene& scene, const RenderSettings& settings, const Progress& progress);
};

// The pass of `probed` that decided whether a pixel, settings.pixels[number], is in shadow, or nullptr where nothing is
// drawn or probed: the last of the passes that mark shadows which changed the pixel's stencil value. If none of them
// changed it, the last of them with a deciding fragment; if none has one either, the last pass that wrote the pixel.
[[nodiscard]] const ProbedPass* deciding_pass(const Rendering& rendering, std::size_t number = 0);

// All techniques, the default first.
[[nodiscard]] std::span<const Technique> techniques();

// The technique of that name, or nullptr.
[[nodiscard]] const Technique* find_technique(std::string_view name);

}  // namespace ninebit
