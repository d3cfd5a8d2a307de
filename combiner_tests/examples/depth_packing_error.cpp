#include <gtest/gtest.h>
#include <ninebit/study/depth_packing_error.h>

TEST(Examples, DepthPackingError) {
  using namespace ninebit;
  const DepthPacking& packing = *find_depth_packing("rgba8-mod");
  const auto error = measure_round_trip(packing, ChannelStorage::round, DepthSet::bits16, 1, {});
  ASSERT_TRUE(error.ok());
  EXPECT_EQ(error->depths, 65536U);
  EXPECT_LT(error->max_error, 1e-5);
  EXPECT_EQ(depth_at(DepthSet::bits16, 1, 65535), 1.0F);
}
