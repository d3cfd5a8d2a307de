// Parts of C++20 that the C++ library of Debian's Emscripten (libc++ 13) does not have, for the rooms that are compiled
// with it. It is included before every file of that build, and is empty for a library that has these.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

// For programs with one thread.
template <class T>
class atomic_ref {
 public:
  explicit atomic_ref(T& value) : value_(value) {}
  template <class Order>
  void store(T value, Order) const {
    value_ = value;
  }
  template <class Order>
  T load(Order) const {
    return value_;
  }

 private:
  T& value_;
};

// Compared element by element, as a library with three-way comparison does.
template <class Sequence>
constexpr auto compare_sequences(const Sequence& a, const Sequence& b) {
  using Order = decltype(a[0] <=> b[0]);
  for (size_t i = 0; i < a.size() && i < b.size(); ++i) {
    if (const Order order = a[i] <=> b[i]; order != 0) return order;
  }
  return static_cast<Order>(a.size() <=> b.size());
}
template <class T, size_t N>
constexpr auto operator<=>(const array<T, N>& a, const array<T, N>& b) {
  return compare_sequences(a, b);
}
template <class T, class Allocator>
constexpr auto operator<=>(const vector<T, Allocator>& a, const vector<T, Allocator>& b) {
  return compare_sequences(a, b);
}

namespace gaps {

// The end of a decimal number as from_chars reads it; `first`: there is none.
inline const char* end_of_decimal(const char* first, const char* last) {
  const auto digits = [&](const char* at) {
    while (at != last && *at >= '0' && *at <= '9') ++at;
    return at;
  };
  const char* const begin = first != last && *first == '-' ? first + 1 : first;
  const char* at = digits(begin);
  bool any = at != begin;
  if (at != last && *at == '.') {
    const char* const fraction = digits(at + 1);
    any = any || fraction != at + 1;
    if (any) at = fraction;
  }
  if (!any) return first;
  if (at != last && (*at == 'e' || *at == 'E')) {
    const char* exponent = at + 1;
    if (exponent != last && (*exponent == '+' || *exponent == '-')) ++exponent;
    if (digits(exponent) != exponent) at = digits(exponent);
  }
  return at;
}

template <class Real>
from_chars_result read_real(const char* first, const char* last, Real& value, Real (*convert)(const char*, char**)) {
  const char* const end = end_of_decimal(first, last);
  if (end == first) return {first, errc::invalid_argument};
  const string text(first, end);
  const Real read = convert(text.c_str(), nullptr);
  const bool zero = text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == string::npos;
  if (read - read != 0 || (read == 0 && !zero)) return {end, errc::result_out_of_range};
  value = read;
  return {end, errc{}};
}

// The fewest digits that read back to the same number, in scientific notation.
template <class Real>
string shortest_scientific(Real value, Real (*convert)(const char*, char**)) {
  char text[64];
  for (int digits = 0; digits <= numeric_limits<Real>::max_digits10; ++digits) {
    snprintf(text, sizeof text, "%.*e", digits, static_cast<double>(value));
    if (convert(text, nullptr) == value) break;
  }
  return text;
}

// The same number without an exponent.
inline string fixed_of(const string& scientific) {
  const size_t e = scientific.find('e');
  const int exponent = atoi(scientific.c_str() + e + 1);
  string digits, sign;
  for (const char c : scientific.substr(0, e)) {
    if (c == '-') sign = "-";
    if (c >= '0' && c <= '9') digits += c;
  }
  const int count = static_cast<int>(digits.size());
  if (exponent < 0) return sign + "0." + string(static_cast<size_t>(-exponent - 1), '0') + digits;
  if (exponent + 1 >= count) return sign + digits + string(static_cast<size_t>(exponent + 1 - count), '0');
  return sign + digits.substr(0, static_cast<size_t>(exponent + 1)) + "." +
         digits.substr(static_cast<size_t>(exponent + 1));
}

inline to_chars_result put(char* first, char* last, const string& text) {
  if (static_cast<size_t>(last - first) < text.size()) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc{}};
}

template <class Real>
to_chars_result write_real(char* first, char* last, Real value, Real (*convert)(const char*, char**), bool fixed) {
  const string scientific = shortest_scientific(value, convert);
  const string plain = fixed_of(scientific);
  return put(first, last, fixed || plain.size() <= scientific.size() ? plain : scientific);
}

}  // namespace gaps

inline from_chars_result from_chars(const char* first, const char* last, float& value) {
  return gaps::read_real<float>(first, last, value, strtof);
}
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  return gaps::read_real<double>(first, last, value, strtod);
}
inline to_chars_result to_chars(char* first, char* last, float value) {
  return gaps::write_real<float>(first, last, value, strtof, false);
}
inline to_chars_result to_chars(char* first, char* last, double value) {
  return gaps::write_real<double>(first, last, value, strtod, false);
}
inline to_chars_result to_chars(char* first, char* last, float value, chars_format) {
  return gaps::write_real<float>(first, last, value, strtof, true);
}

}  // namespace std

#endif
