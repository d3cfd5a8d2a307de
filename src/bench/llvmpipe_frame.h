// The rival of the frame benchmark: the same five passes over the same geometry, in OpenGL on Mesa's software renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/shadow/index_cube/index_cube_renderer.h"

namespace ninebit::bench {

// Vertices, indices, textures and shaders are set up once. A frame only binds, clears and draws:
//   1. six faces of an RGBA8 cube map with a 24-bit depth buffer: flat index colours;
//   2. the camera's depth, no colour;
//   3. depth EQUAL: compares the index colour, as integers, with the nearest texel of the cube map; discards equal
//      fragments (like the combiners and the alpha test), otherwise stencil REPLACE 1;
//   4., 5. depth EQUAL, stencil EQUAL 0 and 1: smooth vertex colours.
// llvmpipe's rasterization rules differ a little from ours, so pixels along edges differ.
class LlvmpipeFrame {
 public:
  // Prepares the frame that `renderer` draws, with `threads` threads for tiles. settings.light_facing must be false.
  // Reports the errors of EglContext::make and of the driver.
  [[nodiscard]] static Result<std::unique_ptr<LlvmpipeFrame>> make(const Scene& scene, const RenderSettings& settings,
                                                                   const IndexCubeRenderer& renderer, int threads);
  virtual ~LlvmpipeFrame() = default;

  // Draws one frame and waits until it is finished.
  virtual void draw() = 0;

  // The driver's own name and version.
  [[nodiscard]] virtual std::string renderer() const = 0;

  // The stencil values of the last frame, the lowest row first. Reports any GL error since the context was made.
  [[nodiscard]] virtual Result<std::vector<std::uint8_t>> stencil() = 0;
};

}  // namespace ninebit::bench
