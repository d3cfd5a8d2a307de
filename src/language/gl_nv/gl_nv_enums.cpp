#include <array>
#include <cstddef>

#include "ninebit/language/gl_enums.h"

namespace ninebit::gl {
namespace {

// Each table is in the order of the C++ enumeration that it translates.
constexpr std::array kRegisters{GL_ZERO,
                                GL_CONSTANT_COLOR0_NV,
                                GL_CONSTANT_COLOR1_NV,
                                GL_FOG,
                                GL_PRIMARY_COLOR_NV,
                                GL_SECONDARY_COLOR_NV,
                                GL_SPARE0_NV,
                                GL_SPARE1_NV,
                                GL_TEXTURE0_ARB,
                                GL_TEXTURE1_ARB,
                                GL_TEXTURE2_ARB,
                                GL_TEXTURE3_ARB,
                                GL_E_TIMES_F_NV,
                                GL_SPARE0_PLUS_SECONDARY_COLOR_NV,
                                GL_DISCARD_NV};
constexpr std::array kMappings{GL_UNSIGNED_IDENTITY_NV, GL_UNSIGNED_INVERT_NV,  GL_EXPAND_NORMAL_NV,
                               GL_EXPAND_NEGATE_NV,     GL_HALF_BIAS_NORMAL_NV, GL_HALF_BIAS_NEGATE_NV,
                               GL_SIGNED_IDENTITY_NV,   GL_SIGNED_NEGATE_NV};
constexpr std::array kUsages{GL_RGB, GL_ALPHA, GL_BLUE};
constexpr std::array kScales{GL_NONE, GL_SCALE_BY_TWO_NV, GL_SCALE_BY_FOUR_NV, GL_SCALE_BY_ONE_HALF_NV};
constexpr std::array kBiases{GL_NONE, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV};
constexpr std::array kPortions{GL_RGB, GL_ALPHA};
constexpr std::array kVariables{GL_VARIABLE_A_NV, GL_VARIABLE_B_NV, GL_VARIABLE_C_NV, GL_VARIABLE_D_NV,
                                GL_VARIABLE_E_NV, GL_VARIABLE_F_NV, GL_VARIABLE_G_NV};

static_assert(kRegisters.size() == static_cast<std::size_t>(Register::discard) + 1);
static_assert(kMappings.size() == kInputMappings.size());
static_assert(kVariables.size() == static_cast<std::size_t>(Variable::g) + 1);

template <class Word, std::size_t N>
std::optional<Word> find(const std::array<GLenum, N>& table, GLenum value) {
  for (std::size_t i = 0; i < N; ++i) {
    if (table[i] == value) return static_cast<Word>(i);
  }
  return std::nullopt;
}

template <class Word, std::size_t N>
GLenum at(const std::array<GLenum, N>& table, Word word) {
  return table[static_cast<std::size_t>(word)];
}

}  // namespace

GLenum to_enum(Register reg) {
  return at(kRegisters, reg);
}

GLenum to_enum(InputMapping mapping) {
  return at(kMappings, mapping);
}

GLenum to_enum(ComponentUsage usage) {
  return at(kUsages, usage);
}

GLenum to_enum(Scale scale) {
  return at(kScales, scale);
}

GLenum to_enum(Bias bias) {
  return at(kBiases, bias);
}

GLenum to_enum(PortionName portion) {
  return at(kPortions, portion);
}

GLenum to_enum(Variable variable) {
  return at(kVariables, variable);
}

std::optional<Register> to_register(GLenum value) {
  return find<Register>(kRegisters, value);
}

std::optional<InputMapping> to_input_mapping(GLenum value) {
  return find<InputMapping>(kMappings, value);
}

std::optional<ComponentUsage> to_component_usage(GLenum value) {
  return find<ComponentUsage>(kUsages, value);
}

std::optional<Scale> to_scale(GLenum value) {
  return find<Scale>(kScales, value);
}

std::optional<Bias> to_bias(GLenum value) {
  return find<Bias>(kBiases, value);
}

std::optional<PortionName> to_portion(GLenum value) {
  return find<PortionName>(kPortions, value);
}

std::optional<Variable> to_variable(GLenum value) {
  return find<Variable>(kVariables, value);
}

std::optional<int> to_stage(GLenum value) {
  if (value < GL_COMBINER0_NV || value > GL_COMBINER7_NV) return std::nullopt;
  return static_cast<int>(value - GL_COMBINER0_NV);
}

}  // namespace ninebit::gl
