#include <gtest/gtest.h>
#include <ninebit/numerics/result.h>

#include <string>

TEST(Examples, Result) {
  using namespace ninebit;
  const auto parse_step = [](const std::string& text) -> Result<int> {
    if (text != "1" && text != "2") {
      return Diagnostic{.message = "'" + text + "' is not a step; expected 1 or 2", .file = "steps.txt", .line = 3};
    }
    return text[0] - '0';
  };
  const Result<int> right = parse_step("2");
  ASSERT_TRUE(right.ok());
  EXPECT_EQ(*right, 2);
  EXPECT_EQ(parse_step("x").error().text(), "steps.txt:3: 'x' is not a step; expected 1 or 2");
}
