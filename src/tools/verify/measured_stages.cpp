// Measured tables of texture-shader stages and of texel formats.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texel_words.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/study/vectors/stage_groups.h"
#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr Words<TextureOperation, 4> kCubeModes{
    {{"STR_CUBE", TextureOperation::dot_product_cube_map},
     {"DIFFUSE", TextureOperation::dot_product_diffuse_cube_map},
     {"SPEC", TextureOperation::dot_product_reflect_cube_map},
     {"SPEC_CONST", TextureOperation::dot_product_const_eye_reflect_cube_map}}};
constexpr Words<DotMapping, 6> kDotMappings{{{"0to1", DotMapping::zero_to_one},
                                             {"-1to1D3D", DotMapping::minus1_to_1_d3d},
                                             {"-1to1GL", DotMapping::minus1_to_1_gl},
                                             {"-1to1", DotMapping::minus1_to_1},
                                             {"HiLo_1", DotMapping::hilo_1},
                                             {"HiLoHemi", DotMapping::hilo_hemisphere}}};
constexpr Words<bool, 2> kCubeTextures{{{"C", false}, {"R", true}}};

// The state with dot products from stage 1 on, the last of which is `last`.
TextureShaderState dot_state(std::size_t last_stage, TextureOperation last, DotMapping mapping) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::texture_2d;
  for (std::size_t i = 1; i <= last_stage; ++i) {
    state.stage[i].operation = i == last_stage ? last : TextureOperation::dot_product;
    state.stage[i].mapping = mapping;
  }
  return state;
}

// Runs stages whose textures are of the kinds that they read. The states of measured tables are always valid.
TextureShaderResult run_stages(const TextureShaderState& state, const HardwareProfile& profile,
                               const StageCoordinates& coordinates, const FetchTexel& fetch) {
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    textures[i] = StageTexture{.target = info_of(state.stage[i].operation).target};
  }
  const TextureShaderProgram program = compile(state, textures, profile).value();
  return evaluate(program, profile, {coordinates, coordinates, coordinates}, fetch);
}

std::array<float, 4> coordinates_of(const MeasuredRow& row, std::array<const char*, 4> columns) {
  std::array<float, 4> at{0.0F, 0.0F, 0.0F, 1.0F};
  for (std::size_t k = 0; k < 4; ++k) {
    if (columns[k] != nullptr) at[k] = static_cast<float>(row.real(columns[k]));
  }
  return at;
}

Bytes4 texel_at(const Texture& texture, const Sampler& sampler, const std::array<float, 3>& at,
                const HardwareProfile& profile) {
  TextureCoordinates coordinates;
  for (std::size_t k = 0; k < 3; ++k) coordinates.value[k] = &at[k];
  return TextureSampler::make(profile, texture, sampler, TexelUse::stages)->bytes(coordinates, 0);
}

std::vector<int> shown_pixel(const Bytes4& color, const MeasuredRow& row) {
  std::vector<int> pixel;
  for (std::size_t k = 0; k < 4; ++k) {
    pixel.push_back(shown_over(color[k], color[3], static_cast<int>(row.list("under")[k])));
  }
  return pixel;
}

// A checkerboard of 32 by 32 cells: red 0 in the first, 1 in the next one.
const Texture& checkerboard() {
  static const Texture made = [] {
    constexpr std::size_t kBoardSide = 256, kCellSide = 8;
    std::vector<std::uint8_t> cells(kBoardSide * kBoardSide);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i] = static_cast<std::uint8_t>((i % kBoardSide / kCellSide + i / kBoardSide / kCellSide) % 2);
    }
    return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8,
                        {{{kBoardSide, kBoardSide, std::move(cells)}}})
        .value();
  }();
  return made;
}

int cell_at(const std::array<float, 3>& at, const HardwareProfile& profile) {
  return texel_at(checkerboard(), kNearestSampler, at, profile)[0];
}

// The pictures draw two by two texels 168 pixels wide, from the first texel's beginning to the last one's end.
constexpr double kRegion = 168.0;
float base_coordinate(int pixel) {
  return static_cast<float>((pixel + 0.5) / kRegion);
}
// The coordinate in a texture of two texels whose weight is that of the pixel.
float filtered_at(int pixel) {
  const double place = std::clamp(2.0 * (pixel + 0.5) / kRegion - 0.5, 0.0, 1.0);
  return static_cast<float>((0.5 + std::floor(256.0 * place) / 256.0) / 2.0);
}

constexpr Sampler kLinearStage{.min_filter = MinFilter::linear,
                               .mag_filter = MagFilter::linear,
                               .wrap_s = Wrap::clamp_to_edge,
                               .wrap_t = Wrap::clamp_to_edge};

// Two by two texels, filtered for the pixel of a row.
Bytes4 filtered_texel(InternalFormat format, const std::array<Bytes4, 4>& texels, const std::array<bool, 4>& is_signed,
                      const MeasuredRow& row, const HardwareProfile& profile) {
  std::vector<std::uint8_t> samples;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const Bytes4& texel : texels) samples.push_back(texel[k]);
  }
  const Texture texture = make_texture(TextureTarget::texture_2d, format, {{{2, 2, std::move(samples)}}}).value();
  Sampler sampler = kLinearStage;
  sampler.is_signed = is_signed;
  return texel_at(texture, sampler, {filtered_at(row.whole("i")), filtered_at(row.whole("j")), 0.0F}, profile);
}

// The cube map's two colours of each face, and the components of the face's gradient.
struct FaceColors {
  std::uint32_t first, second;
  std::array<bool, 3> gradient;
};
constexpr std::array<FaceColors, 6> kFaceColors{{{0xFF7777, 0x222222, {true, false, false}},
                                                 {0x663355, 0xDDDDDD, {true, false, true}},
                                                 {0x55FF55, 0x222222, {false, true, false}},
                                                 {0xAAAA33, 0xDDDDDD, {true, true, false}},
                                                 {0x5555FF, 0x222222, {false, false, true}},
                                                 {0x33AAAA, 0xDDDDDD, {false, true, true}}}};
constexpr std::size_t kCubeSide = 64;

Texture cube_map_of(const auto& color_of_texel) {
  std::vector<std::vector<TextureSamples>> faces;
  for (const FaceColors& face : kFaceColors) {
    std::vector<std::uint8_t> samples(3 * kCubeSide * kCubeSide);
    for (std::size_t i = 0; i < kCubeSide * kCubeSide; ++i) {
      const ColorBytes color = color_of_texel(face, i);
      for (std::size_t k = 0; k < 3; ++k) samples[k * kCubeSide * kCubeSide + i] = color[k];
    }
    const int side = static_cast<int>(kCubeSide);
    faces.push_back({TextureSamples{side, side, std::move(samples)}});
  }
  return make_texture(TextureTarget::cube_map, InternalFormat::rgb8, std::move(faces)).value();
}

const Texture& checkered_cube() {
  static const Texture made = cube_map_of([](const FaceColors& face, std::size_t i) {
    constexpr std::size_t kCellSide = 4;
    const bool is_second = (i % kCubeSide / kCellSide + i / kCubeSide / kCellSide) % 2 == 1;
    return tools::color_of(is_second ? face.second : face.first);
  });
  return made;
}

// The intensity of a texel of the gradient texture, as the program that drew the pictures computed it: black in the
// middle of a face, brighter to its corners, steeper in the first quarter of the way; dimmed to 3/4 at the left and
// top.
std::uint8_t gradient_value(std::size_t column, std::size_t row) {
  constexpr double kMiddle = 31.5, kDimmest = 0.75, kBend = 0.25, kWidth = kCubeSide;
  const double x = static_cast<double>(column), y = static_cast<double>(row);
  const double way = std::hypot(x - kMiddle, y - kMiddle) / (kMiddle * std::sqrt(2.0));
  const double bright = way < kBend ? 2.0 * way : 0.5 + 0.5 * (way - kBend) / (1.0 - kBend);
  return static_cast<std::uint8_t>(255.0 * std::max({x / kWidth, y / kWidth, kDimmest}) * bright);
}

// The texel of the cube map with gradients in a direction.
ColorBytes gradient_color(const std::array<float, 3>& at, const HardwareProfile& profile) {
  static const Texture places = cube_map_of([](const FaceColors& face, std::size_t i) {
    const auto number = static_cast<std::uint8_t>(&face - kFaceColors.data());
    return ColorBytes{static_cast<std::uint8_t>(i % kCubeSide), static_cast<std::uint8_t>(i / kCubeSide), number, 0};
  });
  const Bytes4 place = texel_at(places, kNearestSampler, at, profile);
  const std::uint8_t value = gradient_value(place[0], place[1]);
  ColorBytes color{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k) color[k] = kFaceColors[place[2]].gradient[k] ? value : 0;
  return color;
}

// The three whole numbers of a cell such as "0 0 -7"; empty: it has something else.
std::optional<std::array<float, 3>> eye_of(const std::string& text) {
  const std::vector<std::string_view> numbers = pieces(text, ' ');
  std::array<float, 3> eye{};
  if (numbers.size() != eye.size()) return std::nullopt;
  for (std::size_t k = 0; k < eye.size(); ++k) {
    const auto number = number_of(numbers[k]);
    if (!number) return std::nullopt;
    eye[k] = static_cast<float>(*number);
  }
  return eye;
}

// s, t, r, q as a colour, shown by its alpha over what the table states.
std::vector<int> run_pass_through(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::pass_through;
  const auto result = run_stages(state, profile, {coordinates_of(row, {"s", "t", "r", "q"})}, {});
  return shown_pixel(result.stage[0].texel, row);
}

// The cell of a checkerboard that an offset texture reads: 0 or 1.
std::vector<int> run_offset(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::offset_2d;
  const std::array columns{"m00", "m01", "m10", "m11"};
  for (std::size_t k = 0; k < 4; ++k) state.stage[1].matrix[k] = static_cast<float>(row.real(columns[k]));
  // Green changes from left to right, blue downwards.
  std::array<Bytes4, 4> texels{};
  for (std::size_t k = 0; k < 4; ++k) {
    texels[k] = {0, row.byte(k % 2 == 0 ? "g_first" : "g_last"), row.byte(k < 2 ? "b_first" : "b_last"), 255};
  }
  const std::array<bool, 4> is_signed{false, row.whole("Gs") != 0, row.whole("Bs") != 0, false};
  StageCoordinates at{};
  at[0][3] = 1.0F;
  at[1] = {base_coordinate(row.whole("i")), base_coordinate(row.whole("j")), 0.0F, 1.0F};
  const auto result = run_stages(state, profile, at, [&](int unit, const TexturePlace& place) {
    if (unit == 0) return filtered_texel(InternalFormat::rgba8, texels, is_signed, row, profile);
    return Bytes4{static_cast<std::uint8_t>(cell_at(place.at, profile))};
  });
  return {result.stage[1].texel[0]};
}

// A component of an offset texture's texel, times the luminance.
std::vector<int> run_luminance(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::offset_2d_scale;
  state.stage[1].scale = static_cast<float>(row.real("scale"));
  state.stage[1].bias = static_cast<float>(row.real("offset"));
  const auto result = run_stages(state, profile, {}, [&](int unit, const TexturePlace&) {
    return unit == 0 ? Bytes4{row.byte("L")} : Bytes4{row.byte("T")};
  });
  return {result.stage[1].texel[0]};
}

// The colour that a cube map has where dot products, or the eye that they reflect, look.
std::vector<int> run_dot_cube(const MeasuredRow& row, const HardwareProfile& profile) {
  const TextureOperation mode = *value_of(kCubeModes, row.text("mode"));
  const bool is_diffuse = mode == TextureOperation::dot_product_diffuse_cube_map;
  TextureShaderState state = dot_state(3, is_diffuse ? TextureOperation::dot_product_reflect_cube_map : mode,
                                       *value_of(kDotMappings, row.text("mapping")));
  if (is_diffuse) state.stage[2].operation = mode;
  const std::vector<double>& rows = row.list(row.whole("cube") == 0 ? "rows of cube 0" : "rows of cube 1");
  const auto eye = eye_of(row.text("eye"));
  StageCoordinates at{};
  at[0][3] = 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) at[k + 1][i] = static_cast<float>(rows[3 * k + i]);
    if (eye) at[k + 1][3] = state.stage[3].eye[k] = (*eye)[k];
  }
  const auto result = run_stages(state, profile, at, [&](int unit, const TexturePlace&) {
    return unit == 0 ? Bytes4{row.byte("R"), row.byte("G"), row.byte("B"), row.byte("A")} : Bytes4{};
  });
  const std::array<float, 3>& looks = *result.stage[is_diffuse ? 2 : 3].at;
  const Bytes4 color = *value_of(kCubeTextures, row.text("tex"))
                           ? gradient_color(looks, profile)
                           : texel_at(checkered_cube(), kNearestSampler, looks, profile);
  return {color[0], color[1], color[2]};
}

// The cell of a checkerboard that the dot products of a filtered texel of 16 bits read: 0 or 1.
std::vector<int> run_hilo_dots(const MeasuredRow& row, const HardwareProfile& profile) {
  const TextureShaderState state = dot_state(2, TextureOperation::dot_product_2d, DotMapping::hilo_1);
  std::array<Bytes4, 4> texels{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string n = std::to_string(k);
    const auto high = static_cast<std::uint32_t>(row.whole("hi" + n)),
               low = static_cast<std::uint32_t>(row.whole("lo" + n));
    texels[k] = texel_of_word(TexelWord::r16b16, high << 16 | low);
  }
  const std::array<bool, 4> is_signed{false, row.whole("Gs") != 0, false, row.whole("As") != 0};
  StageCoordinates at{};
  at[0][3] = 1.0F;
  at[1] = {10.0F, 0.0F, base_coordinate(row.whole("i")), 1.0F};
  at[2] = {0.0F, 15.0F, base_coordinate(row.whole("j")), 1.0F};
  const auto result = run_stages(state, profile, at, [&](int unit, const TexturePlace& place) {
    if (unit == 0) return filtered_texel(InternalFormat::hilo16, texels, is_signed, row, profile);
    return Bytes4{static_cast<std::uint8_t>(cell_at(place.at, profile))};
  });
  return {result.stage[2].texel[0]};
}

// The quotient of two dot products as a depth code of 16 bits.
std::vector<int> run_depth_replace(const MeasuredRow& row, const HardwareProfile& profile) {
  const TextureShaderState state = dot_state(2, TextureOperation::dot_product_depth_replace, DotMapping::zero_to_one);
  StageTextures textures;
  textures[0] = StageTexture{};
  const TextureShaderProgram program = compile(state, textures, profile).value();
  const StageCoordinates at{std::array{0.0F, 0.0F, 0.0F, 1.0F}, coordinates_of(row, {"a0", "a1", "a2", nullptr}),
                            coordinates_of(row, {"b0", "b1", "b2", nullptr})};
  const auto result = evaluate(program, profile, {at, at, at}, [&](int, const TexturePlace&) {
    return Bytes4{row.byte("R"), row.byte("G"), row.byte("B"), 255};
  });
  return {static_cast<int>(replaced_depth_code(program, *result.depth, max_depth(DepthStencilFormat::d16)))};
}

// The colour of a cube map in a direction.
std::vector<int> run_cube_map(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::texture_cube_map;
  const auto result = run_stages(
      state, profile, {coordinates_of(row, {"s", "t", "r", nullptr})},
      [&](int, const TexturePlace& place) { return texel_at(checkered_cube(), kNearestSampler, place.at, profile); });
  const Bytes4& color = result.stage[0].texel;
  return {color[0], color[1], color[2]};
}

// The last of three layers that CULL_FRAGMENT leaves: 1 to 3, or 0.
std::vector<int> run_cull(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::cull_fragment;
  for (std::size_t k = 0; k < 4; ++k) {
    state.stage[0].cull[k] = row.text("modes")[k] == '0' ? CullMode::kills_negative : CullMode::kills_not_negative;
  }
  constexpr std::array<std::array<const char*, 4>, 3> kLayers{
      {{"s0", "t0", "r0", "q0"}, {"s1", "t1", "r1", "q1"}, {"s2", "t2", "r2", "q2"}}};
  int visible = 0;
  for (std::size_t layer = 0; layer < kLayers.size(); ++layer) {
    const auto result = run_stages(state, profile, {coordinates_of(row, kLayers[layer])}, {});
    if (!result.is_culled) visible = static_cast<int>(layer) + 1;
  }
  return {visible};
}

// A texel of Y, U and V as red, green and blue.
std::vector<int> run_yuv(const MeasuredRow& row, const HardwareProfile& profile) {
  TextureShaderState state = vectors::stage_state();
  state.stage[0].operation = TextureOperation::texture_2d;
  state.converts_yuv = true;
  const std::uint32_t word = static_cast<std::uint32_t>(row.whole("Y") | row.whole("U") << 8 | row.whole("V") << 24);
  const auto result =
      run_stages(state, profile, {}, [&](int, const TexturePlace&) { return texels_of_yuv_word(word, false)[0]; });
  const Rgba9& codes = result.stage[0].codes;
  return {codes[0], codes[1], codes[2]};
}

// A texel of a word, shown by its alpha over what the table states.
std::vector<int> run_texel_word(const MeasuredRow& row, const HardwareProfile&) {
  return shown_pixel(texel_of_word(*texel_word_called(row.text("format")), row.digits("word")), row);
}

std::string wrong_stages(const MeasuredRow&, const HardwareProfile& profile) {
  return profile.texture_shaders ? "" : no_texture_shaders(profile);
}

std::string wrong_dot_cube(const MeasuredRow& row, const HardwareProfile& profile) {
  for (const std::string& wrong : {wrong_stages(row, profile), wrong_word(row, "mode", kCubeModes),
                                   wrong_word(row, "mapping", kDotMappings), wrong_word(row, "tex", kCubeTextures)}) {
    if (!wrong.empty()) return wrong;
  }
  const bool has_eye = row.text("mode").starts_with("SPEC");
  if (has_eye && !eye_of(row.text("eye"))) {
    return fmt::format("eye must be three whole numbers, such as 0 0 1, not '{}'", shown(row.text("eye")));
  }
  return "";
}

std::string wrong_cull(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::string& modes = row.text("modes");
  const auto is_mode = [](char c) { return c == '0' || c == '1'; };
  if (modes.size() == 4 && std::all_of(modes.begin(), modes.end(), is_mode)) return wrong_stages(row, profile);
  return fmt::format("modes must be four digits 0 or 1, not '{}'", shown(modes));
}

std::string wrong_texel_word(const MeasuredRow& row, const HardwareProfile&) {
  const auto format = texel_word_called(row.text("format"));
  if (!format || *format == TexelWord::index8) {
    return fmt::format("format must be one with a word a texel, such as A8R8G8B8, not '{}'", shown(row.text("format")));
  }
  if (bits_of(*format) == 32 || row.digits("word") >> bits_of(*format) == 0) return "";
  return fmt::format("word must have at most {} bits, not '{}'", bits_of(*format), shown(row.text("word")));
}

constexpr StatedValue kCube0{
    "rows of cube 0", "rows of cube 0: ", StatedValue::Kind::rows, -1e30, 1e30, "1 0 1; -1 -1 1; 0 0 0", 9},
    kCube1{"rows of cube 1", "rows of cube 1: ", StatedValue::Kind::rows, -1e30, 1e30, "1 0 1; 1 1 -1; 0 0 0", 9};

}  // namespace

std::vector<MeasuredFormat> make_stage_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, any_byte = byte({}), flag = whole({}, 0, 1), pixel = whole({}, 0, 167),
                                    code = whole({}, 0, 65535), cube = whole({}, 0, 1);
  return {
      {"pass through",
       columns({{"s,t,r,q", real}, {"pic_r,pic_g,pic_b,pic_a", measured}, {"model_r,model_g,model_b,model_a", note}}),
       run_pass_through,
       wrong_stages,
       {kUnderBlend}},
      {"offset textures",
       columns({{"picture", note},
                {"Bs,Gs", flag},
                {"i,j", pixel},
                {"b_first,g_first,b_last,g_last", any_byte},
                {"b,g", note},
                {"m00,m01,m11,m10", real},
                {"class", measured}}),
       run_offset, wrong_stages},
      {"luminance of offset textures", columns({{"scale,offset", real}, {"L,T", any_byte}, {"out", measured}}),
       run_luminance, wrong_stages},
      {"dot products of cube maps",
       columns({{"mode,mapping,eye", word},
                {"cube", cube},
                {"R,G,B,A", any_byte},
                {"face,tx,ty", note},
                {"pic_r,pic_g,pic_b", measured},
                {"tex", word}}),
       run_dot_cube,
       wrong_dot_cube,
       {kCube0, kCube1}},
      {"dot products of 16 bits",
       columns({{"picture", note},
                {"As,Gs", flag},
                {"i,j", pixel},
                {"hi0,lo0,hi1,lo1,hi2,lo2,hi3,lo3", code},
                {"H,L", note},
                {"class", measured}}),
       run_hilo_dots, wrong_stages},
      {"replaced depths",
       columns({{"x,y", note}, {"R,G,B", any_byte}, {"a0,a1,a2,b0,b1,b2", real}, {"depth", measured}, {"model", note}}),
       run_depth_replace, wrong_stages},
      {"cube maps", columns({{"s,t,r", real}, {"face,tx,ty", note}, {"pic_r,pic_g,pic_b", measured}}), run_cube_map,
       wrong_stages},
      {"culled fragments",
       columns({{"modes", word}, {"s0,t0,r0,q0,s1,t1,r1,q1,s2,t2,r2,q2", real}, {"visible", measured}}), run_cull,
       wrong_cull},
      {"YUV", columns({{"Y,U,V", any_byte}, {"R,G,B", measured}}), run_yuv, wrong_stages},
      {"texel formats",
       columns({{"format", word}, {"word", digits}, {"pic_r,pic_g,pic_b,pic_a", measured}}),
       run_texel_word,
       wrong_texel_word,
       {kUnderBlend}},
  };
}

}  // namespace ninebit::tools
