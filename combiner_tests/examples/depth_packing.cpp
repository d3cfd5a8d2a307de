#include <gtest/gtest.h>
#include <ninebit/frame/depth_packing.h>

TEST(Examples, DepthPacking) {
  using namespace ninebit;
  const DepthPacking* packing = find_depth_packing("rgba8-modf");
  ASSERT_NE(packing, nullptr);
  const DepthBytes bytes = store_depth(*packing, 0.3F, ChannelStorage::round);
  EXPECT_NEAR(read_depth(*packing, bytes, ChannelStorage::round), 0.3F, 1e-7F);
  EXPECT_EQ(depth_packing(DepthEncoding::d24), nullptr);  // a depth texture needs none
}
