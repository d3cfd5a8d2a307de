// The passes that draw what the camera sees: the one way for techniques to draw them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/shadow/technique.h"

namespace ninebit {

// What all camera passes of one rendering share.
struct CameraPasses {
  const RenderSettings& settings;
  Rendering& rendering;
  glm::mat4 projection{1.0F};

  // rasterize() from the camera. Where the settings watch a pixel, the rendering gets a ProbedPass of that name, whose
  // fragments name the scene's triangles: `scene_triangles` has the number of each triangle drawn; empty: as they come.
  [[nodiscard]] Status draw(std::string_view name, const PipelineState& state, const VertexArrays& arrays,
                            std::span<const TextureUnit> units, RenderTarget& target,
                            std::span<const std::uint32_t> scene_triangles = {}) const;
};

}  // namespace ninebit
