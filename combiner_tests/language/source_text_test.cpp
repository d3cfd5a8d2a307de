// The results of parsers: the words of Result, with every fault of the text.
#include "ninebit/language/source_text.h"

#include <gtest/gtest.h>

#include <variant>

#include "ninebit/language/gl_calls.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

TEST(Parsed, SpeaksAsAResultDoes) {
  auto good = parse_gl_calls({"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);", "f"}, profiles::geforce2);
  ASSERT_TRUE(good.ok() && static_cast<bool>(good));
  EXPECT_EQ(good->num_general_combiners, 2);
  EXPECT_EQ(&*good, &good.value());
  EXPECT_TRUE(good.faults().empty());
  EXPECT_THROW(static_cast<void>(good.error()), std::bad_variant_access);

  const auto bad = parse_gl_calls({"glOne();\nglTwo();\n", "f"}, profiles::geforce2);
  EXPECT_FALSE(bad.ok() || static_cast<bool>(bad));
  EXPECT_THROW(static_cast<void>(bad.value()), std::bad_variant_access);
  ASSERT_EQ(bad.faults().size(), 2U);
  EXPECT_EQ(bad.error().text(), bad.faults()[0].text() + "\n" + bad.faults()[1].text());
}

}  // namespace
}  // namespace ninebit::test
