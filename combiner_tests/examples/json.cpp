#include <gtest/gtest.h>
#include <ninebit/language/json.h>

#include <string>

TEST(Examples, Json) {
  using namespace ninebit;
  const std::string text = print_json_program(CombinerState{});
  const auto state = parse_json_program({text, "program.json"}, profiles::geforce2);
  ASSERT_TRUE(state);
  EXPECT_EQ(*state, CombinerState{});
  const auto wrong = parse_json_program({R"({"ninebit": "program", "version": 2})", "new.json"}, profiles::geforce2);
  EXPECT_FALSE(wrong);
}
