// Numbers with C's types: conversions and operators as C defines them, for an x86-64 machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace ninebit::code {

// The arithmetic types, one bit each. long is long long, char is signed.
using Kinds = std::uint16_t;
inline constexpr Kinds kBool = 1, kInt8 = 2, kUint8 = 4, kInt16 = 8, kUint16 = 16, kInt32 = 32, kUint32 = 64,
                       kInt64 = 128, kUint64 = 256, kFloat32 = 512, kFloat64 = 1024;
inline constexpr Kinds kReals = kFloat32 | kFloat64;
// A number in a variable whose type is not known: of an integer or a floating-point type that holds it.
inline constexpr Kinds kAnyNumber = kInt32 | kReals;
// An enumeration without negative values: int in C++, unsigned int in C.
inline constexpr Kinds kEnumeration = kInt32 | kUint32;

[[nodiscard]] constexpr bool is_one_kind(Kinds kinds) {
  return kinds != 0 && (kinds & (kinds - 1)) == 0;
}

// A number whose type is one of `kinds`. What is computed of several must come out the same for all of them; else the
// result is not known.
struct Number {
  Kinds kinds = kInt32;
  std::int64_t integer = 0;  // where an integer type is possible; of kUint64 its bits
  double real = 0;           // where a floating-point type is possible; of kFloat32 rounded to float

  [[nodiscard]] bool may_be_real() const { return (kinds & kReals) != 0; }
  // The value as a double, exact up to 2^53.
  [[nodiscard]] double value() const;
  [[nodiscard]] bool is_true() const { return may_be_real() ? real != 0 : integer != 0; }
};

[[nodiscard]] Number int_number(std::int64_t value, Kinds kinds = kInt32);
[[nodiscard]] Number real_number(double value, Kinds kinds = kFloat64);

// A number as one of the given types; empty: C leaves it undefined, or the types differ.
[[nodiscard]] std::optional<Number> convert(const Number& number, Kinds to);
// The same number as a variable of an unknown type has it.
[[nodiscard]] std::optional<Number> loosen(const Number& number);

// The types of a result: of the usual arithmetic conversions, or after promotion.
[[nodiscard]] Kinds common_kinds(Kinds a, Kinds b);
[[nodiscard]] Kinds promoted_kinds(Kinds a);

// C's operators but && || = and their kin; empty: undefined, or it depends on types that are not known.
[[nodiscard]] std::optional<Number> calculate(std::string_view op, Number operand);
[[nodiscard]] std::optional<Number> calculate(std::string_view op, Number left, Number right);

// Both numbers as one that may have either's types.
[[nodiscard]] std::optional<Number> either(const Number& a, const Number& b);

// The bytes of a type; 0: they depend on it.
[[nodiscard]] int size_of(Kinds kinds);

// A constant as C writes it, with its suffix; Java's 1d, too. Empty: it is not one, or no type holds it.
[[nodiscard]] std::optional<Number> read_number(std::string_view text);
// A character constant with its quotes.
[[nodiscard]] std::optional<Number> read_character(std::string_view text);

}  // namespace ninebit::code
