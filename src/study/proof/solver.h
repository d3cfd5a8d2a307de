// Questions of bit vectors, asked of a solver.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

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

}  // namespace ninebit::proof
