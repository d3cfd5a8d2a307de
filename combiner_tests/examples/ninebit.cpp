#include <gtest/gtest.h>
#include <ninebit/ninebit.h>

TEST(Examples, Ninebit) {
  using namespace ninebit;
  const auto state = parse_rc10({"!!RC1.0\nout.rgb = unsigned_invert(tex0);", "negative.rc1"}, profiles::geforce2);
  ASSERT_TRUE(state);
  const Result<Program> program = compile(*state, profiles::geforce2);
  ASSERT_TRUE(program.ok());
  FragmentInputs in;
  in.texture[0] = Texel{.value = {200, 100, 0, 255}};
  const Rgba9 color = evaluate(*program, initial_registers(profiles::geforce2, in));
  EXPECT_EQ(color[kRed], 55);
}
