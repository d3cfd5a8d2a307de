#include "src/language/xbox/xbox_expression.h"

#include <algorithm>
#include <string>

#include "src/language/c_like/c_number.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/system/nearest_name.h"

// Values and layouts: Cxbx-Reloaded, XbPixelShader.cpp; xemu, hw/xbox/nv2a/pgraph/psh.h.

namespace ninebit::xbox {
namespace {

constexpr Constant kConstants[] = {
    {"PS_REGISTER_ZERO", 0x00},
    {"PS_REGISTER_DISCARD", 0x00},
    {"PS_REGISTER_C0", 0x01},
    {"PS_REGISTER_C1", 0x02},
    {"PS_REGISTER_FOG", 0x03},
    {"PS_REGISTER_V0", 0x04},
    {"PS_REGISTER_V1", 0x05},
    {"PS_REGISTER_T0", 0x08},
    {"PS_REGISTER_T1", 0x09},
    {"PS_REGISTER_T2", 0x0a},
    {"PS_REGISTER_T3", 0x0b},
    {"PS_REGISTER_R0", 0x0c},
    {"PS_REGISTER_R1", 0x0d},
    {"PS_REGISTER_V1R0_SUM", 0x0e},
    {"PS_REGISTER_EF_PROD", 0x0f},
    {"PS_REGISTER_ONE", 0x20},
    {"PS_REGISTER_NEGATIVE_ONE", 0x40},
    {"PS_REGISTER_ONE_HALF", 0xa0},
    {"PS_REGISTER_NEGATIVE_ONE_HALF", 0x80},
    {"PS_CHANNEL_RGB", 0x00},
    {"PS_CHANNEL_BLUE", 0x00},
    {"PS_CHANNEL_ALPHA", 0x10},
    {"PS_INPUTMAPPING_UNSIGNED_IDENTITY", 0x00},
    {"PS_INPUTMAPPING_UNSIGNED_INVERT", 0x20},
    {"PS_INPUTMAPPING_EXPAND_NORMAL", 0x40},
    {"PS_INPUTMAPPING_EXPAND_NEGATE", 0x60},
    {"PS_INPUTMAPPING_HALFBIAS_NORMAL", 0x80},
    {"PS_INPUTMAPPING_HALFBIAS_NEGATE", 0xa0},
    {"PS_INPUTMAPPING_SIGNED_IDENTITY", 0xc0},
    {"PS_INPUTMAPPING_SIGNED_NEGATE", 0xe0},
    {"PS_FINALCOMBINERSETTING_CLAMP_SUM", 0x80},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_V1", 0x40},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_R0", 0x20},
    {"PS_COMBINEROUTPUT_IDENTITY", 0x00},
    {"PS_COMBINEROUTPUT_BIAS", 0x08},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_1", 0x10},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_1_BIAS", 0x18},
    {"PS_COMBINEROUTPUT_SHIFTLEFT_2", 0x20},
    {"PS_COMBINEROUTPUT_SHIFTRIGHT_1", 0x30},
    {"PS_COMBINEROUTPUT_AB_BLUE_TO_ALPHA", 0x80},
    {"PS_COMBINEROUTPUT_CD_BLUE_TO_ALPHA", 0x40},
    {"PS_COMBINEROUTPUT_AB_MULTIPLY", 0x00},
    {"PS_COMBINEROUTPUT_AB_DOT_PRODUCT", 0x02},
    {"PS_COMBINEROUTPUT_CD_MULTIPLY", 0x00},
    {"PS_COMBINEROUTPUT_CD_DOT_PRODUCT", 0x01},
    {"PS_COMBINEROUTPUT_AB_CD_SUM", 0x00},
    {"PS_COMBINEROUTPUT_AB_CD_MUX", 0x04},
    {"PS_COMBINERCOUNT_MUX_LSB", 0x0000},
    {"PS_COMBINERCOUNT_MUX_MSB", 0x0001},
    {"PS_COMBINERCOUNT_SAME_C0", 0x0000},
    {"PS_COMBINERCOUNT_UNIQUE_C0", 0x0010},
    {"PS_COMBINERCOUNT_SAME_C1", 0x0000},
    {"PS_COMBINERCOUNT_UNIQUE_C1", 0x0100},
    {"PS_COMPAREMODE_S_LT", 0x00},
    {"PS_COMPAREMODE_S_GE", 0x01},
    {"PS_COMPAREMODE_T_LT", 0x00},
    {"PS_COMPAREMODE_T_GE", 0x02},
    {"PS_COMPAREMODE_R_LT", 0x00},
    {"PS_COMPAREMODE_R_GE", 0x04},
    {"PS_COMPAREMODE_Q_LT", 0x00},
    {"PS_COMPAREMODE_Q_GE", 0x08},
    {"PS_GLOBALFLAGS_NO_TEXMODE_ADJUST", 0x0000},
    {"PS_GLOBALFLAGS_TEXMODE_ADJUST", 0x0001},
    {"PS_TEXTUREMODES_NONE", 0x00},
    {"PS_TEXTUREMODES_PROJECT2D", 0x01},
    {"PS_TEXTUREMODES_PROJECT3D", 0x02},
    {"PS_TEXTUREMODES_CUBEMAP", 0x03},
    {"PS_TEXTUREMODES_PASSTHRU", 0x04},
    {"PS_TEXTUREMODES_CLIPPLANE", 0x05},
    {"PS_TEXTUREMODES_BUMPENVMAP", 0x06},
    {"PS_TEXTUREMODES_BUMPENVMAP_LUM", 0x07},
    {"PS_TEXTUREMODES_BRDF", 0x08},
    {"PS_TEXTUREMODES_DOT_ST", 0x09},
    {"PS_TEXTUREMODES_DOT_ZW", 0x0a},
    {"PS_TEXTUREMODES_DOT_RFLCT_DIFF", 0x0b},
    {"PS_TEXTUREMODES_DOT_RFLCT_SPEC", 0x0c},
    {"PS_TEXTUREMODES_DOT_STR_3D", 0x0d},
    {"PS_TEXTUREMODES_DOT_STR_CUBE", 0x0e},
    {"PS_TEXTUREMODES_DPNDNT_AR", 0x0f},
    {"PS_TEXTUREMODES_DPNDNT_GB", 0x10},
    {"PS_TEXTUREMODES_DOTPRODUCT", 0x11},
    {"PS_TEXTUREMODES_DOT_RFLCT_SPEC_CONST", 0x12},
    {"PS_DOTMAPPING_ZERO_TO_ONE", 0x00},
    {"PS_DOTMAPPING_MINUS1_TO_1_D3D", 0x01},
    {"PS_DOTMAPPING_MINUS1_TO_1_GL", 0x02},
    {"PS_DOTMAPPING_MINUS1_TO_1", 0x03},
    {"PS_DOTMAPPING_HILO_1", 0x04},
    {"PS_DOTMAPPING_HILO_HEMISPHERE_D3D", 0x05},
    {"PS_DOTMAPPING_HILO_HEMISPHERE_GL", 0x06},
    {"PS_DOTMAPPING_HILO_HEMISPHERE", 0x07},
};

using Argument = Macro::Argument;
constexpr Argument kInputs[] = {{24, 0xff}, {16, 0xff}, {8, 0xff}, {0, 0xff}};
constexpr Argument kOutputs[] = {{4, 0xf}, {0, 0xf}, {8, 0xf}, {12, 0xff}};
constexpr Argument kCount[] = {{0, 0xff}, {8, 0x111}};
constexpr Argument kModes[] = {{0, 0x1f}, {5, 0x1f}, {10, 0x1f}, {15, 0x1f}};
constexpr Argument kDots[] = {{Macro::kUnused, 0x7}, {0, 0x7}, {4, 0x7}, {8, 0x7}};
constexpr Argument kCompares[] = {{0, 0xf}, {4, 0xf}, {8, 0xf}, {12, 0xf}};
constexpr Argument kTextures[] = {{Macro::kUnused, 0x3}, {Macro::kUnused, 0x3}, {16, 0x1}, {20, 0x2}};
constexpr Argument kConstantPlaces[] = {{0, 0xf, true},  {4, 0xf, true},  {8, 0xf, true},  {12, 0xf, true},
                                        {16, 0xf, true}, {20, 0xf, true}, {24, 0xf, true}, {28, 0xf, true}};
constexpr Argument kFinalConstants[] = {{0, 0xf, true}, {4, 0xf, true}, {8, 0x1}};
constexpr Argument kArgb[] = {{24, 0xff}, {16, 0xff}, {8, 0xff}, {0, 0xff}};
constexpr Argument kRgba[] = {{16, 0xff}, {8, 0xff}, {0, 0xff}, {24, 0xff}};
constexpr Argument kRgb[] = {{16, 0xff}, {8, 0xff}, {0, 0xff}};

constexpr Macro kMacros[] = {
    {"PS_COMBINERINPUTS", kInputs},
    {"PS_COMBINEROUTPUTS", kOutputs},
    {"PS_COMBINERCOUNT", kCount},
    {"PS_TEXTUREMODES", kModes},
    {"PS_DOTMAPPING", kDots},
    {"PS_COMPAREMODE", kCompares},
    {"PS_INPUTTEXTURE", kTextures},
    {"PS_CONSTANTMAPPING", kConstantPlaces},
    {"PS_FINALCOMBINERCONSTANTS", kFinalConstants},
    // Direct3D's colours, in which constants are often written.
    {"D3DCOLOR_ARGB", kArgb},
    {"D3DCOLOR_RGBA", kRgba},
    {"D3DCOLOR_XRGB", kRgb, 0xff000000},
};

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(std::begin(table)) {
  const auto found =
      std::find_if(std::begin(table), std::end(table), [&](const auto& one) { return one.name == name; });
  return found == std::end(table) ? nullptr : found;
}

}  // namespace

const Constant* find_constant(std::string_view name) {
  return find_in(kConstants, name);
}

const Macro* find_macro(std::string_view name) {
  return find_in(kMacros, name);
}

bool accepts(const Macro::Argument& argument, std::int64_t value) {
  return argument.masked || (value >= 0 && value <= argument.most);
}

std::uint32_t bits_of(const Macro::Argument& argument, std::int64_t value) {
  if (argument.shift == Macro::kUnused) return 0;
  return (static_cast<std::uint32_t>(value) & (argument.masked ? argument.most : 0xffffffffU)) << argument.shift;
}

std::vector<std::string_view> macro_names() {
  std::vector<std::string_view> names;
  for (const Macro& macro : kMacros) names.push_back(macro.name);
  for (const Constant& constant : kConstants) names.push_back(constant.name);
  return names;
}

namespace {

constexpr int kDeepest = 32;  // brackets in brackets
constexpr std::int64_t kBeyondWords = std::int64_t{1} << 32;

bool is_type(const Token& token) {
  constexpr std::string_view kTypes[] = {"DWORD",    "ULONG",  "UINT", "BYTE", "WORD",     "D3DCOLOR", "dword",
                                         "unsigned", "signed", "long", "int",  "uint32_t", "int32_t"};
  return token.is_name() && std::find(std::begin(kTypes), std::end(kTypes), token.text) != std::end(kTypes);
}

std::string hex(std::int64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  return words::hex_text(word, word > 0xffff ? 8 : word > 0xff ? 4 : 2);
}

}  // namespace

std::optional<std::uint32_t> Expressions::read() {
  const TextPlace place = lexer_.peek().place;
  const Value value = binary(1, 0);
  if (!value) return std::nullopt;
  if (*value >= kBeyondWords || *value < -kBeyondWords / 2) {
    faults_.add(place, "the value does not fit in 32 bits");
    return 0;
  }
  return static_cast<std::uint32_t>(*value);
}

std::uint32_t Expressions::number(const Token& token) {
  const auto value = code::read_number(token.text);
  if (!value || value->may_be_real()) {
    faults_.add(token.place, shown(token) + " is not a number; expected one such as 0x08040000, 15 or 017");
  } else if (value->integer < 0 || value->integer >= kBeyondWords) {
    faults_.add(token.place, "the value does not fit in 32 bits");
  } else {
    return static_cast<std::uint32_t>(value->integer);
  }
  return 0;
}

Expressions::Value Expressions::fail(const std::string& expected) {
  faults_.add(lexer_.peek().place, "expected " + expected + "; found " + shown(lexer_.peek()));
  return std::nullopt;
}

Expressions::Value Expressions::binary(int lowest, int depth) {
  Value left = unary(depth);
  while (left) {
    const Token mark = lexer_.peek();
    const int rank = code::precedence(mark);
    if (rank < lowest) return left;
    (void)lexer_.take();
    const Value right = binary(rank + 1, depth);
    if (!right) return std::nullopt;
    left = apply(mark, *left, *right);
  }
  return left;
}

Expressions::Value Expressions::apply(const Token& mark, std::int64_t left, std::int64_t right) {
  const bool shifts = mark.is("<<") || mark.is(">>");
  if (shifts && (right < 0 || right > 31)) {
    faults_.add(mark.place, "a shift by " + std::to_string(right) + " bits is out of range; expected 0 to 31");
    return 0;
  }
  // Bits that a shift to the left moves out of the word are gone, as in C.
  const bool cuts = mark.is("<<");
  const auto value = code::calculate(
      mark.text, code::int_number(cuts ? static_cast<std::uint32_t>(left) : left, cuts ? code::kUint32 : code::kInt64),
      code::int_number(right, code::kInt64));
  if (value && value->integer < kBeyondWords && value->integer > -kBeyondWords) return value->integer;
  faults_.add(mark.place, value ? "the value does not fit in 32 bits" : shown(mark) + " gives no value here");
  return 0;
}

Expressions::Value Expressions::unary(int depth) {
  // Signs in a row are counted rather than nested; those of arithmetic and ~ do not mix.
  bool negative = false, inverted = false, arithmetic = false, bitwise = false;
  while (lexer_.peek().is("-") || lexer_.peek().is("+") || lexer_.peek().is("~")) {
    const bool bits = lexer_.peek().is("~");
    if (bits ? arithmetic : bitwise) return fail("a value after the sign");
    (bits ? bitwise : arithmetic) = true;
    if (lexer_.peek().is("-")) negative = !negative;
    if (bits) inverted = !inverted;
    (void)lexer_.take();
  }
  while (skip_cast()) {
  }
  Value value = primary(depth);
  if (value && negative) value = -*value;
  if (value && inverted) value = ~*value & (kBeyondWords - 1);
  return value;
}

bool Expressions::skip_cast() {
  if (!lexer_.peek().is("(")) return false;
  Lexer ahead = lexer_;
  (void)ahead.take();
  if (!is_type(ahead.peek())) return false;
  for (int names = 0; names < 4 && is_type(ahead.peek()); ++names) (void)ahead.take();
  if (!ahead.peek().is(")")) return false;
  (void)ahead.take();
  lexer_ = ahead;
  return true;
}

Expressions::Value Expressions::primary(int depth) {
  if (depth > kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  const Token token = lexer_.peek();
  if (token.kind == Token::Kind::number) return number(lexer_.take());
  if (token.is_name()) return named(lexer_.take(), depth);
  if (!token.is("(")) return fail("a value");
  (void)lexer_.take();
  const Value value = binary(1, depth + 1);
  if (!value) return std::nullopt;
  if (!lexer_.peek().is(")")) return fail("')'");
  (void)lexer_.take();
  return value;
}

Expressions::Value Expressions::named(const Token& name, int depth) {
  if (const Constant* const constant = find_constant(name.text)) return constant->value;
  if (const Macro* const macro = find_macro(name.text)) return call(*macro, name, depth);
  if (faults_.full()) return std::nullopt;
  faults_.add(name.place, "unknown name " + shown(name) + did_you_mean(name.text, macro_names()));
  if (!lexer_.peek().is("(")) return 0;
  // The arguments of an unknown macro have faults of their own.
  (void)lexer_.take();
  while (!lexer_.peek().is(")")) {
    if (!binary(1, depth + 1)) return std::nullopt;
    if (lexer_.peek().is(",")) {
      (void)lexer_.take();
    } else if (!lexer_.peek().is(")")) {
      return fail("',' or ')'");
    }
  }
  (void)lexer_.take();
  return 0;
}

Expressions::Value Expressions::call(const Macro& macro, const Token& name, int depth) {
  const std::string expected =
      "the " + std::to_string(macro.arguments.size()) + " arguments of " + std::string(macro.name);
  if (!lexer_.peek().is("(")) return fail("'(' and " + expected);
  if (depth >= kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  (void)lexer_.take();
  std::uint32_t value = macro.always;
  std::size_t count = 0;
  for (; !lexer_.peek().is(")"); ++count) {
    const TextPlace place = lexer_.peek().place;
    const Value argument = binary(1, depth + 1);
    if (!argument) return std::nullopt;
    if (count < macro.arguments.size()) {
      if (accepts(macro.arguments[count], *argument)) {
        value |= bits_of(macro.arguments[count], *argument);
      } else {
        faults_.add(place, "argument " + std::to_string(count + 1) + " of " + std::string(macro.name) + " is " +
                               hex(*argument) + "; expected 0 to " + hex(macro.arguments[count].most));
      }
    }
    if (lexer_.peek().is(")")) continue;
    if (!lexer_.peek().is(",")) return fail("',' or ')' after an argument of " + std::string(macro.name));
    (void)lexer_.take();
    if (lexer_.peek().is(")")) return fail("an argument of " + std::string(macro.name));
  }
  (void)lexer_.take();
  if (count != macro.arguments.size()) {
    faults_.add(name.place, std::string(macro.name) + " has " + std::to_string(count) + " arguments; expected " +
                                std::to_string(macro.arguments.size()));
  }
  return value;
}

}  // namespace ninebit::xbox
