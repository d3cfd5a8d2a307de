#include <gtest/gtest.h>
#include <ninebit/language/register_log.h>

TEST(Examples, RegisterLog) {
  using namespace ninebit;
  const SourceText trace{
      "class,method,data\n"
      "0x97,0x1e60,0x101\n"  // one general combiner
      "0x97,0x17fc,5\n"      // begin: triangles
      "0x97,0x1810,0x02000000\n"
      "0x97,0x17fc,0\n",
      "frame.log"};
  const auto log = parse_register_log(trace);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->draws, 1U);
  const auto program = program_of(*log, 1, "frame.log", profiles::nv2a);
  EXPECT_EQ(program->num_general_combiners, 1);
}
