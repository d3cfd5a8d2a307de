// A profile's results for the rows of measured tables: the values of the picture, in the order of their columns.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/profile_words.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"
#include "src/effect/effect_words.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {

class MeasuredRow;

// A fragment of red 1 over black: 1 where it is drawn, else 0.
[[nodiscard]] std::vector<int> draw_alpha_test(const MeasuredRow& row, const HardwareProfile& profile);

// s over d, whose result a second blend shows over what the table states.
[[nodiscard]] std::vector<int> draw_blend(const MeasuredRow& row, const HardwareProfile& profile);

// A texel of a block. Those of DXT3 and DXT5, and their alpha, are shown over what the table states.
[[nodiscard]] std::vector<int> draw_dxt1(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::vector<int> draw_dxt3(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::vector<int> draw_dxt5(const MeasuredRow& row, const HardwareProfile& profile);

// Four texels of a level, and four of the next one, with their weights.
[[nodiscard]] std::vector<int> draw_filter(const MeasuredRow& row, const HardwareProfile& profile);

// A place between the texels 0 and 255, read as the luminance of a bump environment and shown over what the table
// states.
[[nodiscard]] std::vector<int> draw_weight(const MeasuredRow& row, const HardwareProfile& profile);

// A pixel of a triangle with three colours.
[[nodiscard]] std::vector<int> draw_smooth(const MeasuredRow& row, const HardwareProfile& profile);

// The depth code of a pixel of a quad.
[[nodiscard]] std::vector<int> draw_depth(const MeasuredRow& row, const HardwareProfile& profile);

// The pixels of a row of an object of lines that are drawn and not measured, or measured and not drawn.
[[nodiscard]] std::vector<int> draw_lines(const MeasuredRow& row, const HardwareProfile& profile);

// A pixel of a line with two colours.
[[nodiscard]] std::vector<int> draw_line_color(const MeasuredRow& row, const HardwareProfile& profile);

// The first and the last column of a point at a corner of pixels, from there.
[[nodiscard]] std::vector<int> draw_point(const MeasuredRow& row, const HardwareProfile& profile);

// The comparison of r with a depth texture: 1 where it holds, else 0.
[[nodiscard]] std::vector<int> draw_shadow(const MeasuredRow& row, const HardwareProfile& profile);

// The fault of a row's words, which draw_… would not find; empty: none.
[[nodiscard]] std::string wrong_alpha_test(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_blend(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_depth(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_line_color(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_lines(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_shadow(const MeasuredRow& row, const HardwareProfile& profile);

// Shared by the drawings of measured rows.

// AARRGGBB, or RRGGBB, whose alpha is 0.
[[nodiscard]] inline ColorBytes color_of(std::uint32_t digits) {
  const auto byte = [digits](unsigned shift) { return static_cast<std::uint8_t>(digits >> shift); };
  return {byte(16), byte(8), byte(0), byte(24)};
}

// The picture's blend of a value by its alpha over another one (rule 19).
[[nodiscard]] inline int shown_over(int value, int alpha, int under) {
  return (2 * (alpha * value + (255 - alpha) * under) + 255) / 510;
}

// Without tests.
[[nodiscard]] inline PipelineState plain_state(const HardwareProfile& profile) {
  PipelineState state;
  state.profile = profile;
  state.depth_test.enabled = false;
  return state;
}

// One pixel and what was drawn into it.
struct Pixel {
  ColorBytes color{};
  std::uint32_t depth = 0;
  bool is_drawn = false;
};

// A triangle that covers a target of one pixel.
inline constexpr std::array<glm::vec4, 3> kWholePixel{glm::vec4(-1, -1, 0, 1), glm::vec4(3, -1, 0, 1),
                                                      glm::vec4(-1, 3, 0, 1)};

// Draws triangles into a target of one pixel, which had the colour `under` and depth 1.
[[nodiscard]] Pixel draw_pixel(const PipelineState& state, const VertexArrays& arrays, const ColorBytes& under,
                               std::span<const TextureUnit> units = {},
                               DepthStencilFormat format = DepthStencilFormat::d24s8);

// The clip coordinate, divided by w, of a window coordinate in 1/16 pixel, seen from pixel `at`. It stands for the
// middle of the cell that is cut toward zero to this coordinate.
[[nodiscard]] float clip_of(int q4, int at);

// A square texture of rgba8.
[[nodiscard]] Texture rgba_texture(int size, std::array<std::vector<std::uint8_t>, 4> bytes);

// The bytes at (s, t, r).
[[nodiscard]] Bytes4 texel_bytes(const Texture& texture, const Sampler& sampler, std::array<float, 3> at,
                                 const HardwareProfile& profile);

// Checks of the words in measured tables.

using effect_detail::value_of;
using effect_detail::Words;

// The fault of the word in a column; empty: none.
template <class T, std::size_t N>
[[nodiscard]] std::string wrong_word(const MeasuredRow& row, std::string_view column, const Words<T, N>& words) {
  if (value_of(words, row.text(column))) return "";
  return fmt::format("{} must be one of {}, not '{}'", column, effect_detail::list_of(words), shown(row.text(column)));
}

}  // namespace ninebit::tools
