// Programs that no parser made: states and registers out of the bytes, and all evaluators against each other.
#include <memory>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/validate.h"

namespace ninebit::fuzz {
namespace {

using test::Random;

HardwareProfile profile_of(Random& random) {
  switch (random.below(8)) {
    case 0:
      return test::random_real_profile(random, profiles::ideal);
    case 1:
      return test::random_real_profile(random, profiles::float_shader);
    default:
      return test::random_profile(random);
  }
}

// Anything of its type, whatever GL says of it.
void spoil(Random& random, CombinerInput& in) {
  in.reg =
      static_cast<Register>(random.below(static_cast<int>(kRegisterCount) + 3));  // and those of the final combiner
  in.mapping = kInputMappings[static_cast<std::size_t>(random.below(static_cast<int>(kInputMappings.size())))];
  in.usage = static_cast<ComponentUsage>(random.below(3));
}

void spoil(Random& random, CombinerState& state) {
  GeneralCombiner& stage = state.general[static_cast<std::size_t>(random.below(kMaxGeneralCombiners))];
  Portion& portion = random.one_in(2) ? stage.rgb : stage.alpha;
  switch (random.below(4)) {
    case 0:
      return spoil(random, random.one_in(2) ? portion.a : portion.d);
    case 1:
      return spoil(random, random.one_in(2) ? state.final_combiner.a : state.final_combiner.g);
    case 2:
      state.num_general_combiners = random.below(12) - 1;
      return;
    default:
      portion.out.ab = static_cast<Register>(random.below(static_cast<int>(kRegisterCount) + 1));
      portion.out.scale = static_cast<Scale>(random.below(4));
      portion.out.bias = random.one_in(2) ? Bias::none : Bias::by_negative_one_half;
      portion.out.ab_dot_product = random.one_in(2);
  }
}

// A batch's result is wrong where it differs from the reference's.
std::string wrong_with_batch(const Program& program, const std::vector<RegisterFile>& initial,
                             const std::vector<EvaluatedFragment>& expected, const std::string& where) {
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const bool registers : {true, false}) {
    const BatchProgram compiled(program, {.registers = registers});
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const bool read = registers || compiled.reads().contains(static_cast<Register>(r), static_cast<int>(c));
        for (std::size_t i = 0; i < initial.size(); ++i) {
          batch->plane[r][c][i] = read ? initial[i].value[r][c] : s9{0x5A5A};  // no code: it must not be read
        }
      }
    }
    compiled.run(*batch, initial.size(), *out);
    for (std::size_t i = 0; i < initial.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (out->plane[c][i] != expected[i].color[c]) return "another colour " + where + "\n" + compiled.describe();
        for (auto r = static_cast<std::size_t>(Register::primary); registers && r < kRegisterCount; ++r) {
          if (batch->plane[r][c][i] != expected[i].registers.value[r][c]) {
            return "another register " + std::to_string(r) + " " + where + "\n" + compiled.describe();
          }
        }
      }
    }
  }
  return {};
}

std::string wrong_with_evaluators(Random& random, const Program& program, const HardwareProfile& profile) {
  // Exact numbers double their digits in every stage.
  const int most = profile.arithmetic == Arithmetic::exact ? 2 : 40;
  std::vector<RegisterFile> initial(static_cast<std::size_t>(1 + random.below(most)));
  Random codes(random.next());
  for (RegisterFile& registers : initial) registers = test::random_registers(codes, profile);
  std::vector<EvaluatedFragment> expected;
  for (const RegisterFile& registers : initial) {
    expected.push_back(evaluate_fragment(program, registers));
    const Rgba9& color = expected.back().color;
    if (evaluate(program, registers) != color) return "the two functions of the reference differ";
    for (const s9 code : color) {
      if (code < 0 || code > profile.one) return "a colour is " + std::to_string(code);
    }
  }
  if (profile.arithmetic != Arithmetic::integer) return wrong_with_batch(program, initial, expected, "");
  for (const std::int64_t target : test::simd_targets()) {
    const test::OnTarget here(target);
    std::string wrong = wrong_with_batch(program, initial, expected, "on " + test::simd_target_name(target));
    if (!wrong.empty()) return wrong;
    if (!here.ran()) return "nothing ran on " + test::simd_target_name(target);
  }
  return {};
}

}  // namespace

std::string check_state(std::string_view bytes) {
  Random random(bytes);
  const HardwareProfile profile = profile_of(random);
  const bool spoiled = random.one_in(4);
  CombinerState state = test::random_state(random, profile);
  if (spoiled) spoil(random, state);
  const auto found = validate(state, profile);
  if (!found.empty()) {
    if (!spoiled) return "GL refuses it: " + found.front().message;
    for (const StateDiagnostic& fault : found) {
      std::string wrong = wrong_with_message(fault.message);
      if (!wrong.empty()) return wrong;
    }
    return compile(state, profile) ? "GL refuses what compiles: " + found.front().message : "";
  }
  const auto program = compile(state, profile);
  if (!program) return "it does not compile: " + program.error().message;
  std::string wrong = wrong_with_evaluators(random, *program, profile);
  // Real numbers are not emitted as source.
  return profile.arithmetic == Arithmetic::integer ? first_of(wrong, [&] { return wrong_with_state(state, profile); })
                                                   : wrong;
}

}  // namespace ninebit::fuzz
