// Constant expressions: numbers, the headers' names and macros, and C's operators between them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/source/source_faults.h"

// The constants and the macros of the Xbox's headers that definitions are written in.

namespace ninebit::xbox {

// A name for a value.
struct Constant {
  std::string name;
  std::uint32_t value;
};
[[nodiscard]] const Constant* find_constant(std::string_view name);

// A macro with arguments. Each argument goes, shifted, into the value; an argument beyond its largest value is a fault.
struct Macro {
  static constexpr int kUnused = -1;  // the shift of an argument that the macro does not use

  struct Argument {
    int shift;
    std::uint32_t most;   // its largest value
    bool masked = false;  // the macro cuts larger values, as C does
  };
  std::string_view name;
  std::span<const Argument> arguments;
  std::uint32_t always = 0;  // bits that are set whatever the arguments are
};
[[nodiscard]] const Macro* find_macro(std::string_view name);
// Whether a value may stand at this place, and the bits that it sets there.
[[nodiscard]] bool accepts(const Macro::Argument& argument, std::int64_t value);
[[nodiscard]] std::uint32_t bits_of(const Macro::Argument& argument, std::int64_t value);

// The names of constants and macros, for suggestions.
[[nodiscard]] std::vector<std::string> macro_names();

// The names without their common beginning, by their values: of texture modes (PS_TEXTUREMODES_…) and of dot mappings
// (PS_DOTMAPPING_…).
inline constexpr std::array<std::string_view, 19> kTextureModes{"NONE",
                                                                "PROJECT2D",
                                                                "PROJECT3D",
                                                                "CUBEMAP",
                                                                "PASSTHRU",
                                                                "CLIPPLANE",
                                                                "BUMPENVMAP",
                                                                "BUMPENVMAP_LUM",
                                                                "BRDF",
                                                                "DOT_ST",
                                                                "DOT_ZW",
                                                                "DOT_RFLCT_DIFF",
                                                                "DOT_RFLCT_SPEC",
                                                                "DOT_STR_3D",
                                                                "DOT_STR_CUBE",
                                                                "DPNDNT_AR",
                                                                "DPNDNT_GB",
                                                                "DOTPRODUCT",
                                                                "DOT_RFLCT_SPEC_CONST"};
inline constexpr std::array<std::string_view, 8> kDotMappings{
    "ZERO_TO_ONE", "MINUS1_TO_1_D3D",     "MINUS1_TO_1_GL",     "MINUS1_TO_1",
    "HILO_1",      "HILO_HEMISPHERE_D3D", "HILO_HEMISPHERE_GL", "HILO_HEMISPHERE"};

// The registers of combiners (PS_REGISTER_…) by their codes; empty: reserved.
inline constexpr std::array<std::string_view, 16> kRegisterNames{
    "ZERO", "C0", "C1", "FOG", "V0", "V1", "", "", "T0", "T1", "T2", "T3", "R0", "R1", "V1R0_SUM", "EF_PROD"};
// Input mappings (PS_INPUTMAPPING_…) by bits 7..5 of an input.
inline constexpr std::array<std::string_view, 8> kInputMappingNames{
    "UNSIGNED_IDENTITY", "UNSIGNED_INVERT", "EXPAND_NORMAL",   "EXPAND_NEGATE",
    "HALFBIAS_NORMAL",   "HALFBIAS_NEGATE", "SIGNED_IDENTITY", "SIGNED_NEGATE"};
// Output mappings (PS_COMBINEROUTPUT_…) by bits 17..15 of an output; empty: reserved.
inline constexpr std::array<std::string_view, 8> kOutputMappingNames{
    "IDENTITY", "BIAS", "SHIFTLEFT_1", "SHIFTLEFT_1_BIAS", "SHIFTLEFT_2", "", "SHIFTRIGHT_1", ""};

class Expressions {
 public:
  Expressions(code::TokenReader& tokens, detail::SourceFaults& faults) : tokens_(tokens), faults_(faults) {}

  // Reads one expression. Its value, modulo 2^32 if it is negative; empty after a fault that makes it unreadable. Other
  // faults (unknown names, values out of range) are reported and count as 0, so that reading goes on.
  [[nodiscard]] std::optional<std::uint32_t> read();

  // The value of a C number; a fault at the token if it is none.
  [[nodiscard]] std::uint32_t number(const code::Token& token);

 private:
  using Value = std::optional<std::int64_t>;

  Value binary(int lowest, int depth);
  Value unary(int depth);
  Value primary(int depth);
  Value named(const code::Token& name, int depth);
  Value call(const Macro& macro, const code::Token& name, int depth);
  // The values between the parenthesis that was taken and the closing one, each with its number and the token that it
  // begins with. False: there is a fault.
  template <class Take>
  bool arguments(int depth, const std::string& of, const Take& take);
  // Skips "(DWORD)" and the like. Returns the bits of the type; 0: there is none.
  int skip_cast();
  [[nodiscard]] Value apply(const code::Token& mark, std::int64_t left, std::int64_t right);
  Value fail(const std::string& expected);

  code::TokenReader& tokens_;
  detail::SourceFaults& faults_;
};

}  // namespace ninebit::xbox
