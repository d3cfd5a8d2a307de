#include <gtest/gtest.h>
#include <ninebit/shadow/depth_cube.h>

TEST(Examples, DepthCube) {
  using namespace ninebit;
  const DistanceCode code{.low = 0.0F, .high = 8.0F, .code_bits = 8, .ramp_bits = 11, .offset = 16};
  EXPECT_EQ(code.ramp_size(), 2048U);
  EXPECT_DOUBLE_EQ(code.code_step(), 8.0 / 256);  // world units
  EXPECT_EQ(code.map_code(1024), 128U);
  EXPECT_EQ(code.camera_code(1024), 126U);  // behind by the bias
  EXPECT_TRUE(luminance_above_state(profiles::geforce2).ok());
}
