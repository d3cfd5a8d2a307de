#include "ninebit/study/equivalence.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "src/study/proof/case_run.h"
#include "src/study/proof/case_table.h"
#include "src/study/proof/proof_side.h"
#include "src/study/proof/solver.h"

namespace ninebit {
namespace {

using proof::InputBytes;
using proof::ProofSide;

// The number of cases that run first: most differences are found by them.
constexpr std::uint64_t kFirstCases = 1U << 18U;
// Real numbers, and constants that batches cannot have, run one by one.
constexpr std::uint64_t kMostSingleCases = 1U << 24U;

Diagnostic cancelled() {
  return {.message = "interrupted", .fault = Fault::cancelled};
}

// One target of a question.
class TargetProof {
 public:
  // The solver may take `seconds`; what it took is subtracted.
  TargetProof(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const EquivalenceOptions& options,
              std::function<bool(double)> go_on, double& seconds)
      : sides_(sides), target_(target), options_(options), go_on_(std::move(go_on)), seconds_(seconds) {}

  Result<EquivalenceAnswer> run() {
    const auto wait = [this] { return !go_on_ || go_on_(0); };
    if (proof::same_formula(sides_, target_)) {
      answer_.answer = ProofAnswer::proved;
      answer_.method = ProofMethod::smt;
      return answer_;
    }
    if (!run_random(kFirstCases, nullptr)) return cancelled();
    if (answer_.answer == ProofAnswer::refuted) return answer_;
    const auto table = proof::make_case_table(sides_, target_, wait);
    if (!table) return cancelled();
    const bool in_batches = std::all_of(
        sides_.begin(), sides_.end(), [](const ProofSide& side) { return side.is_integer() && !side.runs_in_rows(); });
    if (table->cases() <= (in_batches ? options_.most_cases : std::min(options_.most_cases, kMostSingleCases))) {
      const proof::CaseRun run = proof::run_all(sides_, target_, *table, go_on_);
      if (run.cancelled) return cancelled();
      answer_.cases += table->cases();
      conclude(run.difference);
      return answer_;
    }
    return ask_solver(wait);
  }

 private:
  // Refuted by these inputs, or proved.
  void conclude(const std::optional<InputBytes>& difference) {
    answer_.answer = difference ? ProofAnswer::refuted : ProofAnswer::proved;
    if (difference) confirm(*difference);
  }

  void confirm(const InputBytes& bytes) {
    Counterexample example{{}, target_, sides_[0].evaluate(target_, bytes), sides_[1].evaluate(target_, bytes)};
    const proof::ComponentMask read = inputs_read();
    for (int i = 0; i < proof::kComponents; ++i) {
      if (proof::has(read, i)) example.inputs.push_back(proof::input_at(i, bytes[static_cast<std::size_t>(i)]));
    }
    answer_.answer = example.a == example.b ? ProofAnswer::unknown : ProofAnswer::refuted;
    if (example.a == example.b) {
      answer_.reason = "the reference does not confirm the counterexample that was found";
    } else {
      answer_.counterexample = std::move(example);
    }
  }

  [[nodiscard]] proof::ComponentMask inputs_read() const {
    proof::ComponentMask inputs;
    for (const ProofSide& side : sides_) {
      const proof::ComponentMask read = proof::reads_of(side.program, 0, target_);
      for (const int i : side.components) {
        const int input = side.start[static_cast<std::size_t>(i)].input;
        if (proof::has(read, i) && input >= 0) inputs |= proof::mask_of(input);
      }
    }
    return inputs;
  }

  // Returns false if it was cancelled.
  bool run_random(std::uint64_t count, const std::function<bool(double)>& go_on) {
    const proof::CaseRun run = proof::run_random(sides_, target_, count, go_on);
    if (run.cancelled) return false;
    answer_.cases += count;
    if (run.difference) confirm(*run.difference);
    return true;
  }

  Result<EquivalenceAnswer> ask_solver(const std::function<bool()>& wait) {
    answer_.method = ProofMethod::smt;
    answer_.answer = ProofAnswer::unknown;
    if (!proof::has_formulas(sides_, target_)) {
      answer_.reason = fmt::format(
          "{} has too many cases to run, and a solver is asked only of colours of two profiles "
          "with integer arithmetic and the same codes",
          component_name(target_.reg, target_.component));
      return answer_;
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto solved = proof::solve(sides_, target_, options_.solver, seconds_, wait);
    seconds_ -= std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    seconds_ = std::max(seconds_, 0.0);
    if (!solved) return solved.error();
    answer_.reason = solved->reason;
    if (solved->answer == ProofAnswer::refuted) confirm(solved->bytes);
    if (solved->answer != ProofAnswer::proved) return answer_;
    answer_.answer = ProofAnswer::proved;
    if (!run_random(options_.random_cases, go_on_)) return cancelled();
    if (answer_.answer == ProofAnswer::refuted) {
      answer_.answer = ProofAnswer::unknown;
      answer_.reason = "the solver's proof is contradicted by an input that was run";
    }
    return answer_;
  }

  const std::array<ProofSide, 2>& sides_;
  ProofTarget target_;
  const EquivalenceOptions& options_;
  std::function<bool(double)> go_on_;
  double& seconds_;
  EquivalenceAnswer answer_;
};

std::vector<ProofTarget> color_targets() {
  return {{std::nullopt, kRed}, {std::nullopt, kGreen}, {std::nullopt, kBlue}, {std::nullopt, kAlpha}};
}

// The reason why a question is meaningless; empty: none.
std::optional<Diagnostic> fault_of(const ProofSubject& a, const ProofSubject& b, const EquivalenceOptions& options) {
  for (const ProofSubject* subject : {&a, &b}) {
    if (const auto program = compile(subject->state, subject->profile); !program) return program.error();
  }
  for (const ProofTarget& target : options.targets) {
    if (target.reg && a.profile.one.value != b.profile.one.value) {
      return Diagnostic{.message =
                            fmt::format("the registers of {} and {} cannot be compared: their codes of 1.0 differ",
                                        a.profile.name, b.profile.name)};
    }
  }
  return std::nullopt;
}

// Adds a target's answer to that of all.
void add(EquivalenceAnswer& all, EquivalenceAnswer one) {
  // A target that is the same formula on both sides runs no case, and the method is that of the others.
  const bool by_formulas = all.cases == 0
                               ? one.method == ProofMethod::smt
                               : all.method == ProofMethod::smt || (one.cases > 0 && one.method == ProofMethod::smt);
  all.method = by_formulas ? ProofMethod::smt : ProofMethod::exhaustive;
  all.cases += one.cases;
  if (one.answer == ProofAnswer::refuted) {
    all.answer = ProofAnswer::refuted;
    all.method = one.method;
    all.counterexample = std::move(one.counterexample);
  } else if (one.answer == ProofAnswer::unknown && all.answer == ProofAnswer::proved) {
    all.answer = ProofAnswer::unknown;
    all.reason = std::move(one.reason);
  }
}

}  // namespace

std::string ProofInput::name() const {
  if (!constant) return component_name(reg, component);
  return fmt::format("{}.{}", name_of_constant(*constant), "rgba"[component]);
}

std::string component_name(std::optional<Register> reg, int component) {
  return fmt::format("{}.{}", reg ? short_name(*reg) : "out", "rgba"[component]);
}

Result<EquivalenceAnswer> prove_equivalent(const ProofSubject& a, const ProofSubject& b,
                                           const EquivalenceOptions& options) {
  if (auto fault = fault_of(a, b, options)) return *fault;
  const std::array<ProofSide, 2> sides{ProofSide(a, options.fixed), ProofSide(b, options.fixed)};
  const auto targets = options.targets.empty() ? color_targets() : options.targets;
  EquivalenceAnswer all;
  all.answer = ProofAnswer::proved;
  double seconds = options.timeout_s;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto go_on = [&](double done) {
      return !options.go_on || options.go_on((static_cast<double>(i) + done) / static_cast<double>(targets.size()));
    };
    auto answer = TargetProof(sides, targets[i], options, go_on, seconds).run();
    if (!answer) return answer.error();
    add(all, std::move(*answer));
    if (all.answer == ProofAnswer::refuted) break;
  }
  if (all.answer == ProofAnswer::refuted) all.reason.clear();
  return all;
}

}  // namespace ninebit
