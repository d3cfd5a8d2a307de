// Questions whether two programs leave the same: answers that are known, random programs against the reference, the
// solver against all cases.
#include "ninebit/study/equivalence.h"

#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/study/proof_support.h"
#include "ninebit/combiner/validate.h"

namespace ninebit::test {
namespace {

ProofSubject subject(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2) {
  return {state, profile, {}};
}

EquivalenceAnswer ask(const ProofSubject& a, const ProofSubject& b, const EquivalenceOptions& options = {}) {
  auto answer = prove_equivalent(a, b, options);
  if (!answer) throw std::runtime_error(answer.error().text());
  return *answer;
}

// The targets' values for a counterexample, by the reference.
void expect_confirmed(const ProofSubject& a, const ProofSubject& b, const EquivalenceAnswer& answer) {
  ASSERT_TRUE(answer.counterexample);
  const Counterexample& example = *answer.counterexample;
  const auto value = [&](const ProofSubject& side) -> int {
    const EvaluatedFragment fragment =
        evaluate_fragment(normalize(side.state, side.profile), registers_of(side.profile, example.inputs));
    const auto i = static_cast<std::size_t>(example.target.component);
    return example.target.reg ? fragment.registers[*example.target.reg][i] : to_byte(side.profile, fragment.color[i]);
  };
  EXPECT_EQ(value(a), example.a);
  EXPECT_EQ(value(b), example.b);
  EXPECT_NE(example.a, example.b);
}

TEST(Equivalence, TheArticlesProgramAndAShorterOne) {
  // Scaled by two twice in the first stage's place: the second stage squares what is saturated either way.
  const ProofSubject article = subject(index_compare());
  const EquivalenceAnswer same = ask(article, subject(index_compare("scale_by_four();", "unsigned(spare0) . spare0")));
  EXPECT_EQ(same.answer, ProofAnswer::refuted);  // the sign of a difference is lost
  const ProofSubject less = subject(index_compare("scale_by_two();"));
  const EquivalenceAnswer answer = ask(article, less);
  EXPECT_EQ(answer.answer, ProofAnswer::refuted);
  expect_confirmed(article, less, answer);
  // The other way round of the difference.
  const ProofSubject turned =
      subject(rc10("{ rgb { discard = unsigned(tex0); discard = -col0; spare0 = sum(); scale_by_four(); } }\n"
                   "{ rgb { spare1 = -spare0 . -spare0; scale_by_four(); } }\nout.rgb = zero; out.a = spare1.b;\n"));
  const EquivalenceAnswer proved = ask(article, turned);
  EXPECT_EQ(proved.answer, ProofAnswer::proved) << proved.reason;
  EXPECT_EQ(proved.method, ProofMethod::exhaustive);
  EXPECT_GT(proved.cases, std::uint64_t{127} * 127 * 127);  // the differences of three channels, all combinations
}

TEST(Equivalence, FourLiveBytes) {
  const ProofSubject a =
      subject(rc10("{ alpha { discard = tex0.a * tex1.a; discard = col0.a * col1.b; spare0 = sum(); } }\n"
                   "out.rgb = zero; out.a = spare0.a;\n"));
  const ProofSubject b =
      subject(rc10("{ alpha { discard = col1.b * col0.a; discard = tex1.a * tex0.a; spare0 = sum(); } }\n"
                   "out.rgb = zero; out.a = spare0.a;\n"));
  const EquivalenceAnswer by_formulas = ask(a, b);
  EXPECT_EQ(by_formulas.answer, ProofAnswer::proved);
  EXPECT_EQ(by_formulas.method, ProofMethod::smt);  // the same formula
  const ProofSubject nearest = subject(b.state, profiles::nv2a);
  const EquivalenceAnswer other = ask(a, nearest);
  EXPECT_EQ(other.answer, ProofAnswer::refuted);
  expect_confirmed(a, nearest, other);
}

TEST(Equivalence, RegistersWithTheirSigns) {
  const ProofSubject a = subject(rc10("{ alpha { spare0 = tex0.a * -tex1.a; } }\nout.rgb = zero; out.a = spare0.a;\n"));
  const ProofSubject b = subject(rc10("{ alpha { spare0 = zero * zero; } }\nout.rgb = zero; out.a = spare0.a;\n"));
  EXPECT_EQ(ask(a, b).answer, ProofAnswer::proved);  // colours are never negative
  EquivalenceOptions registers;
  registers.targets = {{Register::spare0, kAlpha}};
  const EquivalenceAnswer answer = ask(a, b, registers);
  EXPECT_EQ(answer.answer, ProofAnswer::refuted);
  expect_confirmed(a, b, answer);
  EXPECT_EQ(ask(a, a, registers).answer, ProofAnswer::proved);
}

TEST(Equivalence, CodesOfAnotherWidth) {
  // A byte enters with seven bits and leaves with the low bit filled: even the plain texture differs.
  const ProofSubject nine = subject(rc10("{ rgb { spare0 = tex0; } }\nout.rgb = spare0; out.a = zero;\n"));
  const ProofSubject eight = subject(nine.state, profiles::geforce256_8bit);
  const EquivalenceAnswer answer = ask(nine, eight);
  EXPECT_EQ(answer.answer, ProofAnswer::refuted);
  expect_confirmed(nine, eight, answer);
  EquivalenceOptions registers;
  registers.targets = {{Register::spare0, kRed}};
  const auto refused = prove_equivalent(nine, eight, registers);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "the registers of geforce2 and geforce256-8bit cannot be compared: their codes of 1.0 differ");
}

TEST(Equivalence, RealNumbersRunOneByOne) {
  const CombinerState product = rc10("{ alpha { spare0 = tex0.a * tex1.a; } }\nout.rgb = zero; out.a = spare0.a;\n");
  EXPECT_EQ(ask(subject(product, profiles::ideal), subject(product, profiles::float_shader)).answer,
            ProofAnswer::proved);
  EXPECT_EQ(ask(subject(product, profiles::ideal), subject(product)).answer, ProofAnswer::refuted);
  const CombinerState four = rc10("{ rgb { spare0 = tex0 . tex1; } }\nout.rgb = spare0; out.a = zero;\n");
  EquivalenceOptions options;
  const EquivalenceAnswer answer = ask(subject(four, profiles::ideal), subject(four, profiles::float_shader), options);
  if (answer.answer == ProofAnswer::unknown) {
    EXPECT_NE(answer.reason.find("too many cases"), std::string::npos) << answer.reason;
  } else {
    EXPECT_EQ(answer.answer, ProofAnswer::refuted);
  }
}

// Answers of random questions must hold for inputs that the reference evaluates.
TEST(Equivalence, RandomProgramsAgainstTheReference) {
  int proved = 0, refuted = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    Random random(7, i);
    const HardwareProfile profile = random_profile(random);
    const ProofSubject a = subject(random_state(random, profile), profile);
    ProofSubject b = a;
    // Another state of the same kind: one input or one output of a stage is another one.
    GeneralCombiner& stage = b.state.general[static_cast<std::size_t>(random.below(b.state.num_general_combiners))];
    if (random.one_in(2)) {
      stage.alpha.a = random_input(random, PortionName::alpha, profile);
    } else {
      stage.rgb.out.scale = stage.rgb.out.scale == Scale::by_two ? Scale::none : Scale::by_two;
      stage.rgb.out.bias = Bias::none;
    }
    if (!validate(b.state, profile).empty()) continue;
    EquivalenceOptions options;
    options.most_cases = std::uint64_t{1} << 24U;
    options.timeout_s = 2;
    options.random_cases = 1 << 16;
    const EquivalenceAnswer answer = ask(a, b, options);
    if (answer.answer == ProofAnswer::refuted) expect_confirmed(a, b, answer);
    refuted += answer.answer == ProofAnswer::refuted ? 1 : 0;
    if (answer.answer != ProofAnswer::proved) continue;
    ++proved;
    for (int k = 0; k < 2000; ++k) {
      std::vector<ProofInput> inputs;
      for (int r = 0; r < static_cast<int>(kRegisterCount); ++r) {
        for (int c = 0; c < 4; ++c) inputs.push_back({static_cast<Register>(r), c, random.byte()});
      }
      const RegisterFile registers = registers_of(profile, inputs);
      ASSERT_EQ(evaluate_fragment(normalize(a.state, profile), registers).color,
                evaluate_fragment(normalize(b.state, profile), registers).color)
          << "case " << i;
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(refuted, 20);
}

// The solver and the run of all cases must agree.
TEST(Equivalence, TheSolverAgainstAllCases) {
  int asked = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    Random random(11, i);
    const auto mapped = [&](const char* name) {
      constexpr std::array<const char*, 8> kForms{"unsigned(%)",  "unsigned_invert(%)", "expand(%)", "-expand(%)",
                                                  "half_bias(%)", "-half_bias(%)",      "%",         "-%"};
      std::string text = kForms[static_cast<std::size_t>(random.below(8))];
      return text.replace(text.find('%'), 1, name);
    };
    const std::string scale = random.pick({"", "scale_by_two();", "scale_by_four();", "scale_by_one_half();"});
    const auto program = [&](const std::string& first, const std::string& second) {
      return rc10("{ alpha { discard = " + first + "; discard = " + second + "; spare0 = sum(); " + scale +
                  " } }\nout.rgb = zero; out.a = spare0.a;\n");
    };
    const std::string ab = mapped("tex0.a") + " * " + mapped("tex1.a"),
                      cd = mapped("col0.a") + " * " + mapped("tex0.a");
    const ProofSubject a = subject(program(ab, cd));
    const ProofSubject b =
        subject(random.one_in(2) ? program(cd, ab) : program(ab, mapped("col0.a") + " * " + mapped("tex0.a")));
    EquivalenceOptions solver;
    solver.most_cases = 0;
    solver.timeout_s = 3;
    solver.random_cases = 1 << 16;
    const EquivalenceAnswer all = ask(a, b), formulas = ask(a, b, solver);
    ASSERT_NE(all.answer, ProofAnswer::unknown);
    if (formulas.answer == ProofAnswer::unknown) continue;  // no solver here, or too hard for it
    ++asked;
    EXPECT_EQ(all.answer, formulas.answer) << "case " << i << ": " << ab << " + " << cd;
    if (formulas.answer == ProofAnswer::refuted) expect_confirmed(a, b, formulas);
  }
  EXPECT_GT(asked, 5);
}

TEST(Equivalence, WithoutASolver) {
  const ProofSubject a = subject(rc10("{ rgb { spare0 = tex0 . tex1; } }\nout.rgb = spare0; out.a = zero;\n"));
  const ProofSubject b = subject(rc10("{ rgb { spare0 = -tex0 . -tex1; } }\nout.rgb = spare0; out.a = zero;\n"));
  EquivalenceOptions options;
  options.solver = "no-such-solver";
  options.most_cases = 0;
  const EquivalenceAnswer answer = ask(a, b, options);
  if (answer.answer != ProofAnswer::proved) {
    EXPECT_EQ(answer.answer, ProofAnswer::unknown);
    EXPECT_EQ(answer.reason,
              "too many cases to run, and the PATH has no solver no-such-solver; install the package "
              "no-such-solver");
  }
}

TEST(Equivalence, InvalidStatesAndInterrupts) {
  CombinerState invalid = index_compare();
  invalid.num_general_combiners = 9;
  EXPECT_FALSE(prove_equivalent(subject(invalid), subject(index_compare())));
  EquivalenceOptions options;
  options.go_on = [](double) { return false; };
  const auto stopped = prove_equivalent(subject(index_compare()),
                                        subject(index_compare("scale_by_four();", "-spare0 . -spare0")), options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

}  // namespace
}  // namespace ninebit::test
