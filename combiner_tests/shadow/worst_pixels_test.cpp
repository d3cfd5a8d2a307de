// Which wrong pixels are named as the worst: against a search of all pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "combiner_tests/support/random.h"
#include "ninebit/shadow/ground_truth.h"

namespace shadow_test {
namespace {

using namespace ninebit;

constexpr int kWidth = 40, kHeight = 24;

std::size_t place(int x, int y) {
  return static_cast<std::size_t>(y * kWidth + x);
}

// The least distance to a pixel of another cause or outside.
int radius_at(const GroundTruth& truth, int x, int y) {
  int radius = std::min({x + 1, y + 1, kWidth - x, kHeight - y});
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (truth.cause[place(u, v)] == truth.cause[place(x, y)]) continue;
      radius = std::min(radius, std::max(std::abs(u - x), std::abs(v - y)));
    }
  }
  return radius;
}

TEST(WorstPixels, AreTheMiddlesOfPatches) {
  GroundTruth truth;
  truth.cause.assign(kWidth * kHeight, ErrorCause::none);
  const auto fill = [&](int left, int bottom, int width, int height, ErrorCause cause) {
    for (int y = bottom; y < bottom + height; ++y) {
      for (int x = left; x < left + width; ++x) truth.cause[place(x, y)] = cause;
    }
  };
  fill(3, 4, 7, 7, ErrorCause::joint);
  fill(20, 15, 3, 3, ErrorCause::joint);
  fill(30, 2, 1, 1, ErrorCause::acne);
  const auto found = worst_pixels(truth, kWidth, kHeight, 2);
  ASSERT_EQ(found.size(), 3U);
  const auto expect = [](const WorstPixel& pixel, ErrorCause cause, int x, int y, int radius) {
    EXPECT_EQ(pixel.cause, cause);
    EXPECT_EQ(pixel.x, x);
    EXPECT_EQ(pixel.y, y);
    EXPECT_EQ(pixel.radius, radius);
  };
  expect(found[0], ErrorCause::joint, 6, 7, 4);
  expect(found[1], ErrorCause::joint, 21, 16, 2);
  expect(found[2], ErrorCause::acne, 30, 2, 1);
  EXPECT_TRUE(worst_pixels(truth, kWidth, kHeight, 0).empty());
}

TEST(WorstPixels, AgreeWithASearch) {
  test::Random random(46);
  for (int round = 0; round < 20; ++round) {
    GroundTruth truth;
    truth.cause.assign(kWidth * kHeight, ErrorCause::none);
    for (int i = 0; i < 30; ++i) {
      const int left = static_cast<int>(random.below(kWidth)), bottom = static_cast<int>(random.below(kHeight));
      const auto cause = static_cast<ErrorCause>(random.below(4));
      for (int y = bottom; y < std::min(kHeight, bottom + 7); ++y) {
        for (int x = left; x < std::min(kWidth, left + 9); ++x) truth.cause[place(x, y)] = cause;
      }
    }
    const auto found = worst_pixels(truth, kWidth, kHeight, 3);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].radius, radius_at(truth, found[i].x, found[i].y));
      for (std::size_t j = 0; j < i; ++j) {
        if (found[j].cause != found[i].cause) continue;
        EXPECT_GE(found[j].radius, found[i].radius);
        EXPECT_TRUE(std::abs(found[j].x - found[i].x) >= kWidth / 8 ||
                    std::abs(found[j].y - found[i].y) >= kHeight / 8);
      }
      if (i > 0 && found[i - 1].cause == found[i].cause) continue;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          if (truth.cause[place(x, y)] != found[i].cause) continue;
          EXPECT_LE(radius_at(truth, x, y), found[i].radius);
        }
      }
    }
    for (const ErrorCause cause : truth.cause) {
      const auto has = [&](const WorstPixel& pixel) { return pixel.cause == cause; };
      EXPECT_EQ(std::any_of(found.begin(), found.end(), has), cause != ErrorCause::none);
    }
  }
}

}  // namespace
}  // namespace shadow_test
