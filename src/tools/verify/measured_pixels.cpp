// Measured tables of depth formats, fog, wrap modes, colour keys and combiner quads.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"
#include "src/raster/fragment/fog.h"
#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr Words<bool, 2> kDepthKinds{{{"Z", false}, {"W", true}}};    // whether it is a W buffer
constexpr Words<bool, 2> kDepthNumbers{{{"D", false}, {"F", true}}};  // whether it is floating point

// A format by what a row says of it.
DepthStencilFormat depth_format(const MeasuredRow& row) {
  const bool is_w = *value_of(kDepthKinds, row.text("kind")), is_float = *value_of(kDepthNumbers, row.text("fmt"));
  for (std::size_t i = 0; i < kDepthStencilLayouts.size(); ++i) {
    const DepthStencilLayout& layout = kDepthStencilLayouts[i];
    if (layout.depth_bits == row.whole("bits") && layout.is_w == is_w && (layout.exponent_bits > 0) == is_float) {
      return static_cast<DepthStencilFormat>(i);
    }
  }
  return DepthStencilFormat::d24s8;
}

// The depth of a pixel of a triangle. Depths of fixed and floating point are linear in the window, whatever w is.
std::vector<int> draw_depth_format(const MeasuredRow& row, const HardwareProfile& profile) {
  const DepthStencilFormat format = depth_format(row);
  const DepthStencilLayout& layout = layout_of(format);
  const auto real = [&](const char* name, int i) { return row.real(name + std::to_string(i)); };
  double one = max_depth(format);
  if (layout.exponent_bits > 0) {
    const double largest = std::max({real("z", 0), real("z", 1), real("z", 2), 1.0});
    one = std::ldexp(1.0, std::ilogb(largest) + 1);
  }
  std::array<glm::vec4, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const auto q4 = [&](const char* name) { return static_cast<int>(std::lround(16.0 * real(name, i))); };
    const auto z = static_cast<float>(2.0 * real("z", i) / one - 1.0);
    const glm::vec4 at(clip_of(q4("x"), row.whole("x")), -clip_of(q4("y"), row.whole("y")), layout.is_w ? 0.0F : z, 1);
    corners[static_cast<std::size_t>(i)] = layout.is_w ? at * static_cast<float>(real("w", i)) : at;
  }
  PipelineState state = plain_state(profile);
  state.depth_test = {.enabled = true, .function = CompareFunction::always, .write = true};
  if (layout.exponent_bits > 0) state.float_depth_one = static_cast<float>(one);
  return {static_cast<int>(draw_pixel(state, {.homogeneous_positions = corners}, {}, {}, format).depth)};
}

std::string wrong_depth_format(const MeasuredRow& row, const HardwareProfile& profile) {
  for (const std::string& wrong :
       {wrong_word(row, "kind", kDepthKinds), wrong_word(row, "fmt", kDepthNumbers), wrong_depth(row, profile)}) {
    if (!wrong.empty()) return wrong;
  }
  for (const char* const name : {"w0", "w1", "w2"}) {
    if (!(row.real(name) > 0.0)) return "w0, w1 and w2 must be above 0";
  }
  return "";
}

// The factor and the units of an offset.
constexpr Words<std::array<float, 2>, 3> kOffsets{
    {{"bias16", {0.0F, 16.0F}}, {"slope16", {16.0F, 0.0F}}, {"bias16+slope16", {16.0F, 16.0F}}}};

// The differences of neighbours in one direction: their mean, and by how much it may be wrong. The picture shows whole
// numbers; where two of them are each other's neighbours, the mean is that of the gradient itself. The ground's 0 and
// differences across an edge are left out.
struct Gradient {
  double mean = 0.0, error = 0.0;
};
Gradient gradient_of(const std::string& text) {
  constexpr std::int64_t kAcrossEdges = 1 << 16;
  double sum = 0.0, pixels = 0.0;
  std::int64_t least = kAcrossEdges, greatest = 0;
  const auto counts = pixel_counts(text);  // has been checked
  for (const PixelCount& count : *counts) {
    if (count.value == 0 || count.value >= kAcrossEdges) continue;
    sum += static_cast<double>(count.value) * static_cast<double>(count.pixels);
    pixels += static_cast<double>(count.pixels);
    least = std::min(least, count.value);
    greatest = std::max(greatest, count.value);
  }
  if (pixels == 0.0) return {};
  return {sum / pixels, greatest == least + 1 ? 1.0 / 16.0 : 1.0};
}

// The larger one: all planes of the table lie along x or y.
Gradient gradient_of(const MeasuredRow& row) {
  const Gradient x = gradient_of(row.text("absdzdx:n")), y = gradient_of(row.text("absdzdy:n"));
  return x.mean > y.mean ? x : y;
}

// By how much the offset moves most pixels of a plane with the row's gradient.
std::vector<int> draw_offset(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr int kWidth = 1024;
  constexpr double kFirst = 1'000'000.0;
  const double last = kFirst + kWidth * gradient_of(row).mean;
  const auto z = [](double code) {
    return static_cast<float>(2.0 * code / max_depth(DepthStencilFormat::d24s8) - 1.0);
  };
  const std::array<glm::vec4, 4> corners{glm::vec4(-1, -1, z(kFirst), 1), glm::vec4(1, -1, z(last), 1),
                                         glm::vec4(1, 1, z(last), 1), glm::vec4(-1, 1, z(kFirst), 1)};
  std::array<PlaneSamples<std::uint32_t>, 2> depth;
  for (const bool is_moved : {false, true}) {
    Surface surface = Surface::make(kWidth, 1).value();
    RenderTarget target = surface.target();
    PipelineState state = plain_state(profile);
    state.depth_test = {.enabled = true, .function = CompareFunction::always, .write = true};
    const auto [factor, units] = *value_of(kOffsets, row.text("offset"));
    state.polygon_offset = {.fill = is_moved, .factor = factor, .units = units};
    const VertexArrays arrays{.type = PrimitiveType::quads, .homogeneous_positions = corners};
    // The states of measured tables are always valid.
    (void)rasterize(state, glm::mat4(1.0F), arrays, {}, target);
    depth[is_moved ? 1 : 0] = surface.depth();
  }
  std::map<int, int> pixels;
  for (std::size_t i = 0; i < depth[0].size(); ++i) ++pixels[static_cast<int>(depth[1][i] - depth[0][i])];
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return {std::max_element(pixels.begin(), pixels.end(), fewer)->first};
}

// The offset's fraction moves some pixels by one more, and near 2^24 the chip cuts it.
int offset_tolerance(const MeasuredRow& row) {
  const double factor = (*value_of(kOffsets, row.text("offset")))[0];
  return static_cast<int>(std::ceil(factor * gradient_of(row).error));
}

std::string wrong_offset(const MeasuredRow& row, const HardwareProfile&) {
  if (gradient_of(row).mean > 8192.0) return "absdzdx:n and absdzdy:n must be at most 8192";
  return wrong_word(row, "offset", kOffsets);
}

constexpr Words<FogFunction, 6> kFogModes{{{"lin", FogFunction::linear},
                                           {"lin_abs", FogFunction::linear_abs},
                                           {"exp", FogFunction::exp},
                                           {"exp_abs", FogFunction::exp_abs},
                                           {"exp2", FogFunction::exp2},
                                           {"exp2_abs", FogFunction::exp2_abs}}};

std::vector<int> draw_fog(const MeasuredRow& row, const HardwareProfile& profile) {
  const Fog fog{.enabled = true,
                .color = {},
                .function = *value_of(kFogModes, row.text("mode")),
                .bias = static_cast<float>(row.real("bias")),
                .slope = static_cast<float>(row.real("linear"))};
  return {fog_byte(profile, fog, static_cast<float>(row.real("x")))};
}

// The entries of the chip's table are not known.
int fog_tolerance(const MeasuredRow& row) {
  const FogFunction function = *value_of(kFogModes, row.text("mode"));
  return function == FogFunction::linear || function == FogFunction::linear_abs ? 0 : 1;
}

std::string wrong_fog(const MeasuredRow& row, const HardwareProfile&) {
  return wrong_word(row, "mode", kFogModes);
}

// A pixel of the triangle that the comments describe, red, green and blue at its corners.
std::vector<int> draw_counter_clockwise(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr std::array<ColorBytes, 3> kCornerColors{{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}}};
  std::array<glm::vec4, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double>& at = row.list(std::array{"first", "second", "third"}[i]);
    const auto q4 = [&](std::size_t k) { return static_cast<int>(std::lround(16.0 * at[k])); };
    corners[i] = glm::vec4(clip_of(q4(0), row.whole("x")), -clip_of(q4(1), row.whole("y")), 0.0F, 1.0F);
  }
  const ColorBytes color =
      draw_pixel(plain_state(profile), {.homogeneous_positions = corners, .vertex_colors = kCornerColors}, {}).color;
  return {color[0], color[1], color[2]};
}

struct WrapWord {
  Wrap wrap;
  bool border_texels = false;
};
constexpr Words<WrapWord, 6> kWrapWords{{{"repeat", {Wrap::repeat}},
                                         {"mirror", {Wrap::mirrored_repeat}},
                                         {"clamp", {Wrap::clamp_to_edge}},
                                         {"ogl", {Wrap::clamp}},
                                         {"border", {Wrap::clamp_to_border}},
                                         {"border_texel", {Wrap::clamp_to_border, true}}}};

// The pictures' texture of 32 texels a side, or one of 64 with a border.
Texture wrap_texture(bool border_texels) {
  constexpr int kSize = 32, kBorder = 4;
  constexpr std::array<std::uint32_t, 4> kPlain{0xFF0000, 0x00FF00, 0x4444FF, 0xFFFFFF};
  constexpr std::array<std::uint32_t, 4> kInside{0x0000FF, 0x00FF00, 0xFF4444, 0xFFFFFF};
  const int size = border_texels ? 2 * kSize : kSize, first = border_texels ? kBorder : 0;
  std::array<std::vector<std::uint8_t>, 4> bytes;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int s = x - first, t = y - first;
      const bool is_inside = s >= 0 && s < kSize && t >= 0 && t < kSize;
      const int color = (s / 2 + t / 2) % 8;
      const std::uint32_t grey = ((x / 2 + y / 2) & 1) == 0 ? 0xFFCCCCCC : 0xFF444444;
      const std::uint32_t alpha = color % 2 == 0 ? 0xFF000000 : 0x66000000;
      const auto at = static_cast<std::size_t>(color / 2);
      const ColorBytes texel = tools::color_of(is_inside ? alpha | (border_texels ? kInside : kPlain)[at] : grey);
      for (std::size_t k = 0; k < 4; ++k) bytes[k].push_back(texel[k]);
    }
  }
  return rgba_texture(size, std::move(bytes));
}

std::vector<int> draw_wrap(const MeasuredRow& row, const HardwareProfile& profile) {
  static const std::array<Texture, 2> textures{wrap_texture(false), wrap_texture(true)};
  const WrapWord word = *value_of(kWrapWords, row.text("mode"));
  Sampler sampler = kNearestSampler;
  sampler.wrap_s = sampler.wrap_t = word.wrap;
  sampler.border_texels = word.border_texels;
  const ColorBytes border = tools::color_of(row.text("border").empty() ? 0 : row.digits("border"));
  for (std::size_t k = 0; k < 4; ++k) sampler.border_color[k] = static_cast<float>(border[k]) / 255.0F;
  const std::array<float, 3> at{static_cast<float>(row.real("s")), static_cast<float>(row.real("t")), 0.0F};
  const Bytes4 texel = texel_bytes(textures[word.border_texels ? 1 : 0], sampler, at, profile);
  std::vector<int> shown;
  for (std::size_t k = 0; k < 4; ++k) shown.push_back(shown_over(texel[k], texel[3], k == 3 ? 254 : 32));
  return shown;
}

std::string wrong_wrap(const MeasuredRow& row, const HardwareProfile&) {
  return wrong_word(row, "mode", kWrapWords);
}

constexpr Words<ColorKeyOperation, 4> kKeyModes{{{"Disabled", ColorKeyOperation::disable},
                                                 {"Alpha", ColorKeyOperation::alpha},
                                                 {"Color", ColorKeyOperation::rgba},
                                                 {"AlphaColor", ColorKeyOperation::kill}}};
constexpr Words<bool, 2> kKeyAlphas{{{"one", false}, {"texture", true}}};  // whether alpha is the texel's

// A pixel with one texel, blended over green.
std::vector<int> draw_color_key(const MeasuredRow& row, const HardwareProfile& profile) {
  const int stage = row.whole("stage");
  const bool has_texel_alpha = *value_of(kKeyAlphas, row.text("alpha"));
  const ColorBytes texel = tools::color_of(row.digits("texel"));
  std::array<std::vector<std::uint8_t>, 4> bytes;
  for (std::size_t k = 0; k < 4; ++k) bytes[k] = {texel[k]};
  const Texture texture = rgba_texture(1, std::move(bytes));
  std::vector<TextureUnit> units(static_cast<std::size_t>(stage) + 1);
  units.back() = {.texture = &texture, .sampler = kNearestSampler};
  units.back().sampler.color_key = {*value_of(kKeyModes, row.text("mode")), row.digits("key")};
  PipelineState state = plain_state(profile);
  state.program = normalize(quad_state(texture_register(stage), has_texel_alpha), profile);
  state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha, BlendEquation::add, {}};
  const std::array<glm::vec3, 3> middle{glm::vec3(0.5F), glm::vec3(0.5F), glm::vec3(0.5F)};
  VertexArrays arrays{.homogeneous_positions = kWholePixel};
  arrays.texture_coordinates[static_cast<std::size_t>(stage)] = middle;
  const ColorBytes color = draw_pixel(state, arrays, {0, 204, 0, 255}, units).color;
  return {color[0], color[1], color[2], color[3]};
}

std::string wrong_color_key(const MeasuredRow& row, const HardwareProfile& profile) {
  for (const std::string& wrong : {wrong_word(row, "mode", kKeyModes), wrong_word(row, "alpha", kKeyAlphas)}) {
    if (!wrong.empty()) return wrong;
  }
  if (row.whole("stage") < profile.texture_units) return "";
  return fmt::format("profile {} has {} texture units", profile.name, profile.texture_units.value);
}

}  // namespace

std::vector<MeasuredFormat> make_pixel_formats() {
  const Column note{}, word{{}, Kind::word}, real{{}, Kind::real}, digits{{}, Kind::digits},
      digits_or_none{{}, Kind::digits, 0, 0, true}, measured{{}, Kind::measured}, pixel = whole({}, 0, 4095);
  const auto corner = [](std::string_view name, std::string_view before) {
    return StatedValue{name, before, StatedValue::Kind::list, 0, 4095, "(138,44)", 2};
  };
  MeasuredFormat fog{"fog factors", columns({{"mode", word}, {"bias,linear,x", real}, {"factor", measured}}), draw_fog,
                     wrong_fog};
  fog.tolerance = fog_tolerance;
  const Column counts{{}, Kind::counts};
  MeasuredFormat offset{"polygon offsets",
                        columns({{"primitive", word},
                                 {"V1=passthrough vsh", note},
                                 {"offset", word},
                                 {"delta:pixels", {{}, Kind::most}},
                                 {"absdzdx:n,absdzdy:n", counts}}),
                        draw_offset, wrong_offset};
  offset.tolerance = offset_tolerance;
  return {
      {"depth formats",
       columns({{"kind", word},
                {"bits", whole({}, 16, 24)},
                {"fmt", word},
                {"x0,y0,z0,w0,x1,y1,z1,w1,x2,y2,z2,w2", real},
                {"x,y", pixel},
                {"code", measured}}),
       draw_depth_format, wrong_depth_format},
      offset,
      fog,
      {"a counter-clockwise triangle",
       columns({{"x,y", pixel}, {"r,g,b", measured}}),
       draw_counter_clockwise,
       nullptr,
       {corner("first", "corners "), corner("second", "red, "), corner("third", "green, ")}},
      {"wrap modes",
       columns({{"mode", word}, {"s,t", real}, {"border", digits_or_none}, {"pic_r,pic_g,pic_b,pic_a", measured}}),
       draw_wrap, wrong_wrap},
      {"colour keys",
       columns({{"mode,alpha", word},
                {"stage", whole({}, 0, 3)},
                {"key,texel", digits},
                {"pixels", note},
                {"pic_r,pic_g,pic_b,pic_a", measured}}),
       draw_color_key, wrong_color_key},
      {"combiner quads", columns({{"picture,operation,computes", word}, {"r,g,b,a", measured}, {"pixels,wrong", note}}),
       run_quad, wrong_quad},
  };
}

}  // namespace ninebit::tools
