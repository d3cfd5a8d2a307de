#include "src/language/gl_calls/gl_calls_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "ninebit/texture_shader/stage_operation.h"
#include "src/language/source/source_faults.h"
#include "src/system/find_row.h"
#include "src/system/nearest_name.h"

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

constexpr std::array kStageCalls{
    GlSignature{GlCommand::tex_env_i, "TexEnvi", "eei"}, GlSignature{GlCommand::tex_env_f, "TexEnvf", "eef"},
    GlSignature{GlCommand::tex_env_iv, "TexEnviv", "eeI"}, GlSignature{GlCommand::tex_env_fv, "TexEnvfv", "eeF"},
    GlSignature{GlCommand::active_texture, "ActiveTexture", "e"}};

// Names of texture shaders, without GL_; those of operations are in their table.
constexpr std::array kStageNames{
    Name{"TEXTURE_SHADER_NV", gl::GL_TEXTURE_SHADER_NV}, Name{"SHADER_OPERATION_NV", gl::GL_SHADER_OPERATION_NV},
    Name{"CULL_MODES_NV", gl::GL_CULL_MODES_NV}, Name{"OFFSET_TEXTURE_MATRIX_NV", gl::GL_OFFSET_TEXTURE_MATRIX_NV},
    Name{"OFFSET_TEXTURE_2D_MATRIX_NV", gl::GL_OFFSET_TEXTURE_MATRIX_NV},
    Name{"OFFSET_TEXTURE_SCALE_NV", gl::GL_OFFSET_TEXTURE_SCALE_NV},
    Name{"OFFSET_TEXTURE_BIAS_NV", gl::GL_OFFSET_TEXTURE_BIAS_NV},
    Name{"OFFSET_TEXTURE_2D_BIAS_NV", gl::GL_OFFSET_TEXTURE_BIAS_NV},
    Name{"PREVIOUS_TEXTURE_INPUT_NV", gl::GL_PREVIOUS_TEXTURE_INPUT_NV}, Name{"CONST_EYE_NV", gl::GL_CONST_EYE_NV},
    Name{"RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV", gl::GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV},
    Name{"TEXTURE_RECTANGLE", 0x84F5}, Name{"TEXTURE_RECTANGLE_ARB", 0x84F5}, Name{"TEXTURE_RECTANGLE_EXT", 0x84F5},
    Name{"TEXTURE_3D_EXT", 0x806F}, Name{"TEXTURE_CUBE_MAP", 0x8513}, Name{"TEXTURE_CUBE_MAP_EXT", 0x8513},
    Name{"LESS", gl::GL_LESS}, Name{"GEQUAL", gl::GL_GEQUAL},
    // Other targets of glTexEnv, which GL takes.
    Name{"TEXTURE_ENV", 0x2300}, Name{"TEXTURE_FILTER_CONTROL", 0x8500}, Name{"TEXTURE_FILTER_CONTROL_EXT", 0x8500}};

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
  if (const Name* const found = find_row(kNames, &Name::name, name)) return found->value;
  if (const Name* const other = find_row(kOthers, &Name::name, name)) return other->value;
  return texture_of_name(name);
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

namespace {

constexpr std::size_t kLongestName = 64;

std::size_t find_letters(std::string_view text, std::string_view part) {
  const auto found = std::search(text.begin(), text.end(), part.begin(), part.end(),
                                 [](char x, char y) { return lower(x) == lower(y); });
  return found == text.end() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

// Whether a function pointer's name may begin like this: gl, pgl, qgl, _gl, __glew, m_gl_, …
bool is_gl_prefix(std::string_view prefix) {
  if (prefix.ends_with('_')) prefix.remove_suffix(1);
  for (const std::string_view end : {"gl", "glew", "GL", "Gl"}) {
    if (prefix.ends_with(end)) return true;
  }
  return false;
}

// Whether it may end like this, in upper or lower case, with or without an underscore before it.
bool is_pointer_suffix(std::string_view suffix) {
  if (suffix.empty()) return true;
  if (suffix.front() == '_') suffix.remove_prefix(1);
  for (const std::string_view known : {"ext", "proc", "ptr", "func", "fn", "fp", "nv", "arb"}) {
    if (same_but_case(suffix, known)) return true;
  }
  return false;
}

// How the words before a call's own name and after it are judged. Names of combiners are their own proof; Enable and
// Disable need a prefix of GL. Without NV, a combiner's name is one only as GL's own, or bare.
bool is_call(const GlSignature& call, std::string_view prefix, std::string_view suffix, bool has_nv) {
  constexpr std::size_t kLongestPrefix = 20;
  if (prefix.size() > kLongestPrefix || !is_pointer_suffix(suffix)) return false;
  if (call.command == GlCommand::enable || call.command == GlCommand::disable) return is_gl_prefix(prefix);
  if (prefix.empty() || is_gl_prefix(prefix)) return true;
  const bool other = prefix.ends_with("Get") || prefix.ends_with("Final") || prefix.ends_with("get");
  return has_nv && !other;
}

// The letters and digits of an enumerant that tell it from others: without GL, without NV, ARB or EXT at the end,
// without underscores, in upper case.
std::string core_of(std::string_view name) {
  std::string core;
  for (const char c : name) {
    if (c != '_') core += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  if (core.starts_with("GL")) core.erase(0, 2);
  for (const std::string_view end : {"NV", "ARB", "EXT", "SGIS"}) {
    if (core.ends_with(end)) {
      core.erase(core.size() - end.size());
      break;
    }
  }
  return core;
}

// Whether a name without its GL_ is also a word of everyday sources.
bool is_ordinary(std::string_view core) {
  constexpr std::array<std::string_view, 10> kOrdinary{"RGB",  "ALPHA", "BLUE", "FOG",   "ZERO",
                                                       "NONE", "ONE",   "TRUE", "FALSE", "DISCARD"};
  return core.starts_with("TEXTURE") || core.starts_with("SPARE") ||
         std::find(kOrdinary.begin(), kOrdinary.end(), core) != kOrdinary.end();
}

// Whether a name ends as only names of extensions do.
bool has_ending(std::string_view name) {
  return name.ends_with("_NV") || name.ends_with("_ARB") || name.ends_with("_EXT");
}

struct Core {
  std::string core;
  gl::GLenum value;
};

const std::vector<Core>& cores() {
  static const std::vector<Core> all = [] {
    std::vector<Core> made;
    for (const std::string_view name : gl_names()) made.push_back({core_of(name), *value_of_name(name)});
    return made;
  }();
  return all;
}

}  // namespace

const GlSignature* find_gl_call(std::string_view name) {
  // Most names of a source are none of these.
  const bool may_be =
      find_letters(name, "combiner") != std::string_view::npos || find_letters(name, "able") != std::string_view::npos;
  if (name.size() > kLongestName || !may_be) return nullptr;
  for (const GlSignature& call : gl_calls()) {
    const bool is_nv = call.name.ends_with("NV");
    const std::string_view base = is_nv ? call.name.substr(0, call.name.size() - 2) : call.name;
    const std::size_t at = name.find(base);
    if (at == std::string_view::npos) continue;
    std::string_view suffix = name.substr(at + base.size());
    const bool has_nv = is_nv && same_but_case(suffix.substr(0, 2), "nv");
    if (has_nv) suffix.remove_prefix(2);
    if (is_call(call, name.substr(0, at), suffix, has_nv)) return &call;
  }
  return nullptr;
}

const GlSignature* find_stage_call(std::string_view name) {
  if (name.size() > kLongestName) return nullptr;
  for (const GlSignature& call : kStageCalls) {
    const std::size_t at = name.find(call.name);
    if (at == std::string_view::npos || !is_gl_prefix(name.substr(0, at))) continue;
    if (is_pointer_suffix(name.substr(at + call.name.size()))) return &call;
  }
  return nullptr;
}

std::optional<gl::GLenum> stage_value_of_name(std::string_view name) {
  constexpr std::string_view kStart = "GL_";
  if (!name.starts_with(kStart)) return std::nullopt;
  name.remove_prefix(kStart.size());
  if (const Name* const found = find_row(kStageNames, &Name::name, name)) return found->value;
  for (const TextureOperationInfo& info : texture_operations()) {
    if (info.gl == name && info.gl_value != 0) return info.gl_value;
  }
  return std::nullopt;
}

const GlSignature* find_gl_method(std::string_view name) {
  if (same_but_case(name, "enable")) return find_gl_call("glEnable");
  return same_but_case(name, "disable") ? find_gl_call("glDisable") : nullptr;
}

bool is_conversion(std::string_view name) {
  constexpr std::array<std::string_view, 9> kTypes{"byte", "boolean", "bool",  "int", "uint",
                                                   "word", "dword",   "float", "wrap"};
  if (name.ends_with("_cast")) return true;
  if (name.starts_with("GL") && name.size() > 2 && name[2] != '_' && find_gl_call(name) == nullptr) return true;
  return std::any_of(kTypes.begin(), kTypes.end(), [&](std::string_view one) { return same_but_case(name, one); });
}

std::optional<gl::GLenum> value_of_spelling(std::string_view name, bool qualified) {
  if (name.empty() || name.size() > kLongestName) return std::nullopt;
  const std::string core = core_of(name);
  const bool has_gl = name.starts_with("GL") || name.starts_with("gl");
  if (!has_gl && !qualified && !has_ending(name) && is_ordinary(core)) return std::nullopt;
  for (const Core& known : cores()) {
    if (known.core == core) return known.value;
  }
  return std::nullopt;
}

// All names begin with GL_, which would make any two of them look alike: it is not compared.
std::string meant_enumerant(std::string_view name) {
  constexpr std::string_view kStart = "GL_";
  std::vector<std::string_view> names = gl_names();
  for (std::string_view& one : names) one.remove_prefix(kStart.size());
  const auto nearest = nearest_name(name.starts_with(kStart) ? name.substr(kStart.size()) : name, names);
  return nearest ? "; did you mean '" + std::string(kStart) + *nearest + "'?" : "";
}

std::string meant_call(std::string_view name) {
  std::vector<std::string> names;
  for (const GlSignature& call : gl_calls()) names.push_back("gl" + std::string(call.name));
  return did_you_mean(name, names);
}

}  // namespace ninebit::detail
