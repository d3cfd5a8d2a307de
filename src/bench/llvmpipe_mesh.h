// The rival of the raster benchmark: the same mesh in OpenGL, on Mesa's software renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/bench/meshes.h"

namespace ninebit::bench {

// Depth test LESS with depth writes and a flat colour per triangle, into RGBA8 with 24 bits of depth and 8 of stencil.
class LlvmpipeMesh {
 public:
  // With `threads` threads for tiles. Reports the errors of EglContext::make and of the driver.
  [[nodiscard]] static Result<std::unique_ptr<LlvmpipeMesh>> make(int width, int height, int threads);
  virtual ~LlvmpipeMesh() = default;

  // Uploads a mesh, which draw() draws from then on.
  virtual void prepare(const Mesh& mesh) = 0;

  // Clears colour and depth, and waits until that is finished.
  virtual void clear() = 0;

  // Draws the mesh and waits until it is finished.
  virtual void draw() = 0;

  // The driver's own name and version.
  [[nodiscard]] virtual std::string renderer() const = 0;

  // The last picture, RGBA, the lowest row first. Reports any GL error since the context was made.
  [[nodiscard]] virtual Result<std::vector<std::uint8_t>> picture() = 0;
};

}  // namespace ninebit::bench
