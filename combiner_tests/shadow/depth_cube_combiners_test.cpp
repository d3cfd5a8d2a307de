// The comparisons of the depth cube, byte pair by byte pair, through the very states that the render uses.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/shadow/depth_cube.h"
#include "ninebit/shadow/index_cube.h"
#include "src/frame/drawn_passes.h"

namespace {

using namespace ninebit;

constexpr std::array kBoundaries{0, 1, 127, 128, 254, 255};

// A comparison's program, and what it says of two luminance-alpha texels.
class Comparison {
 public:
  Comparison(const HardwareProfile& profile, const Result<CombinerState>& state)
      : profile_(profile), program_(normalize(*state, profile)) {}

  [[nodiscard]] int alpha(int l0, int a0, int l1, int a1) const {
    FragmentInputs in;
    in.texture[0] = texel(l0, a0);
    in.texture[1] = texel(l1, a1);
    return evaluate_fragment(program_, initial_registers(profile_, in)).color[kAlpha];
  }

 private:
  static Texel texel(int l, int a) {
    return {.value = {static_cast<std::uint8_t>(l), 0, 0, static_cast<std::uint8_t>(a)},
            .format = TextureFormat::luminance_alpha};
  }
  const HardwareProfile& profile_;
  Program program_;
};

// 255 is a multiple of both.
constexpr int kPairStep = ninebit::test::kSlowBuild ? 5 : 1;

template <class Check>
void for_all_pairs(const Check& check, int step = kPairStep) {
  for (int a = 0; a < 256; a += step) {
    for (int b = 0; b < 256; b += step) check(a, b);
  }
}

const std::array kExact{&profiles::geforce2, &profiles::nv2a};

TEST(DepthCubeCombiners, LuminancesAreComparedExactly) {
  for (const HardwareProfile* profile : kExact) {
    const Comparison compare(*profile, luminance_above_state(*profile));
    for_all_pairs([&](int own, int map) {
      ASSERT_EQ(compare.alpha(own, 255, map, 255), std::max(0, own - map)) << own << " " << map;
    });
  }
}

TEST(DepthCubeCombiners, HighBytesAreComparedWhateverTheLowOnesAre) {
  for (const HardwareProfile* profile : kExact) {
    const Comparison compare(*profile, high_byte_above_state(*profile));
    for (const std::pair<int, int>& low : {std::pair(0, 255), std::pair(255, 0), std::pair(128, 128)}) {
      for_all_pairs([&](int own, int map) {
        ASSERT_EQ(compare.alpha(low.first, own, low.second, map), std::max(0, own - map)) << own << " " << map;
      });
    }
  }
}

// Every pair of high bytes with low bytes at the boundaries, and every pair of low bytes with such high bytes.
TEST(DepthCubeCombiners, TheMuxComparesLowBytesWhereTheHighOnesAreNotBelow) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile* profile : kExact) {
    const Comparison compare(*profile, low_byte_above_state(*profile));
    const auto check = [&](int l0, int a0, int l1, int a1) {
      const int expected = a0 >= a1 ? std::max(0, l0 - l1) : 0;
      ASSERT_EQ(compare.alpha(l0, a0, l1, a1), expected) << a0 << ":" << l0 << " against " << a1 << ":" << l1;
    };
    for (const int b : kBoundaries) {
      for (const int c : {0, 128, 255}) {
        for_all_pairs([&](int x, int y) {
          check(b, x, c, y);
          check(x, b, y, c);
        });
      }
    }
  }
}

// A fragment is marked by one pass or the other exactly where its 16-bit code is above the map's.
TEST(DepthCubeCombiners, BothPassesTogetherCompareSixteenBits) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile* profile : kExact) {
    const Comparison high(*profile, high_byte_above_state(*profile)), low(*profile, low_byte_above_state(*profile));
    const auto check = [&](unsigned own, unsigned map) {
      const auto byte = [](unsigned code, unsigned shift) { return static_cast<int>((code >> shift) & 255U); };
      const auto marks = [&](const Comparison& pass) {
        return pass.alpha(byte(own, 0), byte(own, 8), byte(map, 0), byte(map, 8)) > 0;
      };
      ASSERT_EQ(marks(high) || marks(low), own > map) << own << " against " << map;
    };
    // Codes as near to each other as can be, all of them.
    for (unsigned code = 0; code < 65536; ++code) {
      check(code, code);
      if (code > 0) check(code, code - 1);
      if (code > 0) check(code - 1, code);
    }
    std::mt19937 random(22);
    for (int n = 0; n < 200'000; ++n) check(random() & 0xFFFFU, random() & 0xFFFFU);
  }
}

// Rule 22: with real numbers, equal high bytes reach one half, and the mux takes the wrong side for all 256 of them.
TEST(DepthCubeCombiners, RealNumbersFailTheMux) {
  for (const HardwareProfile* profile : {&profiles::ideal, &profiles::float_shader}) {
    const Comparison compare(*profile, low_byte_above_state(*profile));
    int wrong = 0;
    for_all_pairs([&](int a0, int a1) { wrong += (compare.alpha(200, a0, 100, a1) > 0) != (a0 >= a1) ? 1 : 0; }, 1);
    EXPECT_EQ(wrong, 256) << profile->name;
  }
}

// "With this technique, we only require 1 texture unit ..., whereas depth cube shadow mapping requires at least 2."
TEST(DepthCubeCombiners, ReadTwoTextureUnitsWhereTheIndexCubeReadsOne) {
  RenderSettings settings;
  const auto index = index_cube_passes(settings);
  ASSERT_TRUE(index.ok());
  EXPECT_EQ(texture_units_read(*index->comparison.program), 1);
  for (const DepthCubeBits bits : {DepthCubeBits::eight, DepthCubeBits::sixteen}) {
    settings.depth_cube.bits = bits;
    const auto depth = depth_cube_passes(settings);
    ASSERT_TRUE(depth.ok());
    EXPECT_EQ(depth->comparisons.size(), bits == DepthCubeBits::eight ? 1U : 2U);
    EXPECT_EQ(texture_units_read(*depth->map.program), 1);
    for (const DepthCubeComparison& pass : depth->comparisons) EXPECT_EQ(texture_units_read(*pass.state.program), 2);
  }
}

}  // namespace
