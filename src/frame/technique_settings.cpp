#include "ninebit/frame/technique_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "src/system/number_list.h"

namespace ninebit {
namespace {

// A bit for each technique.
enum SettingReaders : unsigned {
  kIndexCube = 1,
  kDepthCube = 2,
  kShadowMap = 4,
  kShadowVolume = 8,
  kReflective = 16,
  kLightCookie = 32,
  kCookieIndices = 64  // light-cookie with index shadows
};
constexpr unsigned kIndexReaders = kIndexCube | kCookieIndices;
// The direct light of `reflective` is a shadow map's.
constexpr unsigned kMapReaders = kShadowMap | kReflective;

unsigned readers_of(std::string_view technique, const RenderSettings& settings) {
  constexpr std::array<std::string_view, 6> kNames{"index-cube",    "depth-cube", "shadow-map",
                                                   "shadow-volume", "reflective", "light-cookie"};
  const auto found = std::find(kNames.begin(), kNames.end(), technique);
  if (found == kNames.end()) return 0;
  const unsigned own = 1U << (found - kNames.begin());
  return own == kLightCookie && settings.light_cookie.shadows ? own | kCookieIndices : own;
}

constexpr SettingGroup kPicture{"Picture", kAllTechniques};
constexpr SettingGroup kMap{"Map of the light (index-cube, depth-cube, shadow-map, reflective, light-cookie)",
                            kIndexReaders | kDepthCube | kMapReaders};
constexpr SettingGroup kIndices{"Indices (index-cube, light-cookie)", kIndexReaders};
constexpr SettingGroup kDepthCubes{"Depth cube map (depth-cube)", kDepthCube};
constexpr SettingGroup kShadowMaps{"Shadow map (shadow-map, reflective)", kMapReaders};
constexpr SettingGroup kVolumes{"Shadow volumes (shadow-volume)", kShadowVolume};
constexpr SettingGroup kReflected{"Reflected light (reflective)", kReflective};
constexpr SettingGroup kCookies{"Light cookie (light-cookie)", kLightCookie};

template <class T>
SettingValue numbers_of(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return {static_cast<double>(static_cast<int>(value))};
  } else {
    return {static_cast<double>(value)};
  }
}
SettingValue numbers_of(const std::optional<float>& value) {
  return value ? numbers_of(*value) : SettingValue{};
}
SettingValue numbers_of(const std::optional<OffsetArguments>& value) {
  return value ? SettingValue{value->factor, value->units} : SettingValue{};
}
SettingValue numbers_of(const glm::vec3& value) {
  return {value.x, value.y, value.z};
}

template <class T>
void assign(T& to, const SettingValue& value) {
  if constexpr (std::is_same_v<T, bool>) {
    to = value[0] != 0.0;
  } else if constexpr (std::is_enum_v<T>) {
    to = static_cast<T>(static_cast<int>(value[0]));
  } else {
    to = static_cast<T>(value[0]);
  }
}
void assign(std::optional<float>& to, const SettingValue& value) {
  to.reset();
  if (!value.empty()) to = static_cast<float>(value[0]);
}
void assign(std::optional<OffsetArguments>& to, const SettingValue& value) {
  to.reset();
  if (!value.empty()) to = {static_cast<float>(value[0]), static_cast<float>(value[1])};
}
void assign(glm::vec3& to, const SettingValue& value) {
  to = {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
}

// The member of the settings, or of those of a technique.
template <auto... Path>
SettingValue get(const RenderSettings& settings) {
  return numbers_of((settings.*....*Path));
}
template <auto... Path>
void set(RenderSettings& settings, const SettingValue& value) {
  assign((settings.*....*Path), value);
}

template <auto... Path>
constexpr TechniqueSetting setting(TechniqueSetting described) {
  described.get = get<Path...>;
  described.set = set<Path...>;
  return described;
}

template <class T>
constexpr SettingWord word(std::string_view name, T value) {
  return {name, static_cast<int>(value)};
}
constexpr std::array kCullWords{word("none", CullFace::none), word("back", CullFace::back),
                                word("front", CullFace::front)};
constexpr std::array kColorWords = [] {
  std::array<SettingWord, kColorFormats.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = word(kColorFormats[i].name, kColorFormats[i].format);
  return words;
}();
constexpr auto kFrameWords = [] {
  std::array<SettingWord, kDepthStencilLayouts.size()> words;
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = word(kDepthStencilLayouts[i].name, static_cast<DepthStencilFormat>(i));
  }
  return words;
}();
constexpr std::array kStyleWords{word("plain", false), word("cartoon", true)};
constexpr std::array kFormatWords{word("rgb", IndexFormat::rgb), word("la", IndexFormat::luminance_alpha),
                                  word("l", IndexFormat::luminance), word("a", IndexFormat::alpha)};
constexpr std::array kScopeWords{word("polygon", IndexScope::polygon), word("object", IndexScope::object),
                                 word("section", IndexScope::section)};
constexpr std::array kOrderWords{word("file", IndexOrder::file), word("neighbour", IndexOrder::neighbour)};
constexpr std::array kScaleWords{word("both-x4", IndexScales::both), word("first-x4", IndexScales::first),
                                 word("second-x4", IndexScales::second), word("no-scale", IndexScales::none)};
constexpr std::array kBitsWords{word("8", DepthCubeBits::eight), word("16", DepthCubeBits::sixteen),
                                word("float", DepthCubeBits::real)};
constexpr std::array kEncodingWords{
    word("d24", DepthEncoding::d24),
    word("d16", DepthEncoding::d16),
    word("rgba8-fract", DepthEncoding::rgba8_fract),
    word("rgba8-mod", DepthEncoding::rgba8_mod),
    word("rgba8-256over255", DepthEncoding::rgba8_256over255),
    word("rgba8-modf", DepthEncoding::rgba8_modf),
};
constexpr std::array kStorageWords{word("round", ChannelStorage::round), word("truncate", ChannelStorage::truncate)};
constexpr std::array kMethodWords{word("depth-fail", VolumeMethod::depth_fail),
                                  word("depth-pass", VolumeMethod::depth_pass)};
constexpr std::array kSideWords{word("two", true), word("one", false)};
constexpr std::array kPatternWords{word("poisson", SamplePattern::poisson), word("polar", SamplePattern::polar)};
constexpr std::array kCookieWords{word("index", true), word("none", false)};

constexpr double kMostFloat = std::numeric_limits<float>::max();
static_assert(kMaxSurfaceSize == 16384 && kMaxIndexStep == 16, "the messages below name them");
static_assert(kMinPatchDegrees == 0.0F && kMaxPatchDegrees == 90.0F, "likewise");

using R = RenderSettings;
constexpr std::array kSettings{
    setting<&R::cull_face>({.name = "cull",
                            .group = &kPicture,
                            .kind = SettingKind::word,
                            .words = kCullWords,
                            .help = "Faces to cull, in every pass"}),
    setting<&R::color_format>({.name = "color-format",
                               .group = &kPicture,
                               .kind = SettingKind::word,
                               .words = kColorWords,
                               .help = "Format of the frame's colours"}),
    setting<&R::depth_stencil>({.name = "depth-stencil",
                                .group = &kPicture,
                                .kind = SettingKind::word,
                                .words = kFrameWords,
                                .help = "Depth and stencil bits of the frame"}),
    setting<&R::cartoon>({.name = "style",
                          .group = &kPicture,
                          .kind = SettingKind::word,
                          .words = kStyleWords,
                          .help = "Shading: plain, or flat colours with ink shadows"}),
    setting<&R::map_size>(
        {.name = "map-size",
         .group = &kMap,
         .least = 1,
         .greatest = kMaxSurfaceSize,
         .power_of_two = true,
         .form = "N",
         .noun = "map size",
         .expected = "a power of two from 1 to 16384",
         .help = "Size of the light's map in texels per side, a power of two",
         .axis = {.flag = "map-sizes",
                  .columns = {"map_size"},
                  .expected = "powers of two such as 128,256",
                  .help = "Sizes of the map, in texels per side (default without another list: that of "
                          "--map-size, else 128 to 1024)"}}),
    setting<&R::index, &IndexSettings::format>(
        {.name = "index-format",
         .group = &kIndices,
         .kind = SettingKind::word,
         .words = kFormatWords,
         .help = "Texture format of an index",
         .axis = {.flag = "formats", .columns = {"index_format"}, .help = "Formats of an index"}}),
    setting<&R::index, &IndexSettings::scope>(
        {.name = "index-scope",
         .group = &kIndices,
         .kind = SettingKind::word,
         .words = kScopeWords,
         .help = "Unit that gets its own index",
         .axis = {.flag = "scopes", .columns = {"index_scope"}, .help = "Units that get their own index"}}),
    setting<&R::index, &IndexSettings::step>({.name = "index-step",
                                              .group = &kIndices,
                                              .least = 1,
                                              .greatest = kMaxIndexStep,
                                              .help = "Difference between consecutive indices in a channel",
                                              .axis = {.flag = "steps",
                                                       .columns = {"index_step"},
                                                       .expected = "whole numbers from 1 to 16, such as 1-4",
                                                       .help = "Steps between indices"}}),
    setting<&R::index, &IndexSettings::section_size>({.name = "section-size",
                                                      .group = &kIndices,
                                                      .least = kMinSectionSize,
                                                      .greatest = kMaxSectionSize,
                                                      .form = "N",
                                                      .help = "Maximum number of triangles per section"}),
    setting<&R::index, &IndexSettings::order>(
        {.name = "index-order",
         .group = &kIndices,
         .kind = SettingKind::word,
         .words = kOrderWords,
         .help = "Order of indices: as in the file, or equal for the comparison where surfaces meet",
         .axis = {.flag = "orders", .columns = {"index_order"}, .by_default = false, .help = "Orders of indices"}}),
    setting<&R::index, &IndexSettings::patch_degrees>(
        {.name = "patch-angle",
         .group = &kIndices,
         .kind = SettingKind::real,
         .least = kMinPatchDegrees,
         .greatest = kMaxPatchDegrees,
         .form = "DEGREES",
         .noun = "angle",
         .expected = "degrees from 0 to 90",
         .help = "Maximum angle within a patch of --index-order neighbour"}),
    setting<&R::index, &IndexSettings::scales>({.name = "index-scales",
                                                .group = &kIndices,
                                                .kind = SettingKind::word,
                                                .words = kScaleWords,
                                                .help = "Products that the comparison scales by four",
                                                .axis = {.flag = "scales",
                                                         .columns = {"index_scales"},
                                                         .by_default = false,
                                                         .help = "Products that the comparison scales by four"}}),
    setting<&R::depth_cube, &DepthCubeSettings::bits>({.name = "depth-bits",
                                                       .group = &kDepthCubes,
                                                       .kind = SettingKind::word,
                                                       .words = kBitsWords,
                                                       .help = "Format of the depth cube map",
                                                       .axis = {.flag = "depth-bits",
                                                                .columns = {"depth_bits"},
                                                                .help = "Formats of the depth cube map: 8,16,float"}}),
    setting<&R::depth_cube, &DepthCubeSettings::bias>(
        {.name = "bias",
         .group = &kDepthCubes,
         .kind = SettingKind::real,
         .greatest = 1e12,
         .form = "DISTANCE",
         .noun = "bias",
         .expected = "a distance from 0 to 1e12",
         .help = "Bias of the depth comparison, in world units (default: three texels of the map)",
         .axis = {.flag = "biases",
                  .columns = {"bias"},
                  .expected = "distances from 0 to 1e12, such as 0.01,0.1",
                  .help = "Biases of the depth comparison, in world units"}}),
    setting<&R::shadow_map, &ShadowMapSettings::encoding>(
        {.name = "depth-encoding",
         .group = &kShadowMaps,
         .kind = SettingKind::word,
         .words = kEncodingWords,
         .help = "Encoding of depth in the shadow map",
         .axis = {.flag = "encodings", .columns = {"encoding"}, .help = "Encodings of depth in the shadow map"}}),
    setting<&R::shadow_map, &ShadowMapSettings::polygon_offset>(
        {.name = "polygon-offset",
         .group = &kShadowMaps,
         .kind = SettingKind::real,
         .numbers = 2,
         .least = -kMostFloat,
         .greatest = kMostFloat,
         .form = "FACTOR,UNITS",
         .noun = "polygon offset",
         .expected = "FACTOR,UNITS, two finite numbers",
         .help = "Polygon offset of the shadow map (default: 1.125,16)",
         .axis = {.flag = "polygon-offsets",
                  .columns = {"polygon_offset_factor", "polygon_offset_units"},
                  .expected = "FACTOR,UNITS, such as '0,0;1,16'",
                  .help = "Polygon offsets of the shadow map, such as '0,0;1,16'"}}),
    setting<&R::shadow_map, &ShadowMapSettings::storage>({.name = "depth-storage",
                                                          .group = &kShadowMaps,
                                                          .kind = SettingKind::word,
                                                          .words = kStorageWords,
                                                          .help = "Conversion of rgba8 components to bytes"}),
    setting<&R::shadow_volume, &ShadowVolumeSettings::method>(
        {.name = "volume-method",
         .group = &kVolumes,
         .kind = SettingKind::word,
         .words = kMethodWords,
         .help = "Count shadow volumes where the depth test fails or passes"}),
    setting<&R::shadow_volume, &ShadowVolumeSettings::two_sided>(
        {.name = "stencil-sides",
         .group = &kVolumes,
         .kind = SettingKind::word,
         .words = kSideWords,
         .help = "Sides of the shadow volumes drawn per pass"}),
    setting<&R::reflective, &ReflectiveSettings::samples>({.name = "samples",
                                                           .group = &kReflected,
                                                           .least = 1,
                                                           .greatest = kMaxPixelLights,
                                                           .form = "N",
                                                           .help = "Number of pixel lights that a pixel gathers from"}),
    setting<&R::reflective, &ReflectiveSettings::kernel>({.name = "kernel",
                                                          .group = &kReflected,
                                                          .kind = SettingKind::real,
                                                          .least = 1,
                                                          .greatest = kMaxSurfaceSize,
                                                          .form = "TEXELS",
                                                          .expected = "a number from 1 to 16384",
                                                          .help = "Radius of the sample pattern, in texels"}),
    setting<&R::reflective, &ReflectiveSettings::pattern>({.name = "pattern",
                                                           .group = &kReflected,
                                                           .kind = SettingKind::word,
                                                           .words = kPatternWords,
                                                           .help = "Sample pattern"}),
    setting<&R::reflective, &ReflectiveSettings::gather_scale>({.name = "gather-scale",
                                                                .group = &kReflected,
                                                                .least = 1,
                                                                .greatest = kMaxGatherScale,
                                                                .form = "N",
                                                                .help = "Gather once per block of N x N pixels"}),
    TechniqueSetting{.name = "cookie",
                     .group = &kCookies,
                     .kind = SettingKind::files,
                     .form = "FILE[,FILE...]",
                     .help = "Cube map of the light, required: one DDS file, or six pictures +X,-X,+Y,-Y,+Z,-Z"},
    setting<&R::light_cookie, &LightCookieSettings::rotate_degrees>(
        {.name = "light-rotate",
         .group = &kCookies,
         .kind = SettingKind::real,
         .numbers = 3,
         .least = -1e6,
         .greatest = 1e6,
         .form = "X,Y,Z",
         .noun = "rotation",
         .expected = "X,Y,Z in degrees, each from -1e6 to 1e6",
         .help = "Rotation of the light about x, then y, then z, in degrees (default: 0,0,0)"}),
    setting<&R::light_cookie, &LightCookieSettings::shadows>(
        {.name = "cookie-shadows",
         .group = &kCookies,
         .kind = SettingKind::word,
         .words = kCookieWords,
         .help = "Shadows of the light cookie: by indices, or none"}),
};

template <class T>
std::optional<SettingValue> numbers_in(std::string_view text) {
  const auto numbers = ninebit::numbers<T>(text, ',');
  if (!numbers) return std::nullopt;
  return SettingValue(numbers->begin(), numbers->end());
}

}  // namespace

std::string TechniqueSetting::key() const {
  std::string key(name);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

bool TechniqueSetting::allows(const SettingValue& value) const {
  if (kind == SettingKind::word || kind == SettingKind::files) return true;
  if (value.empty()) return get(RenderSettings{}).empty();  // the technique may choose
  const auto is_whole = [](double n) { return n == std::floor(n); };
  const auto is_power = [](double n) { return (static_cast<int>(n) & (static_cast<int>(n) - 1)) == 0; };
  return value.size() == numbers && std::all_of(value.begin(), value.end(), [&](double n) {
           return n >= least && n <= greatest && (kind == SettingKind::real || is_whole(n)) &&
                  (!power_of_two || is_power(n));  // false for NaN
         });
}

std::optional<SettingValue> TechniqueSetting::value_of(std::string_view text) const {
  if (kind == SettingKind::word) {
    for (const SettingWord& w : words) {
      if (w.word == text) return SettingValue{static_cast<double>(w.value)};
    }
    return std::nullopt;
  }
  auto value = kind == SettingKind::whole ? numbers_in<int>(text) : numbers_in<float>(text);
  if (value && !allows(*value)) value.reset();
  return value;
}

std::string_view TechniqueSetting::word_of(int enumerator) const {
  for (const SettingWord& w : words) {
    if (w.value == enumerator) return w.word;
  }
  return {};
}

std::string TechniqueSetting::text_of(const SettingValue& value) const {
  if (kind == SettingKind::word) return std::string(word_of(static_cast<int>(value[0])));
  std::string text;
  for (const double n : value) text += fmt::format("{}{}", text.empty() ? "" : ",", static_cast<float>(n));
  return text;
}

double shortest_decimal(double value) {
  return std::strtod(fmt::format("{}", static_cast<float>(value)).c_str(), nullptr);
}

std::span<const TechniqueSetting> technique_settings() {
  return kSettings;
}

const TechniqueSetting* find_technique_setting(std::string_view name) {
  for (const TechniqueSetting& setting : kSettings) {
    if (setting.name == name) return &setting;
  }
  return nullptr;
}

bool is_read(const TechniqueSetting& setting, std::string_view technique, const RenderSettings& settings) {
  const unsigned readers = setting.group->readers;
  return readers == kAllTechniques || (readers & readers_of(technique, settings)) != 0;
}

}  // namespace ninebit
