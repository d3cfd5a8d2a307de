#include <gtest/gtest.h>
#include <ninebit/frame/index_codes.h>

TEST(Examples, IndexCodes) {
  using namespace ninebit;
  constexpr IndexCodes codes(2);
  EXPECT_EQ(codes.capacity(), 1U << 21);
  EXPECT_EQ(codes.color(300), (ColorBytes{88, 4, 0, 255}));  // 300 is 44 + 2 · 128
  EXPECT_EQ(codes.number({88, 4, 0, 255}), 300U);
  const Status too_many = check_index_codes(IndexFormat::luminance, 2, IndexScope::polygon, {.polygons = 5000});
  EXPECT_FALSE(too_many.ok());
}
