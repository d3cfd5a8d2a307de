// The conditions of #if and #elif: C's constant expressions.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/c_like/c_lexer.h"

namespace ninebit::code {

struct ConditionValue {
  bool holds = false;     // with names as 0, as in C
  std::string unknown{};  // a name on which the value depends; empty: none
  std::string fault{};    // why the value cannot be computed, which then does not hold; empty: it can
};

// The value of an expression whose macros are expanded.
[[nodiscard]] ConditionValue condition_value(const std::vector<Token>& expression,
                                             const std::function<bool(std::string_view)>& is_defined);

}  // namespace ninebit::code
