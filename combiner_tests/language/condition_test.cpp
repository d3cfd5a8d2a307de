// The expressions of #if: C's operators, and what of an expression must be known.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/language/c_like/c_macros.h"
#include "src/language/c_like/c_preprocessor.h"

namespace ninebit::code {
namespace {

// The value with macros.
ConditionValue value_with(const std::string& expression, const std::map<std::string, std::string>& bodies = {}) {
  Macros macros;
  for (const auto& [name, body] : bodies) {
    macros.all[name].body = tokens_of(body);
    macros.all[name].body.pop_back();
  }
  std::vector<Token> tokens = tokens_of(expression);
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    tokens[i].is_final = tokens[i - 1].is("defined") || (i > 1 && tokens[i - 2].is("defined"));
  }
  return condition_value(expand_tokens(macros, tokens),
                         [&](std::string_view name) { return bodies.contains(std::string(name)); });
}

TEST(Condition, OperatorsAreThoseOfC) {
  for (const char* expression : {"1 + 2 * 3 == 7",
                                 "(1 + 2) * 3 == 9",
                                 "7 / 2 == 3",
                                 "-7 / 2 == -3",
                                 "7 % 4 == 3",
                                 "-7 % 4 == -3",
                                 "8 - 4 - 2 == 2",
                                 "1 << 3 == 8",
                                 "64 >> 2 >> 1 == 8",
                                 "-8 >> 1 == -4",
                                 "7 & 3 == 3",
                                 "(6 & 3) == 2",
                                 "6 | 1 && 1",
                                 "(5 ^ 1) == 4",
                                 "~0 == -1",
                                 "!0",
                                 "!!5",
                                 "- -3 == 3",
                                 "+4 == 4",
                                 "0x1F == 31",
                                 "017 == 15",
                                 "0XfuL == 15",
                                 "1 || 0 && 0",
                                 "(1 || 0) && 1",
                                 "2 > 1 == 1",
                                 "1 < 2",
                                 "2 <= 2",
                                 "3 >= 2",
                                 "3 != 2",
                                 "0 ? 0 : 2",
                                 "1 ? 2 : 0",
                                 "0 ? 0 : 0 ? 0 : 5",
                                 "1 | 2 ^ 2",
                                 "(3 & 1 ^ 1) == 0",
                                 "-1 > 0u",
                                 "-1 < 0",
                                 "0xFFFFFFFFFFFFFFFF == -1",
                                 "18446744073709551615 > 0",
                                 "-1 / 2u > 1",
                                 "(-1 >> 1) == -1",
                                 "(0u - 1 >> 63) == 1",
                                 "1 ? 1 : 1 / 0",
                                 "0 && 1 / 0 || 1",
                                 "1 || 1 / 0",
                                 "(1 ? -1 : 0u) > 0",
                                 "(-1 < 0u) - 1 < 0"}) {
    const ConditionValue value = value_with(expression);
    EXPECT_TRUE(value.holds) << expression;
    EXPECT_EQ(value.unknown + value.fault, "") << expression;
  }
  for (const char* expression : {"0", "1 - 1", "2 < 1", "1 == 2", "!1", "0 || 0", "1 && 0", "4 & 3", "0u - 1 < 0",
                                 "1 ? 0 : 1", "0xF0 >> 8", "1 > 1"}) {
    const ConditionValue value = value_with(expression);
    EXPECT_FALSE(value.holds) << expression;
    EXPECT_EQ(value.unknown + value.fault, "") << expression;
  }
}

TEST(Condition, NamesStandForTheirBodies) {
  const std::map<std::string, std::string> bodies{
      {"ONE", "1"}, {"SUM", "1 + 1"}, {"FROM", "SUM"}, {"SELF", "SELF + 1"}, {"NONE", ""}};
  for (const char* expression : {"ONE", "SUM * 2 == 3", "(SUM) * 2 == 4", "FROM == 2", "defined(FROM)", "defined NONE",
                                 "!defined(OTHER)", "defined(ONE) && !defined OTHER"}) {
    const ConditionValue value = value_with(expression, bodies);
    EXPECT_TRUE(value.holds) << expression << value.fault;
    EXPECT_EQ(value.unknown + value.fault, "") << expression;
  }
  EXPECT_EQ(value_with("SELF", bodies).unknown, "SELF");
}

// C takes names without a body as 0. Whether that decides is told apart.
TEST(Condition, WhatDecidesIsNamed) {
  for (const auto& [expression, holds] : std::vector<std::pair<const char*, bool>>{{"X", false},
                                                                                   {"X == 0", true},
                                                                                   {"X != 0", false},
                                                                                   {"!X", true},
                                                                                   {"0 || X", false},
                                                                                   {"1 && X", false},
                                                                                   {"X || 0", false},
                                                                                   {"X ? 1 : 0", false},
                                                                                   {"1 ? X : 0", false},
                                                                                   {"X + 1", true},
                                                                                   {"-X < 1", true},
                                                                                   {"1 / X == 0", true},
                                                                                   {"~X", true},
                                                                                   {"(X)", false}}) {
    const ConditionValue value = value_with(expression);
    EXPECT_EQ(value.unknown, "X") << expression;
    EXPECT_EQ(value.holds, holds) << expression;
    EXPECT_EQ(value.fault, "") << expression;
  }
  for (const auto& [expression, holds] : std::vector<std::pair<const char*, bool>>{{"1 || X", true},
                                                                                   {"X || 1", true},
                                                                                   {"0 && X", false},
                                                                                   {"X && 0", false},
                                                                                   {"0 ? X : 2", true},
                                                                                   {"defined(X) && X > 1", false},
                                                                                   {"!defined X || X", true}}) {
    const ConditionValue value = value_with(expression);
    EXPECT_EQ(value.unknown, "") << expression;
    EXPECT_EQ(value.holds, holds) << expression;
  }
  EXPECT_EQ(value_with("A == 1 || B").unknown, "A");
}

TEST(Condition, WhatCannotBeComputedIsAFault) {
  std::string deep;
  for (int i = 0; i < 70; ++i) deep += "(";
  std::map<std::string, std::string> doubled{{"a0", "1 + 1"}};
  for (int i = 1; i < 30; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    doubled["a" + std::to_string(i)] = before + " + " + before;
  }
  for (const auto& [expression, fault] : std::vector<std::pair<std::string, std::string>>{
           {"", "expected a number, a name or defined(NAME); found the end of the line"},
           {"1 +", "expected a number, a name or defined(NAME); found the end of the line"},
           {"1 2", "expected an operator; found '2'"},
           {"1 = 1", "expected an operator; found '='"},
           {"(1", "expected ')'; found the end of the line"},
           {"1 ? 2", "expected ':'; found the end of the line"},
           {"defined", "expected a name after defined; found the end of the line"},
           {"defined(1)", "expected a name after defined; found '1'"},
           {"defined(X", "expected ')'; found the end of the line"},
           {"X(1)", "'X' has parameters; only names without them are computed"},
           {"1.5", "'1.5' is not a whole number of 64 bits"},
           {"08", "'08' is not a whole number of 64 bits"},
           {"18446744073709551616", "'18446744073709551616' is not a whole number of 64 bits"},
           {"1 / 0", "1 / 0 has no value"},
           {"1 % 0u", "1 % 0 has no value"},
           {"18446744073709551615 / 0", "18446744073709551615 / 0 has no value"},
           {"1 / 0 && 0", "1 / 0 has no value"},
           {"1 << 64", "1 << 64 has no value"},
           {deep, "expected at most 64 brackets and signs in each other; found '('"},
           {"a29", "the condition is longer than 1 MiB with names replaced"}}) {
    const ConditionValue value = value_with(expression, doubled);
    EXPECT_EQ(value.fault.substr(0, fault.size()), fault) << expression;
    EXPECT_FALSE(value.holds) << expression;
  }
}

}  // namespace
}  // namespace ninebit::code
