// The conditions of #if and #elif: C's constant expressions over the names that a preprocessor has.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit::detail {

// The longest expression with names replaced, in bytes; and the most bytes of the bodies that replace names in it.
inline constexpr std::size_t kMostConditionBytes = std::size_t{1} << 20;
inline constexpr std::string_view kLongCondition = "the condition is longer than 1 MiB with names replaced";

// The names that a preprocessor has.
struct ConditionNames {
  std::function<bool(std::string_view)> is_defined;
  // The text that stands for a macro without parameters; empty: the name is not one.
  std::function<std::optional<std::string>(std::string_view)> body_of;
};

struct ConditionValue {
  bool holds = false;     // with names that have no body as 0, as in C
  std::string unknown{};  // such a name, on which the value depends; empty: none
  std::string fault{};    // why the value cannot be computed, which then does not hold; empty: it can
};

// The value of an expression without comments. Names are replaced by their bodies before it is computed.
[[nodiscard]] ConditionValue condition_value(std::string_view expression, const ConditionNames& names);

}  // namespace ninebit::detail
