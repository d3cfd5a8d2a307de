// Measured tables of surfaces, stipple, point sprites and samples.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "src/tools/verify/measured_rows.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr Words<ColorFormat, 8> kBlendedSurfaces{{{"A8R8G8B8", ColorFormat::a8r8g8b8},
                                                  {"X8R8G8B8_Z", ColorFormat::x8r8g8b8_z},
                                                  {"X8R8G8B8_O", ColorFormat::x8r8g8b8_o},
                                                  {"X1A7R8G8B8_Z", ColorFormat::x1a7r8g8b8_z},
                                                  {"X1A7R8G8B8_O", ColorFormat::x1a7r8g8b8_o},
                                                  {"R5G6B5", ColorFormat::r5g6b5},
                                                  {"X1R5G5B5_Z", ColorFormat::x1r5g5b5_z},
                                                  {"X1R5G5B5_O", ColorFormat::x1r5g5b5_o}}};
constexpr Words<ColorFormat, 3> kStoredSurfaces{{{"R5G6B5", ColorFormat::r5g6b5},
                                                 {"X1R5G5B5_Z1R5G5B5", ColorFormat::x1r5g5b5_z},
                                                 {"X1R5G5B5_O1R5G5B5", ColorFormat::x1r5g5b5_o}}};
constexpr Words<BlendFactor, 2> kDestinationFactors{
    {{"ONE_MINUS_SRC_ALPHA", BlendFactor::one_minus_src_alpha}, {"DST_ALPHA", BlendFactor::dst_alpha}}};
constexpr Words<SampleMode, 2> kSampleModes{
    {{"CENTER_1", SampleMode::center_1}, {"CENTER_CORNER_2", SampleMode::center_corner_2}}};

// A pattern's 32 words, the first for the lowest row, from its runs of equal words.
constexpr std::array<std::uint32_t, 32> words_of(std::initializer_list<std::pair<int, std::uint32_t>> runs) {
  std::array<std::uint32_t, 32> words{};
  std::size_t at = 0;
  while (at < words.size()) {
    for (const auto& [count, word] : runs) {
      for (int i = 0; i < count && at < words.size(); ++i) words[at++] = word;
    }
  }
  return words;
}
using PatternWords = std::array<std::uint32_t, 32>;
constexpr Words<PatternWords, 3> kPatterns{
    {{"Asymmetric", words_of({{8, 0xC0C0FFFF}, {8, 0x3030FFFF}, {8, 0x00008CEF}, {8, 0x0F000F0F}})},
     {"Border", words_of({{1, 0x00000000}, {30, 0x7FFFFFFE}, {1, 0x00000000}})},
     {"Checkered", words_of({{4, 0x0F0F0F0F}, {4, 0xF0F0F0F0}})}}};

// A word's low byte is the left one.
StipplePattern pattern_of(const PatternWords& words) {
  StipplePattern pattern{};
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    pattern[i] = static_cast<std::uint8_t>(words[i / 4] >> (8 * (i % 4)));
  }
  return pattern;
}

// The clip coordinate of a window coordinate in a window of so many pixels. It stands for the middle of the cell that
// is cut toward zero to its 1/16.
float clip_of(double pixels, int size) {
  const double middle = pixels + (pixels < 0 ? -1.0 : 1.0) / 32.0;
  return static_cast<float>(2.0 * middle / size - 1.0);
}

constexpr std::array<glm::vec4, 3> kWholeTarget{glm::vec4(-1, -1, 0, 1), glm::vec4(3, -1, 0, 1),
                                                glm::vec4(-1, 3, 0, 1)};

// Draws a colour over a whole target.
void draw_over(const PipelineState& state, const ColorBytes& color, RenderTarget& target) {
  const std::array<ColorBytes, 3> colors{color, color, color};
  // The states of measured tables are always valid.
  (void)rasterize(state, glm::mat4(1.0F), {.homogeneous_positions = kWholeTarget, .vertex_colors = colors}, {}, target);
}

ColorBytes color_at(const RenderTarget& target, int x, int y) {
  ColorBytes color{};
  for (std::size_t k = 0; k < 4; ++k) color[k] = target.color[k].at(x, y);
  return color;
}

// Draws white polygons at window coordinates, y up, where nothing was.
void draw_white(const PipelineState& state, PrimitiveType type, std::span<const glm::dvec2> corners,
                RenderTarget& target) {
  std::vector<glm::vec4> clip;
  for (const glm::dvec2& c : corners) {
    clip.emplace_back(clip_of(c.x, target.width), clip_of(c.y, target.height), 0.0F, 1.0F);
  }
  (void)rasterize(state, glm::mat4(1.0F), {.type = type, .homogeneous_positions = clip}, {}, target);
}

constexpr Blend kOver{true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha, BlendEquation::add, {}};

// The measured point: its size in eighths, the distance in pixels from its left side to its centre, its centre's x, and
// its centres' y in the picture, by test.
constexpr int kSpriteEighths = 511;
constexpr double kSpriteX = 180.5;
constexpr std::array<double, 2> kSpriteY{96.5, 192.5};
constexpr int kSpriteTexels = 64;

// floor(64 (x + 1/2 - left) / size), with the left side at centre - size / 2; all in sixteenths of a pixel.
int sprite_texel(int pixel, double centre) {
  const int from_side = 16 * pixel + 8 - static_cast<int>(16 * centre) + kSpriteEighths;
  return from_side < 0 ? -1 : kSpriteTexels * from_side / (2 * kSpriteEighths);
}

Program texture_alone(const HardwareProfile& profile) {
  CombinerState state;
  state.general[0].rgb.out.sum = state.general[0].alpha.out.sum = Register::discard;
  state.final_combiner = {};
  state.final_combiner.d = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  state.final_combiner.g = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::alpha};
  return normalize(state, profile);
}

std::string wrong_multisampling(const HardwareProfile& profile) {
  return profile.multisampling ? "" : fmt::format("profile {} has no surfaces with several samples", profile.name);
}

// Up to four colours, blended one after the other into a surface, as a texture shows it.
std::vector<int> blend_into_surface(const MeasuredRow& row, const HardwareProfile& profile) {
  const ColorFormat format = *value_of(kBlendedSurfaces, row.text("surface"));
  Surface surface = Surface::make(1, 1, {.color = format}).value();
  RenderTarget target = surface.target();
  PipelineState state = plain_state(profile);
  draw_over(state, {25, 25, 25, 178}, target);
  state.blend = kOver;
  state.blend.destination = *value_of(kDestinationFactors, row.text("dst_factor"));
  for (int i = 1; i <= row.whole("n"); ++i) {
    const std::string n = std::to_string(i);
    draw_over(state, {row.byte("r" + n), row.byte("g" + n), row.byte("b" + n), row.byte("a" + n)}, target);
  }
  const ColorBytes color = color_at(target, 0, 0);
  return {color[0], color[1], color[2]};
}

// The word in memory of a colour that was written, or blended over 0.
std::vector<int> store_in_surface(const MeasuredRow& row, const HardwareProfile& profile) {
  const ColorFormat format = *value_of(kStoredSurfaces, row.text("surface"));
  Surface surface = Surface::make(1, 1, {.color = format}).value();
  RenderTarget target = surface.target();
  PipelineState state = plain_state(profile);
  if (row.whole("blend") == 1) state.blend = kOver;
  draw_over(state, {row.byte("r"), row.byte("g"), row.byte("b"), row.byte("a")}, target);
  return {static_cast<int>(color_word(format, color_at(target, 0, 0)))};
}

// A pixel of a stippled polygon: 1 where it is drawn, else 0.
std::vector<int> draw_stippled(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr int kHeight = 480;      // of the picture
  constexpr int kPatternSide = 32;  // of the pattern
  Surface surface = Surface::make(kPatternSide, kPatternSide).value();
  RenderTarget target = surface.target();
  PipelineState state = plain_state(profile);
  state.polygon_stipple = pattern_of(*value_of(kPatterns, row.text("pattern")));
  draw_over(state, {255, 255, 255, 255}, target);
  const int y = kHeight - 1 - row.whole("y");
  return {color_at(target, row.whole("x") % kPatternSide, (y % kPatternSide + kPatternSide) % kPatternSide)[0] == 255
              ? 1
              : 0};
}

// A pixel of a textured point over grey.
std::vector<int> draw_sprite(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr int kWindowSide = 80;  // of a window around the point, in pixels
  const auto test = static_cast<std::size_t>(row.whole("test"));
  const int left = static_cast<int>(kSpriteX) - kWindowSide / 2,
            top = static_cast<int>(kSpriteY[test]) - kWindowSide / 2;
  // The texel of the row stands at the place that the measured rule gives; all others differ from it.
  const ColorBytes texel{row.byte("r"), row.byte("g"), row.byte("b"), row.byte("a")};
  const int s = sprite_texel(row.whole("x"), kSpriteX), t = sprite_texel(row.whole("y"), kSpriteY[test]);
  std::vector<std::uint8_t> texels(std::size_t{4} * kSpriteTexels * kSpriteTexels);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    // One component after the other.
    constexpr std::size_t kCount = std::size_t{kSpriteTexels} * kSpriteTexels;
    const std::uint8_t component = texel[i / kCount];
    const bool is_there = static_cast<int>(i % kCount) == kSpriteTexels * t + s;
    texels[i] = is_there ? component : static_cast<std::uint8_t>(component ^ 0x80);
  }
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::rgba8,
                                       {{{kSpriteTexels, kSpriteTexels, std::move(texels)}}})
                              .value();
  Surface surface = Surface::make(kWindowSide, kWindowSide).value();
  surface.fill({.color = {51, 51, 51, 255}});
  RenderTarget target = surface.target();
  PipelineState state = plain_state(profile);
  state.point_size = kSpriteEighths / 8.0F;
  state.point_sprite = {.enabled = true, .coord_replace = {true}};
  state.program = texture_alone(profile);
  state.blend = kOver;
  if (test == 1) state.alpha_test = {true, CompareFunction::greater, 0x7F};
  const int x = row.whole("x") - left, y = kWindowSide - 1 - (row.whole("y") - top);
  state.scissor = PixelRect{x, y, 1, 1};
  const std::array<glm::vec4, 1> centre{glm::vec4(
      clip_of(kSpriteX - left, kWindowSide), clip_of(kWindowSide - (kSpriteY[test] - top), kWindowSide), 0.0F, 1.0F)};
  const std::array<glm::vec3, 1> coordinates{};
  VertexArrays arrays{.type = PrimitiveType::points, .homogeneous_positions = centre};
  arrays.texture_coordinates[0] = coordinates;
  const TextureUnit unit{&texture, kNearestSampler};
  (void)rasterize(state, glm::mat4(1.0F), arrays, {&unit, 1}, target);
  const ColorBytes color = color_at(target, x, y);
  return {color[0], color[1], color[2], color[3]};
}

// The alpha of a pixel of a smoothed triangle, blended over 255.
std::vector<int> draw_smoothed(const MeasuredRow& row, const HardwareProfile& profile) {
  // One pixel; the window's y grows upwards.
  const double x = row.whole("x"), y = row.whole("y");
  std::array<glm::dvec2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    corners[i] = {row.real("x" + n) - x, y + 1.0 - row.real("y" + n)};
  }
  Surface surface = Surface::make(1, 1).value();
  surface.fill({.color = {0, 0, 0, 255}});
  RenderTarget target = surface.target();
  PipelineState state = plain_state(profile);
  state.polygon_smooth = true;
  state.blend = kOver;
  draw_white(state, PrimitiveType::triangles, corners, target);
  return {color_at(target, 0, 0)[3]};
}

// The first and the last pixel of a row whose sample a quad covers; -1: none.
std::vector<int> draw_samples(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr int kWidth = 640;
  const SampleMode mode = *value_of(kSampleModes, row.text("mode"));
  Surface surface = Surface::make(kWidth, 1, {.samples = mode}).value();
  RenderTarget target = surface.target();
  const double lowest = row.whole("y") + 1.0;  // the row's lower side in the picture
  const std::array<glm::dvec2, 4> corners{glm::dvec2(64, lowest - 240), glm::dvec2(320, lowest - 64),
                                          glm::dvec2(576, lowest - 240), glm::dvec2(320, lowest - 416)};
  draw_white(plain_state(profile), PrimitiveType::quads, corners, target);
  const int columns = sample_columns(mode);
  std::vector<int> extent{-1, -1};
  for (int x = 0; x < kWidth; ++x) {
    if (color_at(target, columns * x + row.whole("sample"), 0)[0] == 0) continue;
    if (extent[0] < 0) extent[0] = x;
    extent[1] = x;
  }
  return extent;
}

// A sample of a triangle on a surface with four for each pixel: 1 where it is covered, else 0.
std::vector<int> draw_square(const MeasuredRow& row, const HardwareProfile& profile) {
  const int x = row.whole("column") / 2, y = row.whole("row") / 2;
  Surface surface = Surface::make(1, 1, {.samples = SampleMode::square_offset_4}).value();
  RenderTarget target = surface.target();
  const double lowest = y + 1.0;
  const std::array<glm::dvec2, 3> corners{glm::dvec2(5 - x, lowest - 64), glm::dvec2(123 - x, lowest - 5),
                                          glm::dvec2(123 - x, lowest - 123)};
  draw_white(plain_state(profile), PrimitiveType::triangles, corners, target);
  return {color_at(target, row.whole("column") % 2, 1 - row.whole("row") % 2)[0] == 0 ? 0 : 1};
}

std::string wrong_surface_blend(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  const std::string wrong = wrong_word(row, "surface", kBlendedSurfaces);
  return wrong.empty() ? wrong_word(row, "dst_factor", kDestinationFactors) : wrong;
}

std::string wrong_surface_store(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  return wrong_word(row, "surface", kStoredSurfaces);
}

std::string wrong_stipple(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  return wrong_word(row, "pattern", kPatterns);
}

std::string wrong_sprite(const MeasuredRow& row, const HardwareProfile& profile) {
  if (!profile.point_sprites) return fmt::format("profile {} has no point sprites", profile.name);
  const auto is_inside = [](int pixel, double centre) {
    const int texel = sprite_texel(pixel, centre);
    return texel >= 0 && texel < kSpriteTexels;
  };
  const double y = kSpriteY[static_cast<std::size_t>(row.whole("test"))];
  return is_inside(row.whole("x"), kSpriteX) && is_inside(row.whole("y"), y) ? "" : "x and y must lie within the point";
}

std::string wrong_smoothed(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  constexpr double kFarthest = 4096;
  for (const char* column : {"x0", "y0", "x1", "y1", "x2", "y2"}) {
    if (std::abs(row.real(column)) <= kFarthest) continue;
    return fmt::format("{} must be a number from -{} to {}", column, kFarthest, kFarthest);
  }
  return "";
}

std::string wrong_samples(const MeasuredRow& row, const HardwareProfile& profile) {
  if (const std::string wrong = wrong_word(row, "mode", kSampleModes); !wrong.empty()) return wrong;
  const SampleMode mode = *value_of(kSampleModes, row.text("mode"));
  if (row.whole("sample") >= sample_columns(mode)) return "CENTER_1 has sample 0 alone";
  return mode == SampleMode::center_1 ? "" : wrong_multisampling(profile);
}

std::string wrong_square(const MeasuredRow& /*row*/, const HardwareProfile& profile) {
  return wrong_multisampling(profile);
}

}  // namespace

std::vector<MeasuredFormat> make_surface_formats() {
  const Column word{{}, Kind::word}, real{{}, Kind::real}, measured{{}, Kind::measured},
      any_byte = byte({}), flag = whole({}, 0, 1), pixel = whole({}, 0, 4095);
  return {
      {"blending into surfaces",
       columns({{"surface,dst_factor", word},
                {"n", whole({}, 1, 4)},
                {"r1,g1,b1,a1,r2,g2,b2,a2,r3,g3,b3,a3,r4,g4,b4,a4", any_byte},
                {"pic_r,pic_g,pic_b", measured}}),
       blend_into_surface, wrong_surface_blend},
      {"colours in memory",
       columns({{"surface", word}, {"blend", flag}, {"r,g,b,a", any_byte}, {"word_hex", {{}, Kind::word_hex}}}),
       store_in_surface, wrong_surface_store},
      {"polygon stipple", columns({{"pattern", word}, {"x,y", pixel}, {"drawn", measured}}), draw_stippled,
       wrong_stipple},
      {"point sprites",
       columns({{"test", flag}, {"x,y", pixel}, {"r,g,b,a", any_byte}, {"pic_r,pic_g,pic_b,pic_a", measured}}),
       draw_sprite, wrong_sprite},
      {"smoothed triangles", columns({{"x0,y0,x1,y1,x2,y2", real}, {"x,y", pixel}, {"alpha", measured}}), draw_smoothed,
       wrong_smoothed},
      {"samples of rows", columns({{"mode", word}, {"sample", flag}, {"y", pixel}, {"first,last", measured}}),
       draw_samples, wrong_samples},
      {"samples of a square", columns({{"column,row", pixel}, {"covered", measured}}), draw_square, wrong_square},
  };
}

}  // namespace ninebit::tools
