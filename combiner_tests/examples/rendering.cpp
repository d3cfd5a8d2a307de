#include <gtest/gtest.h>
#include <ninebit/frame/rendering.h>

TEST(Examples, Rendering) {
  using namespace ninebit;
  ProbedPass pass{.name = "lit", .program = {}, .fragments = {}};
  EXPECT_EQ(deciding_fragment(pass), nullptr);
  pass.fragments.emplace_back();  // was written
  EXPECT_EQ(deciding_fragment(pass), &pass.fragments[0]);
}
