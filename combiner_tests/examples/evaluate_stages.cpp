#include <gtest/gtest.h>
#include <ninebit/texture_shader/evaluate_stages.h>

TEST(Examples, EvaluateStages) {
  using namespace ninebit;
  // Stage 1 reads its texture at the alpha and red of stage 0's texel.
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::dependent_ar;
  const auto program = compile(state, {StageTexture{}, StageTexture{}}, profiles::nv2a);
  ASSERT_TRUE(program.ok());
  StageInputs inputs;
  inputs.at[0] = inputs.right[0] = inputs.above[0] = {0.5F, 0.5F, 0.0F, 1.0F};
  const FetchTexel fetch = [](int unit, const TexturePlace&) {
    return unit == 0 ? Bytes4{51, 0, 0, 255} : Bytes4{10, 20, 30, 40};
  };
  const TextureShaderResult result = evaluate(*program, profiles::nv2a, inputs, fetch);
  EXPECT_EQ((*result.stage[1].at)[0], 1.0F);
  EXPECT_EQ((*result.stage[1].at)[1], 51.0F / 255.0F);
  EXPECT_EQ(result.stage[1].codes, (Rgba9{10, 20, 30, 40}));
}
