#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/texture_shader/validate_stages.h>

TEST(Examples, ValidateStages) {
  using namespace ninebit;
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = TextureOperation::dependent_ar;
  const auto faults = validate(state, profiles::nv2a);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].gl_error, GlError::invalid_operation);
  EXPECT_EQ(faults[0].message, "texture stage 0: dependent_ar is for stages 1 to 3 only");
}
