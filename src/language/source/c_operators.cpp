#include "src/language/source/c_operators.h"

#include <algorithm>
#include <array>
#include <limits>

namespace ninebit::detail {
namespace {

struct BinaryOperator {
  std::string_view mark;
  int precedence;
};
constexpr std::array kBinaryOperators{BinaryOperator{"||", 1}, BinaryOperator{"&&", 2}, BinaryOperator{"|", 3},
                                      BinaryOperator{"^", 4},  BinaryOperator{"&", 5},  BinaryOperator{"==", 6},
                                      BinaryOperator{"!=", 6}, BinaryOperator{"<", 7},  BinaryOperator{">", 7},
                                      BinaryOperator{"<=", 7}, BinaryOperator{">=", 7}, BinaryOperator{"<<", 8},
                                      BinaryOperator{">>", 8}, BinaryOperator{"+", 9},  BinaryOperator{"-", 9},
                                      BinaryOperator{"*", 10}, BinaryOperator{"/", 10}, BinaryOperator{"%", 10}};

// Two's complement, so that nothing is undefined.
std::int64_t wrapped(std::uint64_t value) {
  return static_cast<std::int64_t>(value);
}

}  // namespace

int c_precedence(std::string_view mark) {
  const auto* const found = std::find_if(kBinaryOperators.begin(), kBinaryOperators.end(),
                                         [&](const BinaryOperator& one) { return one.mark == mark; });
  return found == kBinaryOperators.end() ? 0 : found->precedence;
}

std::optional<std::int64_t> c_result(std::string_view mark, std::int64_t left, std::int64_t right) {
  const auto a = static_cast<std::uint64_t>(left), b = static_cast<std::uint64_t>(right);
  if (mark == "+") return wrapped(a + b);
  if (mark == "-") return wrapped(a - b);
  if (mark == "*") return wrapped(a * b);
  if (mark == "/" || mark == "%") {
    if (right == 0 || (right == -1 && left == std::numeric_limits<std::int64_t>::min())) return std::nullopt;
    return mark == "/" ? left / right : left % right;
  }
  if (mark == "<<" || mark == ">>") {
    if (right < 0 || right >= 64) return std::nullopt;
    return mark == "<<" ? wrapped(a << right) : left >> right;
  }
  if (mark == "|") return left | right;
  if (mark == "&") return left & right;
  if (mark == "^") return left ^ right;
  if (mark == "==") return left == right ? 1 : 0;
  if (mark == "!=") return left != right ? 1 : 0;
  if (mark == "<") return left < right ? 1 : 0;
  if (mark == ">") return left > right ? 1 : 0;
  if (mark == "<=") return left <= right ? 1 : 0;
  if (mark == ">=") return left >= right ? 1 : 0;
  return std::nullopt;
}

}  // namespace ninebit::detail
