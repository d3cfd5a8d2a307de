// Planes of memory that the rasterizer draws into.
//
// Window coordinates are OpenGL's: x to the right, y UP, row 0 is the lowest row of the picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/half.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/color_format.h"
#include "ninebit/raster/plane_samples.h"

namespace NINEBIT_PUBLIC ninebit {

// The largest step between pixels, in samples.
inline constexpr int kMaxStep = 4096;

// The largest width and height of a target: a position then lies within 8,192 pixels of the viewport's centre.
inline constexpr int kMaxSurfaceSize = 16384;

// A view of rows of samples; it owns nothing. An empty plane (data == nullptr) is not drawn into.
//
// Interleaved memory is several planes with gaps: RGBA words are four planes of step 4, each one byte after the
// previous one. This layout is drawn and sampled as fast as separate planes; other gaps are slower.
template <class T>
struct Plane {
  T* data = nullptr;                                               // the lowest row's first sample
  std::ptrdiff_t stride = 0;                                       // samples from one row to the next
  std::ptrdiff_t step = 1;                                         // samples from one pixel to the next: 1 to kMaxStep
  [[nodiscard]] T* row(int y) const { return data + stride * y; }  // the first sample of row y; nothing is checked
  [[nodiscard]] T& at(int x, int y) const { return row(y)[step * x]; }  // nothing is checked
  explicit operator bool() const { return data != nullptr; }            // false: empty
};

// How depth and stencil are stored. d: a depth code k of m bits stands for the window depth k / (2^m - 1). f: it is a
// floating-point number (rule 51). w, wf: a W buffer (rule 50), whose codes are whole or floating-point values of w.
enum class DepthStencilFormat : std::uint8_t { d24s8, d16, d15s1, f24s8, f16, w24s8, w16, wf24s8, wf16 };

// The contents of a format's planes.
struct DepthStencilLayout {
  std::string_view name;  // the format's: "d24s8"
  int depth_bits;         // of a depth code
  int stencil_bits;       // of a stencil value
  bool is_w;              // depth is w, not z
  int exponent_bits;      // of a floating-point depth, whose other bits are its mantissa's; 0: fixed point
  // Whether a code stands for a window depth times the largest code.
  [[nodiscard]] constexpr bool is_fixed_z() const { return !is_w && exponent_bits == 0; }
};

// In the order of DepthStencilFormat.
inline constexpr std::array<DepthStencilLayout, 9> kDepthStencilLayouts{{{"d24s8", 24, 8, false, 0},
                                                                         {"d16", 16, 0, false, 0},
                                                                         {"d15s1", 15, 1, false, 0},
                                                                         {"f24s8", 24, 8, false, 8},
                                                                         {"f16", 16, 0, false, 4},
                                                                         {"w24s8", 24, 8, true, 0},
                                                                         {"w16", 16, 0, true, 0},
                                                                         {"wf24s8", 24, 8, true, 8},
                                                                         {"wf16", 16, 0, true, 4}}};

// The layout of a format.
[[nodiscard]] constexpr const DepthStencilLayout& layout_of(DepthStencilFormat format) {
  return kDepthStencilLayouts[static_cast<std::size_t>(format)];
}

// The number of bits of a depth code: 24, 16 or 15.
[[nodiscard]] constexpr int depth_bits(DepthStencilFormat format) {
  return layout_of(format).depth_bits;
}

// The number of bits of a stencil value: 8, 0 or 1.
[[nodiscard]] constexpr int stencil_bits(DepthStencilFormat format) {
  return layout_of(format).stencil_bits;
}

// The largest depth code, all ones: that of window depth 1, and of a w that is too large.
[[nodiscard]] constexpr std::uint32_t max_depth(DepthStencilFormat format) {
  return (std::uint32_t{1} << depth_bits(format)) - 1;
}

// How many samples a pixel has and where they lie, by the NV2A's names (rule 48). Every plane of the target then has
// the samples of a row side by side. Each sample is drawn as a pixel whose centre lies at the sample's place.
enum class SampleMode : std::uint8_t {
  center_1,         // one: the pixel's centre
  center_corner_2,  // two, side by side: the upper left corner, then the centre
  square_offset_4   // two above two: the upper left corner, the middle of the upper side; the middle of the left side,
                    // the centre
};

// The number of samples of a pixel side by side, and one above the other.
[[nodiscard]] constexpr int sample_columns(SampleMode mode) {
  return mode == SampleMode::center_1 ? 1 : 2;
}
[[nodiscard]] constexpr int sample_rows(SampleMode mode) {
  return mode == SampleMode::square_offset_4 ? 2 : 1;
}

// The value that a fragment writes into an output plane.
enum class OutputSource : std::uint8_t {
  register_code,  // one component of a register after the last general combiner: s9
  output_code,    // one component of the final combiner's output: s9, or u8 after conversion to a byte
  attribute,      // one component of an interpolated attribute: float or half
  primitive,      // the primitive's number in the draw call: u32
  depth           // the fragment's depth code: u32, or u16 with 16 and 15 bits
};

// When a plane is written.
enum class OutputTime : std::uint8_t {
  when_drawn,    // with the colour, by fragments that passed all tests
  at_depth_pass  // by fragments that pass the depth test, regardless of the alpha and stencil tests
};

// A plane of any of the types that OutputSource names.
using OutputSamples =
    std::variant<Plane<s9>, Plane<std::uint8_t>, Plane<std::uint16_t>, Plane<std::uint32_t>, Plane<Half>, Plane<float>>;

// A further plane of the render target. The last fragment at a pixel wins. The scissor applies to it; masks and
// blending do not. An output_code in bytes is the colour before blending; without a program, the primary colour's own
// byte.
struct OutputPlane {
  OutputSource source = OutputSource::output_code;  // the value that is written
  Register reg = Register::spare0;                  // of register_code
  int attribute = 0;                                // of attribute: 0 to kMaxAttributes - 1
  int component = kRed;                             // of a register, output or attribute: kRed to kAlpha
  OutputTime time = OutputTime::when_drawn;         // which fragments are written
  OutputSamples plane{};                            // of the sample type that the source names
  Plane<const std::uint32_t> owner{};  // not empty: only the primitive whose number stands here writes a pixel
};
// The largest number of output planes of a target.
inline constexpr std::size_t kMaxOutputPlanes = 32;

struct FragmentProbe;

// The planes that a draw writes. All have the size of the target, in samples; any may be the caller's own memory.
struct RenderTarget {
  int width = 0;                               // pixels, 1 to kMaxSurfaceSize
  int height = 0;                              // pixels, 1 to kMaxSurfaceSize
  SampleMode samples = SampleMode::center_1;   // of each pixel
  std::array<Plane<std::uint8_t>, 4> color{};  // red, green, blue, alpha
  // The format of colours: every colour that is written becomes one that the format has; see stored_color().
  ColorFormat color_format = ColorFormat::a8r8g8b8;
  DepthStencilFormat format =
      DepthStencilFormat::d24s8;       // of depth and stencil; decides the arithmetic even without these planes
  Plane<std::uint32_t> depth{};        // codes of format's depth bits: 0 near, max_depth(format) far
  Plane<std::uint8_t> stencil{};       // values of format's stencil bits
  std::vector<OutputPlane> outputs{};  // at most kMaxOutputPlanes
  std::vector<FragmentProbe>* probes = nullptr;  // not owned; nullptr: no pixel is watched (fragment_probe.h)
};

// The initial content of a surface, and the values that clear() writes.
struct ClearValues {
  std::array<std::uint8_t, 4> color{};  // red, green, blue, alpha
  double depth = 1.0;                   // clamped to [0, 1], then the nearest code; in a W buffer of the largest w
  int stencil = 0;                      // its low bits
};

// The planes of a surface.
struct SurfaceFormat {
  DepthStencilFormat depth_stencil = DepthStencilFormat::d24s8;  // format of depth and stencil
  bool with_primitive = false;                // adds a plane of primitive numbers, 0xFFFFFFFF where nothing was drawn
  ColorFormat color = ColorFormat::a8r8g8b8;  // format of colour; all four planes are there in any
  SampleMode samples = SampleMode::center_1;  // of each pixel, in all planes
  // Colour, depth and the stencil bits start uninitialized: fill them, or clear them with the first draw. If a stencil
  // value has fewer than 8 bits, the other bits of its byte are 0, and clear() keeps them.
  bool undrawn = false;
};

// A target that owns its planes: colour, depth, stencil if the format has it, and optionally primitive numbers.
class Surface {
 public:
  // Reports sizes outside 1 to kMaxSurfaceSize, in samples.
  [[nodiscard]] static Result<Surface> make(int width, int height, SurfaceFormat format = {});

  // In pixels, as constructed.
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  // As constructed.
  [[nodiscard]] DepthStencilFormat format() const { return format_; }

  [[nodiscard]] ColorFormat color_format() const { return color_format_; }  // as constructed
  [[nodiscard]] SampleMode samples() const { return samples_; }             // as constructed

  // Views of all planes, valid until this surface is moved from or destroyed.
  [[nodiscard]] RenderTarget target();

  // Fills all planes without masks. GL's clear is clear() in rasterizer.h.
  void fill(const ClearValues& values);

  // Samples row by row, the lowest row first; component is kRed to kAlpha.
  [[nodiscard]] const PlaneSamples<std::uint8_t>& color(int component) const {
    return color_[static_cast<std::size_t>(component)];
  }
  [[nodiscard]] const PlaneSamples<std::uint32_t>& depth() const { return depth_; }
  [[nodiscard]] const PlaneSamples<std::uint8_t>& stencil() const { return stencil_; }
  [[nodiscard]] const PlaneSamples<std::uint32_t>& primitive() const { return primitive_; }

 private:
  Surface(int width, int height, SurfaceFormat format);
  int width_;
  int height_;
  DepthStencilFormat format_;
  ColorFormat color_format_;
  SampleMode samples_;
  std::array<PlaneSamples<std::uint8_t>, 4> color_;
  PlaneSamples<std::uint32_t> depth_;
  PlaneSamples<std::uint8_t> stencil_;
  PlaneSamples<std::uint32_t> primitive_;
};

}  // namespace ninebit
