// The rival of the effect benchmark: the same effect in GLSL, on Mesa's software renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/bench/effect_workloads.h"

namespace ninebit::bench {

class LlvmpipeEffect {
 public:
  // With `threads` threads for tiles. Reports the errors of EglContext::make and of the driver.
  [[nodiscard]] static Result<std::unique_ptr<LlvmpipeEffect>> make(int threads);
  virtual ~LlvmpipeEffect() = default;

  // Makes the textures, the program and a framebuffer for an effect, which draw() draws from then on.
  [[nodiscard]] virtual Status prepare(const EffectWorkload& workload) = 0;

  // Clears and draws the picture and waits until it is finished.
  virtual void draw() = 0;

  // The driver's own name and version.
  [[nodiscard]] virtual std::string renderer() const = 0;

  // The last picture, RGBA, the lowest row first. Reports any GL error since the context was made.
  [[nodiscard]] virtual Result<std::vector<std::uint8_t>> picture() = 0;
};

}  // namespace ninebit::bench
