// Register codes: from and to bytes and reals, and the two ways a float becomes a byte.
#include "ninebit/numerics/fixed9.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/support/special_floats.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

using ninebit::test::kInfinity;
using ninebit::test::kNan;

// The definition of rule 17 in integers: `bits` fraction bits kept, times 255, a half rounded up.
int vertex_byte_by_integers(float component, int bits) {
  if (!(component > 0.0F)) return 0;
  if (component >= 1.0F) return 255;
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(component, &exponent), 24));
  std::int64_t kept = mantissa;
  for (int i = bits; i < 23; ++i) kept /= 2;
  for (int i = bits; i < 23; ++i) kept *= 2;
  const int shift = 24 - exponent;
  // kept * 255 < 2^32; past a shift of 40 the value is far below one half.
  if (shift > 40) return 0;
  return static_cast<int>((kept * 255 + (std::int64_t{1} << (shift - 1))) >> shift);
}

TEST(Fixed9, ByteEntersWithoutTheBitsThatAreShiftedOut) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    for (int byte = 0; byte < 256; ++byte) {
      const int expected = profile.byte_shift == 1 ? byte / 2 : byte;
      EXPECT_EQ(from_byte(profile, static_cast<std::uint8_t>(byte)), expected) << profile.name;
    }
    EXPECT_EQ(from_byte(profile, 255), profile.one.value) << profile.name;
  }
}

TEST(Fixed9, EveryByteSurvivesARegisterOfNineBits) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::geforce2_early_truncation, profiles::nv2a}) {
    for (int byte = 0; byte < 256; ++byte) {
      EXPECT_EQ(to_byte(profile, from_byte(profile, static_cast<std::uint8_t>(byte))), byte);
    }
  }
}

TEST(Fixed9, SevenBitCodesFillWithTheirUpperBits) {
  const HardwareProfile& p = profiles::geforce256_8bit;
  int last = -1;
  for (int code = 0; code <= 127; ++code) {
    const int byte = to_byte(p, static_cast<s9>(code));
    EXPECT_EQ(byte, code * 2 + code / 64);
    EXPECT_EQ(from_byte(p, static_cast<std::uint8_t>(byte)), code);
    EXPECT_GT(byte, last);
    last = byte;
  }
  EXPECT_EQ(last, 255);
}

TEST(Fixed9, CodesOutsideTheFrameBufferRangeAreClamped) {
  for (const HardwareProfile& p : hardware_profiles()) {
    for (int code = -256; code <= 0; ++code) EXPECT_EQ(to_byte(p, static_cast<s9>(code)), 0);
    EXPECT_EQ(to_byte(p, static_cast<s9>(p.one)), 255);
    EXPECT_EQ(to_byte(p, static_cast<s9>(p.one + 1)), 255);
    EXPECT_EQ(to_byte(p, static_cast<s9>(2 * p.one)), 255);
  }
}

TEST(Fixed9, RealValueOfACode) {
  for (const HardwareProfile& p : hardware_profiles()) {
    EXPECT_EQ(to_real(p, static_cast<s9>(p.one)), 1.0);
    EXPECT_EQ(to_real(p, static_cast<s9>(-p.one)), -1.0);
    EXPECT_EQ(to_real(p, 0), 0.0);
    EXPECT_DOUBLE_EQ(to_real(p, static_cast<s9>(p.half)) * p.one, static_cast<double>(p.half.value));
  }
}

TEST(Fixed9, ColorComponentRoundsToTheNearestByte) {
  for (int n = 0; n <= 255; ++n) {
    const auto exact = static_cast<float>(n / 255.0);
    EXPECT_EQ(byte_of_color(exact), n);
    if (n == 255) continue;
    // Between n and n + 1: a byte changes at the half step, to within one float.
    const auto middle = static_cast<float>((n + 0.5) / 255.0);
    const float below = std::nextafter(middle, 0.0F);
    const float above = std::nextafter(middle, 1.0F);
    EXPECT_EQ(byte_of_color(below), n);
    EXPECT_EQ(byte_of_color(above), n + 1);
  }
}

TEST(Fixed9, ColorComponentIsClamped) {
  EXPECT_EQ(byte_of_color(-0.0F), 0);
  EXPECT_EQ(byte_of_color(-3.0F), 0);
  EXPECT_EQ(byte_of_color(-kInfinity), 0);
  EXPECT_EQ(byte_of_color(kNan), 0);
  EXPECT_EQ(byte_of_color(1.5F), 255);
  EXPECT_EQ(byte_of_color(kInfinity), 255);
  EXPECT_EQ(byte_of_color(std::numeric_limits<float>::denorm_min()), 0);
}

// The byte changes where 4096 f reaches the first whole number n with 255 (n + 1) >= 4096 byte.
TEST(Fixed9, FogFactorsAreCutToTwelveBits) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    for (int n = 1; n <= 255; ++n) {
      const int step = (4096 * n + 254) / 255 - 1;
      const float above = static_cast<float>(step) / 4096.0F, below = std::nextafter(above, 0.0F);
      EXPECT_EQ(byte_of_fog_factor(profile, above), n);
      EXPECT_EQ(byte_of_fog_factor(profile, below), n - 1);
    }
    EXPECT_EQ(byte_of_fog_factor(profile, -3.0F), 0);
    EXPECT_EQ(byte_of_fog_factor(profile, kNan), 0);
    EXPECT_EQ(byte_of_fog_factor(profile, kInfinity), 255);
  }
  for (const float f : {-1.0F, 0.0F, 0.1F, 0.5F, 0.7F, 1.0F, kNan}) {
    EXPECT_EQ(byte_of_fog_factor(profiles::ideal, f), byte_of_color(f));
  }
}

TEST(VertexColor, FollowsTheDefinitionForEveryByteAndItsNeighbours) {
  const HardwareProfile& p = profiles::nv2a;
  int differs_from_plain_rounding = 0;
  for (int n = 0; n <= 255; ++n) {
    for (const double offset : {0.0, 0.25, 0.49, 0.5, 0.51, 0.75}) {
      const auto base = static_cast<float>((n + offset) / 255.0);
      for (const float v : {std::nextafter(base, -1.0F), base, std::nextafter(base, 2.0F)}) {
        const int expected = vertex_byte_by_integers(v, 13);
        ASSERT_EQ(byte_of_vertex_color(p, v), expected) << v;
        ASSERT_EQ(byte_of_vertex_color(profiles::geforce2, v), expected) << v;
        differs_from_plain_rounding += expected != byte_of_color(v) ? 1 : 0;
      }
    }
    const int exact = byte_of_vertex_color(p, static_cast<float>(n / 255.0));
    EXPECT_EQ(exact, n);
  }
  EXPECT_GT(differs_from_plain_rounding, 100) << "the truncation of the mantissa must show";
}

TEST(VertexColor, FollowsTheDefinitionForEveryMantissaThatIsKept) {
  // Exponents 2^-1 to 2^-10, all 2^13 kept mantissas, with all dropped bits clear and all set.
  for (int exponent = 1; exponent <= 10; ++exponent) {
    for (std::uint32_t kept = 0; kept < 8192; ++kept) {
      for (const std::uint32_t dropped : {0U, 1023U}) {
        const std::uint32_t bits = (static_cast<std::uint32_t>(127 - exponent) << 23) | (kept << 10) | dropped;
        float v = 0;
        std::memcpy(&v, &bits, sizeof v);
        ASSERT_EQ(byte_of_vertex_color(profiles::geforce2, v), vertex_byte_by_integers(v, 13)) << v;
      }
    }
  }
}

TEST(VertexColor, IsClamped) {
  const HardwareProfile& p = profiles::geforce2;
  EXPECT_EQ(byte_of_vertex_color(p, -1.0F), 0);
  EXPECT_EQ(byte_of_vertex_color(p, -0.0F), 0);
  EXPECT_EQ(byte_of_vertex_color(p, kNan), 0);
  EXPECT_EQ(byte_of_vertex_color(p, -kInfinity), 0);
  EXPECT_EQ(byte_of_vertex_color(p, std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(byte_of_vertex_color(p, std::nextafter(1.0F, 0.0F)), 255);
  EXPECT_EQ(byte_of_vertex_color(p, 1.0F), 255);
  EXPECT_EQ(byte_of_vertex_color(p, 4.0F), 255);
  EXPECT_EQ(byte_of_vertex_color(p, kInfinity), 255);
}

TEST(VertexColor, KeptBitsAreTheProfiles) {
  HardwareProfile p = profiles::geforce2;
  for (const int bits : {4, 8, 13, 23}) {
    p.vertex_color_mantissa_bits.value = bits;
    for (int i = 0; i < 4096; ++i) {
      const float v = static_cast<float>(i) / 4096.0F + 0.0001F;
      ASSERT_EQ(byte_of_vertex_color(p, v), vertex_byte_by_integers(v, bits)) << bits << " " << v;
    }
  }
}

TEST(VertexColor, MatchesTheHardwareTable) {
  int rows = 0;
  for (const auto& row : test::read_hardware_table("nv2a_vertex_color_to_byte")) {
    const float v = std::stof(row.at("float"));
    EXPECT_EQ(byte_of_vertex_color(profiles::nv2a, v), std::stoi(row.at("hw"))) << row.at("float");
    ++rows;
  }
  EXPECT_EQ(rows, 16);
}

TEST(VertexColor, MatchesThePointParameterPicture) {
  int rows = 0;
  for (const auto& row : test::read_hardware_table("nv2a_final_AB_pointparams")) {
    const float v = std::stof(row.at("diffuse_float"));
    EXPECT_EQ(byte_of_vertex_color(profiles::nv2a, v), std::stoi(row.at("hw_full"))) << row.at("diffuse_float");
    ++rows;
  }
  EXPECT_EQ(rows, 273);
}

}  // namespace
}  // namespace ninebit
