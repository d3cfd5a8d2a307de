#include "src/language/gl_calls/gl_calls_names.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

struct Name {
  std::string_view name;
  gl::GLenum value;
};

#define NINEBIT_GL(name) \
  Name {                 \
#name, gl::name      \
  }
constexpr std::array kNames{NINEBIT_GL(GL_FALSE),
                            NINEBIT_GL(GL_TRUE),
                            NINEBIT_GL(GL_NONE),
                            NINEBIT_GL(GL_ZERO),
                            NINEBIT_GL(GL_ONE),
                            NINEBIT_GL(GL_FOG),
                            NINEBIT_GL(GL_BLUE),
                            NINEBIT_GL(GL_ALPHA),
                            NINEBIT_GL(GL_RGB),
                            NINEBIT_GL(GL_REGISTER_COMBINERS_NV),
                            NINEBIT_GL(GL_VARIABLE_A_NV),
                            NINEBIT_GL(GL_VARIABLE_B_NV),
                            NINEBIT_GL(GL_VARIABLE_C_NV),
                            NINEBIT_GL(GL_VARIABLE_D_NV),
                            NINEBIT_GL(GL_VARIABLE_E_NV),
                            NINEBIT_GL(GL_VARIABLE_F_NV),
                            NINEBIT_GL(GL_VARIABLE_G_NV),
                            NINEBIT_GL(GL_CONSTANT_COLOR0_NV),
                            NINEBIT_GL(GL_CONSTANT_COLOR1_NV),
                            NINEBIT_GL(GL_PRIMARY_COLOR_NV),
                            NINEBIT_GL(GL_SECONDARY_COLOR_NV),
                            NINEBIT_GL(GL_SPARE0_NV),
                            NINEBIT_GL(GL_SPARE1_NV),
                            NINEBIT_GL(GL_DISCARD_NV),
                            NINEBIT_GL(GL_E_TIMES_F_NV),
                            NINEBIT_GL(GL_SPARE0_PLUS_SECONDARY_COLOR_NV),
                            NINEBIT_GL(GL_PER_STAGE_CONSTANTS_NV),
                            NINEBIT_GL(GL_UNSIGNED_IDENTITY_NV),
                            NINEBIT_GL(GL_UNSIGNED_INVERT_NV),
                            NINEBIT_GL(GL_EXPAND_NORMAL_NV),
                            NINEBIT_GL(GL_EXPAND_NEGATE_NV),
                            NINEBIT_GL(GL_HALF_BIAS_NORMAL_NV),
                            NINEBIT_GL(GL_HALF_BIAS_NEGATE_NV),
                            NINEBIT_GL(GL_SIGNED_IDENTITY_NV),
                            NINEBIT_GL(GL_SIGNED_NEGATE_NV),
                            NINEBIT_GL(GL_SCALE_BY_TWO_NV),
                            NINEBIT_GL(GL_SCALE_BY_FOUR_NV),
                            NINEBIT_GL(GL_SCALE_BY_ONE_HALF_NV),
                            NINEBIT_GL(GL_BIAS_BY_NEGATIVE_ONE_HALF_NV),
                            NINEBIT_GL(GL_COMBINER_INPUT_NV),
                            NINEBIT_GL(GL_COMBINER_MAPPING_NV),
                            NINEBIT_GL(GL_COMBINER_COMPONENT_USAGE_NV),
                            NINEBIT_GL(GL_COMBINER_AB_DOT_PRODUCT_NV),
                            NINEBIT_GL(GL_COMBINER_CD_DOT_PRODUCT_NV),
                            NINEBIT_GL(GL_COMBINER_MUX_SUM_NV),
                            NINEBIT_GL(GL_COMBINER_SCALE_NV),
                            NINEBIT_GL(GL_COMBINER_BIAS_NV),
                            NINEBIT_GL(GL_COMBINER_AB_OUTPUT_NV),
                            NINEBIT_GL(GL_COMBINER_CD_OUTPUT_NV),
                            NINEBIT_GL(GL_COMBINER_SUM_OUTPUT_NV),
                            NINEBIT_GL(GL_MAX_GENERAL_COMBINERS_NV),
                            NINEBIT_GL(GL_NUM_GENERAL_COMBINERS_NV),
                            NINEBIT_GL(GL_COLOR_SUM_CLAMP_NV),
                            NINEBIT_GL(GL_COMBINER0_NV),
                            NINEBIT_GL(GL_COMBINER1_NV),
                            NINEBIT_GL(GL_COMBINER2_NV),
                            NINEBIT_GL(GL_COMBINER3_NV),
                            NINEBIT_GL(GL_COMBINER4_NV),
                            NINEBIT_GL(GL_COMBINER5_NV),
                            NINEBIT_GL(GL_COMBINER6_NV),
                            NINEBIT_GL(GL_COMBINER7_NV),
                            Name{"true", gl::GL_TRUE},
                            Name{"false", gl::GL_FALSE},
                            Name{"TRUE", gl::GL_TRUE},
                            Name{"True", gl::GL_TRUE},
                            Name{"False", gl::GL_FALSE},
                            Name{"FALSE", gl::GL_FALSE}};
#undef NINEBIT_GL

// Enumerants of OpenGL that are passed to the calls by mistake: GL takes the number, and refuses it.
constexpr std::array kOthers{Name{"GL_RED", 0x1903},
                             Name{"GL_GREEN", 0x1904},
                             Name{"GL_RGBA", 0x1908},
                             Name{"GL_LUMINANCE", 0x1909},
                             Name{"GL_INTENSITY", 0x8049},
                             Name{"GL_COLOR", 0x1800},
                             Name{"GL_TEXTURE", 0x1702},
                             Name{"GL_PRIMARY_COLOR", 0x8577},
                             Name{"GL_PRIMARY_COLOR_ARB", 0x8577},
                             Name{"GL_PRIMARY_COLOR_EXT", 0x8577},
                             Name{"GL_CONSTANT", 0x8576},
                             Name{"GL_CONSTANT_ARB", 0x8576},
                             Name{"GL_CONSTANT_COLOR", 0x8001},
                             Name{"GL_PREVIOUS", 0x8578},
                             Name{"GL_PREVIOUS_ARB", 0x8578},
                             Name{"GL_MODULATE", 0x2100},
                             Name{"GL_REPLACE", 0x1E01},
                             Name{"GL_ADD", 0x0104},
                             Name{"GL_SRC_COLOR", 0x0300},
                             Name{"GL_SRC_ALPHA", 0x0302}};

constexpr std::array kCalls{GlSignature{GlCommand::combiner_parameter_i, "CombinerParameteriNV", "ei"},
                            GlSignature{GlCommand::combiner_parameter_f, "CombinerParameterfNV", "ef"},
                            GlSignature{GlCommand::combiner_parameter_iv, "CombinerParameterivNV", "eI"},
                            GlSignature{GlCommand::combiner_parameter_fv, "CombinerParameterfvNV", "eF"},
                            GlSignature{GlCommand::combiner_input, "CombinerInputNV", "eeeeee"},
                            GlSignature{GlCommand::combiner_output, "CombinerOutputNV", "eeeeeeebbb"},
                            GlSignature{GlCommand::final_combiner_input, "FinalCombinerInputNV", "eeee"},
                            GlSignature{GlCommand::combiner_stage_parameter_fv, "CombinerStageParameterfvNV", "eeF"},
                            // Java's LWJGL.
                            GlSignature{GlCommand::combiner_parameter_fv, "CombinerParameterNV", "eF"},
                            GlSignature{GlCommand::combiner_stage_parameter_fv, "CombinerStageParameterNV", "eeF"},
                            GlSignature{GlCommand::enable, "Enable", "e"},
                            GlSignature{GlCommand::disable, "Disable", "e"}};

// GL_TEXTUREn and GL_TEXTUREn_ARB, n from 0 to 31 without leading zeros.
std::optional<gl::GLenum> texture_of_name(std::string_view name) {
  constexpr std::string_view kStart = "GL_TEXTURE", kEnd = "_ARB";
  if (!name.starts_with(kStart)) return std::nullopt;
  name.remove_prefix(kStart.size());
  if (name.ends_with(kEnd)) name.remove_suffix(kEnd.size());
  if (name.empty() || name.size() > 2 || (name.size() == 2 && name.front() == '0')) return std::nullopt;
  gl::GLenum unit = 0;
  for (const char c : name) {
    if (!is_digit(c)) return std::nullopt;
    unit = unit * 10 + static_cast<gl::GLenum>(c - '0');
  }
  return unit < 32 ? std::optional(gl::GL_TEXTURE0_ARB + unit) : std::nullopt;
}

constexpr std::array<std::string_view, 15> kRegisterNames{"GL_ZERO",
                                                          "GL_CONSTANT_COLOR0_NV",
                                                          "GL_CONSTANT_COLOR1_NV",
                                                          "GL_FOG",
                                                          "GL_PRIMARY_COLOR_NV",
                                                          "GL_SECONDARY_COLOR_NV",
                                                          "GL_SPARE0_NV",
                                                          "GL_SPARE1_NV",
                                                          "GL_TEXTURE0_ARB",
                                                          "GL_TEXTURE1_ARB",
                                                          "GL_TEXTURE2_ARB",
                                                          "GL_TEXTURE3_ARB",
                                                          "GL_E_TIMES_F_NV",
                                                          "GL_SPARE0_PLUS_SECONDARY_COLOR_NV",
                                                          "GL_DISCARD_NV"};
constexpr std::array<std::string_view, 8> kMappingNames{
    "GL_UNSIGNED_IDENTITY_NV", "GL_UNSIGNED_INVERT_NV",  "GL_EXPAND_NORMAL_NV",   "GL_EXPAND_NEGATE_NV",
    "GL_HALF_BIAS_NORMAL_NV",  "GL_HALF_BIAS_NEGATE_NV", "GL_SIGNED_IDENTITY_NV", "GL_SIGNED_NEGATE_NV"};
constexpr std::array<std::string_view, 3> kUsageNames{"GL_RGB", "GL_ALPHA", "GL_BLUE"};
constexpr std::array<std::string_view, 4> kScaleNames{"GL_NONE", "GL_SCALE_BY_TWO_NV", "GL_SCALE_BY_FOUR_NV",
                                                      "GL_SCALE_BY_ONE_HALF_NV"};
constexpr std::array<std::string_view, 2> kBiasNames{"GL_NONE", "GL_BIAS_BY_NEGATIVE_ONE_HALF_NV"};

template <class Word, std::size_t N>
std::string_view at(const std::array<std::string_view, N>& names, Word word) {
  const auto i = static_cast<std::size_t>(word);
  return i < N ? names[i] : "0xFFFFFFFF";
}

}  // namespace

std::optional<gl::GLenum> value_of_name(std::string_view name) {
  const auto* const found = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.name == name; });
  if (found != kNames.end()) return found->value;
  const auto* const other = std::find_if(kOthers.begin(), kOthers.end(), [&](const Name& n) { return n.name == name; });
  return other != kOthers.end() ? std::optional(other->value) : texture_of_name(name);
}

std::span<const GlSignature> gl_calls() {
  return kCalls;
}

std::vector<std::string_view> gl_names() {
  std::vector<std::string_view> names;
  for (const Name& name : kNames) {
    if (name.name.starts_with("GL_")) names.push_back(name.name);
  }
  names.insert(names.end(), {"GL_TEXTURE0_ARB", "GL_TEXTURE1_ARB", "GL_TEXTURE2_ARB", "GL_TEXTURE3_ARB"});
  return names;
}

std::string_view gl_name(Register reg) {
  return at(kRegisterNames, reg);
}

std::string_view gl_name(InputMapping mapping) {
  return at(kMappingNames, mapping);
}

std::string_view gl_name(ComponentUsage usage) {
  return at(kUsageNames, usage);
}

std::string_view gl_name(Scale scale) {
  return at(kScaleNames, scale);
}

std::string_view gl_name(Bias bias) {
  return at(kBiasNames, bias);
}

}  // namespace ninebit::detail
