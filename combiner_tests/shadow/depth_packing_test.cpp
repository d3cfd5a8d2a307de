// Depth packings: the numbers of a round trip through bytes, and the digits that the bytes ought to be.
#include "ninebit/frame/depth_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;

constexpr std::uint32_t kSteps = 1U << 22;  // depths i / 2^22, both ends included

const DepthPacking& packing(std::string_view name) {
  const DepthPacking* found = find_depth_packing(name);
  EXPECT_NE(found, nullptr) << name;
  return *found;
}

struct RoundTrip {
  double largest = 0.0;  // of depths below 1
  double mean = 0.0;
  int inversions = 0;  // where the next depth reads as a smaller one
  float at_zero = 0.0F, at_one = 0.0F;
};

template <class Read>
RoundTrip round_trip(Read read) {
  RoundTrip r;
  float before = -1.0F;
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    const float depth = static_cast<float>(i) / static_cast<float>(kSteps), back = read(depth);
    const double error = std::fabs(static_cast<double>(back) - static_cast<double>(depth));
    if (i < kSteps) r.largest = std::max(r.largest, error);
    r.mean += error / (kSteps + 1.0);
    r.inversions += back < before ? 1 : 0;
    before = back;
    if (i == 0) r.at_zero = back;
    if (i == kSteps) r.at_one = back;
  }
  return r;
}

RoundTrip through_bytes(std::string_view name, ChannelStorage storage) {
  const DepthPacking& p = packing(name);
  return round_trip([&](float depth) { return read_depth(p, store_depth(p, depth, storage), storage); });
}

TEST(DepthPacking, TableNamesEveryEncodingAndRelease) {
  std::set<std::string_view> names;
  for (const DepthPacking& p : depth_packings()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_FALSE(p.source.empty() || p.formula.empty()) << p.name;
    EXPECT_TRUE(p.channels >= 2 && p.channels <= 4) << p.name;
    EXPECT_EQ(find_depth_packing(p.name), &p);
    const DepthComponents c = p.pack(0.7F);
    for (std::size_t i = static_cast<std::size_t>(p.channels); i < 4; ++i) EXPECT_EQ(c[i], 0.0F) << p.name;
  }
  EXPECT_EQ(find_depth_packing("rgba8"), nullptr);
  EXPECT_EQ(depth_packing(DepthEncoding::d24), nullptr);
  EXPECT_EQ(depth_packing(DepthEncoding::d16), nullptr);
  EXPECT_EQ(depth_packing(DepthEncoding::rgba8_fract)->name, "rgba8-fract");
  EXPECT_EQ(depth_packing(DepthEncoding::rgba8_mod)->name, "rgba8-mod");
  EXPECT_EQ(depth_packing(DepthEncoding::rgba8_256over255)->name, "rgba8-256over255");
  EXPECT_EQ(depth_packing(DepthEncoding::rgba8_modf)->name, "rgba8-modf");
}

TEST(DepthPacking, ComponentsBecomeBytesByRoundingOrCutting) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [storage, name, help, formula, source] : storage_rules()) {
    EXPECT_EQ(name_of(storage), name);
    EXPECT_FALSE(help.empty() || formula.empty() || source.empty()) << name;
    EXPECT_EQ(stored_component(-0.1F, storage), 0);
    EXPECT_EQ(stored_component(kNaN, storage), 0);
    EXPECT_EQ(stored_component(1.5F, storage), 255);
    EXPECT_EQ(stored_component(1.0F, storage), 255);
  }
  EXPECT_EQ(stored_component(0.5F, ChannelStorage::round), 128);
  EXPECT_EQ(stored_component(0.5F, ChannelStorage::truncate), 127);
  EXPECT_EQ(stored_component(0.999F, ChannelStorage::round), 255);
  EXPECT_EQ(stored_component(0.999F, ChannelStorage::truncate), 254);
  EXPECT_EQ(stored_component(0.999F, ChannelStorage::floor_256), 255);
  EXPECT_EQ(stored_component(0.5F, ChannelStorage::floor_256), 127);
  EXPECT_EQ(stored_component(0.5F, ChannelStorage::half), 128);
  for (int n = 0; n < 256; ++n) {
    const auto byte = static_cast<std::uint8_t>(n);
    EXPECT_EQ(stored_component(read_component(byte, ChannelStorage::round), ChannelStorage::round), n);
  }
}

// In floats alone nearly every packing is right to the last bits. Those that take the fraction of depth 1 lose it.
TEST(DepthPacking, UnstoredComponentsGiveTheDepthBack) {
  for (const DepthPacking& p : depth_packings()) {
    if (p.name == "rg8-256over255") continue;         // the wrong order
    if (p.name == "rgba8-base255-2007") continue;     // half a step is added, and nothing is subtracted
    if (p.name == "rgba8-base255-clamped") continue;  // beyond 0.999
    const RoundTrip r = round_trip([&](float depth) { return p.unpack(p.pack(depth)); });
    // 256ths are subtracted and 255ths read; the 24 bits have digits of a depth that float32 has rounded.
    const double most = p.name == "rgba8-base255-by-256" ? 1.6e-5 : p.name == "rgb8-65793" ? 1.8e-7 : 1.2e-7;
    EXPECT_LE(r.largest, most) << p.name;
    EXPECT_EQ(r.at_zero, 0.0F) << p.name;
    const bool three_js = p.source.starts_with("three.js");
    if (!three_js) continue;
    EXPECT_EQ(r.at_one, p.name == "rgba8-fract" ? 0.0F : 1.0F) << p.name;
    EXPECT_EQ(r.inversions, p.name == "rgba8-fract" ? 1 : 0) << p.name;
  }
}

TEST(DepthPacking, FractShiftsByHalfATopStepWhenRounded) {
  const RoundTrip r = through_bytes("rgba8-fract", ChannelStorage::round);
  EXPECT_NEAR(r.largest, 1.97e-3, 0.005e-3);
  EXPECT_NEAR(r.mean, 9.8e-4, 0.05e-4);
  EXPECT_EQ(r.inversions, 258);
  EXPECT_EQ(r.at_zero, 0.0F);
  EXPECT_EQ(r.at_one, 0.0F);  // the farthest depth reads as the nearest
}

TEST(DepthPacking, FractShiftsByAWholeTopStepWhenCut) {
  const RoundTrip r = through_bytes("rgba8-fract", ChannelStorage::truncate);
  EXPECT_NEAR(r.largest, 3.9e-3, 0.05e-3);
  EXPECT_EQ(r.at_one, 0.0F);
}

// 255ths go into bytes and come back, if they are rounded: a 255th in float32 can lie just below its byte.
TEST(DepthPacking, ModIsExactWhenRoundedAndFallsBelowWhenCut) {
  const RoundTrip rounded = through_bytes("rgba8-mod", ChannelStorage::round);
  EXPECT_LE(rounded.largest, 6e-8);
  EXPECT_EQ(rounded.inversions, 0);
  EXPECT_EQ(rounded.at_one, 1.0F);
  const RoundTrip cut = through_bytes("rgba8-mod", ChannelStorage::truncate);
  EXPECT_NEAR(cut.largest, 3.9e-3, 0.05e-3);
  EXPECT_GT(cut.inversions, 300'000);
  EXPECT_LT(cut.inversions, 400'000);
}

TEST(DepthPacking, UpscaledFractionsLoseNothingButDepthOne) {
  for (const ChannelStorage storage : {ChannelStorage::round, ChannelStorage::truncate}) {
    const RoundTrip r = through_bytes("rgba8-256over255", storage);
    EXPECT_LE(r.largest, 1.2e-10);
    EXPECT_EQ(r.inversions, 1);
    EXPECT_EQ(r.at_one, 0.99609375F);  // alpha is cut to 1 and the other components are 0
  }
  const DepthComponents one = packing("rgba8-256over255").pack(1.0F);
  EXPECT_EQ(one[3], 256.0F / 255.0F);
}

TEST(DepthPacking, DigitsAreExactAndKeepOne) {
  for (const ChannelStorage storage : {ChannelStorage::round, ChannelStorage::truncate}) {
    const RoundTrip r = through_bytes("rgba8-modf", storage);
    EXPECT_EQ(r.largest, 0.0);
    EXPECT_EQ(r.at_one, 1.0F);
  }
  const double last = std::ldexp(1.0, -16);
  EXPECT_NEAR(through_bytes("rg8-modf", ChannelStorage::round).largest, last / 2, last / 100);
  EXPECT_NEAR(through_bytes("rg8-modf", ChannelStorage::truncate).largest, last, last / 100);
  EXPECT_LE(through_bytes("rgb8-modf", ChannelStorage::round).largest, 6e-8);
}

// Small depths have digits beyond the fourth byte. The lowest component of rgba8-modf is a fraction in 255ths; that of
// rgba8-256over255 is in 256ths, and cut to 255 of them even where it is rounded.
TEST(DepthPacking, TheFourthByteEndsAt2ToThe32nd) {
  const auto largest = [](std::string_view name, ChannelStorage storage) {
    const DepthPacking& p = packing(name);
    double error = 0.0;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const float depth = std::ldexp(static_cast<float>(i), -40),
                  back = read_depth(p, store_depth(p, depth, storage), storage);
      error = std::max(error, std::fabs(static_cast<double>(back) - static_cast<double>(depth)));
    }
    return std::ldexp(error, 24);
  };
  EXPECT_NEAR(largest("rgba8-modf", ChannelStorage::round), 1.0 / 510.0, 1e-4);
  EXPECT_NEAR(largest("rgba8-modf", ChannelStorage::truncate), 1.0 / 255.0, 1e-4);
  EXPECT_NEAR(largest("rgba8-256over255", ChannelStorage::round), 1.0 / 256.0, 1e-4);
  EXPECT_NEAR(largest("rgba8-256over255", ChannelStorage::truncate), 1.0 / 256.0, 1e-4);
}

// The pair of releases before r167: the two lowest digits, unpacked in the wrong order.
TEST(DepthPacking, TheOldPairKeepsNothingOfTheDepth) {
  const RoundTrip r = through_bytes("rg8-256over255", ChannelStorage::round);
  EXPECT_GT(r.largest, 0.99);
  EXPECT_NEAR(r.mean, 0.5, 0.01);
}

// What the bytes ought to be, in whole numbers: the digits of the depth in base 256; those that fract stores are
// 255/256 of them, rounded.
TEST(DepthPacking, BytesAreTheDigitsInBase256) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const float depth = static_cast<float>(i) / static_cast<float>(kSteps);
    const std::array<std::uint32_t, 4> digit{i >> 14, i >> 6 & 255, i << 2 & 255, 0};  // highest first
    for (const std::string_view name : {"rgba8-fract", "rgba8-256over255", "rgba8-modf"}) {
      const DepthPacking& p = packing(name);
      const DepthBytes bytes = store_depth(p, depth, ChannelStorage::round);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t expected = name == "rgba8-fract" ? (digit[k] * 255 + 128) / 256 : digit[k];
        ASSERT_EQ(bytes[p.red_is_highest ? k : 3 - k], expected) << name << " digit " << k << " of " << i << " / 2^22";
      }
    }
  }
}

// Those of rgba8-mod are the digits of 255 times the depth. (Of 16 bits here: the products are then exact in floats.)
TEST(DepthPacking, ModStoresTheDigitsOf255TimesTheDepth) {
  for (std::uint32_t i = 0; i < 65536; ++i) {
    const DepthBytes bytes = store_depth(packing("rgba8-mod"), static_cast<float>(i) / 65536.0F, ChannelStorage::round);
    const std::uint32_t n = i * 255;
    ASSERT_EQ(bytes[3], n >> 16) << i;
    ASSERT_EQ(bytes[2], n >> 8 & 255) << i;
    ASSERT_EQ(bytes[1], n & 255) << i;
    ASSERT_EQ(bytes[0], 0) << i;
  }
}

TEST(DepthPacking, FractNeverStores255) {
  std::array<int, 2> highest{};
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const float depth = static_cast<float>(i) / static_cast<float>(kSteps);
    for (const std::uint8_t byte : store_depth(packing("rgba8-fract"), depth, ChannelStorage::round)) {
      highest[0] = std::max(highest[0], int{byte});
    }
    for (const std::uint8_t byte : store_depth(packing("rgba8-mod"), depth, ChannelStorage::round)) {
      highest[1] = std::max(highest[1], int{byte});
    }
  }
  EXPECT_EQ(highest[0], 254);
  EXPECT_EQ(highest[1], 255);
}

// The text's chart: where the highest digit is 128, the depth that is read back is off by that many steps of the second
// one with fract, and by none with the 255ths.
TEST(DepthPacking, TheSecondDigitIsOffByTheFirst) {
  for (int second = 0; second < 256; ++second) {
    const float depth = (128.0F + static_cast<float>(second) / 256.0F) / 256.0F;
    const auto off_by = [&](std::string_view name) {
      const DepthPacking& p = packing(name);
      const double back =
          static_cast<double>(read_depth(p, store_depth(p, depth, ChannelStorage::round), ChannelStorage::round));
      return (back - static_cast<double>(depth)) * 65536.0;
    };
    EXPECT_NEAR(off_by("rgba8-fract"), 128.0, 1.1) << second;
    EXPECT_NEAR(off_by("rgba8-mod"), 0.0, 0.01) << second;
  }
}

// In a scene 256 units deep: from half a unit too far to half a unit too near, halfway through.
TEST(DepthPacking, FractJumpsByAUnitHalfwayThrough256) {
  const DepthPacking& p = packing("rgba8-fract");
  const auto off_by = [&](double units) {
    const auto depth = static_cast<float>(units / 256.0);
    return 256.0 *
               static_cast<double>(read_depth(p, store_depth(p, depth, ChannelStorage::round), ChannelStorage::round)) -
           units;
  };
  EXPECT_NEAR(off_by(128.99), 0.5, 0.02);
  EXPECT_NEAR(off_by(129.01), -0.5, 0.02);
  EXPECT_NEAR(off_by(0.5), 0.0, 0.02);
  EXPECT_NEAR(off_by(255.5), 0.0, 0.02);
  for (double units = 1.03; units < 128.0; units += 0.371) EXPECT_GT(off_by(units), 0.0) << units;
  for (double units = 129.01; units < 255.0; units += 0.371) EXPECT_LT(off_by(units), 0.0) << units;
}

}  // namespace
