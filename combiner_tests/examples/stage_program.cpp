#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/texture_shader/stage_program.h>

TEST(Examples, StageProgram) {
  using namespace ninebit;
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = TextureOperation::texture_cube_map;
  StageTextures textures;
  textures[0] = StageTexture{.target = StageTarget::two_dimensional};
  const auto program = compile(state, textures, profiles::nv2a);
  ASSERT_TRUE(program.ok());
  EXPECT_EQ(program->warnings().at(0),
            "texture stage 0: texture_cube_map reads a cube map, and the unit has a 2D texture; it gives (0, 0, 0, 0)");
}
