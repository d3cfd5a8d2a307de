// C's binary operators on whole numbers: how closely they bind, and what they give.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace ninebit::detail {

// A higher one binds closer; 0: not an operator of expressions.
[[nodiscard]] int c_precedence(std::string_view mark);

// The result of an arithmetic, bitwise or comparing operator in 64 bits, two's complement; empty where C leaves it
// undefined, and for other operators.
[[nodiscard]] std::optional<std::int64_t> c_result(std::string_view mark, std::int64_t left, std::int64_t right);

}  // namespace ninebit::detail
