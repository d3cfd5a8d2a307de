// explain against what random programs compute: its equations are read back and evaluated, and what it calls unused is
// taken out without a change of the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/explain_reader.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/explain.h"

namespace ninebit::test {
namespace {

// The registers before the first stage as explain takes them to be.
RegisterFile gl_registers(Random& random, const HardwareProfile& profile) {
  RegisterFile registers = random_registers(random, profile);
  for (Rgba9& value : registers.value) {
    for (s9& code : value) code = static_cast<s9>(std::abs(std::min<int>(code, profile.one)) % (profile.one + 1));
  }
  for (const int c : {kRed, kGreen, kBlue}) registers[Register::spare0][static_cast<std::size_t>(c)] = 0;
  registers[Register::spare1] = {};
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    registers[Register::secondary][kAlpha] = static_cast<s9>(profile.one);
  }
  return registers;
}

struct Checked {
  int equations = 0;
  int clamped = 0;
  int removed = 0;
};

// Each equation, read back and computed in real numbers, is within what narrowing can drop of what the stage wrote.
void check_equations(const Program& program, const Explanation& e, const RegisterFile& initial, Checked& checked) {
  const Datapath& d = program.datapath;
  const bool early = d.narrowing_point == NarrowingPoint::before_scale && d.arithmetic == Arithmetic::integer;
  for (const Equation& equation : e.equations) {
    Program part = program;
    part.num_general_combiners = equation.stage.value_or(program.num_general_combiners);
    RegisterFile before = initial;
    evaluate_general(part, before);
    const ProgramStage& stage = program.general[static_cast<std::size_t>(equation.stage.value_or(0))];
    const Rgba9& constant0 = equation.stage ? stage.constant0 : program.constant0;
    const Rgba9& constant1 = equation.stage ? stage.constant1 : program.constant1;
    const Real3 said = value_of(equation.expression, d, before, constant0, constant1);

    Rgba9 wrote{};
    if (equation.stage) {
      part.num_general_combiners = *equation.stage + 1;
      RegisterFile after = initial;
      evaluate_general(part, after);
      const bool rgb = equation.portion == PortionName::rgb;
      const Portion& portion = rgb ? stage.rgb : stage.alpha;
      const PortionOutput& out = portion.out;
      wrote = after[equation.output == "AB" ? out.ab : equation.output == "CD" ? out.cd : out.sum];
    } else {
      wrote = evaluate_final(program, before);
    }
    const double lowest = equation.stage ? static_cast<double>(d.lowest_output) : 0.0;
    const double tolerance = !equation.stage ? 2.0 : early ? 4.0 : 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double code = said[c] * d.one;
      const bool to_alpha = equation.portion == PortionName::alpha || equation.target.ends_with(".a");
      const std::size_t at = to_alpha ? kAlpha : c;
      ASSERT_NEAR(std::clamp(code, lowest, static_cast<double>(d.one)), wrote[at], tolerance + 1e-6)
          << equation.target << " = " << equation.expression << " in\n"
          << print_explanation(e);
      if (equation.clamps) {
        ++checked.clamped;
      } else {
        ASSERT_GE(code, lowest - tolerance) << equation.expression;
        ASSERT_LE(code, d.one + tolerance) << equation.expression;
      }
    }
    ++checked.equations;
  }
}

// Without the outputs that explain calls unused, the result is the same to the bit.
void check_unused(const Program& program, const Explanation& e, const RegisterFile& initial, Checked& checked) {
  Program less = program;
  for (const Equation& equation : e.equations) {
    if (equation.used) continue;
    ProgramStage& stage = less.general[static_cast<std::size_t>(equation.stage.value())];
    PortionOutput& out = (equation.portion == PortionName::rgb ? stage.rgb : stage.alpha).out;
    if (equation.portion == PortionName::rgb && equation.target.ends_with(".a")) {
      (equation.output == "AB" ? out.ab_blue_to_alpha : out.cd_blue_to_alpha) = false;
      ++checked.removed;
    }
  }
  for (const Equation& equation : e.equations) {
    if (equation.used || equation.target.ends_with(".a") != (equation.portion == PortionName::alpha)) continue;
    ProgramStage& stage = less.general[static_cast<std::size_t>(equation.stage.value())];
    PortionOutput& out = (equation.portion == PortionName::rgb ? stage.rgb : stage.alpha).out;
    // An output whose blue goes on as alpha cannot be taken away alone.
    if (equation.output == "AB" ? out.ab_blue_to_alpha : equation.output == "CD" && out.cd_blue_to_alpha) continue;
    (equation.output == "AB" ? out.ab : equation.output == "CD" ? out.cd : out.sum) = Register::discard;
    ++checked.removed;
  }
  ASSERT_EQ(evaluate(program, initial), evaluate(less, initial)) << print_explanation(e);
}

TEST(Explain, RandomProgramsDoWhatTheirEquationsSay) {
  constexpr std::uint64_t kSeed = 20'001'017;
  constexpr std::uint64_t kPrograms = cases_here<std::uint64_t>(4000);
  Checked checked;
  for (std::uint64_t index = 0; index < kPrograms; ++index) {
    SCOPED_TRACE("program " + std::to_string(index));
    Random random(kSeed, index);
    const HardwareProfile profile = random_profile(random);
    const Program program = normalize(random_state(random, profile), profile);
    const Explanation e = explain(program, profile);
    for (int fragment = 0; fragment < 4; ++fragment) {
      const RegisterFile initial = gl_registers(random, profile);
      check_equations(program, e, initial, checked);
      check_unused(program, e, initial, checked);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(checked.equations, cases_here(50'000));
  EXPECT_GT(checked.clamped, cases_here(5'000));
  EXPECT_GT(checked.removed, cases_here(10'000));
}

}  // namespace
}  // namespace ninebit::test
