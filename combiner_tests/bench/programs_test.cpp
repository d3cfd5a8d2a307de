// The measured programs are what they claim to be: legal, and without anything that could be left out.
#include "src/bench/programs.h"

#include <gtest/gtest.h>

#include "combiner_tests/bench/support.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/shadow/index_cube.h"

namespace bench_test {
namespace {

using namespace ninebit;

TEST(MeasuredPrograms, EveryProfileTakesThem) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    const auto programs = bench::measured_programs(profile);
    ASSERT_TRUE(programs.ok()) << profile.name;
    ASSERT_EQ(programs->size(), 4U);
    for (const bench::MeasuredProgram& p : *programs) {
      SCOPED_TRACE(std::string(p.name) + " " + std::string(p.profile.name));
      EXPECT_TRUE(validate(p.state, p.profile).empty());
      EXPECT_EQ(p.profile.name, p.name == "eight" && profile.general_combiners < 8 ? "nv2a" : profile.name);
    }
    EXPECT_EQ(programs->at(0).state, *index_comparison_state(profile));
    EXPECT_EQ(programs->at(1).state.num_general_combiners, 2);
    EXPECT_EQ(programs->at(2).state.num_general_combiners, 8);
    EXPECT_EQ(programs->at(3).state, CombinerState{});
  }
}

// As `ninebit bench combiner --print` gives them.
TEST(MeasuredPrograms, PrintAsGlCalls) {
  const auto programs = bench::measured_programs(profiles::geforce2);
  for (const bench::MeasuredProgram& p : *programs) {
    const std::string text = print_gl_calls(p.state, p.profile).value();
    const auto parsed = parse_gl_calls({text, "printed"}, p.profile);
    ASSERT_TRUE(parsed.ok()) << p.name;
    EXPECT_EQ(normalize(*parsed, p.profile), normalize(p.state, p.profile)) << p.name;
  }
}

// How many of the fragments two states colour differently.
int differences(const CombinerState& a, const CombinerState& b, const HardwareProfile& profile) {
  const Program first = normalize(a, profile), second = normalize(b, profile);
  int count = 0;
  for (const RegisterFile& fragment : random_fragments(400)) {
    if (evaluate(first, fragment) != evaluate(second, fragment)) ++count;
  }
  return count;
}

// No compiler of programs may get rid of a portion: each one decides colours.
TEST(MeasuredPrograms, EveryPortionOfHeavyAndEightCounts) {
  const auto programs = bench::measured_programs(profiles::geforce2);
  for (const std::size_t number : {std::size_t{1}, std::size_t{2}}) {
    const bench::MeasuredProgram& p = programs->at(number);
    for (int stage = 0; stage < p.state.num_general_combiners; ++stage) {
      for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
        CombinerState without = p.state;
        GeneralCombiner& combiner = without.general[static_cast<std::size_t>(stage)];
        PortionOutput& out = name == PortionName::rgb ? combiner.rgb.out : combiner.alpha.out;
        out = {.sum = Register::discard};
        EXPECT_GT(differences(p.state, without, p.profile), 20)
            << p.name << ", stage " << stage << (name == PortionName::rgb ? " RGB" : " alpha");
      }
    }
  }
}

}  // namespace
}  // namespace bench_test
