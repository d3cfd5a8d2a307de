#include "ninebit/shadow/index_codes.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace ninebit;

TEST(IndexCodes, CapacityIsTheNumberOfLevelsCubed) {
  EXPECT_EQ(IndexCodes(1).capacity(), 1U << 24);
  EXPECT_EQ(IndexCodes(2).capacity(), 1U << 21);  // the article's seven bits a channel
  EXPECT_EQ(IndexCodes(3).capacity(), 86U * 86U * 86U);
  EXPECT_EQ(IndexCodes(4).capacity(), 64U * 64U * 64U);
  EXPECT_EQ(IndexCodes(16).capacity(), 16U * 16U * 16U);
}

TEST(IndexCodes, RedCountsFastestAndZeroIsTheClearedMap) {
  const IndexCodes codes(2);
  EXPECT_EQ(codes.color(0), (ColorBytes{0, 0, 0, 255}));
  EXPECT_EQ(codes.color(1), (ColorBytes{2, 0, 0, 255}));
  EXPECT_EQ(codes.color(127), (ColorBytes{254, 0, 0, 255}));
  EXPECT_EQ(codes.color(128), (ColorBytes{0, 2, 0, 255}));
  EXPECT_EQ(codes.color(128 * 128), (ColorBytes{0, 0, 2, 255}));
  EXPECT_EQ(codes.color(codes.capacity() - 1), (ColorBytes{254, 254, 254, 255}));
}

TEST(IndexCodes, EveryCodeIsItsOwnMultipleOfTheStep) {
  for (int step = 1; step <= kMaxIndexStep; ++step) {
    const IndexCodes codes(step);
    // All codes of the larger steps; of the smaller ones every 97th, which meets every digit.
    const std::uint32_t stride = step >= 4 ? 1 : 97;
    for (std::uint32_t n = 0; n < codes.capacity(); n += stride) {
      const ColorBytes c = codes.color(n);
      ASSERT_EQ(c[0] % step + c[1] % step + c[2] % step, 0) << "step " << step << ", number " << n;
      ASSERT_EQ(codes.number(c[0], c[1], c[2]), n) << "step " << step;
    }
  }
}

TEST(IndexCodes, TooManyPolygonsNameCountsAndRemedies) {
  EXPECT_TRUE(check_index_codes(16, IndexScope::polygon, 4095, 3).ok());
  const Status full = check_index_codes(16, IndexScope::polygon, 4096, 3);
  ASSERT_FALSE(full.ok());
  const std::string text = full.error().message;
  for (const char* part :
       {"4096 of them", "4097 codes", "index step 16 has 4096", "index step 15", "index scope object"}) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in: " << text;
  }
  EXPECT_EQ(check_index_codes(1, IndexScope::polygon, 1U << 24, 1U << 25).error().message.find("index scope"),
            std::string::npos);
  EXPECT_NE(check_index_codes(1, IndexScope::object, 1U << 24, 1U << 24).error().message.find("no step or scope"),
            std::string::npos);
  EXPECT_FALSE(check_index_codes(0, IndexScope::polygon, 1, 1).ok());
  EXPECT_FALSE(check_index_codes(17, IndexScope::polygon, 1, 1).ok());
}

}  // namespace
