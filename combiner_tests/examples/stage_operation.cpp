#include <gtest/gtest.h>
#include <ninebit/texture_shader/stage_operation.h>

TEST(Examples, StageOperation) {
  using namespace ninebit;
  const TextureOperationInfo& info = info_of(TextureOperation::offset_2d);
  EXPECT_EQ(info.gl, "OFFSET_TEXTURE_2D_NV");
  EXPECT_EQ(info.direct3d, "texbem");
  EXPECT_EQ(info.first, 1);  // it reads an earlier stage
  EXPECT_EQ(texture_operation_called("dependent_ar"), TextureOperation::dependent_ar);
}
