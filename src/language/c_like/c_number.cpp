#include "src/language/c_like/c_number.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace ninebit::code {
namespace {

constexpr std::array kAllKinds{kBool,   kInt8,  kUint8,  kInt16,   kUint16, kInt32,
                               kUint32, kInt64, kUint64, kFloat32, kFloat64};

bool is_real(Kinds kind) {
  return (kind & kReals) != 0;
}

// Bits that do not fit are cut, as two's complement does.
std::int64_t wrapped(std::int64_t value, Kinds kind) {
  switch (kind) {
    case kBool:
      return value != 0 ? 1 : 0;
    case kInt8:
      return static_cast<std::int8_t>(value);
    case kUint8:
      return static_cast<std::uint8_t>(value);
    case kInt16:
      return static_cast<std::int16_t>(value);
    case kUint16:
      return static_cast<std::uint16_t>(value);
    case kInt32:
      return static_cast<std::int32_t>(value);
    case kUint32:
      return static_cast<std::uint32_t>(value);
    default:
      return value;
  }
}

double real_of(std::int64_t bits, Kinds kind) {
  return kind == kUint64 ? static_cast<double>(static_cast<std::uint64_t>(bits)) : static_cast<double>(bits);
}

// The nearest float of an integer, rounded once.
double float_of(std::int64_t bits, Kinds kind) {
  const float nearest =
      kind == kUint64 ? static_cast<float>(static_cast<std::uint64_t>(bits)) : static_cast<float>(bits);
  return static_cast<double>(nearest);
}

double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

// The number as if it had one of its types.
Number only(const Number& number, Kinds kind) {
  Number out{kind, number.integer, 0};
  if (is_real(kind)) out = {kind, 0, kind == kFloat32 ? as_float(number.real) : number.real};
  return out;
}

// From one type to another.
std::optional<Number> convert_one(const Number& from, Kinds to) {
  if (is_real(to)) {
    if (is_real(from.kinds)) return Number{to, 0, to == kFloat32 ? as_float(from.real) : from.real};
    return Number{to, 0, to == kFloat32 ? float_of(from.integer, from.kinds) : real_of(from.integer, from.kinds)};
  }
  if (!is_real(from.kinds)) return Number{to, wrapped(from.integer, to), 0};
  if (to == kBool) return Number{to, from.real != 0 ? 1 : 0, 0};
  // Outside of the type's range C leaves the result undefined.
  const double cut = std::trunc(from.real);
  constexpr double kLargest = 9223372036854774784.0;
  if (!(cut >= -kLargest && cut <= kLargest)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(cut);
  if (to == kUint64 ? whole < 0 : wrapped(whole, to) != whole) return std::nullopt;
  return Number{to, whole, 0};
}

Kinds promoted(Kinds kind) {
  return kind < kInt32 ? kInt32 : kind;
}

Kinds common(Kinds a, Kinds b) {
  return std::max(promoted(a), promoted(b));
}

// Of <, > and the like; empty: another operator.
template <class T>
std::optional<int> compared(std::string_view op, T a, T b) {
  if (op == "<") return a < b ? 1 : 0;
  if (op == ">") return a > b ? 1 : 0;
  if (op == "<=") return a <= b ? 1 : 0;
  if (op == ">=") return a >= b ? 1 : 0;
  if (op == "==") return a == b ? 1 : 0;
  if (op == "!=") return a != b ? 1 : 0;
  return std::nullopt;
}

template <class T>
std::optional<std::int64_t> of_integers(std::string_view op, T a, T b) {
  using U = std::make_unsigned_t<T>;
  const auto wrap = [](U value) { return static_cast<std::int64_t>(static_cast<T>(value)); };
  const auto bit_pattern = [](T value) { return static_cast<std::int64_t>(value); };
  const U ua = static_cast<U>(a), ub = static_cast<U>(b);
  if (op == "+") return wrap(ua + ub);
  if (op == "-") return wrap(ua - ub);
  if (op == "*") return wrap(ua * ub);
  if (op == "&") return wrap(ua & ub);
  if (op == "|") return wrap(ua | ub);
  if (op == "^") return wrap(ua ^ ub);
  if (const auto truth = compared(op, a, b)) return *truth;
  const bool overflows = std::is_signed_v<T> && a == std::numeric_limits<T>::min() && b == static_cast<T>(-1);
  if (b == 0 || overflows) return std::nullopt;
  if (op == "/") return bit_pattern(static_cast<T>(a / b));
  if (op == "%") return bit_pattern(static_cast<T>(a % b));
  return std::nullopt;
}

bool compares(std::string_view op) {
  return op == "<" || op == ">" || op == "<=" || op == ">=" || op == "==" || op == "!=";
}

template <class T>
std::optional<double> of_reals(std::string_view op, T a, T b) {
  if (op == "+") return static_cast<double>(a + b);
  if (op == "-") return static_cast<double>(a - b);
  if (op == "*") return static_cast<double>(a * b);
  if (op == "/") return static_cast<double>(a / b);
  if (const auto truth = compared(op, a, b)) return *truth;
  return std::nullopt;
}

std::optional<Number> shift(bool left, const Number& value, const Number& by, Kinds kind) {
  const int bits = (kind & (kInt64 | kUint64)) != 0 ? 64 : 32;
  if (by.integer < 0 || by.integer >= bits) return std::nullopt;
  const auto count = static_cast<unsigned>(by.integer);
  const std::int64_t from = wrapped(value.integer, kind);
  if (left) {
    return Number{kind, wrapped(static_cast<std::int64_t>(static_cast<std::uint64_t>(from) << count), kind), 0};
  }
  if (kind == kUint64) return Number{kind, static_cast<std::int64_t>(static_cast<std::uint64_t>(from) >> count), 0};
  return Number{kind, from >> count, 0};
}

// For operands of one type each.
std::optional<Number> apply_one(std::string_view op, const Number& left, const Number& right) {
  if (op == "<<" || op == ">>") {
    if (is_real(left.kinds) || is_real(right.kinds)) return std::nullopt;
    return shift(op == "<<", left, right, promoted(left.kinds));
  }
  const Kinds kind = common(left.kinds, right.kinds);
  const auto a = convert_one(left, kind), b = convert_one(right, kind);
  if (!a || !b) return std::nullopt;
  if (is_real(kind)) {
    const auto real = kind == kFloat32 ? of_reals(op, static_cast<float>(a->real), static_cast<float>(b->real))
                                       : of_reals(op, a->real, b->real);
    if (!real) return std::nullopt;
    return compares(op) ? int_number(*real != 0 ? 1 : 0) : Number{kind, 0, *real};
  }
  std::optional<std::int64_t> integer;
  if (kind == kInt32) {
    integer = of_integers(op, static_cast<std::int32_t>(a->integer), static_cast<std::int32_t>(b->integer));
  } else if (kind == kUint32) {
    integer = of_integers(op, static_cast<std::uint32_t>(a->integer), static_cast<std::uint32_t>(b->integer));
  } else if (kind == kInt64) {
    integer = of_integers(op, a->integer, b->integer);
  } else {
    integer = of_integers(op, static_cast<std::uint64_t>(a->integer), static_cast<std::uint64_t>(b->integer));
  }
  if (!integer) return std::nullopt;
  return Number{compares(op) ? kInt32 : kind, *integer, 0};
}

// Visits a number as each of its types; combines what comes out.
template <class Compute>
std::optional<Number> for_kinds(const Number& number, const Compute& compute) {
  if (is_one_kind(number.kinds)) return compute(only(number, number.kinds));
  std::optional<Number> all;
  for (const Kinds kind : kAllKinds) {
    if ((number.kinds & kind) == 0) continue;
    const std::optional<Number> one = compute(only(number, kind));
    if (!one) return std::nullopt;
    all = all ? either(*all, *one) : one;
    if (!all) return std::nullopt;
  }
  return all;
}

template <class Compute>
Kinds union_of(Kinds kinds, const Compute& compute) {
  Kinds out = 0;
  for (const Kinds kind : kAllKinds) {
    if ((kinds & kind) != 0) out = static_cast<Kinds>(out | compute(kind));
  }
  return out;
}

}  // namespace

double Number::value() const {
  return may_be_real() ? real : real_of(integer, kinds);
}

Number int_number(std::int64_t value, Kinds kinds) {
  return {kinds, value, 0};
}

Number real_number(double value, Kinds kinds) {
  return {kinds, 0, kinds == kFloat32 ? as_float(value) : value};
}

std::optional<Number> either(const Number& a, const Number& b) {
  const bool integers = (a.kinds & ~kReals) != 0 && (b.kinds & ~kReals) != 0;
  if (integers && a.integer != b.integer) return std::nullopt;
  // A value that one type has and the other has not is negative as int and large as unsigned.
  const bool signs = ((a.kinds | b.kinds) & kUint64) != 0 && a.kinds != b.kinds;
  if (integers && signs && a.integer < 0) return std::nullopt;
  if (a.may_be_real() && b.may_be_real()) {
    const bool same = a.real == b.real || (std::isnan(a.real) && std::isnan(b.real));
    const bool rounded = (a.kinds & kFloat64) == 0   ? a.real == as_float(b.real)
                         : (b.kinds & kFloat64) == 0 ? b.real == as_float(a.real)
                                                     : same;
    if (!same && !rounded) return std::nullopt;
  }
  Number out{static_cast<Kinds>(a.kinds | b.kinds), (a.kinds & ~kReals) != 0 ? a.integer : b.integer, 0};
  const bool of_a = (a.kinds & kFloat64) != 0 || !b.may_be_real();
  out.real = a.may_be_real() && of_a ? a.real : b.real;
  if ((out.kinds & ~kReals) != 0 && out.may_be_real() && static_cast<double>(out.integer) != out.real) {
    return std::nullopt;
  }
  return out;
}

std::optional<Number> convert(const Number& number, Kinds to) {
  if (number.kinds == to) return number;
  return for_kinds(number, [&](const Number& one) -> std::optional<Number> {
    std::optional<Number> all;
    for (const Kinds kind : kAllKinds) {
      if ((to & kind) == 0) continue;
      const auto as = convert_one(one, kind);
      if (!as) return std::nullopt;
      all = all ? either(*all, *as) : as;
      if (!all) return std::nullopt;
    }
    return all;
  });
}

std::optional<Number> loosen(const Number& number) {
  if (number.may_be_real() && (number.kinds & ~kReals) == 0) {
    return Number{kReals, 0, number.real};
  }
  constexpr std::int64_t kExact = std::int64_t{1} << 24;
  if (number.integer < -kExact || number.integer > kExact) return Number{kInt64, number.integer, 0};
  return Number{kAnyNumber, number.integer, static_cast<double>(number.integer)};
}

Kinds promoted_kinds(Kinds a) {
  return union_of(a, promoted);
}

Kinds common_kinds(Kinds a, Kinds b) {
  return union_of(a, [&](Kinds one) { return union_of(b, [&](Kinds other) { return common(one, other); }); });
}

std::optional<Number> calculate(std::string_view op, Number operand) {
  if (op == "~" && (operand.kinds & ~kReals) != 0) operand.kinds = static_cast<Kinds>(operand.kinds & ~kReals);
  if (op == "!") return int_number(operand.is_true() ? 0 : 1);
  return for_kinds(operand, [&](const Number& one) -> std::optional<Number> {
    const Kinds kind = promoted(one.kinds);
    if (op == "+") return Number{kind, one.integer, one.real};
    if (is_real(kind)) return op == "-" ? std::optional(Number{kind, 0, -one.real}) : std::nullopt;
    if (op == "-") {
      return Number{kind, wrapped(static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(one.integer)), kind), 0};
    }
    if (op == "~") return Number{kind, wrapped(~one.integer, kind), 0};
    return std::nullopt;
  });
}

std::optional<Number> calculate(std::string_view op, Number left, Number right) {
  // Operands of these operators have integer types alone.
  const bool is_of_integers = op == "&" || op == "|" || op == "^" || op == "%" || op == "<<" || op == ">>";
  for (Number* const one : {&left, &right}) {
    if (is_of_integers && (one->kinds & ~kReals) != 0) one->kinds = static_cast<Kinds>(one->kinds & ~kReals);
  }
  return for_kinds(
      left, [&](const Number& a) { return for_kinds(right, [&](const Number& b) { return apply_one(op, a, b); }); });
}

int size_of(Kinds kinds) {
  switch (kinds) {
    case kBool:
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kInt32:
    case kUint32:
    case kFloat32:
    case kEnumeration:
      return 4;
    case kInt64:
    case kUint64:
    case kFloat64:
      return 8;
    default:
      return 0;
  }
}

std::optional<Number> read_number(std::string_view text) {
  std::string_view digits = text;
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  const bool is_real = hex ? digits.find_first_of("pP.") != std::string_view::npos
                           : digits.find_first_of(".eE") != std::string_view::npos ||
                                 digits.find_first_of("fFdD") != std::string_view::npos;
  if (is_real) {
    if (hex) return std::nullopt;  // not every library reads them
    double value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const std::string_view suffix(read.ptr, static_cast<std::size_t>(digits.data() + digits.size() - read.ptr));
    if (read.ec != std::errc{}) return std::nullopt;
    if (suffix.empty() || suffix == "d" || suffix == "D") return real_number(value);
    if (suffix != "f" && suffix != "F") return std::nullopt;
    // Rounded once, from the digits.
    float single = 0;
    const auto again = std::from_chars(digits.data(), digits.data() + digits.size(), single);
    if (again.ec != std::errc{}) return std::nullopt;
    return real_number(static_cast<double>(single), kFloat32);
  }
  const bool binary = digits.starts_with("0b") || digits.starts_with("0B");
  const bool octal = !hex && !binary && digits.size() > 1 && digits[0] == '0';
  if (hex || binary) digits.remove_prefix(2);
  std::uint64_t value = 0;
  const int base = hex ? 16 : binary ? 2 : octal ? 8 : 10;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (read.ec != std::errc{}) return std::nullopt;
  bool is_unsigned = false, is_long = false;
  for (const char* c = read.ptr; c != digits.data() + digits.size(); ++c) {
    if (*c == 'u' || *c == 'U') {
      is_unsigned = true;
    } else if (*c == 'l' || *c == 'L') {
      is_long = true;
    } else {
      return std::nullopt;
    }
  }
  const bool may_be_unsigned = is_unsigned || base != 10;
  constexpr std::uint64_t kMost32 = 0x7FFFFFFF, kMost64 = 0x7FFFFFFFFFFFFFFF;
  const auto bits = static_cast<std::int64_t>(value);
  if (!is_long && !is_unsigned && value <= kMost32) return int_number(bits);
  if (!is_long && may_be_unsigned && value <= 0xFFFFFFFF) return int_number(bits, kUint32);
  if (!is_unsigned && value <= kMost64) return int_number(bits, kInt64);
  return may_be_unsigned ? std::optional(int_number(bits, kUint64)) : std::nullopt;
}

std::optional<Number> read_character(std::string_view text) {
  if (text.size() < 3 || text.front() != '\'' || text.back() != '\'') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  if (text.size() == 1 && text[0] != '\\') return int_number(static_cast<signed char>(text[0]));
  if (text[0] != '\\' || text.size() < 2) return std::nullopt;
  constexpr std::string_view kNames = "abtnvfr\\'\"?", kMeant = "\a\b\t\n\v\f\r\\'\"?";
  if (const std::size_t at = kNames.find(text[1]); text.size() == 2 && at != std::string_view::npos) {
    return int_number(kMeant[at]);
  }
  const bool hex = text[1] == 'x';
  const std::string_view digits = text.substr(hex ? 2 : 1);
  int value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, hex ? 16 : 8);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || value > 255) return std::nullopt;
  return int_number(static_cast<signed char>(value));
}

}  // namespace ninebit::code
