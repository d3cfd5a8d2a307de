#include "src/language/xbox/stage_words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/system/find_row.h"

namespace ninebit::xbox {
namespace {

using words::bits;

// In the order of kOtherWordNames.
constexpr std::array<std::string_view, 4> kStageWordNames{"PSCompareMode", "PSTextureModes", "PSDotMapping",
                                                          "PSInputTexture"};
constexpr std::array<std::uint32_t, 4> kStageWordMasks{0xffff, 0xfffff, 0x777, 0xff0000};
constexpr std::size_t kCompareModes = 0, kTextureModeWord = 1, kDotMappingWord = 2, kInputWord = 3;

// The operation of a mode: that of a 2D texture, where the mode leaves the kind to the texture. Empty: reserved.
std::optional<TextureOperation> operation_of(std::uint32_t mode) {
  for (const TextureOperationInfo& info : texture_operations()) {
    if (info.word == mode && info.target != StageTarget::one_dimensional && info.target != StageTarget::rectangle) {
      return info.operation;
    }
  }
  return std::nullopt;
}

const RegisterWord* find(std::span<const RegisterWord> words, std::string_view name) {
  return find_row(words, &RegisterWord::name, name);
}

// A float among the words; its name is "NAME[stage][i]" or "NAME[i]".
void read_float(std::span<const RegisterWord> words, const std::string& name, float& into) {
  if (const RegisterWord* const word = find(words, name)) into = std::bit_cast<float>(word->value);
}

// The numbers of used stages that are not finite, in one phrase; empty: none.
std::string not_finite(const TextureShaderState& used) {
  for (std::size_t i = 0; i < used.stage.size(); ++i) {
    const TextureStage& stage = used.stage[i];
    const auto is_bad = [](float value) { return !std::isfinite(value); };
    const std::string of = " of texture stage " + std::to_string(i) + " is not a finite number";
    if (std::any_of(stage.matrix.begin(), stage.matrix.end(), is_bad)) return "the bump matrix" + of;
    if (is_bad(stage.scale) || is_bad(stage.bias)) return "the luminance scale or offset" + of;
    if (std::any_of(stage.eye.begin(), stage.eye.end(), is_bad)) return "the eye vector" + of;
  }
  return "";
}

// The numbers that used stages read and that no word has, in one phrase; empty: none.
std::string missing_numbers(std::span<const RegisterWord> words, const TextureShaderState& used) {
  std::string text;
  const auto add = [&](const std::string& what, std::size_t i) {
    text += (text.empty() ? "the " : ", the ") + what + " of texture stage " + std::to_string(i);
  };
  for (std::size_t i = 1; i < used.stage.size(); ++i) {
    const StageInput input = info_of(used.stage[i].operation).input;
    const std::string place = '[' + std::to_string(i) + ']';
    const bool is_scaled = input == StageInput::luminance;
    if ((is_scaled || input == StageInput::offset) && find(words, "BUMP_ENV_MAT" + place + "[0]") == nullptr) {
      add("bump matrix", i);
    }
    if (is_scaled && find(words, "BUMP_ENV_SCALE" + place) == nullptr) add("luminance scale and offset", i);
    const bool has_eye = used.stage[i].operation == TextureOperation::dot_product_const_eye_reflect_cube_map;
    if (has_eye && find(words, "EYE_VECTOR[0]") == nullptr) add("eye vector", i);
  }
  return text;
}

constexpr std::array<std::size_t, 4> kMatrixPlaces{0, 1, 3, 2};  // m00, m01, m11, m10
constexpr int kColorConversionShift = 28;                        // of CONTROL0

void read_registers(std::span<const RegisterWord> words, StageWords& out) {
  for (std::size_t i = 1; i < out.state.stage.size(); ++i) {
    TextureStage& stage = out.state.stage[i];
    const std::string place = '[' + std::to_string(i) + ']';
    for (std::size_t k = 0; k < 4; ++k) {
      read_float(words, "BUMP_ENV_MAT" + place + '[' + std::to_string(k) + ']', stage.matrix[kMatrixPlaces[k]]);
    }
    read_float(words, "BUMP_ENV_SCALE" + place, stage.scale);
    read_float(words, "BUMP_ENV_OFFSET" + place, stage.bias);
    for (std::size_t k = 0; k < 3; ++k) {
      read_float(words, "EYE_VECTOR[" + std::to_string(k) + ']', stage.eye[k]);
    }
  }
  if (const RegisterWord* const control = find(words, "CONTROL0")) {
    const std::uint32_t conversion = bits(control->value, kColorConversionShift, 4);
    out.state.converts_yuv = conversion == 1;
    if (conversion > 1) out.why = "CONTROL0 asks for a colour conversion but that from YUV";
  }
}

}  // namespace

StageWords decode_stage_words(std::span<const RegisterWord> words) {
  StageWords out;
  std::array<std::uint32_t, kStageWordNames.size()> value{};
  for (std::size_t i = 0; i < kStageWordNames.size(); ++i) {
    const RegisterWord* const word = find(words, kStageWordNames[i]);
    if (word == nullptr) continue;
    value[i] = word->value;
    if (i == kTextureModeWord) out.place = word->place;
    if ((word->value & ~kStageWordMasks[i]) != 0) {
      out.why = std::string(kStageWordNames[i]) + " has unknown " + words::bits_text(word->value & ~kStageWordMasks[i]);
    }
  }
  if (value[kTextureModeWord] == 0) return {};
  out.state.enabled = true;
  out.state.rules = StageRules::nv2a;
  out.state.depth_unit = DepthUnit::codes;
  for (int i = 0; i < kTextureStages; ++i) {
    TextureStage& stage = out.state.stage[static_cast<std::size_t>(i)];
    const std::uint32_t mode = bits(value[kTextureModeWord], 5 * i, 5);
    const auto operation = operation_of(mode);
    if (!operation) out.why = "PSTextureModes has the reserved mode " + words::hex_text(mode, 2);
    stage.operation = operation.value_or(TextureOperation::none);
    if (i > 0) stage.mapping = static_cast<DotMapping>(bits(value[kDotMappingWord], 4 * (i - 1), 3));
    if (i > 1) stage.previous = static_cast<int>(bits(value[kInputWord], 4 * (i + 2), 4));
    for (int k = 0; k < 4; ++k) {
      stage.cull[static_cast<std::size_t>(k)] = static_cast<CullMode>(bits(value[kCompareModes], 4 * i + k, 1));
    }
  }
  read_registers(words, out);
  if (!out.why.empty()) return out;
  // Fields that no operation reads are without effect.
  const TextureShaderState used = only_used(out.state);
  out.why = not_finite(used);
  if (!out.why.empty()) return out;
  if (const auto refused = validate(used, profiles::nv2a); !refused.empty()) out.why = refused.front().message;
  if (!validate(out.state, profiles::nv2a).empty()) out.state = used;
  out.missing = missing_numbers(words, used);
  return out;
}

bool is_stage_word(std::string_view name) {
  return std::find(kStageWordNames.begin(), kStageWordNames.end(), name) != kStageWordNames.end();
}

TextureShaderState without_kinds(TextureShaderState state) {
  for (TextureStage& stage : state.stage) {
    stage.operation = operation_of(info_of(stage.operation).word).value_or(stage.operation);
  }
  return state;
}

Result<std::vector<RegisterWord>> encode_stage_words(const TextureShaderState& state) {
  const auto why = [](const std::string& what) {
    return Diagnostic{.message = "the Xbox's words cannot express this: " + what};
  };
  if (const auto refused = validate(state, profiles::nv2a); !refused.empty()) return why(refused.front().message);
  std::array<std::uint32_t, kStageWordNames.size()> value{};
  for (int i = 0; i < kTextureStages; ++i) {
    const TextureStage& stage = state.stage[static_cast<std::size_t>(i)];
    const TextureOperationInfo& info = info_of(stage.operation);
    const std::string place = "texture stage " + std::to_string(i) + ": ";
    if (operation_of(info.word) != stage.operation) {
      return why(place + std::string(info.name) + "; " + std::string(info.xbox) +
                 " reads the kind that the texture has");
    }
    value[kTextureModeWord] |= std::uint32_t{info.word} << (5 * i);
    const auto mapping = static_cast<std::uint32_t>(stage.mapping),
               previous = static_cast<std::uint32_t>(stage.previous);
    if (i > 0) value[kDotMappingWord] |= mapping << (4 * (i - 1));
    if (i > 1) value[kInputWord] |= previous << (4 * (i + 2));
    for (int k = 0; k < 4; ++k) {
      value[kCompareModes] |= static_cast<std::uint32_t>(stage.cull[static_cast<std::size_t>(k)]) << (4 * i + k);
    }
  }
  if (value[kTextureModeWord] == 0) return why("stages that are enabled, though all are none");
  const auto replaces_depth = [](const TextureStage& stage) {
    return stage.operation == TextureOperation::dot_product_depth_replace;
  };
  if (state.depth_unit == DepthUnit::window && std::any_of(state.stage.begin(), state.stage.end(), replaces_depth)) {
    return why("replaced depths from 0 to 1; the NV2A's are codes of the depth buffer");
  }
  std::vector<RegisterWord> words;
  for (std::size_t i = 0; i < kStageWordNames.size(); ++i) {
    if (value[i] != 0) words.push_back({std::string(kStageWordNames[i]), value[i], {}});
  }
  return words;
}

std::vector<RegisterWord> encode_stage_numbers(const TextureShaderState& state) {
  std::vector<RegisterWord> words;
  const auto put = [&](const std::string& name, bool is_read, float value) {
    words.push_back({name, is_read ? std::bit_cast<std::uint32_t>(value) : 0U, {}});
  };
  for (std::size_t i = 1; i < state.stage.size(); ++i) {
    const TextureStage& stage = state.stage[i];
    const std::string place = '[' + std::to_string(i) + ']';
    const bool is_scaled = info_of(stage.operation).input == StageInput::luminance;
    const bool is_moved = is_scaled || info_of(stage.operation).input == StageInput::offset;
    for (std::size_t k = 0; k < 4; ++k) {
      put("BUMP_ENV_MAT" + place + '[' + std::to_string(k) + ']', is_moved, stage.matrix[kMatrixPlaces[k]]);
    }
    put("BUMP_ENV_SCALE" + place, is_scaled, stage.scale);
    put("BUMP_ENV_OFFSET" + place, is_scaled, stage.bias);
  }
  const TextureStage& last = state.stage[3];
  const bool has_eye = last.operation == TextureOperation::dot_product_const_eye_reflect_cube_map;
  for (std::size_t k = 0; k < 3; ++k) put("EYE_VECTOR[" + std::to_string(k) + ']', has_eye, last.eye[k]);
  words.push_back({"CONTROL0", static_cast<std::uint32_t>(state.converts_yuv) << kColorConversionShift, {}});
  return words;
}

std::string not_in_stage_words(const TextureShaderState& state) {
  const TextureStage fresh;
  const TextureShaderState used = only_used(state);
  std::string text;
  for (std::size_t i = 0; i < used.stage.size(); ++i) {
    const TextureStage& stage = used.stage[i];
    const auto add = [&](bool is_set, const std::string& what) {
      if (is_set) text += (text.empty() ? "" : ", ") + ("the " + what + " of texture stage ") + std::to_string(i);
    };
    add(stage.matrix != fresh.matrix, "bump matrix");
    add(stage.scale != fresh.scale || stage.bias != fresh.bias, "luminance scale and offset");
    add(stage.eye != fresh.eye, "eye vector");
  }
  if (used.converts_yuv) text += std::string(text.empty() ? "" : ", ") + "the conversion from YUV";
  return text;
}

}  // namespace ninebit::xbox
