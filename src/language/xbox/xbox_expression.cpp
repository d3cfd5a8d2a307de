#include "src/language/xbox/xbox_expression.h"

#include <algorithm>
#include <string>

#include "src/language/c_like/c_number.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/system/find_row.h"
#include "src/system/nearest_name.h"

// Values and layouts: Cxbx-Reloaded, XbPixelShader.cpp; xemu, hw/xbox/nv2a/pgraph/psh.h.

namespace ninebit::xbox {
namespace {

// Names whose values count up from 0, shifted.
struct NameList {
  std::string_view beginning;
  std::span<const std::string_view> names;
  int shift = 0;
};
constexpr NameList kNameLists[] = {{"PS_REGISTER_", kRegisterNames},
                                   {"PS_INPUTMAPPING_", kInputMappingNames, 5},
                                   {"PS_COMBINEROUTPUT_", kOutputMappingNames, 3},
                                   {"PS_TEXTUREMODES_", kTextureModes},
                                   {"PS_DOTMAPPING_", kDotMappings}};

struct NamedValue {
  std::string_view name;
  std::uint32_t value;
};
constexpr NamedValue kNamedValues[] = {
    {"PS_REGISTER_DISCARD", 0x00},
    {"PS_REGISTER_ONE", 0x20},
    {"PS_REGISTER_NEGATIVE_ONE", 0x40},
    {"PS_REGISTER_ONE_HALF", 0xa0},
    {"PS_REGISTER_NEGATIVE_ONE_HALF", 0x80},
    {"PS_CHANNEL_RGB", 0x00},
    {"PS_CHANNEL_BLUE", 0x00},
    {"PS_CHANNEL_ALPHA", 0x10},
    {"PS_FINALCOMBINERSETTING_CLAMP_SUM", 0x80},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_V1", 0x40},
    {"PS_FINALCOMBINERSETTING_COMPLEMENT_R0", 0x20},
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
};

const std::vector<Constant>& constants() {
  static const std::vector<Constant> all = [] {
    std::vector<Constant> made;
    for (const auto& [beginning, names, shift] : kNameLists) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto value = static_cast<std::uint32_t>(i) << shift;
        if (!names[i].empty()) made.push_back({std::string(beginning) + std::string(names[i]), value});
      }
    }
    for (const NamedValue& one : kNamedValues) made.push_back({std::string(one.name), one.value});
    return made;
  }();
  return all;
}

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

}  // namespace

const Constant* find_constant(std::string_view name) {
  return find_row(constants(), &Constant::name, name);
}

const Macro* find_macro(std::string_view name) {
  return find_row(kMacros, &Macro::name, name);
}

bool accepts(const Macro::Argument& argument, std::int64_t value) {
  return argument.masked || (value >= 0 && value <= argument.most);
}

std::uint32_t bits_of(const Macro::Argument& argument, std::int64_t value) {
  if (argument.shift == Macro::kUnused) return 0;
  return (static_cast<std::uint32_t>(value) & (argument.masked ? argument.most : 0xffffffffU)) << argument.shift;
}

std::vector<std::string> macro_names() {
  std::vector<std::string> names;
  for (const Macro& macro : kMacros) names.emplace_back(macro.name);
  for (const Constant& constant : constants()) names.push_back(constant.name);
  return names;
}

namespace {

using code::shown;
using code::Token;

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
  const std::size_t offset = tokens_.peek().offset;
  const Value value = binary(1, 0);
  if (!value) return std::nullopt;
  if (*value >= kBeyondWords || *value < -kBeyondWords / 2) {
    faults_.add(offset, "the value does not fit in 32 bits");
    return 0;
  }
  return static_cast<std::uint32_t>(*value);
}

std::uint32_t Expressions::number(const Token& token) {
  const auto value = code::read_number(token.text);
  if (!value || value->may_be_real()) {
    faults_.add(token.offset, shown(token) + " is not a number; expected one such as 0x08040000, 15 or 017");
  } else if (value->integer < 0 || value->integer >= kBeyondWords) {
    faults_.add(token.offset, "the value does not fit in 32 bits");
  } else {
    return static_cast<std::uint32_t>(value->integer);
  }
  return 0;
}

Expressions::Value Expressions::fail(const std::string& expected) {
  faults_.add(tokens_.peek().offset, "expected " + expected + "; found " + shown(tokens_.peek()));
  return std::nullopt;
}

Expressions::Value Expressions::binary(int lowest, int depth) {
  Value left = unary(depth);
  while (left) {
    const Token mark = tokens_.peek();
    const int rank = code::precedence(mark);
    if (rank < lowest) return left;
    tokens_.take();
    const Value right = binary(rank + 1, depth);
    if (!right) return std::nullopt;
    left = apply(mark, *left, *right);
  }
  return left;
}

Expressions::Value Expressions::apply(const Token& mark, std::int64_t left, std::int64_t right) {
  const bool shifts = mark.is("<<") || mark.is(">>");
  if (shifts && (right < 0 || right > 31)) {
    faults_.add(mark.offset, "a shift by " + std::to_string(right) + " bits is out of range; expected 0 to 31");
    return 0;
  }
  // Bits that a shift to the left moves out of the word are gone, as in C.
  const bool cuts = mark.is("<<");
  const auto value = code::calculate(
      mark.text, code::int_number(cuts ? static_cast<std::uint32_t>(left) : left, cuts ? code::kUint32 : code::kInt64),
      code::int_number(right, code::kInt64));
  if (value && value->integer < kBeyondWords && value->integer > -kBeyondWords) return value->integer;
  faults_.add(mark.offset, value ? "the value does not fit in 32 bits" : shown(mark) + " gives no value here");
  return 0;
}

Expressions::Value Expressions::unary(int depth) {
  // Signs in a row are counted rather than nested; those of arithmetic and ~ do not mix.
  bool negative = false, inverted = false, arithmetic = false, bitwise = false;
  while (tokens_.peek().is("-") || tokens_.peek().is("+") || tokens_.peek().is("~")) {
    const bool bits = tokens_.peek().is("~");
    if (bits ? arithmetic : bitwise) return fail("a value after the sign");
    (bits ? bitwise : arithmetic) = true;
    if (bits) inverted = !inverted;
    if (tokens_.take().is("-")) negative = !negative;
  }
  int bits = 32;
  while (const int cast = skip_cast()) bits = std::min(bits, cast);
  const std::size_t offset = tokens_.peek().offset;
  Value value = primary(depth);
  if (value && bits < 32 && (*value < 0 || *value >> bits != 0)) {
    faults_.add(offset, "the value does not fit in " + std::to_string(bits) + " bits");
    value = 0;
  }
  if (value && negative) value = -*value;
  if (value && inverted) value = ~*value & (kBeyondWords - 1);
  return value;
}

int Expressions::skip_cast() {
  code::TokenReader ahead = tokens_;
  if (!ahead.takes("(") || !is_type(ahead.peek())) return 0;
  int bits = 32;
  for (int names = 0; names < 4 && is_type(ahead.peek()); ++names) {
    const Token type = ahead.take();
    if (type.is("BYTE")) bits = 8;
    if (type.is("WORD")) bits = 16;
  }
  if (!ahead.takes(")")) return 0;
  tokens_ = ahead;
  return bits;
}

Expressions::Value Expressions::primary(int depth) {
  if (depth > kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  if (tokens_.peek().kind == Token::Kind::number) return number(tokens_.take());
  if (tokens_.peek().is_name()) return named(tokens_.take(), depth);
  if (!tokens_.takes("(")) return fail("a value");
  const Value value = binary(1, depth + 1);
  return !value || tokens_.takes(")") ? value : fail("')'");
}

template <class Take>
bool Expressions::arguments(int depth, const std::string& of, const Take& take) {
  for (std::size_t count = 0; !tokens_.takes(")"); ++count) {
    const std::size_t offset = tokens_.peek().offset;
    const Value argument = binary(1, depth + 1);
    if (!argument) return false;
    take(count, *argument, offset);
    if (tokens_.peek().is(")")) continue;
    if (!tokens_.takes(",")) return fail("',' or ')' after an argument of " + of).has_value();
    if (tokens_.peek().is(")")) return fail("an argument of " + of).has_value();
  }
  return true;
}

Expressions::Value Expressions::named(const Token& name, int depth) {
  if (const Constant* const constant = find_constant(name.text)) return constant->value;
  if (const Macro* const macro = find_macro(name.text)) return call(*macro, name, depth);
  if (faults_.full()) return std::nullopt;
  faults_.add(name.offset, "unknown name " + shown(name) + did_you_mean(name.text, macro_names()));
  if (!tokens_.takes("(")) return 0;
  // The arguments of an unknown macro have faults of their own.
  const bool is_whole = arguments(depth, std::string(name.text), [](std::size_t, std::int64_t, std::size_t) {});
  return is_whole ? Value(0) : std::nullopt;
}

Expressions::Value Expressions::call(const Macro& macro, const Token& name, int depth) {
  const std::string own(macro.name), expected = std::to_string(macro.arguments.size());
  if (!tokens_.peek().is("(")) return fail("'(' and the " + expected + " arguments of " + own);
  if (depth >= kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  tokens_.take();
  std::uint32_t value = macro.always;
  std::size_t count = 0;
  const bool is_whole = arguments(depth, own, [&](std::size_t which, std::int64_t argument, std::size_t offset) {
    count = which + 1;
    if (which >= macro.arguments.size()) return;
    const Macro::Argument& place = macro.arguments[which];
    if (accepts(place, argument)) {
      value |= bits_of(place, argument);
    } else {
      faults_.add(offset, "argument " + std::to_string(count) + " of " + own + " is " + hex(argument) +
                              "; expected 0 to " + hex(place.most));
    }
  });
  if (!is_whole) return std::nullopt;
  if (count != macro.arguments.size()) {
    faults_.add(name.offset, own + " has " + std::to_string(count) + " arguments; expected " + expected);
  }
  return value;
}

}  // namespace ninebit::xbox
