// Shared by the files that compute a profile's results for the rows of measured tables: the values of the picture, in
// the order of their columns.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"
#include "src/effect/effect_words.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {

// The formats of the tables, each in the file that computes the values of their pictures for a profile: of one pixel,
// of lines and points, of the combiners' own rules, of texture-shader stages and texel formats, of surfaces, and of
// depth formats, fog, wrap modes, colour keys and combiner quads.
[[nodiscard]] std::vector<MeasuredFormat> make_row_formats();
[[nodiscard]] std::vector<MeasuredFormat> make_line_formats();
[[nodiscard]] std::vector<MeasuredFormat> make_combiner_formats();
[[nodiscard]] std::vector<MeasuredFormat> make_stage_formats();
[[nodiscard]] std::vector<MeasuredFormat> make_surface_formats();
[[nodiscard]] std::vector<MeasuredFormat> make_pixel_formats();

// Short forms for the columns of these tables.

namespace columns_of_tables {

using Column = MeasuredColumn;
using Kind = MeasuredColumn::Kind;

inline Column whole(std::string_view name, std::int64_t low, std::int64_t high) {
  return {name, Kind::whole, low, high};
}
inline Column byte(std::string_view name) {
  return whole(name, 0, 255);
}

// Columns of one kind, from their part of the header.
inline void add_columns(std::vector<Column>& to, std::string_view names, Column like) {
  for (const std::string_view name : pieces(names, ',')) {
    like.name = name;
    to.push_back(like);
  }
}
inline std::vector<Column> columns(std::initializer_list<std::pair<std::string_view, Column>> groups) {
  std::vector<Column> all;
  for (const auto& [names, like] : groups) add_columns(all, names, like);
  return all;
}

}  // namespace columns_of_tables

// The combiners' results for a quad of the pictures of combiner programs, and the fault of its row's words for a
// profile; empty: none.
[[nodiscard]] std::vector<int> run_quad(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_quad(const MeasuredRow& row, const HardwareProfile& profile);

// General combiners that write nothing; the output is the register's colour, with its alpha or 1.0.
[[nodiscard]] CombinerState quad_state(Register reg, bool own_alpha);

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

// The background that a picture was blended over, and the alpha.
inline constexpr StatedValue kUnderBlend{"under", "over ", StatedValue::Kind::list, 0, 255, "(32,32,32,255)", 4};

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

// The fault of a depth; empty: none.
[[nodiscard]] std::string wrong_depth(const MeasuredRow& row, const HardwareProfile& profile);

using effect_detail::value_of;
using effect_detail::Words;

// The fault of the word in a column; empty: none.
template <class T, std::size_t N>
[[nodiscard]] std::string wrong_word(const MeasuredRow& row, std::string_view column, const Words<T, N>& words) {
  if (value_of(words, row.text(column))) return "";
  return fmt::format("{} must be one of {}, not '{}'", column, effect_detail::list_of(words), shown(row.text(column)));
}

}  // namespace ninebit::tools
