// The differences that a comparison loses: against formulas, and against every pair of bytes.
#include "src/shadow/index_order/lost_differences.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;

LostDifferences measured(const HardwareProfile& profile, IndexFormat format, IndexScales scales = IndexScales::both) {
  auto lost = LostDifferences::measure(profile, format, scales);
  EXPECT_TRUE(lost.ok());
  return *lost;
}

int sum_of_squares(const CodeBytes& d) {
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// Compares all differences up to 20 per channel with `lost(sum of squares)`.
template <class Lost>
void expect_formula(const LostDifferences& found, const Lost& lost) {
  std::size_t count = 0;
  const auto range = [&](int channel) { return channel < found.channels() ? 20 : 0; };
  for (int z = -range(2); z <= range(2); ++z) {
    for (int y = -range(1); y <= range(1); ++y) {
      for (int x = -range(0); x <= range(0); ++x) {
        const CodeBytes d{x, y, z};
        const bool expected = lost(sum_of_squares(d));
        ASSERT_EQ(found.always(d), expected) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(found.never(d), !expected) << x << ' ' << y << ' ' << z;
        if (expected && sum_of_squares(d) > 0) ++count;
      }
    }
  }
  EXPECT_EQ(found.all_always().size(), count);
}

TEST(LostDifferences, TruncationLosesSumsOfSquaresBelowOne) {
  for (const IndexFormat format :
       {IndexFormat::rgb, IndexFormat::luminance_alpha, IndexFormat::luminance, IndexFormat::alpha}) {
    SCOPED_TRACE(name_of(format));
    expect_formula(measured(profiles::geforce2, format), [](int s) { return 64 * s < 255; });
  }
  EXPECT_EQ(measured(profiles::geforce2, IndexFormat::rgb).all_always().size(), 26U);
  EXPECT_EQ(measured(profiles::geforce2, IndexFormat::luminance_alpha).all_always().size(), 8U);
  EXPECT_EQ(measured(profiles::geforce2, IndexFormat::alpha).all_always().size(), 2U);
}

TEST(LostDifferences, EachScaleThatIsLeftOutWidensTheTolerance) {
  const auto with = [](IndexScales scales) { return measured(profiles::geforce2, IndexFormat::rgb, scales); };
  expect_formula(with(IndexScales::first), [](int s) { return 16 * s < 255; });
  expect_formula(with(IndexScales::second), [](int s) { return 4 * s < 255; });
  expect_formula(with(IndexScales::none), [](int s) { return s < 255; });
  EXPECT_EQ(with(IndexScales::first).radius(), 3);
  EXPECT_EQ(with(IndexScales::second).radius(), 7);
  EXPECT_EQ(with(IndexScales::none).radius(), 15);
}

TEST(LostDifferences, RoundingLosesSumsOfSquaresBelowOneHalf) {
  for (const HardwareProfile* profile : {&profiles::nv2a, &profiles::ideal}) {
    SCOPED_TRACE(profile->name);
    expect_formula(measured(*profile, IndexFormat::rgb), [](int s) { return 64 * s * 2 < 255; });
  }
}

// Every pair of bytes of one channel, evaluated: what is always lost is lost for all of them, and so on.
TEST(LostDifferences, AgreeWithEveryPairOfOneChannel) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    SCOPED_TRACE(profile.name);
    const LostDifferences lost = measured(profile, IndexFormat::alpha);
    const Program program = normalize(*index_comparison_state(profile, IndexFormat::alpha), profile);
    std::array<int, 511> count{}, lost_count{};
    for (int own = 0; own < 256; ++own) {
      for (int other = 0; other < 256; ++other) {
        FragmentInputs inputs;
        inputs.primary = {0, 0, 0, static_cast<std::uint8_t>(own)};
        inputs.texture[0] = Texel{.value = {0, 0, 0, static_cast<std::uint8_t>(other)}, .format = TextureFormat::alpha};
        const auto out = evaluate_fragment(program, initial_registers(profile, inputs));
        const auto d = static_cast<std::size_t>(own - other + 255);
        ++count[d];
        if (to_byte(profile, out.color[kAlpha]) == 0) ++lost_count[d];
      }
    }
    for (int d = -255; d <= 255; ++d) {
      const auto i = static_cast<std::size_t>(d + 255);
      EXPECT_EQ(lost.always({d, 0, 0}), lost_count[i] == count[i]) << d;
      EXPECT_EQ(lost.never({d, 0, 0}), lost_count[i] == 0) << d;
      if (lost_count[i] > 0) {
        EXPECT_LE(std::abs(d), lost.radius());
      }
    }
  }
}

// With fewer bits in a register a difference may be lost for some codes only.
TEST(LostDifferences, EightBitsLoseSomeDifferencesSometimes) {
  const LostDifferences lost = measured(profiles::geforce256_8bit, IndexFormat::alpha);
  bool sometimes = false;
  for (int d = 1; d <= lost.radius(); ++d) sometimes = sometimes || (!lost.always({d, 0, 0}) && !lost.never({d, 0, 0}));
  EXPECT_TRUE(sometimes);
}

}  // namespace
