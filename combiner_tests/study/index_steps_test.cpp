// Index steps: the table of docs/numerics.md, and the classes against brute force.
#include "ninebit/study/index_steps.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;

const IndexVariant& variant(std::string_view name) {
  for (const IndexVariant& v : index_variants()) {
    if (v.name == name) return v;
  }
  throw std::runtime_error("no variant " + std::string(name));
}

Program program_of(const HardwareProfile& profile, StudyFormat format, std::string_view name) {
  const auto state = index_variant_state(profile, format, variant(name));
  if (!state) throw std::runtime_error(state.error().text());
  const auto program = compile(*state, profile);
  if (!program) throw std::runtime_error(program.error().text());
  return *program;
}

std::uint64_t losses(const HardwareProfile& profile, StudyFormat format, std::string_view name, int step) {
  const auto count = count_false_matches(program_of(profile, format, name), profile, format, step,
                                         variant(name).separate);
  if (!count) throw std::runtime_error(count.error().text());
  return count->false_matches;
}

HardwareProfile early_to_nearest() {
  HardwareProfile p = profiles::geforce2_early_truncation;
  p.general_narrowing.value = Narrowing::nearest_halves_up;
  return p;
}

// The article's ladder, as the design of the arithmetic demands it.
TEST(IndexSteps, OneChannelLosesWhatTheTableSays) {
  constexpr std::array steps{1, 2, 3, 4, 8, 16};
  const auto expect = [&](const HardwareProfile& profile, std::string_view name,
                          const std::array<std::uint64_t, 6>& lost) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(losses(profile, StudyFormat::channel, name, steps[i]), lost[i])
          << profile.name << ' ' << name << " step " << steps[i];
    }
  };
  expect(profiles::geforce2, "both-x4", {510, 0, 0, 0, 0, 0});
  expect(early_to_nearest(), "both-x4", {1018, 254, 0, 0, 0, 0});
  expect(profiles::geforce2_early_truncation, "both-x4", {1524, 254, 170, 0, 0, 0});
  expect(profiles::geforce256_8bit, "both-x4", {1272, 254, 86, 0, 0, 0});
  expect(profiles::geforce2, "no-scale", {7440, 1736, 830, 372, 62, 0});
}

// Every ordered pair of two different indices, one by one.
std::uint64_t by_brute_force(const Program& program, const HardwareProfile& profile, StudyFormat format, int step) {
  std::vector<FragmentInputs> all;
  for (int r = 0; r <= 255; r += step) {
    if (format == StudyFormat::luminance) {
      const auto l = static_cast<std::uint8_t>(r);
      all.push_back({.primary = {l, l, l, 255}});
      continue;
    }
    if (format == StudyFormat::alpha) {
      all.push_back({.primary = {0, 0, 0, static_cast<std::uint8_t>(r)}});
      continue;
    }
    for (int g = 0; g <= 255; g += step) {
      const auto l = static_cast<std::uint8_t>(r), second = static_cast<std::uint8_t>(g);
      if (format == StudyFormat::luminance_alpha) {
        all.push_back({.primary = {l, l, l, second}});
        continue;
      }
      for (int b = 0; b <= 255; b += step) all.push_back({.primary = {l, second, static_cast<std::uint8_t>(b), 255}});
    }
  }
  const TextureFormat texture = format == StudyFormat::rgb               ? TextureFormat::rgb
                                : format == StudyFormat::luminance_alpha ? TextureFormat::luminance_alpha
                                : format == StudyFormat::luminance       ? TextureFormat::luminance
                                                                         : TextureFormat::alpha;
  std::uint64_t lost = 0;
  for (const FragmentInputs& own : all) {
    for (const FragmentInputs& other : all) {
      if (own.primary == other.primary) continue;
      FragmentInputs in = own;
      in.texture[0] = Texel{.value = other.primary, .format = texture};
      if (to_byte(profile, evaluate(program, initial_registers(profile, in))[kAlpha]) == 0) ++lost;
    }
  }
  return lost;
}

TEST(IndexSteps, ClassesCountWhatBruteForceCounts) {
  std::uint64_t all_lost = 0;
  for (const HardwareProfile& profile : hardware_profiles()) {
    const bool slow = profile.arithmetic != Arithmetic::integer;
    for (const char* name : {"both-x4", "first-x4", "second-x4", "no-scale"}) {
      for (const auto& [format, step] : std::vector<std::pair<StudyFormat, int>>{{StudyFormat::rgb, slow ? 85 : 40},
                                                                               {StudyFormat::rgb, slow ? 127 : 51},
                                                                               {StudyFormat::luminance_alpha, slow ? 60 : 12},
                                                                               {StudyFormat::luminance, slow ? 9 : 1},
                                                                               {StudyFormat::alpha, slow ? 9 : 1}}) {
        const Program program = program_of(profile, format, name);
        const auto counted = count_false_matches(program, profile, format, step);
        ASSERT_TRUE(counted.ok()) << counted.error().text();
        ASSERT_EQ(counted->false_matches, by_brute_force(program, profile, format, step))
            << profile.name << ' ' << name << ' ' << name_of(format) << " step " << step;
        all_lost += counted->false_matches;
      }
    }
  }
  EXPECT_GT(all_lost, 1000U);
}

// Small channel differences are what gets lost: RGB codes with channels near each other, some of them far.
TEST(IndexSteps, PairsOfNeighbouringRgbIndicesAreWeightedRight) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = program_of(profile, StudyFormat::rgb, "both-x4");
  // Step 1 loses a pair if no channel differs by more than one and … : counted by hand over the 27 differences.
  std::uint64_t expected = 0;
  for (int r = -1; r <= 1; ++r) {
    for (int g = -1; g <= 1; ++g) {
      for (int b = -1; b <= 1; ++b) {
        const int squares = 16 * (r * r + g * g + b * b);
        if (squares == 0 || 4 * squares / 255 != 0) continue;
        expected += static_cast<std::uint64_t>(256 - std::abs(r)) * static_cast<std::uint64_t>(256 - std::abs(g)) *
                    static_cast<std::uint64_t>(256 - std::abs(b));
      }
    }
  }
  const auto counted = count_false_matches(program, profile, StudyFormat::rgb, 1);
  ASSERT_TRUE(counted.ok());
  EXPECT_EQ(counted->false_matches, expected);
  EXPECT_EQ(counted->codes, std::uint64_t{1} << 24);
  EXPECT_EQ(counted->pairs, (std::uint64_t{1} << 24) * ((std::uint64_t{1} << 24) - 1));
}

TEST(IndexSteps, SeparateComparisonsLoseWhereEachChannelLoses) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = program_of(profile, StudyFormat::rgb, "both-x4");
  const auto separate = count_false_matches(program, profile, StudyFormat::rgb, 1, true);
  ASSERT_TRUE(separate.ok());
  // A channel is taken for equal in 256 + 510 of its pairs.
  EXPECT_EQ(separate->false_matches, std::uint64_t{766} * 766 * 766 - (std::uint64_t{1} << 24));
}

TEST(IndexSteps, AMixedFirstStageIsRefused) {
  const HardwareProfile& profile = profiles::geforce2;
  auto state = *index_comparison_state(profile);
  state.general[0].rgb.out.sum = Register::discard;
  state.general[0].rgb.out.ab = Register::spare0;
  state.general[0].rgb.out.ab_dot_product = true;
  const Program program = normalize(state, profile);
  const auto counted = count_false_matches(program, profile, StudyFormat::rgb, 1);
  ASSERT_FALSE(counted.ok());
  EXPECT_NE(counted.error().message.find("more than one channel"), std::string::npos) << counted.error().message;
  EXPECT_TRUE(count_false_matches(program, profile, StudyFormat::channel, 1).ok());
}

TEST(IndexSteps, StepsOutOfRangeAndStopping) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = program_of(profile, StudyFormat::rgb, "no-scale");
  EXPECT_FALSE(count_false_matches(program, profile, StudyFormat::rgb, 0).ok());
  EXPECT_FALSE(count_false_matches(program, profile, StudyFormat::rgb, 256).ok());
  const auto stopped = count_false_matches(program, profile, StudyFormat::rgb, 1, false, [] { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

TEST(IndexSteps, TheSmallestSafeStepHasOnlySafeOnesAbove) {
  const auto row = [](int step, std::uint64_t lost) {
    return IndexStepRow{"p", StudyFormat::rgb, "v", step, {0, 0, lost}};
  };
  const std::vector<IndexStepRow> rows{row(1, 5), row(2, 0), row(3, 1), row(4, 0), row(5, 0)};
  EXPECT_EQ(smallest_safe_step(rows, "p", StudyFormat::rgb, "v"), 4);
  EXPECT_EQ(smallest_safe_step(std::span(rows).first(3), "p", StudyFormat::rgb, "v"), std::nullopt);
  EXPECT_EQ(smallest_safe_step(rows, "q", StudyFormat::rgb, "v"), std::nullopt);
}

}  // namespace
