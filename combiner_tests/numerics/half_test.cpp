// 16-bit floats: every half, and floats around every boundary between two of them.
#include "ninebit/numerics/half.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

Half half(unsigned bits) {
  return Half{static_cast<std::uint16_t>(bits)};
}

// The value of a finite half without its sign, from the definition of binary16.
double value_of(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10), fraction = static_cast<int>(bits & 1023U);
  return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
}

// The nearest half by search among all of them; a tie goes to the even one, and 2^16 stands for infinity.
unsigned nearest_bits(double magnitude) {
  static const std::vector<double> values = [] {
    std::vector<double> all;
    for (unsigned bits = 0; bits < 0x7C00; ++bits) all.push_back(value_of(bits));
    all.push_back(65536.0);
    return all;
  }();
  const auto above =
      static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), magnitude) - values.begin());
  if (above == values.size()) return 0x7C00;
  if (above == 0) return 0;
  const double down = magnitude - values[above - 1], up = values[above] - magnitude;
  const bool takes_lower = down < up || (down == up && (above - 1) % 2 == 0);
  return static_cast<unsigned>(takes_lower ? above - 1 : above);
}

TEST(Halves, EveryOneHasItsValueAndComesBack) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const float value = float_of(half(bits));
    const unsigned magnitude = bits & 0x7FFFU;
    if (magnitude > 0x7C00) {
      ASSERT_TRUE(std::isnan(value)) << bits;
    } else {
      ASSERT_EQ(std::fabs(static_cast<double>(value)), magnitude == 0x7C00 ? kInfinity : value_of(magnitude)) << bits;
    }
    ASSERT_EQ(std::signbit(value), bits >= 0x8000) << bits;
    ASSERT_EQ(half_of(value), half(bits)) << bits;
  }
}

void expect_nearest(float value) {
  const unsigned sign = std::signbit(value) ? 0x8000U : 0;
  const unsigned expected = sign | nearest_bits(std::fabs(static_cast<double>(value)));
  ASSERT_EQ(half_of(value).bits, expected) << value;
}

// The number halfway to the next half, which a float holds exactly, and the floats around it.
TEST(Halves, TiesGoToEven) {
  for (unsigned bits = 0; bits < 0x7C00; ++bits) {
    const double next = bits == 0x7BFF ? 65536.0 : value_of(bits + 1);
    const auto middle = static_cast<float>((value_of(bits) + next) / 2);
    ASSERT_EQ(middle, (value_of(bits) + next) / 2);
    ASSERT_EQ(half_of(middle).bits, bits + bits % 2) << bits;
    for (const float value : {middle, std::nextafter(middle, 0.0F), std::nextafter(middle, kInfinity)}) {
      expect_nearest(value);
      expect_nearest(-value);
    }
  }
}

// One float in 1,021 of all exponents, and of those that a half reaches one in 61.
TEST(Halves, AnyFloatGoesToTheNearest) {
  std::uint32_t tried = 0;
  for (std::uint32_t bits = 0; bits < 0x7F800000U; ++tried) {
    expect_nearest(std::bit_cast<float>(bits));
    expect_nearest(std::bit_cast<float>(bits | 0x80000000U));
    if (HasFatalFailure()) return;
    bits += bits > 0x32000000U && bits < 0x48000000U ? 61 : 1021;
  }
  EXPECT_GE(tried, 7000000U);
}

TEST(Halves, EndsOfTheRange) {
  EXPECT_EQ(half_of(65504.0F), half(0x7BFF));
  EXPECT_EQ(half_of(std::nextafter(65520.0F, 0.0F)), half(0x7BFF));
  EXPECT_EQ(half_of(65520.0F), half(0x7C00));
  EXPECT_EQ(half_of(kInfinity), half(0x7C00));
  EXPECT_EQ(half_of(-kInfinity), half(0xFC00));
  EXPECT_EQ(half_of(-std::numeric_limits<float>::max()), half(0xFC00));
  EXPECT_EQ(half_of(0x1p-25F), half(0));  // a tie between 0 and the smallest
  EXPECT_EQ(half_of(std::nextafter(0x1p-25F, 1.0F)), half(1));
  EXPECT_EQ(half_of(-0x1p-24F), half(0x8001));
  EXPECT_EQ(half_of(std::numeric_limits<float>::denorm_min()), half(0));
  EXPECT_EQ(half_of(-0.0F), half(0x8000));
  // A NaN stays one, also if all of its payload lies in bits that a half does not have.
  EXPECT_EQ(half_of(std::bit_cast<float>(0x7F800001U)), half(0x7E00));
  EXPECT_EQ(half_of(std::bit_cast<float>(0xFFC00000U)), half(0xFE00));
}

}  // namespace
}  // namespace ninebit::test
