#include <gtest/gtest.h>
#include <ninebit/language/rc10.h>
#include <ninebit/language/source_text.h>

TEST(Examples, SourceText) {
  using namespace ninebit;
  const SourceText source{"!!RC1.0\nout.rgb = spare2;", "wrong.rc1"};
  const Parsed<CombinerState> parsed = parse_rc10(source, profiles::geforce2);
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.faults()[0].line, 2);
  EXPECT_EQ(parsed.faults()[0].text().substr(0, 16), "wrong.rc1:2:11: ");
}
