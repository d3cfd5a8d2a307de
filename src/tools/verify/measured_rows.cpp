#include "src/tools/verify/measured_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/s3tc.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr Words<CompareFunction, 8> kFunctions{{{"Never", CompareFunction::never},
                                                {"LessThan", CompareFunction::less},
                                                {"Equal", CompareFunction::equal},
                                                {"LessThanOrEqual", CompareFunction::lequal},
                                                {"GreaterThan", CompareFunction::greater},
                                                {"NotEqual", CompareFunction::notequal},
                                                {"GreaterThanOrEqual", CompareFunction::gequal},
                                                {"Always", CompareFunction::always}}};

constexpr Words<BlendEquation, 7> kEquations{{{"ADD", BlendEquation::add},
                                              {"SUB", BlendEquation::subtract},
                                              {"REVSUB", BlendEquation::reverse_subtract},
                                              {"MIN", BlendEquation::min},
                                              {"MAX", BlendEquation::max},
                                              {"SADD", BlendEquation::add_signed},
                                              {"SREVSUB", BlendEquation::reverse_subtract_signed}}};

constexpr Words<BlendFactor, 15> kFactors{{{"0", BlendFactor::zero},
                                           {"1", BlendFactor::one},
                                           {"srcRGB", BlendFactor::src_color},
                                           {"1-srcRGB", BlendFactor::one_minus_src_color},
                                           {"dstRGB", BlendFactor::dst_color},
                                           {"1-dstRGB", BlendFactor::one_minus_dst_color},
                                           {"srcA", BlendFactor::src_alpha},
                                           {"1-srcA", BlendFactor::one_minus_src_alpha},
                                           {"dstA", BlendFactor::dst_alpha},
                                           {"1-dstA", BlendFactor::one_minus_dst_alpha},
                                           {"cRGB", BlendFactor::constant_color},
                                           {"1-cRGB", BlendFactor::one_minus_constant_color},
                                           {"cA", BlendFactor::constant_alpha},
                                           {"1-cA", BlendFactor::one_minus_constant_alpha},
                                           {"srcAsat", BlendFactor::src_alpha_saturate}}};

// r on the left.
constexpr Words<DepthComparison, 8> kComparisons{{{"N", DepthComparison::never},
                                                  {"LT", DepthComparison::less},
                                                  {"EQ", DepthComparison::equal},
                                                  {"LE", DepthComparison::lequal},
                                                  {"GT", DepthComparison::greater},
                                                  {"NE", DepthComparison::notequal},
                                                  {"GE", DepthComparison::gequal},
                                                  {"A", DepthComparison::always}}};

// Whether r is compared.
constexpr Words<bool, 2> kStageModes{{{"2D", false}, {"3D", true}}};

Pixel draw_color(const PipelineState& state, const ColorBytes& color, const ColorBytes& under) {
  const std::array<ColorBytes, 3> colors{color, color, color};
  return draw_pixel(state, {.homogeneous_positions = kWholePixel, .vertex_colors = colors}, under);
}

std::vector<int> values(const ColorBytes& color) {
  return {color[0], color[1], color[2], color[3]};
}

using Block = std::array<std::uint8_t, 16>;

void put(Block& block, std::size_t first, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) block[first + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

// The texel of a row's colours, whose alpha stands in `block`, at (x, y).
Bytes4 texel_of(const MeasuredRow& row, S3tcFormat format, Block block, unsigned x, unsigned y,
                const HardwareProfile& profile) {
  const std::size_t colors = s3tc_block_bytes(format) - 8, at = 4 * y + x;
  put(block, colors, row.digits("c0"), 2);
  put(block, colors + 2, row.digits("c1"), 2);
  put(block, colors + 4, static_cast<std::uint64_t>(row.whole("index")) << (2 * at), 4);
  const std::span<const std::uint8_t> bytes(block.data(), s3tc_block_bytes(format));
  return decode_s3tc_block(format, profile.dxt1_palette, bytes)[at];
}

std::vector<int> shown_texel(const Bytes4& texel, const MeasuredRow& row) {
  const auto over = [&](std::size_t k, const char* under) { return shown_over(texel[k], texel[3], row.whole(under)); };
  return {over(0, "under"), over(1, "under"), over(2, "under"), over(3, "alpha_under")};
}

// The red byte at (s, t), where the texture changes so much from one fragment to the next.
int sampled(const Texture& texture, const Sampler& sampler, std::array<float, 3> at, const HardwareProfile& profile,
            float change = 0.0F) {
  const auto made = TextureSampler::make(profile, texture, sampler);
  const float none = 0.0F;
  TextureCoordinates coordinates;
  for (std::size_t k = 0; k < 3; ++k) {
    coordinates.value[k] = &at[k];
    coordinates.dx[k] = coordinates.dy[k] = &none;
  }
  coordinates.dx[0] = &change;
  return made->texel(coordinates, 0).value[0];
}

Texture luminance(std::vector<TextureSamples> levels) {
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {std::move(levels)}).value();
}

// The coordinate in a texture of two texels that is `place` texels beyond the middle of the first.
float between_texels(double place) {
  return static_cast<float>((0.5 + place) / 2.0);
}

constexpr Sampler kLinear{.min_filter = MinFilter::linear,
                          .mag_filter = MagFilter::linear,
                          .wrap_s = Wrap::clamp_to_edge,
                          .wrap_t = Wrap::clamp_to_edge};

// One level's sample; `level` is the ending of its columns.
std::uint8_t level_sample(const MeasuredRow& row, const std::string& level, const HardwareProfile& profile) {
  const auto byte = [&](const char* column) { return row.byte(column + level); };
  const auto place = [&](const char* column) { return between_texels(byte(column) / 256.0); };
  const Texture texture = luminance({{2, 2, std::vector{byte("A"), byte("B"), byte("C"), byte("D")}}});
  return static_cast<std::uint8_t>(sampled(texture, kLinear, {place("fu"), place("fv"), 0.0F}, profile));
}

}  // namespace

Pixel draw_pixel(const PipelineState& state, const VertexArrays& arrays, const ColorBytes& under,
                 std::span<const TextureUnit> units, DepthStencilFormat format) {
  Surface surface = Surface::make(1, 1, {.depth_stencil = format, .with_primitive = true}).value();
  RenderTarget target = surface.target();
  Pixel pixel;
  for (std::size_t k = 0; k < 4; ++k) *target.color[k].data = under[k];
  // The states of measured tables are always valid.
  if (!rasterize(state, glm::mat4(1.0F), arrays, units, target)) return pixel;
  for (std::size_t k = 0; k < 4; ++k) pixel.color[k] = *target.color[k].data;
  pixel.depth = surface.depth()[0];
  pixel.is_drawn = surface.primitive()[0] == 0;
  return pixel;
}

float clip_of(int q4, int at) {
  const int from_pixel = q4 - 16 * at;
  const double middle = from_pixel + (from_pixel > 0 ? 0.5 : from_pixel < 0 ? -0.5 : 0.0);
  return static_cast<float>(middle / 8.0 - 1.0);
}

Texture rgba_texture(int size, std::array<std::vector<std::uint8_t>, 4> bytes) {
  std::vector<std::uint8_t> texels;
  for (const auto& plane : bytes) texels.insert(texels.end(), plane.begin(), plane.end());
  return make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{{size, size, std::move(texels)}}}).value();
}

Bytes4 texel_bytes(const Texture& texture, const Sampler& sampler, std::array<float, 3> at,
                   const HardwareProfile& profile) {
  const auto made = TextureSampler::make(profile, texture, sampler);
  const float none = 0.0F;
  TextureCoordinates coordinates;
  for (std::size_t k = 0; k < 3; ++k) {
    coordinates.value[k] = &at[k];
    coordinates.dx[k] = coordinates.dy[k] = &none;
  }
  return made->bytes(coordinates, 0);
}

namespace {

// A fragment of red 1 over black: 1 where it is drawn, else 0.
std::vector<int> draw_alpha_test(const MeasuredRow& row, const HardwareProfile& profile) {
  PipelineState state = plain_state(profile);
  state.alpha_test = {true, *value_of(kFunctions, row.text("func")), row.byte("ref")};
  return {draw_color(state, {255, 0, 0, row.byte("alpha_byte")}, {}).is_drawn ? 1 : 0};
}

// s over d, whose result a second blend shows over what the table states.
std::vector<int> draw_blend(const MeasuredRow& row, const HardwareProfile& profile) {
  PipelineState state = plain_state(profile);
  state.blend = {true, *value_of(kFactors, row.text("sfactor")), *value_of(kFactors, row.text("dfactor")),
                 *value_of(kEquations, row.text("equation")), color_of(row.digits("constant"))};
  const ColorBytes blended = draw_color(state, color_of(row.digits("s")), color_of(row.digits("d"))).color;
  state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha, BlendEquation::add, {}};
  ColorBytes under{};
  for (std::size_t k = 0; k < 4; ++k) under[k] = static_cast<std::uint8_t>(row.list("under")[k]);
  return values(draw_color(state, blended, under).color);
}

// A texel of a block.
std::vector<int> draw_dxt1(const MeasuredRow& row, const HardwareProfile& profile) {
  const auto x = static_cast<unsigned>(row.whole("x_and_3")), y = static_cast<unsigned>(row.whole("y_and_3"));
  const Bytes4 texel = texel_of(row, S3tcFormat::dxt1_rgba, {}, x, y, profile);
  return {texel[0], texel[1], texel[2], texel[3]};
}

// A texel of a DXT3 block and its alpha, shown over the stated background.
std::vector<int> draw_dxt3(const MeasuredRow& row, const HardwareProfile& profile) {
  return shown_texel(texel_of(row, S3tcFormat::dxt3, {row.byte("alpha4")}, 0, 0, profile), row);
}

// A texel of a DXT5 block and its alpha, shown over the stated background.
std::vector<int> draw_dxt5(const MeasuredRow& row, const HardwareProfile& profile) {
  return shown_texel(
      texel_of(row, S3tcFormat::dxt5, {row.byte("alpha0"), row.byte("alpha1"), row.byte("alpha_index")}, 0, 0, profile),
      row);
}

// Four texels of a level, and four of the next one, with their weights.
std::vector<int> draw_filter(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::uint8_t level = level_sample(row, "", profile);
  if (row.whole("f") == 0) return {level};
  // Lambda is the bias: a change of half of a level of two texels a pixel.
  const std::uint8_t next = level_sample(row, "2", profile);
  const Texture levels = luminance({{2, 2, std::vector<std::uint8_t>(4, level)}, {1, 1, std::vector{next}}});
  Sampler sampler = kLinear;
  sampler.min_filter = MinFilter::linear_mipmap_linear;
  sampler.lod_bias = static_cast<float>(row.whole("f")) / 256.0F;
  return {sampled(levels, sampler, {0.5F, 0.5F, 0.0F}, profile, 0.5F)};
}

// A place between the texels 0 and 255, read as the luminance of a bump environment and shown over what the table
// states.
std::vector<int> draw_weight(const MeasuredRow& row, const HardwareProfile& profile) {
  const Texture texture = luminance({{1, 2, std::vector<std::uint8_t>{0, 255}}});
  const int read = sampled(texture, kLinear, {0.5F, between_texels(row.real("place")), 0.0F}, profile);
  const auto value = static_cast<int>(std::floor(254.0 * (0.7 * read / 255.0 + 76.0 / 255.0) + 0.5));
  return {shown_over(value, row.whole("alpha"), row.whole("under"))};
}

// A pixel of a triangle with three colours.
std::vector<int> draw_smooth(const MeasuredRow& row, const HardwareProfile& profile) {
  constexpr int kHeight = 480;  // of the picture, whose y grows downwards
  std::array<glm::vec4, 3> corners;
  std::array<ColorBytes, 3> colors;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    const auto w = static_cast<float>(row.real("w" + n));
    const int x = row.whole("x" + n), y = 16 * kHeight - row.whole("y" + n);
    const glm::vec4 at(clip_of(x, row.whole("x")), clip_of(y, kHeight - 1 - row.whole("y")), 0.0F, 1.0F);
    corners[static_cast<std::size_t>(i)] = at * w;
    colors[static_cast<std::size_t>(i)] = color_of(row.digits("c" + n));
  }
  const VertexArrays arrays{.homogeneous_positions = corners, .vertex_colors = colors};
  const ColorBytes color = draw_pixel(plain_state(profile), arrays, {}).color;
  return {color[0], color[1], color[2]};
}

// The depth code of a pixel of a quad.
std::vector<int> draw_depth(const MeasuredRow& row, const HardwareProfile& profile) {
  const DepthStencilFormat format = row.whole("bits") == 16 ? DepthStencilFormat::d16 : DepthStencilFormat::d24s8;
  const double largest = max_depth(format);
  const auto corner = [&](const char* x, int y, const char* z) {
    return glm::vec4(clip_of(16 * row.whole(x), row.whole("x")), clip_of(16 * y, 0),
                     static_cast<float>(2.0 * row.whole(z) / largest - 1.0), 1.0F);
  };
  const std::array<glm::vec4, 4> corners{corner("x0", -4, "z_left"), corner("x1", -4, "z_right"),
                                         corner("x1", 4, "z_right"), corner("x0", 4, "z_left")};
  PipelineState state = plain_state(profile);
  state.depth_test = {.enabled = true, .function = CompareFunction::always, .write = true};
  const VertexArrays arrays{.type = PrimitiveType::quads, .homogeneous_positions = corners};
  return {static_cast<int>(draw_pixel(state, arrays, {}, {}, format).depth)};
}

// The comparison of r with a depth texture: 1 where it holds, else 0.
std::vector<int> draw_shadow(const MeasuredRow& row, const HardwareProfile& profile) {
  const bool is_16 = row.whole("bits") == 16;
  const InternalFormat format = is_16 ? InternalFormat::depth16 : InternalFormat::depth24;
  const double largest = max_depth(is_16 ? DepthStencilFormat::d16 : DepthStencilFormat::d24s8);
  const std::vector stored{static_cast<std::uint32_t>(row.whole("t"))};
  const Texture texture = make_texture(TextureTarget::texture_2d, format, {{{1, 1, stored}}}).value();
  Sampler sampler = kNearestSampler;
  sampler.comparison = *value_of(kComparisons, row.text("func"));
  // The stage mode of 2D textures compares 0 in place of r.
  const double r = *value_of(kStageModes, row.text("mode")) ? row.whole("r") / largest : 0.0;
  return {sampled(texture, sampler, {0.5F, 0.5F, static_cast<float>(r)}, profile) == 0 ? 0 : 1};
}

std::string wrong_alpha_test(const MeasuredRow& row, const HardwareProfile&) {
  return wrong_word(row, "func", kFunctions);
}

std::string wrong_blend(const MeasuredRow& row, const HardwareProfile&) {
  for (const std::string& wrong : {wrong_word(row, "equation", kEquations), wrong_word(row, "sfactor", kFactors),
                                   wrong_word(row, "dfactor", kFactors)}) {
    if (!wrong.empty()) return wrong;
  }
  return "";
}

std::string wrong_shadow(const MeasuredRow& row, const HardwareProfile& profile) {
  for (const std::string& wrong :
       {wrong_word(row, "mode", kStageModes), wrong_word(row, "func", kComparisons), wrong_depth(row, profile)}) {
    if (!wrong.empty()) return wrong;
  }
  if (std::max(row.whole("r"), row.whole("t")) >> row.whole("bits") == 0) return "";
  return fmt::format("r and t must be whole numbers from 0 to {}", (1 << row.whole("bits")) - 1);
}

constexpr StatedValue kBlendConstant{"constant", "blend constant ", StatedValue::Kind::digits,
                                     0,          0xFFFFFFFFP0,      "55555555"},
    kUnderTexel{"under", "texel + (255-A)*", StatedValue::Kind::real, 0, 255, "16"},
    kAlphaUnderTexel{"alpha_under", "A*A + (255-A)*", StatedValue::Kind::real, 0, 255, "254"},
    kBlendAlpha{"alpha", "alpha ", StatedValue::Kind::real, 0, 255, "127"},
    kUnder{"under", "blended over ", StatedValue::Kind::real, 0, 255, "32"};

}  // namespace

std::string wrong_depth(const MeasuredRow& row, const HardwareProfile&) {
  return row.whole("bits") == 16 || row.whole("bits") == 24 ? "" : "bits must be 16 or 24";
}

// Their pictures: abaire/nxdk_pgraph_tests_golden_results.
std::vector<MeasuredFormat> make_row_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, match{{}, Kind::match},
      any_byte = byte({}), cut = whole({}, 0, 3), weight = whole({}, 0, 255), next_level{{}, Kind::whole, 0, 255, true},
      depth = whole({}, 0, (1 << 24) - 1), position = whole({}, -100'000, 100'000), pixel = whole({}, 0, 4095);
  return {
      {"alpha test",
       columns({{"func", word},
                {"ref,alpha_byte", any_byte},
                {"hw_drawn", measured},
                {"pixels,model_drawn", note},
                {"match", match}}),
       draw_alpha_test, wrong_alpha_test},
      {"blending",
       columns({{"equation,sfactor,dfactor", word},
                {"s,d", digits},
                {"bR,bG,bB,bA", note},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_blend,
       wrong_blend,
       {kBlendConstant, kUnderBlend}},
      {"DXT1",
       columns({{"c0,c1", digits},
                {"index,x_and_3,y_and_3", cut},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_dxt1},
      {"DXT3",
       columns({{"c0,c1", digits},
                {"index", cut},
                {"alpha4", whole({}, 0, 15)},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_dxt3,
       nullptr,
       {kUnderTexel, kAlphaUnderTexel}},
      {"DXT5",
       columns({{"c0,c1", digits},
                {"index", cut},
                {"alpha0,alpha1", any_byte},
                {"alpha_index", whole({}, 0, 7)},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_dxt5,
       nullptr,
       {kUnderTexel, kAlphaUnderTexel}},
      {"linear filters",
       columns({{"bias,level", note},
                {"fu,fv", weight},
                {"A,B,C,D", any_byte},
                {"f", weight},
                {"fu2,fv2,A2,B2,C2,D2", next_level},
                {"hw", measured},
                {"model", note},
                {"match", match}}),
       draw_filter},
      {"weights of linear filters",
       columns({{"row", note},
                {"place", real},
                {"w,lum", note},
                {"hw_R(values seen)", measured},
                {"model_out", note},
                {"match", match},
                {"model_out_if_nearest,match_if_nearest", note}}),
       draw_weight,
       nullptr,
       {kBlendAlpha, kUnder}},
      {"depth comparison",
       columns({{"picture", note},
                {"mode", word},
                {"bits", whole({}, 16, 24)},
                {"r", depth},
                {"func", word},
                {"t", depth},
                {"hw", measured},
                {"model", note},
                {"match", match}}),
       draw_shadow, wrong_shadow},
      {"smooth colours",
       columns({{"triangle", word},
                {"x,y", pixel},
                {"hw_R,hw_G,hw_B", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_smooth,
       nullptr,
       {},
       "nv2a_gouraud_triangles.csv",
       "triangle",
       columns({{"triangle", word},
                {"picture,vertices", note},
                {"x0,y0,x1,y1,x2,y2", position},
                {"w0,w1,w2", real},
                {"c0,c1,c2", digits},
                {"pixels,wrong,uncovered", note}})},
      {"depth codes",
       columns({{"bits", whole({}, 16, 24)},
                {"x0,x1", pixel},
                {"z_left,z_right", depth},
                {"x", pixel},
                {"exact", note},
                {"hw", measured},
                {"model_floor", note},
                {"match", match},
                {"match_if_nearest", note}}),
       draw_depth, wrong_depth},
  };
}

}  // namespace ninebit::tools
