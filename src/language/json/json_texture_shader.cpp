#include "src/language/json/json_texture_shader.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/system/digits.h"
#include "src/system/nearest_name.h"

namespace ninebit::json {
namespace {

// A table of an enumeration's names, in its order.
constexpr std::array<std::string_view, 8> kMappings{"zero_to_one",        "minus1_to_1_d3d", "minus1_to_1_gl",
                                                    "minus1_to_1",        "hilo_1",          "hilo_hemisphere_d3d",
                                                    "hilo_hemisphere_gl", "hilo_hemisphere"};
constexpr std::array<std::string_view, 2> kCullModes{"kills_negative", "kills_not_negative"};
constexpr std::array<std::string_view, 2> kDepthUnits{"window", "codes"};
constexpr std::array<std::string_view, 2> kRules{"open_gl", "nv2a"};

class StagesReader {
 public:
  explicit StagesReader(Reader& read) : read_(read) {}

  PlacedTextureShader read(const Value& value) {
    out_.offset = value.offset;
    out_.stage_at.fill(value.offset);
    out_.state.enabled = true;
    if (!read_.object(value, {"stages", "rules", "depth_unit", "converts_yuv"})) return out_;
    Reader::with(value, "stages", [&](const Value& part) { stages(part); });
    Reader::with(value, "rules", [&](const Value& part) { word(part, kRules, "rule", out_.state.rules); });
    Reader::with(value, "depth_unit",
                 [&](const Value& part) { word(part, kDepthUnits, "unit", out_.state.depth_unit); });
    Reader::with(value, "converts_yuv", [&](const Value& part) { read_.boolean(part, out_.state.converts_yuv); });
    return out_;
  }

 private:
  void stages(const Value& value) {
    if (value.type != Type::array) return read_.wrong_type(value, "an array");
    for (std::size_t i = 0; i < value.children.size(); ++i) {
      const Value& child = value.children[i];
      if (i >= out_.state.stage.size()) return read_.fault(child.offset, "there are at most 4 texture-shader stages");
      out_.stage_at[i] = child.offset;
      stage(child, out_.state.stage[i]);
    }
  }

  void stage(const Value& value, TextureStage& into) {
    if (!read_.object(value, {"operation", "previous", "mapping", "cull", "matrix", "scale", "bias", "eye"})) return;
    Reader::with(value, "operation", [&](const Value& part) { operation(part, into.operation); });
    Reader::with(value, "previous", [&](const Value& part) {
      read_.integer(part, 0, kTextureStages - 1, into.previous, GlError::invalid_enum);
    });
    Reader::with(value, "mapping",
                 [&](const Value& part) { word(part, kMappings, "dot-product mapping", into.mapping); });
    Reader::with(value, "cull", [&](const Value& part) {
      if (!has_elements(part, into.cull.size(), "cull modes: of s, t, r, q")) return;
      for (std::size_t i = 0; i < into.cull.size(); ++i) word(part.children[i], kCullModes, "cull mode", into.cull[i]);
    });
    Reader::with(value, "matrix", [&](const Value& part) { numbers(part, into.matrix, "numbers"); });
    Reader::with(value, "scale", [&](const Value& part) { number(part, into.scale); });
    Reader::with(value, "bias", [&](const Value& part) { number(part, into.bias); });
    Reader::with(value, "eye", [&](const Value& part) { numbers(part, into.eye, "numbers: x, y, z"); });
  }

  void operation(const Value& value, TextureOperation& into) {
    if (value.type != Type::string) return read_.wrong_type(value, "a string");
    if (const auto found = texture_operation_called(value.text)) {
      into = *found;
      return;
    }
    std::vector<std::string_view> names;
    for (const TextureOperationInfo& info : texture_operations()) names.push_back(info.name);
    read_.fault(value.offset, in_quotes(value.text) +
                                  " is not an operation of texture-shader stages; expected none, texture_2d, …" +
                                  did_you_mean(value.text, names));
  }

  template <class Enum>
  void word(const Value& value, std::span<const std::string_view> names, std::string_view what, Enum& into) {
    if (const auto chosen = read_.choice(value, names, what)) into = static_cast<Enum>(*chosen);
  }

  bool has_elements(const Value& value, std::size_t count, std::string_view what) {
    if (value.type == Type::array && value.children.size() == count) return true;
    read_.fault(value.offset, value.key + " must be an array of " + std::to_string(count) + ' ' + std::string(what));
    return false;
  }

  template <std::size_t N>
  void numbers(const Value& value, std::array<float, N>& into, std::string_view what) {
    if (!has_elements(value, N, what)) return;
    for (std::size_t i = 0; i < N; ++i) number(value.children[i], into[i]);
  }

  // Rounded to the nearest float, which may be 0.
  void number(const Value& value, float& into) {
    if (value.type != Type::number) return read_.wrong_type(value, "a number");
    double number = 0;
    const auto [end, error] = std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
    const auto rounded = static_cast<float>(number);
    if (error == std::errc::invalid_argument || !std::isfinite(rounded)) {
      return read_.fault(value.offset, in_quotes(value.text) + " is too large for a number of 32 bits");
    }
    into = rounded;
  }

  Reader& read_;
  PlacedTextureShader out_;
};

std::string list_text(std::span<const float> values) {
  std::string text;
  for (const float value : values) text += (text.empty() ? "" : ", ") + digits_of(value);
  return '[' + text + ']';
}

std::string quoted_name(std::string_view name) {
  return '"' + std::string(name) + '"';
}

template <class Enum>
std::string quoted_name(std::span<const std::string_view> names, Enum value) {
  return quoted_name(names[static_cast<std::size_t>(value)]);
}

std::string stage_text(const TextureStage& stage) {
  static const TextureStage fresh;
  std::string text = "{\"operation\": " + quoted_name(info_of(stage.operation).name);
  const auto add = [&](std::string_view key, bool is_default, const std::string& value) {
    if (!is_default) text += ", \"" + std::string(key) + "\": " + value;
  };
  add("previous", stage.previous == fresh.previous, std::to_string(stage.previous));
  add("mapping", stage.mapping == fresh.mapping, quoted_name(kMappings, stage.mapping));
  std::string cull;
  for (const CullMode mode : stage.cull) cull += (cull.empty() ? "" : ", ") + quoted_name(kCullModes, mode);
  add("cull", stage.cull == fresh.cull, '[' + cull + ']');
  add("matrix", stage.matrix == fresh.matrix, list_text(stage.matrix));
  add("scale", stage.scale == fresh.scale, digits_of(stage.scale));
  add("bias", stage.bias == fresh.bias, digits_of(stage.bias));
  add("eye", stage.eye == fresh.eye, list_text(stage.eye));
  return text + '}';
}

}  // namespace

PlacedTextureShader read_texture_shader(const Value& value, Reader& read) {
  return StagesReader(read).read(value);
}

void check_texture_shader(const PlacedTextureShader& stages, const HardwareProfile& profile, Reader& read) {
  for (const TextureShaderDiagnostic& found : validate(stages.state, profile)) {
    const std::size_t at = found.stage ? stages.stage_at[static_cast<std::size_t>(*found.stage)] : stages.offset;
    read.fault(at, found.message, found.gl_error);
  }
}

std::string texture_shader_text(const TextureShaderState& state, std::string_view indent) {
  static const TextureShaderState fresh;
  const std::string line = ",\n" + std::string(indent) + "  ";
  std::size_t count = state.stage.size();
  while (count > 0 && state.stage[count - 1] == TextureStage{}) --count;
  std::string text = "{\n" + std::string(indent) + "  \"stages\": [";
  for (std::size_t i = 0; i < count; ++i) {
    text += (i == 0 ? "\n" : ",\n") + std::string(indent) + "    " + stage_text(state.stage[i]);
  }
  text += count == 0 ? "]" : '\n' + std::string(indent) + "  ]";
  if (state.rules != fresh.rules) text += line + "\"rules\": " + quoted_name(kRules, state.rules);
  if (state.depth_unit != fresh.depth_unit) {
    text += line + "\"depth_unit\": " + quoted_name(kDepthUnits, state.depth_unit);
  }
  if (state.converts_yuv) text += line + "\"converts_yuv\": true";
  return text + '\n' + std::string(indent) + '}';
}

}  // namespace ninebit::json
