// Index steps: the counts of one channel, and counting by classes against brute force.
#include "ninebit/study/index_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/shadow/index_cube.h"
#include "src/study/index_steps/false_matches.h"

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

using Index = std::array<std::uint8_t, 3>;
using Pairs = std::vector<std::pair<Index, Index>>;

Bytes4 color_of(StudyFormat format, const Index& i) {
  switch (format) {
    case StudyFormat::channel:
      return {i[0], 0, 0, 255};
    case StudyFormat::rgb:
      return {i[0], i[1], i[2], 255};
    case StudyFormat::luminance_alpha:
      return {i[0], i[0], i[0], i[1]};
    case StudyFormat::luminance:
      return {i[0], i[0], i[0], 255};
    case StudyFormat::alpha:
      break;
  }
  return {0, 0, 0, i[0]};
}

TextureFormat texture_of(StudyFormat format) {
  return format == StudyFormat::luminance_alpha ? TextureFormat::luminance_alpha
         : format == StudyFormat::luminance     ? TextureFormat::luminance
         : format == StudyFormat::alpha         ? TextureFormat::alpha
                                                : TextureFormat::rgb;
}

// Whether the program takes each pair for equal: evaluated in batches, one pair in 16 by the reference, too.
std::vector<bool> taken_for_equal(const Program& program, const HardwareProfile& profile, StudyFormat format,
                                  const Pairs& pairs) {
  const BatchProgram batch(program, {.color = {false, false, false, true}});
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::vector<bool> equal;
  equal.reserve(pairs.size());
  for (std::size_t first = 0; first < pairs.size(); first += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, pairs.size() - first);
    std::array<s9, kBatchSize> expected{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto& [own, other] = pairs[first + lane];
      FragmentInputs in{.primary = color_of(format, own)};
      in.texture[0] = Texel{.value = color_of(format, other), .format = texture_of(format)};
      const RegisterFile initial = initial_registers(profile, in);
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers->plane[r][c][lane] = initial.value[r][c];
      }
      if (lane % 16 == 0) expected[lane] = evaluate(program, initial)[kAlpha];
    }
    batch.run(*registers, count, *out);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const s9 alpha = out->plane[kAlpha][lane];
      if (lane % 16 == 0) {
        EXPECT_EQ(alpha, expected[lane]) << profile.name;
      }
      equal.push_back(to_byte(profile, alpha) == 0);
    }
  }
  return equal;
}

// Every ordered pair of two different indices, one by one; or each digit's pairs alone, the others being 0.
std::uint64_t by_brute_force(const Program& program, const HardwareProfile& profile, StudyFormat format,
                             const std::vector<std::uint8_t>& values, bool separate) {
  const auto digits = static_cast<std::size_t>(channels_of(format));
  std::vector<Index> all{Index{}};
  for (std::size_t d = 0; d < digits; ++d) {
    std::vector<Index> longer;
    for (const Index& index : all) {
      for (const std::uint8_t value : values) {
        longer.push_back(index);
        longer.back()[d] = value;
      }
    }
    all = longer;
  }
  Pairs pairs;
  for (const Index& own : all) {
    for (const Index& other : all) {
      if (own != other) pairs.emplace_back(own, other);
    }
  }
  if (!separate) {
    const std::vector<bool> equal = taken_for_equal(program, profile, format, pairs);
    return static_cast<std::uint64_t>(std::count(equal.begin(), equal.end(), true));
  }
  std::vector<std::array<std::array<bool, 256>, 256>> of_digit(digits);
  for (std::size_t d = 0; d < digits; ++d) {
    Pairs alone;
    for (const std::uint8_t own : values) {
      for (const std::uint8_t other : values) {
        alone.emplace_back();
        alone.back().first[d] = own;
        alone.back().second[d] = other;
      }
    }
    const std::vector<bool> equal = taken_for_equal(program, profile, format, alone);
    for (std::size_t i = 0; i < alone.size(); ++i) of_digit[d][alone[i].first[d]][alone[i].second[d]] = equal[i];
  }
  return static_cast<std::uint64_t>(std::count_if(pairs.begin(), pairs.end(), [&](const auto& pair) {
    for (std::size_t d = 0; d < digits; ++d) {
      if (!of_digit[d][pair.first[d]][pair.second[d]]) return false;
    }
    return true;
  }));
}

using Way = FalseMatchCounter::Way;

FalseMatches counted(const Program& program, const HardwareProfile& profile, StudyFormat format,
                     const std::vector<std::uint8_t>& values) {
  const auto counter = FalseMatchCounter::prepare(program, profile, format, {});
  if (!counter) throw std::runtime_error(counter.error().text());
  const auto count = counter->count(values, false, {});
  if (!count) throw std::runtime_error(count.error().text());
  return *count;
}

// Small sets of values with small differences, which are what gets lost, and large ones; steps of one channel.
TEST(IndexSteps, CountsAreThoseOfBruteForce) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::vector<std::vector<std::uint8_t>> few{
      {0, 1, 2, 4, 11}, {100, 101, 103, 110, 255}, {0, 127, 128, 254, 255}};
  const std::vector<std::vector<std::uint8_t>> more{{0, 1, 2, 3, 5, 8, 13, 21, 22}, {17, 84, 85, 86, 170, 171, 254}};
  for (const HardwareProfile& profile : hardware_profiles()) {
    std::uint64_t all_lost = 0;
    for (const IndexVariant& v : index_variants()) {
      for (const StudyFormat format : kStudyFormats) {
        if (v.separate && channels_of(format) == 1) continue;
        const Program program = program_of(profile, format, v.name);
        const auto counter = FalseMatchCounter::prepare(program, profile, format, {});
        ASSERT_TRUE(counter.ok()) << counter.error().text();
        std::vector<std::vector<std::uint8_t>> sets = channels_of(format) == 3 ? few : more;
        if (channels_of(format) == 3) sets.push_back(values_of_step(85));
        if (channels_of(format) == 2) sets.push_back(values_of_step(32));
        // All 65,536 pairs, and those of a step of 3, in the format that has no other channels to go with it.
        for (const int step : {1, 3, 5, 7, 16, 255}) {
          const bool is_alone = channels_of(format) == 1 && (format == StudyFormat::channel || step > 3);
          if (is_alone || step == 255) sets.push_back(values_of_step(step));
        }
        for (const auto& values : sets) {
          const auto count = counter->count(values, v.separate, {});
          ASSERT_TRUE(count.ok()) << count.error().text();
          ASSERT_EQ(count->false_matches, by_brute_force(program, profile, format, values, v.separate))
              << profile.name << ' ' << v.name << ' ' << name_of(format) << ", " << values.size() << " values from "
              << int{values[0]} << ", " << int{values[1]};
          all_lost += count->false_matches;
        }
      }
    }
    EXPECT_GT(all_lost, 1000U) << profile.name;
  }
}

// The order of the classes' products is used, not only assumed: every combination of classes gives the same, with rgb
// all 511³ triples of differences.
TEST(IndexSteps, EveryCombinationOfClassesCountsTheSame) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile& profile : hardware_profiles()) {
    const bool integer = profile.arithmetic == Arithmetic::integer;
    for (const char* name : {"both-x4", "first-x4", "second-x4", "no-scale"}) {
      const bool all_apart = std::string_view(name) == "no-scale";  // a class for each of the 511 differences
      for (const StudyFormat format : kStudyFormats) {
        const Program program = program_of(profile, format, name);
        const auto fast = FalseMatchCounter::prepare(program, profile, format, {});
        const auto slow = FalseMatchCounter::prepare(program, profile, format, {}, Way::every_combination);
        ASSERT_TRUE(fast.ok() && slow.ok());
        for (const int step : {1, 3, 5, 7, 16, 255}) {
          const int least = profile.name == "geforce2" && all_apart ? 1 : integer ? 5 : all_apart ? 16 : 255;
          if (channels_of(format) == 3 && step < least) continue;
          if (channels_of(format) == 2 && step < (integer ? 1 : 7)) continue;
          const auto expected = slow->count(values_of_step(step), false, {});
          const auto count = fast->count(values_of_step(step), false, {});
          ASSERT_TRUE(expected.ok() && count.ok());
          ASSERT_EQ(count->false_matches, expected->false_matches)
              << profile.name << ' ' << name << ' ' << name_of(format) << " step " << step;
        }
      }
    }
  }
}

// Programs of other forms than the article's: one is its inverse, the others do not sum a product of each digit.
TEST(IndexSteps, OtherPrograms) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  struct Other {
    CombinerState state;
    StudyFormat format = StudyFormat::rgb;
    bool summed = false;
  };
  std::array<std::uint64_t, 5> lost{};
  for (const HardwareProfile* profile :
       {&profiles::geforce2, &profiles::nv2a, &profiles::ideal, &profiles::float_shader}) {
    const CombinerState article = *index_comparison_state(*profile);
    CombinerState upside_down = article;
    upside_down.final_combiner.g.mapping = InputMapping::unsigned_invert;
    CombinerState blue_alone = article;  // no dot product: the final combiner takes blue's square
    blue_alone.general[1].rgb.out.ab_dot_product = false;
    CombinerState chosen = article;  // blue's square or, where texture 0's alpha says so, 0
    chosen.general[1].rgb.out = {.ab = Register::discard,
                                 .cd = Register::discard,
                                 .sum = Register::spare1,
                                 .scale = Scale::by_four,
                                 .mux_sum = true};
    CombinerState crossed = *index_comparison_state(*profile, IndexFormat::luminance_alpha);  // luminance times alpha
    crossed.general[1].alpha.b.usage = ComponentUsage::blue;
    crossed.general[1].alpha.d.usage = ComponentUsage::alpha;
    const std::vector<Other> programs{{upside_down, StudyFormat::rgb, true},
                                      {blue_alone, StudyFormat::rgb, true},
                                      {chosen, StudyFormat::rgb, false},
                                      {article, StudyFormat::luminance, false},  // the same square three times
                                      {crossed, StudyFormat::luminance_alpha, false}};
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const auto program = compile(programs[i].state, *profile);
      ASSERT_TRUE(program.ok()) << program.error().text();
      const StudyFormat format = programs[i].format;
      const auto sum = digit_sum(*program, digits_after_first_stage(*program, digits_before_first_stage(format)));
      EXPECT_EQ(sum.has_value(), programs[i].summed) << i;
      const std::vector<std::uint8_t> values{0, 1, 2, 5, 70};
      const FalseMatches count = counted(*program, *profile, format, values);
      EXPECT_EQ(count.false_matches, by_brute_force(*program, *profile, format, values, false)) << profile->name << i;
      lost[i] += count.false_matches;
    }
  }
  for (const std::uint64_t of_program : lost) EXPECT_GT(of_program, 0U);
}

// A program may copy indices into its last stage: then no two pairs are alike, and three channels of such have more
// combinations than can be evaluated.
TEST(IndexSteps, TooManyCombinationsAreRefused) {
  for (const HardwareProfile* profile : {&profiles::geforce2, &profiles::float_shader}) {
    CombinerState late = *index_comparison_state(*profile);
    late.general[1].rgb = late.general[0].rgb;
    late.general[1].rgb.out = {
        .ab = Register::discard, .cd = Register::discard, .sum = Register::spare1, .mux_sum = true};
    late.general[0] = GeneralCombiner{};
    late.final_combiner.g = {Register::spare1, InputMapping::unsigned_identity, ComponentUsage::blue};
    const Program program = normalize(late, *profile);
    const auto counter = FalseMatchCounter::prepare(program, *profile, StudyFormat::rgb, {});
    ASSERT_TRUE(counter.ok()) << counter.error().text();
    const auto count = counter->count(values_of_step(1), false, {});
    ASSERT_FALSE(count.ok());
    EXPECT_NE(count.error().message.find("too many cases"), std::string::npos) << count.error().message;
    EXPECT_TRUE(counter->count(values_of_step(85), false, {}).ok());
  }
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
