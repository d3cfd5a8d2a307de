// The library's results: values, faults and their text.
#include "ninebit/numerics/result.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>

namespace ninebit::test {
namespace {

TEST(Diagnostic, TextHasThePartsThatAreKnown) {
  EXPECT_EQ((Diagnostic{.message = "no"}).text(), "no");
  EXPECT_EQ((Diagnostic{.message = "no", .file = "a.txt"}).text(), "a.txt: no");
  EXPECT_EQ((Diagnostic{.message = "no", .file = "a.txt", .line = 12}).text(), "a.txt:12: no");
  EXPECT_EQ((Diagnostic{.message = "no", .file = "", .line = 12}).text(), "no") << "a line of no file says nothing";
}

TEST(Result, HoldsAValueOrAFault) {
  Result<std::string> good(std::string("value"));
  ASSERT_TRUE(good.ok() && static_cast<bool>(good));
  good->push_back('!');
  *good += '?';
  good.value() += '.';
  EXPECT_EQ(std::as_const(good).value(), "value!?.");
  EXPECT_EQ(std::as_const(good)->size(), 8U);
  EXPECT_EQ(std::string(std::move(good).value()), "value!?.");

  const Result<std::string> bad(Diagnostic{.message = "no", .fault = Fault::cannot_write});
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().fault, Fault::cannot_write);
  EXPECT_THROW(static_cast<void>(bad.value()), std::bad_variant_access);
}

TEST(Status, IsDoneOrAFault) {
  EXPECT_TRUE(Status().ok());
  const Status bad(Diagnostic{.message = "no"});
  EXPECT_FALSE(bad.ok() || static_cast<bool>(bad));
  EXPECT_EQ(bad.error().message, "no");
}

}  // namespace
}  // namespace ninebit::test
