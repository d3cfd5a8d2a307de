#include <gtest/gtest.h>
#include <ninebit/texture_shader/stage_state.h>

TEST(Examples, StageState) {
  using namespace ninebit;
  // Water: unit 1's coordinates are moved by the bumps of unit 0.
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::offset_2d;
  state.stage[1].matrix = {0.1F, 0.0F, 0.0F, 0.1F};
  EXPECT_EQ(state.stage[1].previous, 0);
}
