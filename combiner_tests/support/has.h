// Parts of texts.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

namespace ninebit::test {

// Whether a text has a part. A test that expects the other answer shows the text.
[[nodiscard]] inline ::testing::AssertionResult has(std::string_view text, std::string_view part) {
  const bool found = text.find(part) != std::string_view::npos;
  return (found ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
         << '\'' << part << (found ? "' is in\n" : "' is not in\n") << text;
}

}  // namespace ninebit::test
