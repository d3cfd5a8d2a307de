#include "src/effect/moving_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "src/system/characters.h"

namespace ninebit::effect_detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostCharacters = 1000;
constexpr int kDeepest = 50;  // parentheses, functions and minus signs inside each other

// sin(2 pi turns), with an error below 1e-11.
double sine_of_turns(double turns) {
  double part = turns - std::floor(turns);  // 0 to 1
  if (part > 0.75) {
    part -= 1.0;
  } else if (part > 0.25) {
    part = 0.5 - part;
  }
  const double x = 2.0 * kPi * part, square = x * x;  // |x| <= pi / 2
  double sum = 0.0;
  for (int power = 17; power >= 3; power -= 2) sum = (sum + 1.0) * -square / (power * (power - 1));
  return x * (1.0 + sum);
}

// A function of a known number of arguments.
struct Function {
  std::string_view name;
  std::size_t arguments;
  double (*of)(double, double);
};

constexpr std::array kFunctions{
    Function{"sin", 1, [](double x, double) { return sine_of_turns(x / (2.0 * kPi)); }},
    Function{"cos", 1, [](double x, double) { return sine_of_turns(x / (2.0 * kPi) + 0.25); }},
    Function{"abs", 1, [](double x, double) { return std::fabs(x); }},
    Function{"floor", 1, [](double x, double) { return std::floor(x); }},
    Function{"fract", 1, [](double x, double) { return x - std::floor(x); }},
    Function{"sqrt", 1, [](double x, double) { return std::sqrt(x); }},
    Function{"min", 2, [](double x, double y) { return x < y ? x : y; }},
    Function{"max", 2, [](double x, double y) { return x > y ? x : y; }},
};

// Whether a number that is out of a double's range is too small, not too large.
bool is_tiny(std::string_view number) {
  long long magnitude = 0;  // how many digits before the point, from the first that is not 0; below 0: zeros behind it
  bool begun = false, behind_point = false;
  std::size_t i = 0;
  for (; i < number.size() && (detail::is_digit(number[i]) || number[i] == '.'); ++i) {
    begun = begun || (number[i] != '0' && number[i] != '.');
    if (number[i] == '.') {
      behind_point = true;
    } else if (begun != behind_point) {
      magnitude += begun ? 1 : -1;
    }
  }
  const std::string_view exponent = number.substr(std::min(i + 1, number.size()));
  if (exponent.empty()) return magnitude < 1;
  int power = 0;
  const char* const first = exponent.data() + (exponent[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(first, exponent.data() + exponent.size(), power);
  return error == std::errc{} ? magnitude + power < 1 : exponent[0] == '-';
}

// Reads by descent; after the first fault nothing more is read.
class Expression {
 public:
  Expression(std::string_view text, const EffectMoment& moment) : length_(text.size()), rest_(text), moment_(moment) {}

  Result<MovingNumber> value() {
    const double found = sum();
    (void)next();
    if (!rest_.empty()) refuse();
    if (!fault_.empty()) return Diagnostic{.message = fault_};
    if (!std::isfinite(found)) return Diagnostic{.message = "is not a finite number at this time"};
    return MovingNumber{found, moves_};
  }

 private:
  // The next character that is not a blank; '\0' at the end and after a fault.
  char next() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_[0]) != std::string_view::npos)
      rest_.remove_prefix(1);
    return rest_.empty() || !fault_.empty() ? '\0' : rest_[0];
  }

  bool takes(char c) {
    if (next() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  double refuse() {
    if (!fault_.empty()) return 0.0;
    const std::string place =
        rest_.empty() ? "ends too early" : "is wrong at character " + std::to_string(length_ - rest_.size() + 1);
    fault_ = place +
             "; expected numbers, time, frame, pi, + - * /, parentheses, and sin, cos, abs, floor, fract, sqrt, "
             "min and max";
    return 0.0;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (takes('+')) {
        value = value + product();
      } else if (takes('-')) {
        value = value - product();
      } else {
        return value;
      }
    }
  }

  double product() {
    double value = factor();
    for (;;) {
      if (takes('*')) {
        value = value * factor();
      } else if (takes('/')) {
        value = value / factor();
      } else {
        return value;
      }
    }
  }

  double factor() {
    if (depth_ > kDeepest) {
      if (fault_.empty()) {
        fault_ =
            "has more than " + std::to_string(kDeepest) + " parentheses, functions and minus signs inside each other";
      }
      return 0.0;
    }
    ++depth_;
    const double value = takes('-') ? -factor() : primary();
    --depth_;
    return value;
  }

  double primary() {
    if (takes('(')) {
      const double value = sum();
      return takes(')') ? value : refuse();
    }
    return detail::is_letter(next()) ? named() : number();
  }

  double number() {
    // from_chars would take "inf", "nan" and a sign.
    const char first = next();
    if (!detail::is_digit(first) && first != '.') return refuse();
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    const std::string_view read = rest_.substr(0, static_cast<std::size_t>(end - rest_.data()));
    if (error == std::errc::result_out_of_range && is_tiny(read)) {
      value = 0.0;
    } else if (error != std::errc{}) {
      return refuse();
    }
    rest_.remove_prefix(read.size());
    return value;
  }

  double named() {
    std::size_t length = 0;
    while (length < rest_.size() && detail::is_letter(rest_[length])) ++length;
    const std::string_view name = rest_.substr(0, length);
    for (const Function& function : kFunctions) {
      if (function.name == name) return called(function);
    }
    const double value = name == "time" ? moment_.time : name == "frame" ? static_cast<double>(moment_.frame) : kPi;
    if (name != "time" && name != "frame" && name != "pi") return refuse();
    moves_ = moves_ || name != "pi";
    rest_.remove_prefix(length);
    return value;
  }

  double called(const Function& function) {
    rest_.remove_prefix(function.name.size());
    std::array<double, 2> given{};
    if (!takes('(')) return refuse();
    for (std::size_t i = 0; i < function.arguments; ++i) {
      if (i > 0 && !takes(',')) return refuse();
      given[i] = sum();
    }
    if (!takes(')')) return refuse();
    return function.of(given[0], given[1]);
  }

  std::size_t length_;
  std::string_view rest_;
  const EffectMoment& moment_;
  std::string fault_{};
  int depth_ = 0;
  bool moves_ = false;
};

}  // namespace

Result<MovingNumber> moving_number(std::string_view text, const EffectMoment& moment) {
  if (text.size() > kMostCharacters) {
    return Diagnostic{.message = "has " + std::to_string(text.size()) + " characters; expected at most " +
                                 std::to_string(kMostCharacters)};
  }
  return Expression(text, moment).value();
}

}  // namespace ninebit::effect_detail
