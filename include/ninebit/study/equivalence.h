// Do two programs leave the same for all inputs?
//
// An input is a byte: a component of the primary or secondary colour, of fog, of a texture, or of a constant that a
// program does not set. A constant that both do not set is one input. Inputs that an output does not depend on are left
// out. Where the rest are few enough, all cases are run by the batch evaluator. If they are
// too many, the question is cut between two general combiners: components there that depend on other inputs than the
// rest take only so many values, which are found by running their inputs alone, and only their combinations are run.
// That is no estimate: each combination is what some input gives. What is left is a question of bit vectors to a
// solver.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A program as one side of a question.
struct ProofSubject {
  CombinerState state;                // valid for the profile (see validate)
  HardwareProfile profile;            // that it is run with
  std::array<bool, 4> texture_off{};  // by unit: its register holds what the profile says
  bool fog_off = false;               // then fog's alpha is what the profile says
};

// The compared value: a component, kRed to kAlpha, of the final combiner's colour as a byte, or of a register as the
// last general combiner leaves it.
struct ProofTarget {
  std::optional<Register> reg;  // spare0, spare1, or another that a stage can write; none: the colour
  int component = 0;            // kRed to kAlpha
  friend bool operator==(const ProofTarget&, const ProofTarget&) = default;
};

// The name of a target: "spare1.a", "out.g".
[[nodiscard]] std::string component_name(std::optional<Register> reg, int component);

// Proved: for all inputs. Refuted: there is an input that shows it. Unknown: neither was found in the time given.
enum class ProofAnswer : std::uint8_t { proved, refuted, unknown };
// Exhaustive: all inputs were run. Smt: a solver proved it or found the input.
enum class ProofMethod : std::uint8_t { exhaustive, smt };

// A component of a register before the first general combiner, or of a constant that is not set, and its byte.
struct ProofInput {
  Register reg = Register::zero;           // a texture's, a colour's or the fog's; zero for a constant
  int component = 0;                       // kRed to kAlpha
  std::uint8_t byte = 0;                   // 0 to 255
  std::optional<ConstantName> constant{};  // if it is one

  // "tex0.r", "const0.g", "stage2.const0.a".
  [[nodiscard]] std::string name() const;
};

// An input for which the sides differ, confirmed by the reference.
struct Counterexample {
  std::vector<ProofInput> inputs;  // those that the target depends on; the others may be anything
  ProofTarget target;              // that differs
  int a = 0, b = 0;                // its values: bytes of a colour, codes of a register
};

// Whether two sides give the same values of all targets.
struct EquivalenceAnswer {
  ProofAnswer answer = ProofAnswer::unknown;     // proved: they do
  ProofMethod method = ProofMethod::exhaustive;  // smt: a target needed the solver, or all are the same formulas
  std::uint64_t cases = 0;                       // that were run, of all targets
  std::optional<Counterexample> counterexample;  // if it is refuted
  std::string reason;                            // if it is unknown: one sentence
};

// The compared values, and limits of the work.
struct EquivalenceOptions {
  std::vector<ProofTarget> targets;                    // none: the colour's four components
  std::vector<ProofInput> fixed{};                     // inputs that have these bytes only
  std::uint64_t most_cases = std::uint64_t{1} << 34U;  // that are run for a target
  double timeout_s = 60;                               // of the solver, for the whole question
  std::uint64_t random_cases = 100'000'000;            // that cross-check each of the solver's proofs
  std::string solver = "z3";                           // a program that reads SMT-LIB 2 with -in, looked up in the PATH
  std::function<bool(double done)> go_on{};            // called now and then; false cancels the work
};

// Returns the answer, the same for any number of threads unless the solver runs out of time. Fails for states that are
// invalid, for registers of profiles whose codes differ, and if `go_on` cancels it.
[[nodiscard]] Result<EquivalenceAnswer> prove_equivalent(const ProofSubject& a, const ProofSubject& b,
                                                         const EquivalenceOptions& options = {});

}  // namespace ninebit
