// Numbers as text that reads as the same number.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace ninebit {

// The shortest digits of a number: "0.1", "1e-10", "2", "inf", "nan".
[[nodiscard]] inline std::string digits_of(float value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

// The same without an exponent.
[[nodiscard]] inline std::string plain_digits_of(float value) {
  std::array<char, 200> digits{};  // the smallest float has 149 decimals
  char* const end = digits.data() + digits.size();
  return {digits.data(), std::to_chars(digits.data(), end, value, std::chars_format::fixed).ptr};
}

}  // namespace ninebit
