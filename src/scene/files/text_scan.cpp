#include "src/scene/files/text_scan.h"

#include <array>
#include <cmath>
#include <limits>

#include "src/system/characters.h"

namespace ninebit {
namespace {

constexpr std::size_t kMostDecimals = 15;
constexpr std::size_t kMostDigits = 19;  // any number with so many digits fits into 64 bits

constexpr std::array<double, kMostDecimals + 1> kDecimals{0.0,
                                                          0.1,
                                                          0.01,
                                                          0.001,
                                                          0.0001,
                                                          0.00001,
                                                          0.000001,
                                                          0.0000001,
                                                          0.00000001,
                                                          0.000000001,
                                                          0.0000000001,
                                                          0.00000000001,
                                                          0.000000000001,
                                                          0.0000000000001,
                                                          0.00000000000001,
                                                          0.000000000000001};

// Takes digits off the word, and returns the number formed by the first `most` of them.
std::uint64_t take_digits(std::string_view& word, std::size_t most, std::size_t& count) {
  std::uint64_t value = 0;
  count = 0;
  while (!word.empty() && detail::is_digit(word.front())) {
    if (count < most) value = value * 10 + static_cast<std::uint64_t>(word.front() - '0');
    ++count;
    word.remove_prefix(1);
  }
  return value;
}

// Reads a word with from_chars: NaN, infinity and other unusual numbers.
template <class Real>
std::optional<Real> unusual(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Real value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too large or too small, depending on the sign of the exponent.
    const std::size_t exponent = word.find_first_of("eE");
    const bool small = exponent == std::string_view::npos ? word.find('.') < 2 : word.substr(exponent + 1)[0] == '-';
    value = small ? Real(0) : std::numeric_limits<Real>::infinity();
    return word[0] == '-' ? -value : value;
  }
  return value;
}

}  // namespace

template <class Real>
std::optional<Real> real_of(std::string_view word) {
  std::string_view rest = word;
  const bool negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  std::size_t digits = 0;
  std::size_t decimals = 0;
  Real value = static_cast<Real>(take_digits(rest, kMostDigits, digits));
  if (!rest.empty() && rest.front() == '.') {
    rest.remove_prefix(1);
    const auto fraction = static_cast<double>(take_digits(rest, kMostDecimals, decimals));
    if (decimals > 0) value += static_cast<Real>(fraction * kDecimals[std::min(decimals, kMostDecimals)]);
  }
  if (digits + decimals == 0 || digits > kMostDigits) return unusual<Real>(word);
  if (!rest.empty() && (rest.front() == 'e' || rest.front() == 'E')) {
    rest.remove_prefix(1);
    const bool down = !rest.empty() && rest.front() == '-';
    if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
    std::size_t length = 0;
    const Real exponent = static_cast<Real>(take_digits(rest, kMostDigits, length));
    const Real power = std::pow(static_cast<Real>(10.0), down ? -exponent : exponent);
    value *= power;
    if (length == 0 || length > kMostDigits || !std::isnormal(power) || !std::isfinite(value))
      return unusual<Real>(word);
  }
  if (!rest.empty()) return std::nullopt;
  return negative ? -value : value;
}

template std::optional<float> real_of<float>(std::string_view word);
template std::optional<double> real_of<double>(std::string_view word);

std::optional<std::string> read_normal_part(std::string_view word, float& value) {
  const std::optional<float> read = real_of<float>(word);
  if (!read) return fmt::format("'{}' is not a number", word);
  value = *read;
  return std::nullopt;
}

std::optional<std::string> read_coordinate(std::string_view word, float& value) {
  if (auto fault = read_normal_part(word, value)) return fault;
  if (!std::isfinite(value)) return fmt::format("the position '{}' is not finite", word);
  return std::nullopt;
}

}  // namespace ninebit
