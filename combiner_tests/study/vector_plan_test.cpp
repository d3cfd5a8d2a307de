// Plans: emulators with one fault and with many, each mended by what `verify` names. The tables of docs/emulators.md
// are what is counted here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "combiner_tests/study/emulator_model.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/study/vectors.h"

namespace ninebit {
namespace {

using test::EmulatorFault;

struct NamedFault {
  EmulatorFault fault;
  const char* mistake;
};

constexpr NamedFault kFaults[] = {
    {EmulatorFault::floats, "arithmetic = float32"},
    {EmulatorFault::third_of_products, "the third output beside a dot product is of the products"},
    {EmulatorFault::no_third_beside_dot, "no third output beside a dot product"},
    {EmulatorFault::zero_stage_skipped, "general combiners whose two input words are 0 are skipped"},
    {EmulatorFault::own_constants, "each stage's own constants, also where stage 0's are for all"},
    {EmulatorFault::final_last_constants, "the last stage's constants in the final combiner"},
    {EmulatorFault::sum_negative, "the colour sum adds negative registers"},
    {EmulatorFault::ef_unrounded, "E times F is not rounded"},
    {EmulatorFault::mix_unrounded, "AB + (1 - A)C is not rounded before D is added"},
    {EmulatorFault::alpha_reads_red, "alpha portions read red instead of blue"},
    {EmulatorFault::red_blue_swapped, "red and blue of the colour are exchanged"},
    {EmulatorFault::mux_swapped, "the mux takes AB for CD"},
    {EmulatorFault::registers_kept, "spare0's RGB and spare1 keep the last fragment's values"},
    {EmulatorFault::spare1_alpha_tex1, "spare1's alpha starts as texture 1's"},
    {EmulatorFault::cd_reads_ab, "C and D read what AB wrote"},
    {EmulatorFault::bias_of_products, "a sum has the bias of each of its products"},
    {EmulatorFault::mappings_keep_sign, "mappings other than unsigned identity keep the sign"},
    {EmulatorFault::third_unclamped, "third outputs of general combiners are not clamped"},
    {EmulatorFault::bytes_cut, "bytes of the colour are cut, not rounded"},
    {EmulatorFault::two_stages_at_least, "always two general combiners or more"},
    {EmulatorFault::invert_above_one, "1 - x of x above 1 is negative"},
    {EmulatorFault::sum_always_clamped, "the colour sum always clamped"},
    {EmulatorFault::sum_inverts_swapped, "the colour sum's two inversions exchanged"},
    {EmulatorFault::constant_alpha_one, "alpha of constants is 1"},
    {EmulatorFault::constants_abgr, "constants as ABGR"},
    {EmulatorFault::alpha_before_rgb_blue, "the alpha portion is written before the RGB portion's blue to alpha"},
    {EmulatorFault::no_output_clamp, "outputs of general combiners are not clamped"},
    {EmulatorFault::no_scale, "no scale"},
    {EmulatorFault::no_bias, "no bias"},
    {EmulatorFault::no_mux, "the sum instead of the mux"},
    {EmulatorFault::no_blue_to_alpha, "no blue to alpha"},
    {EmulatorFault::no_sum_inverts, "the colour sum never inverted"},
    {EmulatorFault::alpha_reads_alpha, "alpha portions read alpha instead of blue"},
    {EmulatorFault::spare0_alpha_kept, "spare0's alpha keeps the last fragment's value"},
    {EmulatorFault::alpha_reads_rgb_written, "the alpha portion reads what the RGB portion wrote"},
    {EmulatorFault::eight_stages_none, "eight general combiners count as none"},
    {EmulatorFault::sum_never_clamped, "the colour sum never clamped"},
    {EmulatorFault::mux_by_threshold, "mux always by the threshold of spare0's alpha"},
    {EmulatorFault::final_zero_shows_zero, "a final combiner whose two words are 0 shows 0"},
    {EmulatorFault::final_g_reads_red, "G of the final combiner reads red instead of blue"},
    {EmulatorFault::clamped_when_read,
     "outputs of general combiners are clamped to 1 only where they are read as unsigned identity"},
};

std::string mistake_of(EmulatorFault fault) {
  for (const NamedFault& one : kFaults) {
    if (one.fault == fault) return one.mistake;
  }
  return {};
}

const VectorPack& pack() {
  static const VectorPack made = [] {
    auto of_words = make_vector_pack(profiles::nv2a, {.programs = kQuickVectorPrograms});
    const auto read = read_vector_pack(print_vector_pack(*of_words), "v.txt", profiles::nv2a);
    EXPECT_TRUE(read.ok());
    return *read;
  }();
  return made;
}

VectorVerdict judged(const std::set<EmulatorFault>& faults) {
  VectorResults results;
  const auto colors = test::emulator_colors(pack(), faults);
  for (std::size_t i = 0; i < colors.size(); ++i) results.programs[i] = {0, colors[i]};
  auto verdict = judge_vectors(pack(), results, 0);
  EXPECT_TRUE(verdict.ok());
  return *std::move(verdict);
}

// Floats and cut bytes are also one mistake together.
bool names(const VectorVerdict::Step& step, EmulatorFault fault) {
  const std::string mistake = mistake_of(fault);
  const bool of_both = fault == EmulatorFault::floats || fault == EmulatorFault::bytes_cut;
  return step.mistake.name == mistake || std::find(step.same.begin(), step.same.end(), mistake) != step.same.end() ||
         (of_both && step.mistake.name == "arithmetic = float32, and bytes of the colour are cut, not rounded");
}

std::string text_of(const VectorVerdict& verdict) {
  std::string text;
  for (const auto& step : verdict.plan) {
    text += "  " + step.mistake.name + ": explains " + std::to_string(step.mistake.explains) + ", breaks " +
            std::to_string(step.breaks) + '\n';
  }
  return text + "  unexplained: " + std::to_string(verdict.unexplained) + " of " + std::to_string(verdict.differ) +
         '\n';
}

// 16238 as "16,238".
std::string figure(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

// A row of a table that docs/emulators.md has.
void expect_row(const std::vector<std::string>& cells) {
  static const std::string page = [] {
    std::ifstream file(NINEBIT_SOURCE_DIR "/docs/emulators.md");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }();
  std::string row;
  for (const std::string& cell : cells) row += "| " + cell + (cell.empty() ? "" : " ");
  row += "|\n";
  EXPECT_NE(page.find('\n' + row), std::string::npos) << "docs/emulators.md does not have the row\n" << row;
}

TEST(VectorPlan, TheModelWithoutFaultsPasses) {
  EXPECT_EQ(judged({}).differ, 0U);
}

// Whether all models are judged, also those that take minutes.
bool judges_all() {
  return std::getenv("NINEBIT_JOURNEYS") != nullptr;
}

// One fault gives a plan of one mistake, the right one. What is not rounded before D is added shows nothing alone.
// NINEBIT_JOURNEYS=all takes each fault, other runs every third, others each day.
TEST(VectorPlan, SingleFaultsAreNamed) {
  if (test::kSanitized) GTEST_SKIP() << "too slow; the build without sanitizers runs this";
  std::size_t exact = 0, seen = 0;
  std::string others;
  const std::size_t step = judges_all() ? 1 : 3;
  for (std::size_t i = static_cast<std::size_t>(std::time(nullptr) / 86400) % step; i < std::size(kFaults); i += step) {
    const NamedFault& one = kFaults[i];
    SCOPED_TRACE(one.mistake);
    const VectorVerdict verdict = judged({one.fault});
    EXPECT_EQ(verdict.differ == 0, one.fault == EmulatorFault::mix_unrounded);
    if (verdict.differ == 0) continue;
    ++seen;
    ASSERT_EQ(verdict.plan.size(), 1U) << text_of(verdict);
    EXPECT_TRUE(names(verdict.plan.front(), one.fault)) << text_of(verdict);
    if (verdict.unexplained == 0 && verdict.plan.front().same.empty()) {
      ++exact;
    } else {
      others += one.mistake + std::string("\n") + text_of(verdict);
    }
    std::string same;
    for (const std::string& other : verdict.plan.front().same) same += (same.empty() ? "" : "; ") + other;
    expect_row({one.mistake, figure(verdict.differ), figure(verdict.unexplained), same});
    // Floats of another order of operations round otherwise.
    const bool is_float = one.fault == EmulatorFault::floats;
    EXPECT_LE(verdict.unexplained, is_float ? verdict.differ / 10 : 2) << text_of(verdict);
  }
  if (judges_all()) {
    EXPECT_GE(exact + 5, seen) << others;
  }
}

// The smallest program of a step shows it, and the pack's words of it run as its state does.
TEST(VectorPlan, AStepNamesASmallProgramThatShowsIt) {
  const VectorVerdict verdict = judged({EmulatorFault::no_scale, EmulatorFault::mux_swapped});
  ASSERT_EQ(verdict.plan.size(), 2U) << text_of(verdict);
  const auto colors = test::emulator_colors(pack(), {EmulatorFault::no_scale, EmulatorFault::mux_swapped});
  for (const VectorVerdict::Step& step : verdict.plan) {
    const VectorProgram& program = pack().programs[step.program];
    EXPECT_NE(colors[step.program][step.fragment], program.expected[step.fragment]);
    const bool has_scale = program.state.general[0].rgb.out.scale != Scale::none ||
                           program.state.general[0].alpha.out.scale != Scale::none;
    const bool has_mux = program.state.general[0].rgb.out.mux_sum || program.state.general[0].alpha.out.mux_sum;
    EXPECT_TRUE(step.mistake.name == "no scale" ? has_scale : has_mux) << step.mistake.name;
  }
}

// Faults that touch the same programs: of each alone, more than one fragment in eight breaks.
TEST(VectorPlan, FaultsOfOneOperationAreNamedTogether) {
  if (test::kSanitized) GTEST_SKIP() << "too slow; the build without sanitizers runs this";
  const std::set<EmulatorFault> faults{EmulatorFault::mux_swapped, EmulatorFault::mux_by_threshold,
                                       EmulatorFault::alpha_reads_red};
  const VectorVerdict verdict = judged(faults);
  ASSERT_EQ(verdict.plan.size(), faults.size()) << text_of(verdict);
  for (const EmulatorFault fault : faults) {
    EXPECT_TRUE(
        std::any_of(verdict.plan.begin(), verdict.plan.end(), [&](const auto& step) { return names(step, fault); }))
        << mistake_of(fault) << '\n'
        << text_of(verdict);
  }
  EXPECT_EQ(verdict.unexplained, 0U) << text_of(verdict);
}

struct Emulator {
  const char* name;
  std::set<EmulatorFault> faults;
};

const Emulator kEmulators[] = {
    {"Bochs",
     {EmulatorFault::floats, EmulatorFault::no_output_clamp, EmulatorFault::no_scale, EmulatorFault::no_bias,
      EmulatorFault::no_mux, EmulatorFault::no_blue_to_alpha, EmulatorFault::no_sum_inverts,
      EmulatorFault::alpha_reads_alpha, EmulatorFault::spare0_alpha_kept, EmulatorFault::zero_stage_skipped,
      EmulatorFault::own_constants, EmulatorFault::final_last_constants, EmulatorFault::third_of_products,
      EmulatorFault::sum_negative, EmulatorFault::sum_never_clamped, EmulatorFault::final_zero_shows_zero,
      EmulatorFault::registers_kept}},
    {"xemu", {EmulatorFault::floats, EmulatorFault::sum_negative, EmulatorFault::final_zero_shows_zero}},
    {"Cxbx-Reloaded",
     {EmulatorFault::floats, EmulatorFault::clamped_when_read, EmulatorFault::bias_of_products,
      EmulatorFault::sum_always_clamped, EmulatorFault::no_third_beside_dot, EmulatorFault::cd_reads_ab,
      EmulatorFault::alpha_reads_rgb_written, EmulatorFault::spare1_alpha_tex1}},
    {"MAME",
     {EmulatorFault::floats, EmulatorFault::mux_swapped, EmulatorFault::no_third_beside_dot,
      EmulatorFault::no_blue_to_alpha, EmulatorFault::no_sum_inverts, EmulatorFault::alpha_reads_red,
      EmulatorFault::bytes_cut, EmulatorFault::own_constants, EmulatorFault::registers_kept,
      EmulatorFault::mux_by_threshold, EmulatorFault::final_zero_shows_zero, EmulatorFault::final_g_reads_red}},
};

// At least 80 % of the faults of each are named, and nothing that it does not do. Bochs with NINEBIT_JOURNEYS=all.
TEST(VectorPlan, EmulatorsWithManyFaultsAreMended) {
  for (const Emulator& emulator : kEmulators) {
    if (test::kSanitized && emulator.name != std::string("xemu")) continue;  // too slow
    if (!judges_all() && emulator.name == std::string("Bochs")) continue;
    SCOPED_TRACE(emulator.name);
    const VectorVerdict verdict = judged(emulator.faults);
    std::size_t named = 0, wrong = 0;
    for (const EmulatorFault fault : emulator.faults) {
      named +=
          std::any_of(verdict.plan.begin(), verdict.plan.end(), [&](const auto& step) { return names(step, fault); })
              ? 1U
              : 0U;
    }
    EXPECT_GE(10 * named, 8 * emulator.faults.size()) << text_of(verdict);
    for (const VectorVerdict::Step& step : verdict.plan) {
      const bool is_made = std::any_of(emulator.faults.begin(), emulator.faults.end(),
                                       [&](EmulatorFault fault) { return names(step, fault); });
      EXPECT_TRUE(is_made) << "named, but not made: " << step.mistake.name << '\n' << text_of(verdict);
      wrong += is_made ? 0U : 1U;
    }
    expect_row({emulator.name, std::to_string(emulator.faults.size()), std::to_string(named), std::to_string(wrong),
                figure(verdict.differ), figure(verdict.unexplained)});
    EXPECT_LE(20 * verdict.unexplained, 2 * verdict.differ) << text_of(verdict);
    // Who mends what the plan names is done, but for what the next plan names.
    std::set<EmulatorFault> left;
    std::copy_if(emulator.faults.begin(), emulator.faults.end(), std::inserter(left, left.begin()), [&](auto fault) {
      return std::none_of(verdict.plan.begin(), verdict.plan.end(),
                          [&](const auto& step) { return names(step, fault); });
    });
    if (!left.empty()) {
      const VectorVerdict next = judged(left);
      for (const VectorVerdict::Step& step : next.plan) std::erase_if(left, [&](auto f) { return names(step, f); });
    }
    EXPECT_TRUE(left.empty()) << "not named by two plans";
    std::cout << emulator.name << ": " << named << " of " << emulator.faults.size() << " faults named, "
              << verdict.plan.size() << " mistakes\n"
              << text_of(verdict);
  }
}

// An author who mends what `verify` names first, and runs the pack again, until nothing differs: every step removes a
// fault that is there. Each step takes seconds: NINEBIT_JOURNEYS=all takes the journeys of more than three faults, too.
TEST(VectorPlan, JourneysFromAnEmulatorToTheChip) {
  if (test::kSanitized) GTEST_SKIP() << "too slow; the build without sanitizers runs this";
  const bool all = judges_all();
  for (const Emulator& emulator : kEmulators) {
    if (!all && emulator.faults.size() > 3) continue;
    SCOPED_TRACE(emulator.name);
    std::set<EmulatorFault> left = emulator.faults;
    std::size_t steps = 0;
    std::string way;
    VectorVerdict verdict = judged(left);
    std::string counts = figure(verdict.differ);
    for (; verdict.differ != 0 && steps <= emulator.faults.size(); ++steps) {
      ASSERT_FALSE(verdict.plan.empty()) << way << text_of(verdict);
      const VectorVerdict::Step& first = verdict.plan.front();
      const std::size_t before = left.size();
      // What stands for floats and cut bytes together is mended as both.
      std::erase_if(left, [&](EmulatorFault fault) { return names(first, fault); });
      ASSERT_LT(left.size(), before) << "named, but not made: " << first.mistake.name << '\n' << way;
      const VectorVerdict next = judged(left);
      way += std::to_string(steps + 1) + ". " + first.mistake.name + ": " + std::to_string(verdict.differ) + " -> " +
             std::to_string(next.differ) + " fragments\n";
      counts += ", " + figure(next.differ);
      verdict = next;
    }
    EXPECT_EQ(verdict.differ, 0U) << way;
    expect_row({emulator.name, std::to_string(steps), counts});
    std::cout << emulator.name << ": " << steps << " steps\n" << way;
  }
}

}  // namespace
}  // namespace ninebit
