// Questions of bit vectors, asked of a solver.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "src/study/proof/case_run.h"
#include "src/study/proof/proof_side.h"

namespace ninebit::proof {

struct SolverAnswer {
  ProofAnswer answer = ProofAnswer::unknown;
  InputBytes bytes{};  // if it is refuted
  std::string reason;  // if it is unknown: one sentence
};

// Whether both sides compute in integers with the same code of 1.0, and the target is a component of the colour: only
// then are there formulas of the question.
[[nodiscard]] bool has_formulas(const std::array<ProofSide, 2>& sides, const ProofTarget& target);

// Whether both sides are the same formula; false for a question without formulas.
[[nodiscard]] bool same_formula(const std::array<ProofSide, 2>& sides, const ProofTarget& target);

// Whether the sides' colours differ in the target for any input of a question that has formulas. Fails if `go_on`
// cancels it.
[[nodiscard]] Result<SolverAnswer> solve(const std::array<ProofSide, 2>& sides, const ProofTarget& target,
                                         const std::string& solver, double timeout_s,
                                         const std::function<bool()>& go_on);

// Whether two profiles agree in the steps of the arithmetic, over all codes that registers can hold.

struct StepAgreement {
  bool start = false;  // initial registers, for all bytes, with each texture unit on and off
  bool final_combiner = false;
  bool byte_stage = false;  // one general combiner on initial registers, as the final combiner reads its output
  bool any_stage = false;   // general combiners on all codes
  std::uint64_t cases = 0;

  // No program without general combiners differs; none with one; none of any length.
  [[nodiscard]] bool without_stages() const { return start && final_combiner; }
  [[nodiscard]] bool one_stage() const { return without_stages() && byte_stage; }
  [[nodiscard]] bool any_length() const { return without_stages() && any_stage; }
};

// For any two profiles. Steps agree in arithmetics that are the same; steps without integers are not compared.
[[nodiscard]] StepAgreement compare_steps(const HardwareProfile& a, const HardwareProfile& b);

}  // namespace ninebit::proof
