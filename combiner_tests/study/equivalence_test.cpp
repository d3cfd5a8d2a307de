// Questions whether two programs leave the same: answers that are known, random programs against the reference, the
// solver against all cases.
#include "ninebit/study/equivalence.h"

#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/study/proof_support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/pixel_shader.h"

namespace ninebit::test {
namespace {

ProofSubject subject(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2) {
  return {state, profile, {}, false};
}

ProofSubject shader(const std::string& body, const HardwareProfile& profile = profiles::geforce2) {
  return subject(parse_pixel_shader({"ps.1.1\ntex t0\n" + body, ""}, profile).value(), profile);
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
    Program program = normalize(side.state, side.profile);
    for (const ProofInput& input : example.inputs) {
      const auto c = static_cast<std::size_t>(input.component);
      const auto put = [&](auto& part) {
        if (input.constant && part.unset[0] == input.constant) part.constant0[c] = from_byte(side.profile, input.byte);
        if (input.constant && part.unset[1] == input.constant) part.constant1[c] = from_byte(side.profile, input.byte);
      };
      for (ProgramStage& stage : program.general) put(stage);
      put(program);
    }
    const EvaluatedFragment fragment = evaluate_fragment(program, registers_of(side.profile, example.inputs));
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

// Constants that programs do not set are inputs; one that both do not set is the same input.
TEST(Equivalence, ConstantsThatAreNotSet) {
  const std::string end = "\nout.a = zero;\n";
  const ProofSubject product = subject(rc10("out.rgb = tex0 * const0;" + end)),
                     turned = subject(rc10("out.rgb = const0 * tex0;" + end)),
                     alone = subject(rc10("out.rgb = const0;" + end)),
                     zero = subject(rc10("const0 = (0, 0, 0, 0);\nout.rgb = tex0 * const0;" + end)),
                     black = subject(rc10("out.rgb = zero;" + end)),
                     second = subject(rc10("out.rgb = tex0 * const1;" + end));
  for (const ProofSubject* other : {&alone, &zero, &black, &second}) {
    const EquivalenceAnswer answer = ask(product, *other);
    ASSERT_EQ(answer.answer, ProofAnswer::refuted);
    expect_confirmed(product, *other, answer);
  }
  EXPECT_EQ(ask(product, turned).answer, ProofAnswer::proved);
  EXPECT_EQ(ask(zero, black).answer, ProofAnswer::proved);
  // Only cases decide a register, and all of them are run.
  EquivalenceOptions spare;
  spare.targets = {{Register::spare0, kRed}};
  const EquivalenceAnswer squares =
      ask(subject(rc10("{ rgb { spare0 = const0 * tex0; } }\nout.rgb = spare0;" + end)),
          subject(rc10("{ rgb { spare0 = tex0 * const0; } }\nout.rgb = spare0;" + end)), spare);
  EXPECT_EQ(squares.answer, ProofAnswer::proved);
  EXPECT_GE(squares.cases, 65536U);
  // A fixed input is no input.
  EquivalenceOptions fixed;
  for (int c = 0; c < 4; ++c) fixed.fixed.push_back({Register::zero, c, 0, ConstantName{0}});
  EXPECT_EQ(ask(product, black, fixed).answer, ProofAnswer::proved);
  fixed.fixed[1].byte = 255;
  const EquivalenceAnswer green = ask(product, black, fixed);
  ASSERT_EQ(green.answer, ProofAnswer::refuted);
  EXPECT_EQ(green.counterexample->target.component, kGreen);
  ASSERT_EQ(green.counterexample->inputs.size(), 1U);
  EXPECT_EQ(green.counterexample->inputs[0].name(), "tex0.g");
  EquivalenceOptions texture;
  for (int c = 0; c < 3; ++c) texture.fixed.push_back({Register::texture0, c, 255, {}});
  EXPECT_EQ(ask(product, alone, texture).answer, ProofAnswer::proved);
  // The solver has the same inputs.
  EquivalenceOptions solver;
  solver.most_cases = 0;
  solver.random_cases = 1 << 16;
  const EquivalenceAnswer asked =
      ask(subject(rc10("{ rgb { spare0 = tex0; } }\nout.rgb = spare0 * const0;" + end)), product, solver);
  EXPECT_NE(asked.answer, ProofAnswer::refuted);
  // In real numbers, too.
  const auto in_real = [](const ProofSubject& side) { return subject(side.state, profiles::ideal); };
  EXPECT_EQ(ask(in_real(product), in_real(alone)).answer, ProofAnswer::refuted);
  if (kSanitized) return;  // too long
  EXPECT_EQ(ask(in_real(product), in_real(turned)).answer, ProofAnswer::proved);
}

// A shader's constants are told apart by their numbers, wherever the combiners have them.
TEST(Equivalence, ConstantsOfShaders) {
  const auto refuted = [](const std::string& a, const std::string& b) {
    const EquivalenceAnswer answer = ask(shader(a), shader(b));
    if (answer.answer == ProofAnswer::refuted) expect_confirmed(shader(a), shader(b), answer);
    return answer.answer == ProofAnswer::refuted;
  };
  EXPECT_TRUE(refuted("add r0, t0, -c0\n", "mov r0, t0\n"));
  EXPECT_TRUE(refuted("mul r0, t0, c0\n", "mul r0, t0, c1\n"));
  EXPECT_TRUE(refuted("mul r0, t0, c7\n", "mul r0, t0, c6\n"));
  // The second reads c1 first, which is its constant 0.
  const HardwareProfile& chip = profiles::nv2a;
  EXPECT_EQ(ask(shader("mul r0, t0, c0\nadd r0, r0, c1\n", chip),
                shader("mov r1, c1\nmul r0, t0, c0\nadd r0, r0, r1\n", chip))
                .answer,
            ProofAnswer::proved);
  EXPECT_EQ(ask(shader("mad r0, t0, c0, c1\n"), shader("mad r0, c0, t0, c1\n")).answer, ProofAnswer::proved);
  // Four constants: each general combiner has its own, and those of one number are one input.
  const std::string sum = "mul r0, t0, c0\nmad r0, t0, c1, r0\nmad r0, t0, c2, r0\nmad r0, v0, c0, r0\n";
  const std::string changed = "mul r0, t0, c0\nmad r0, t0, c1, r0\nmad r0, t0, c2, r0\nmad r0, v0, c3, r0\n";
  const ProofSubject four = shader(sum, profiles::nv2a), other = shader(changed, profiles::nv2a);
  EXPECT_EQ(ask(four, four).answer, ProofAnswer::proved);
  const EquivalenceAnswer answer = ask(four, other);
  ASSERT_EQ(answer.answer, ProofAnswer::refuted);
  expect_confirmed(four, other, answer);
}

// Constants of general combiners' own, of which some are set.
TEST(Equivalence, ConstantsOfGeneralCombinersOwn) {
  const HardwareProfile& profile = profiles::nv2a;
  const std::string end = "out.rgb = spare0;\nout.a = zero;\n";
  const auto program = [&](const std::string& body) { return subject(rc10(body + end, profile), profile); };
  const ProofSubject some =
      program("{ const0 = (1, 1, 1, 1); rgb { spare0 = tex0 * const0; } }\n{ rgb { spare0 = spare0 * const0; } }\n");
  const ProofSubject plain =
      program("{ const1 = (0, 0, 0, 0); rgb { spare0 = tex0 * const1; } }\n{ rgb { spare0 = tex0 * const0; } }\n");
  const ProofSubject half =
      program("{ const0 = (0.5, 1, 1, 1); rgb { spare0 = tex0 * const0; } }\n{ rgb { spare0 = spare0 * const0; } }\n");
  EquivalenceOptions red;
  red.targets = {{Register::spare0, kRed}};
  const EquivalenceAnswer same = ask(some, plain, red);
  EXPECT_EQ(same.answer, ProofAnswer::proved) << same.reason;
  EXPECT_GE(same.cases, 65536U);
  const EquivalenceAnswer answer = ask(some, half);
  ASSERT_EQ(answer.answer, ProofAnswer::refuted);
  expect_confirmed(some, half, answer);
  ASSERT_EQ(answer.counterexample->inputs.size(), 2U);
  EXPECT_EQ(answer.counterexample->inputs[1].name(), "stage1.const0.r");
}

// Spare0's alpha starts as texture 0's: the two are one input.
TEST(Equivalence, Spare0sAlphaIsTexture0s) {
  const auto product = [](const std::string& alpha) {
    return subject(rc10("{ alpha { spare1 = " + alpha + " * tex1.a; } }\nout.rgb = zero; out.a = spare1.a;\n"));
  };
  EquivalenceOptions spare1;
  spare1.targets = {{Register::spare1, kAlpha}};
  const EquivalenceAnswer answer = ask(product("spare0.a"), product("tex0.a"), spare1);
  EXPECT_EQ(answer.answer, ProofAnswer::proved) << answer.reason;
  EXPECT_GE(answer.cases, 65536U);
}

// A colour that only some of 2^24 texels near one colour do not give: random inputs do not find it, all cases do.
TEST(Equivalence, FindsTheOnlyCase) {
  const std::string square = "{ rgb { spare1 = spare1; scale_by_four(); } }\n";
  const ProofSubject differs =
      subject(rc10("const0 = (0.39216, 0.1451, 0.78824, 0);\n"
                   "{ rgb { discard = tex0; discard = -const0; spare0 = sum(); scale_by_four(); } }\n"
                   "{ rgb { spare1 = spare0 . spare0; scale_by_four(); } }\n" +
                       square + square + square + square + "out.rgb = zero; out.a = spare1.b;\n",
                   profiles::nv2a),
              profiles::nv2a);
  const ProofSubject white =
      subject(rc10("out.rgb = zero; out.a = unsigned_invert(zero);\n", profiles::nv2a), profiles::nv2a);
  const EquivalenceAnswer answer = ask(differs, white);
  ASSERT_EQ(answer.answer, ProofAnswer::refuted);
  EXPECT_EQ(answer.method, ProofMethod::exhaustive);
  expect_confirmed(differs, white, answer);
  const std::array<int, 3> color{100, 37, 201};
  for (std::size_t i = 0; i < color.size(); ++i) {
    EXPECT_NEAR(answer.counterexample->inputs[i].byte, color[i], 2);
  }
}

TEST(Equivalence, FourLiveBytes) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
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
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const CombinerState product = rc10("{ alpha { spare0 = tex0.a * tex1.a; } }\nout.rgb = zero; out.a = spare0.a;\n");
  EXPECT_EQ(ask(subject(product, profiles::ideal), subject(product, profiles::float_shader)).answer,
            ProofAnswer::proved);
  EXPECT_EQ(ask(subject(product, profiles::ideal), subject(product)).answer, ProofAnswer::refuted);
  const CombinerState four = rc10("{ rgb { spare0 = tex0 . tex1; } }\nout.rgb = spare0; out.a = zero;\n");
  const EquivalenceAnswer answer = ask(subject(four, profiles::ideal), subject(four, profiles::float_shader));
  if (answer.answer == ProofAnswer::unknown) {
    EXPECT_NE(answer.reason.find("too many cases"), std::string::npos) << answer.reason;
  } else {
    EXPECT_EQ(answer.answer, ProofAnswer::refuted);
  }
}

// Answers of random questions must hold for inputs that the reference evaluates.
TEST(Equivalence, RandomProgramsAgainstTheReference) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
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
    const Program program_a = normalize(a.state, profile), program_b = normalize(b.state, profile);
    for (int k = 0; k < 2000; ++k) {
      std::vector<ProofInput> inputs;
      for (int r = 0; r < static_cast<int>(kRegisterCount); ++r) {
        for (int c = 0; c < 4; ++c) inputs.push_back({static_cast<Register>(r), c, random.byte()});
      }
      const RegisterFile registers = registers_of(profile, inputs);
      ASSERT_EQ(evaluate(program_a, registers), evaluate(program_b, registers)) << "case " << i;
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(refuted, 20);
}

// The solver and the run of all cases must agree.
TEST(Equivalence, TheSolverAgainstAllCases) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
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
