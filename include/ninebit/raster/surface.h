// Planes of memory that the rasterizer draws into.
//
// Window coordinates are OpenGL's: x to the right, y UP, row 0 is the lowest row of the picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/result.h"

namespace ninebit {

// Sizes from 1 to this are drawn: a position then lies within 8,192 pixels of the viewport's centre.
inline constexpr int kMaxSurfaceSize = 16384;
inline constexpr std::uint32_t kMaxDepthZ24 = 0xFFFFFF;

// A view of rows of samples; it owns nothing. An empty plane (data == nullptr) is not drawn into.
template <class T>
struct Plane {
  T* data = nullptr;
  std::ptrdiff_t stride = 0;  // samples from one row to the next
  [[nodiscard]] T* row(int y) const { return data + stride * y; }
  [[nodiscard]] T& at(int x, int y) const { return row(y)[x]; }
  explicit operator bool() const { return data != nullptr; }
};

// One component of a register after the last general combiner, or one of the output, written for every fragment that
// reaches the depth test and would pass it, whatever the alpha and stencil tests say. The last fragment stays.
struct RegisterCapture {
  std::optional<Register> reg;  // empty: the final combiner's output
  int component = kRed;
  Plane<s9> plane;
};

struct FragmentProbe;

// Where a draw goes. All planes have the size of the target.
struct RenderTarget {
  int width = 0;
  int height = 0;
  std::array<Plane<std::uint8_t>, 4> color;  // red, green, blue, alpha
  Plane<std::uint32_t> depth_z24;            // 0 near to 0xFFFFFF far
  Plane<std::uint8_t> stencil;
  Plane<std::uint32_t> primitive;  // the number of the triangle that was drawn last, with the colour
  std::vector<RegisterCapture> captures;
  FragmentProbe* probe = nullptr;  // not owned; nullptr: no pixel is watched (fragment_probe.h)
};

// What a surface starts with and what clear() writes.
struct ClearValues {
  std::array<std::uint8_t, 4> color{};
  std::uint32_t depth_z24 = kMaxDepthZ24;
  std::uint8_t stencil = 0;
  std::uint32_t primitive = 0xFFFFFFFF;
};

// A target that owns its planes: colour, 24-bit depth, 8-bit stencil and, where asked for, primitive numbers.
class Surface {
 public:
  // Reports sizes outside 1 to kMaxSurfaceSize.
  [[nodiscard]] static Result<Surface> make(int width, int height, bool with_primitive = false);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  // Views of all planes, valid as long as this surface is neither moved from nor destroyed.
  [[nodiscard]] RenderTarget target();

  void clear(const ClearValues& values);

  // Gives one colour plane away; the surface must not be drawn into any more.
  [[nodiscard]] std::vector<std::uint8_t> take_color(int component) {
    return std::move(color_[static_cast<std::size_t>(component)]);
  }

  // Samples row by row, the lowest row first; component is kRed to kAlpha.
  [[nodiscard]] const std::vector<std::uint8_t>& color(int component) const {
    return color_[static_cast<std::size_t>(component)];
  }
  [[nodiscard]] const std::vector<std::uint32_t>& depth_z24() const { return depth_; }
  [[nodiscard]] const std::vector<std::uint8_t>& stencil() const { return stencil_; }
  [[nodiscard]] const std::vector<std::uint32_t>& primitive() const { return primitive_; }

 private:
  Surface(int width, int height, bool with_primitive);
  int width_;
  int height_;
  std::array<std::vector<std::uint8_t>, 4> color_;
  std::vector<std::uint32_t> depth_;
  std::vector<std::uint8_t> stencil_;
  std::vector<std::uint32_t> primitive_;
};

}  // namespace ninebit
