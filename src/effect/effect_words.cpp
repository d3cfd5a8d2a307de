#include "src/effect/effect_words.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "src/system/quoting.h"

namespace ninebit {

using namespace effect_detail;

namespace {

Diagnostic wrong(std::string message) {
  return {.message = std::move(message)};
}

// The text before and after the first colon; the second is empty without one.
struct Split {
  std::string_view word, rest;
  bool has_rest = false;
};
Split split(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {text, {}, false};
  return {text.substr(0, colon), text.substr(colon + 1), true};
}

// Finite numbers with commas between them; empty if the text is something else.
std::vector<float> numbers_in(std::string_view text) {
  std::vector<float> numbers;
  while (true) {
    const std::size_t end = std::min(text.find(','), text.size());
    float number = 0.0F;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc{} || stop != text.data() + end || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = std::min(text.find(','), text.size());
    parts.emplace_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

// "index" or "index:FORMAT,STEP".
Result<ColorSource> parse_index(const Split& said) {
  ColorSource source{.source = VertexSource::index};
  if (!said.has_rest) return source;
  const std::size_t comma = std::min(said.rest.find(','), said.rest.size());
  const auto format = value_of(kIndexFormats, said.rest.substr(0, comma));
  const auto step = comma < said.rest.size() ? whole_number(said.rest.substr(comma + 1)) : std::optional<int>(2);
  if (!format || !step || *step < 1 || *step > kMaxIndexStep) {
    return wrong(in_quotes(said.rest) + " is not an index format and step; expected FORMAT,STEP with " +
                 list_of(kIndexFormats) + " and a step from 1 to " + std::to_string(kMaxIndexStep));
  }
  source.index_format = *format;
  source.index_step = *step;
  return source;
}

bool repeats(TextureOrigin origin) {
  return origin == TextureOrigin::file || origin == TextureOrigin::checker ||
         (origin >= TextureOrigin::normals && origin < TextureOrigin::rectangle);
}

// HILO normals and heights, and volumes, are read as they are unless an effect asks for mip-maps.
bool has_levels(TextureOrigin origin) {
  return repeats(origin) && origin != TextureOrigin::hilo_normals && origin != TextureOrigin::hilo_heights &&
         origin != TextureOrigin::volume;
}

EffectTexture texture_from(TextureOrigin origin) {
  EffectTexture texture{.origin = origin};
  const bool from_target = origin == TextureOrigin::target_color || origin == TextureOrigin::target_depth;
  const Filters filters = *value_of(kFilters, has_levels(origin) ? "trilinear" : from_target ? "nearest" : "linear");
  Sampler& sampler = texture.sampler;
  sampler.min_filter = filters.min;
  sampler.mag_filter = filters.mag;
  sampler.wrap_s = sampler.wrap_t = sampler.wrap_r = repeats(origin) ? Wrap::repeat : Wrap::clamp_to_edge;
  if (origin == TextureOrigin::signed_normals) sampler.is_signed = {true, true, true, false};
  if (origin == TextureOrigin::hilo_normals) sampler.is_signed = {false, true, false, true};
  return texture;
}

EffectTexture texture_of_target(TextureOrigin origin, std::string_view target) {
  EffectTexture texture = texture_from(origin);
  texture.target = target;
  return texture;
}

Result<EffectTexture> generated(TextureOrigin origin, const Split& said) {
  EffectTexture texture = texture_from(origin);
  const auto size = whole_number(said.rest);
  const bool power_of_two = size && *size > 0 && (*size & (*size - 1)) == 0;
  if (!power_of_two || *size > kMaxSurfaceSize) {
    return wrong(in_quotes(said.rest) + " is not a texture size; expected " + std::string(said.word) +
                 ":N with a power of two from 1 to " + std::to_string(kMaxSurfaceSize));
  }
  texture.size = *size;
  return texture;
}

Result<EffectTexture> files(std::string_view text) {
  EffectTexture texture = texture_from(TextureOrigin::file);
  texture.files = parts_of(text);
  for (const std::string& file : texture.files) {
    if (file.empty()) return wrong(in_quotes(text) + " has an empty file name; expected a texture file");
  }
  if (texture.files.size() == 1) return texture;
  EffectTexture cube = texture_from(TextureOrigin::cube_files);
  cube.files = std::move(texture.files);
  if (cube.files.size() == 6) return cube;
  return wrong(in_quotes(text) + " names " + std::to_string(cube.files.size()) +
               " files; expected one texture, or six faces +X,-X,+Y,-Y,+Z,-Z");
}

}  // namespace

namespace effect_detail {

std::string in_quotes(std::string_view text) {
  return quoted_briefly(text, '\'', 80);
}

std::string source_words(bool (*fits)(VertexSource)) {
  std::string list;
  for (const auto& [name, source] : kVertexSources) {
    if (fits(source)) list += std::string(name) + ", ";
  }
  return list;
}

}  // namespace effect_detail

std::string_view name_of(VertexSource source) {
  for (const auto& [name, value] : kVertexSources) {
    if (value == source) return name;
  }
  return "constant";
}

Result<CoordinateSource> parse_coordinate_source(std::string_view text) {
  const Split said = split(text);
  if (said.word == "constant") {
    const std::vector<float> n = numbers_in(said.rest);
    if (n.size() < 2 || n.size() > 4) {
      return wrong(in_quotes(text) + " is not a texture coordinate; expected constant:S,T[,R[,Q]]");
    }
    CoordinateSource source{.source = VertexSource::constant};
    for (std::size_t i = 0; i < n.size(); ++i) source.constant[static_cast<int>(i)] = n[i];
    return source;
  }
  const auto source = value_of(kVertexSources, said.word);
  if (source && is_coordinate_source(*source) && !said.has_rest) return CoordinateSource{.source = *source};
  return wrong(in_quotes(text) + " is not a source of texture coordinates; expected " +
               source_words(&is_coordinate_source) + "or constant:S,T[,R[,Q]]");
}

Result<ColorSource> parse_color_source(std::string_view text) {
  const Split said = split(text);
  if (said.word == "constant") {
    const std::vector<float> n = numbers_in(said.rest);
    bool in_range = n.size() == 3 || n.size() == 4;
    for (const float x : n) in_range = in_range && x >= 0.0F && x <= 1.0F;
    if (!in_range) {
      return wrong(in_quotes(text) + " is not a colour; expected constant:R,G,B[,A] with numbers from 0 to 1");
    }
    ColorSource source;
    for (std::size_t i = 0; i < n.size(); ++i) source.constant[static_cast<int>(i)] = n[i];
    return source;
  }
  if (said.word == "index") return parse_index(said);
  const auto source = value_of(kVertexSources, said.word);
  if (source && is_color_source(*source) && !said.has_rest) return ColorSource{.source = *source};
  return wrong(in_quotes(text) + " is not a source of colours; expected " + source_words(&is_color_source) +
               "or constant:R,G,B[,A]");
}

Result<EffectFog> parse_fog(std::string_view text) {
  const Split said = split(text);
  const std::vector<float> n = numbers_in(said.rest);
  EffectFog fog;
  if (said.word == "none" && !said.has_rest) return fog;
  if (said.word == "mesh" && !said.has_rest) {
    fog.mode = FogMode::mesh;
    return fog;
  }
  if (said.word == "linear" && n.size() == 2 && n[0] != n[1]) {
    fog.mode = FogMode::linear;
    fog.start = n[0];
    fog.end = n[1];
    return fog;
  }
  if ((said.word == "exp" || said.word == "exp2") && n.size() == 1 && n[0] >= 0.0F) {
    fog.mode = said.word == "exp" ? FogMode::exp : FogMode::exp2;
    fog.density = n[0];
    return fog;
  }
  constexpr std::string_view kRegisters = "registers-";
  if (said.word.starts_with(kRegisters) && n.size() == 2) {
    if (const auto function = value_of(kFogFunctions, said.word.substr(kRegisters.size()))) {
      fog.mode = FogMode::registers;
      fog.function = *function;
      fog.bias = n[0];
      fog.slope = n[1];
      return fog;
    }
  }
  return wrong(in_quotes(text) +
               " is not a fog; expected none, mesh, linear:START,END with two different distances, exp:DENSITY or "
               "exp2:DENSITY with a density that is not negative, or registers-FUNCTION:BIAS,SLOPE with the function " +
               list_of(kFogFunctions));
}

Result<EffectTexture> parse_texture_source(std::string_view text) {
  const Split said = split(text);
  if (said.word == "normalize-cube") return generated(TextureOrigin::normalize_cube, said);
  if (said.word == "checker") return generated(TextureOrigin::checker, said);
  if (text == "gradient") return texture_from(TextureOrigin::gradient);
  if (text == "falloff") return texture_from(TextureOrigin::falloff);
  if (said.has_rest && said.rest.empty()) return wrong(in_quotes(text) + " names nothing after the colon");
  if (said.word == "target" && said.has_rest) return texture_of_target(TextureOrigin::target_color, said.rest);
  if (said.word == "depth" && said.has_rest) return texture_of_target(TextureOrigin::target_depth, said.rest);
  if (const auto origin = value_of(kFileOrigins, said.word); origin && said.has_rest) {
    EffectTexture texture = texture_from(*origin);
    texture.files.emplace_back(said.rest);
    return texture;
  }
  return files(text);
}

Status parse_filter(std::string_view text, Sampler& sampler) {
  const auto filters = value_of(kFilters, text);
  if (!filters) return wrong(in_quotes(text) + " is not a filter; expected " + list_of(kFilters));
  sampler.min_filter = filters->min;
  sampler.mag_filter = filters->mag;
  return {};
}

Status parse_border_color(std::string_view text, Sampler& sampler) {
  const std::vector<float> n = numbers_in(text);
  bool in_range = n.size() == 4;
  for (const float x : n) in_range = in_range && x >= 0.0F && x <= 1.0F;
  if (!in_range) return wrong(in_quotes(text) + " is not a border colour; expected R,G,B,A with numbers from 0 to 1");
  std::copy(n.begin(), n.end(), sampler.border_color.begin());
  return {};
}

Status parse_cylinder_wrap(std::string_view text, Sampler& sampler) {
  const auto directions = value_of(kCylinderWraps, text);
  if (!directions) return wrong(in_quotes(text) + " is not a cylinder wrap; expected " + list_of(kCylinderWraps));
  sampler.cylinder_wrap = *directions;
  return {};
}

Status parse_color_key(std::string_view text, Sampler& sampler) {
  const Split said = split(text);
  const auto operation = value_of(kColorKeyOperations, said.word);
  std::uint32_t key = 0;
  const char* const end = said.rest.data() + said.rest.size();
  const auto [stop, error] = std::from_chars(said.rest.data(), end, key, 16);
  if (!operation || said.rest.size() != 8 || error != std::errc{} || stop != end) {
    return wrong(in_quotes(text) + " is not a colour key; expected " + list_of(kColorKeyOperations) +
                 ", a colon and the word AARRGGBB of eight hexadecimal digits");
  }
  sampler.color_key = {*operation, key};
  return {};
}

Result<StipplePattern> parse_polygon_stipple(std::string_view text) {
  const std::vector<std::string> rows = parts_of(text);
  const std::size_t count = rows.size();
  bool valid = count <= 32 && 32 % count == 0 && 32 % std::max<std::size_t>(rows[0].size(), 1) == 0;
  for (const std::string& row : rows) {
    valid = valid && !row.empty() && row.size() == rows[0].size() && row.find_first_not_of("01") == std::string::npos;
  }
  if (!valid) {
    return wrong(in_quotes(text) +
                 " is not a stipple pattern; expected 1, 2, 4, 8, 16 or 32 rows with commas between them, each of as "
                 "many digits 0 and 1 as the others, 1 to 32, a power of two");
  }
  StipplePattern pattern{};
  for (std::size_t y = 0; y < 32; ++y) {
    const std::string& row = rows[count - 1 - y % count];
    for (std::size_t x = 0; x < 32; ++x) {
      const unsigned bit = row[x % row.size()] == '1' ? 0x80U >> (x % 8) : 0U;
      std::uint8_t& byte = pattern[4 * y + x / 8];
      byte = static_cast<std::uint8_t>(byte | bit);
    }
  }
  return pattern;
}

Status parse_wrap(std::string_view text, Sampler& sampler) {
  const auto wrap = value_of(kWraps, text);
  if (!wrap) return wrong(in_quotes(text) + " is not a wrap mode; expected " + list_of(kWraps));
  sampler.wrap_s = sampler.wrap_t = sampler.wrap_r = *wrap;
  return {};
}

}  // namespace ninebit
