// The words of effects, in JSON and on the command line.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/effect/effect.h"

namespace ninebit::effect_detail {

// A text in quotes for a message, as quoted_briefly() writes it: of at most 80 of its bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

// A table of words and their values.
template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

// The value of a word; empty if the table does not have it.
template <class T, std::size_t N>
[[nodiscard]] std::optional<T> value_of(const Words<T, N>& words, std::string_view word) {
  for (const auto& [name, value] : words) {
    if (name == word) return value;
  }
  return std::nullopt;
}

// The word of a value that the table has.
template <class T, std::size_t N>
[[nodiscard]] std::string_view word_of(const Words<T, N>& words, T value) {
  for (const auto& [name, own] : words) {
    if (own == value) return name;
  }
  return {};
}

// "repeat, clamp, clamp-to-edge or mirrored-repeat".
template <class T, std::size_t N>
[[nodiscard]] std::string list_of(const Words<T, N>& words) {
  std::string list;
  for (std::size_t i = 0; i < N; ++i) {
    list += (i == 0 ? "" : i + 1 == N ? " or " : ", ") + std::string(words[i].first);
  }
  return list;
}

inline constexpr Words<VertexSource, 20> kVertexSources{{{"uv", VertexSource::uv},
                                                         {"screen", VertexSource::screen},
                                                         {"projected", VertexSource::projected},
                                                         {"position", VertexSource::position},
                                                         {"from-light", VertexSource::from_light},
                                                         {"light-vector", VertexSource::light_vector},
                                                         {"view-vector", VertexSource::view_vector},
                                                         {"half-vector", VertexSource::half_vector},
                                                         {"normal", VertexSource::normal},
                                                         {"reflection", VertexSource::reflection},
                                                         {"tangent-light-vector", VertexSource::tangent_light_vector},
                                                         {"tangent-half-vector", VertexSource::tangent_half_vector},
                                                         {"tangent-to-world-x", VertexSource::tangent_to_world_x},
                                                         {"tangent-to-world-y", VertexSource::tangent_to_world_y},
                                                         {"tangent-to-world-z", VertexSource::tangent_to_world_z},
                                                         {"point-sprite", VertexSource::point_sprite},
                                                         {"color", VertexSource::color},
                                                         {"secondary-color", VertexSource::secondary_color},
                                                         {"lambert", VertexSource::lambert},
                                                         {"index", VertexSource::index}}};

// `clamp` is GL_CLAMP, which mixes in the border colour.
inline constexpr Words<Wrap, 5> kWraps{{{"repeat", Wrap::repeat},
                                        {"clamp", Wrap::clamp},
                                        {"clamp-to-edge", Wrap::clamp_to_edge},
                                        {"mirrored-repeat", Wrap::mirrored_repeat},
                                        {"clamp-to-border", Wrap::clamp_to_border}}};

// Whether s and t wrap like a cylinder.
inline constexpr Words<std::array<bool, 2>, 3> kCylinderWraps{
    {{"s", {true, false}}, {"t", {false, true}}, {"st", {true, true}}}};

// The words before the colon of a colour key.
inline constexpr Words<ColorKeyOperation, 3> kColorKeyOperations{
    {{"alpha", ColorKeyOperation::alpha}, {"rgba", ColorKeyOperation::rgba}, {"kill", ColorKeyOperation::kill}}};

// A setting of a sampler: a texture's text in JSON, and a flag of `ninebit draw` with the unit's number.
struct SamplerWord {
  std::string_view key;  // in JSON
  Status (*parse)(std::string_view text, Sampler& sampler);
  std::string_view type;  // of the flag's value
  std::string_view help;  // of the flag
};
inline constexpr std::array<SamplerWord, 4> kSamplerWords{
    {{"filter", &parse_filter, "FILTER", "Filter: nearest, linear, bilinear-mipmap or trilinear"},
     {"wrap", &parse_wrap, "WRAP", "Wrap mode: repeat, clamp, clamp-to-edge, mirrored-repeat or clamp-to-border"},
     {"cylinder_wrap", &parse_cylinder_wrap, "s|t|st", "Coordinates that take the shorter way around the texture"},
     {"color_key", &parse_color_key, "OPERATION:AARRGGBB",
      "Key of nearest texels, as kill:FF00FF00: their alpha or rgba is 0, or the pixel is not drawn"}}};

// The words before the colon of textures that are made from a file, by origin.
inline constexpr Words<TextureOrigin, 8> kFileOrigins{{{"normals", TextureOrigin::normals},
                                                       {"signed-normals", TextureOrigin::signed_normals},
                                                       {"hilo-normals", TextureOrigin::hilo_normals},
                                                       {"hilo-heights", TextureOrigin::hilo_heights},
                                                       {"offsets", TextureOrigin::offsets},
                                                       {"1d", TextureOrigin::one_dimensional},
                                                       {"3d", TextureOrigin::volume},
                                                       {"rectangle", TextureOrigin::rectangle}}};

// Whether a texture's steepness is read.
[[nodiscard]] constexpr bool has_slopes(TextureOrigin origin) {
  return origin == TextureOrigin::normals || origin == TextureOrigin::signed_normals ||
         origin == TextureOrigin::hilo_normals || origin == TextureOrigin::offsets;
}

struct Filters {
  MinFilter min;
  MagFilter mag;
};
inline constexpr Words<Filters, 4> kFilters{{{"nearest", {MinFilter::nearest, MagFilter::nearest}},
                                             {"linear", {MinFilter::linear, MagFilter::linear}},
                                             {"bilinear-mipmap", {MinFilter::linear_mipmap_nearest, MagFilter::linear}},
                                             {"trilinear", {MinFilter::linear_mipmap_linear, MagFilter::linear}}}};

inline constexpr Words<CompareFunction, 8> kCompareFunctions{{{"never", CompareFunction::never},
                                                              {"less", CompareFunction::less},
                                                              {"equal", CompareFunction::equal},
                                                              {"lequal", CompareFunction::lequal},
                                                              {"greater", CompareFunction::greater},
                                                              {"notequal", CompareFunction::notequal},
                                                              {"gequal", CompareFunction::gequal},
                                                              {"always", CompareFunction::always}}};

inline constexpr Words<StencilOperation, 8> kStencilOperations{{{"keep", StencilOperation::keep},
                                                                {"zero", StencilOperation::zero},
                                                                {"replace", StencilOperation::replace},
                                                                {"incr", StencilOperation::incr},
                                                                {"decr", StencilOperation::decr},
                                                                {"invert", StencilOperation::invert},
                                                                {"incr_wrap", StencilOperation::incr_wrap},
                                                                {"decr_wrap", StencilOperation::decr_wrap}}};

inline constexpr Words<BlendFactor, 15> kBlendFactors{
    {{"zero", BlendFactor::zero},
     {"one", BlendFactor::one},
     {"src_color", BlendFactor::src_color},
     {"one_minus_src_color", BlendFactor::one_minus_src_color},
     {"dst_color", BlendFactor::dst_color},
     {"one_minus_dst_color", BlendFactor::one_minus_dst_color},
     {"src_alpha", BlendFactor::src_alpha},
     {"one_minus_src_alpha", BlendFactor::one_minus_src_alpha},
     {"dst_alpha", BlendFactor::dst_alpha},
     {"one_minus_dst_alpha", BlendFactor::one_minus_dst_alpha},
     {"constant_color", BlendFactor::constant_color},
     {"one_minus_constant_color", BlendFactor::one_minus_constant_color},
     {"constant_alpha", BlendFactor::constant_alpha},
     {"one_minus_constant_alpha", BlendFactor::one_minus_constant_alpha},
     {"src_alpha_saturate", BlendFactor::src_alpha_saturate}}};

inline constexpr Words<BlendEquation, 7> kBlendEquations{
    {{"add", BlendEquation::add},
     {"subtract", BlendEquation::subtract},
     {"reverse_subtract", BlendEquation::reverse_subtract},
     {"min", BlendEquation::min},
     {"max", BlendEquation::max},
     {"add_signed", BlendEquation::add_signed},
     {"reverse_subtract_signed", BlendEquation::reverse_subtract_signed}}};

inline constexpr Words<CullFace, 3> kCullFaces{
    {{"none", CullFace::none}, {"back", CullFace::back}, {"front", CullFace::front}}};

inline constexpr Words<PolygonMode, 3> kPolygonModes{
    {{"fill", PolygonMode::fill}, {"line", PolygonMode::line}, {"point", PolygonMode::point}}};

inline constexpr Words<SampleMode, 3> kSampleModes{{{"center_1", SampleMode::center_1},
                                                    {"center_corner_2", SampleMode::center_corner_2},
                                                    {"square_offset_4", SampleMode::square_offset_4}}};

inline constexpr Words<ShadeModel, 2> kShadeModels{{{"smooth", ShadeModel::smooth}, {"flat", ShadeModel::flat}}};

inline constexpr Words<DepthComparison, 9> kDepthComparisons{{{"none", DepthComparison::none},
                                                              {"never", DepthComparison::never},
                                                              {"less", DepthComparison::less},
                                                              {"equal", DepthComparison::equal},
                                                              {"lequal", DepthComparison::lequal},
                                                              {"greater", DepthComparison::greater},
                                                              {"notequal", DepthComparison::notequal},
                                                              {"gequal", DepthComparison::gequal},
                                                              {"always", DepthComparison::always}}};

// After "registers-".
inline constexpr Words<FogFunction, 6> kFogFunctions{{{"linear", FogFunction::linear},
                                                      {"linear-abs", FogFunction::linear_abs},
                                                      {"exp", FogFunction::exp},
                                                      {"exp-abs", FogFunction::exp_abs},
                                                      {"exp2", FogFunction::exp2},
                                                      {"exp2-abs", FogFunction::exp2_abs}}};

inline constexpr auto kDepthStencilFormats = [] {
  Words<DepthStencilFormat, kDepthStencilLayouts.size()> words;
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = {kDepthStencilLayouts[i].name, static_cast<DepthStencilFormat>(i)};
  }
  return words;
}();

inline constexpr auto kColorFormatWords = [] {
  Words<ColorFormat, kColorFormats.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = {kColorFormats[i].name, kColorFormats[i].format};
  return words;
}();

inline constexpr Words<InternalFormat, 6> kTargetFormats{{{"rgba8", InternalFormat::rgba8},
                                                          {"rgb8", InternalFormat::rgb8},
                                                          {"luminance8", InternalFormat::luminance8},
                                                          {"alpha8", InternalFormat::alpha8},
                                                          {"luminance8_alpha8", InternalFormat::luminance8_alpha8},
                                                          {"intensity8", InternalFormat::intensity8}}};

inline constexpr Words<IndexFormat, 4> kIndexFormats{{{"rgb", IndexFormat::rgb},
                                                      {"la", IndexFormat::luminance_alpha},
                                                      {"l", IndexFormat::luminance},
                                                      {"a", IndexFormat::alpha}}};

inline constexpr Words<EffectGeometry, 2> kGeometries{
    {{"mesh", EffectGeometry::mesh}, {"rectangle", EffectGeometry::rectangle}}};

inline constexpr Words<EffectView, 2> kViews{{{"camera", EffectView::camera}, {"light", EffectView::light}}};

inline constexpr Words<LightKind, 3> kLightKinds{
    {{"point", LightKind::point}, {"spot", LightKind::spot}, {"directional", LightKind::directional}}};

inline constexpr Words<UpAxis, 2> kUpAxes{{{"y", UpAxis::y}, {"z", UpAxis::z}}};

// Whether a source gives texture coordinates, or a colour.
[[nodiscard]] constexpr bool is_coordinate_source(VertexSource source) {
  return source < VertexSource::color;
}
[[nodiscard]] constexpr bool is_color_source(VertexSource source) {
  return source == VertexSource::constant ||
         (source > VertexSource::projected && source < VertexSource::tangent_to_world_x) ||
         source >= VertexSource::color;
}

// The words of the sources that `fits`.
[[nodiscard]] std::string source_words(bool (*fits)(VertexSource));

}  // namespace ninebit::effect_detail
