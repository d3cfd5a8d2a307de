// Captures a draw call: the inputs that its fragments gave to the combiners, pixel by pixel, and the colours that came
// out. It works for every way to draw, because the driver itself draws, into buffers of the layer's; the program's own
// buffers get the result.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "src/gl_layer/context/context.h"
#include "src/gl_layer/shader/program_cache.h"

namespace ninebit::gl_layer {

using FloatPixel = std::array<float, 4>;
using BytePixel = std::array<unsigned char, 4>;

// By rows from below.
struct CapturedDraw {
  std::string call;
  int width = 0, height = 0;
  std::vector<BytePixel> color;  // of the color buffer after the draw call
  // Where a pixel was not drawn, the primary colour's red is negative.
  std::vector<FloatPixel> primary, secondary, fog;  // fog: its colour, and the factor as alpha
  std::array<std::vector<FloatPixel>, kLayerUnits> texels;
  ShaderInputs inputs{};
  std::size_t program = 0;  // its number
};

[[nodiscard]] bool draws_anything(const CapturedDraw& draw);

class Capture {
 public:
  // Redirects the draw call that follows into the layer's buffers; nullptr: the log says why that is impossible here.
  static std::unique_ptr<Capture> begin(Context& context, const char* call);
  // The draw call is over: gives the program's buffers what was drawn, and restores all state.
  CapturedDraw end();
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

 private:
  explicit Capture(Context& context) : context_(context) {}
  bool make_buffers();
  void set_up_buffers();
  void copy_in();
  void copy_out();
  void blit() const;
  [[nodiscard]] std::vector<FloatPixel> read_floats(std::size_t buffer) const;

  Context& context_;
  CapturedDraw draw_{};
  unsigned own_framebuffer_ = 0, program_framebuffer_ = 0, depth_buffer_ = 0;
  int read_framebuffer_ = 0;
  std::array<unsigned, 8> textures_{};
  std::array<unsigned char, 4> color_mask_{};
};

}  // namespace ninebit::gl_layer
