#include "ninebit/study/discriminate.h"

#include <fmt/format.h>

#include "ninebit/language/rc10.h"
#include "src/study/proof/program_forms.h"
#include "src/study/proof/proof_side.h"
#include "src/study/proof/solver.h"

namespace ninebit {
namespace {

using proof::ProgramForm;

constexpr ProofTarget kShown{std::nullopt, kRed};
constexpr std::array kInputs{Register::texture0, Register::texture1, Register::primary};

CombinerState state_of(const std::string& rc10) {
  return *parse_rc10({rc10, "a program of the search"}, profiles::geforce2);
}

class Search {
 public:
  Search(const HardwareProfile& a, const HardwareProfile& b, const std::function<bool(double)>& go_on)
      : a_(a), b_(b), go_on_(go_on) {}

  // Looks for a program among these. Returns what made it impossible.
  Status look_among(const std::vector<ProgramForm>& forms, int general_combiners) {
    for (std::size_t i = 0; i < forms.size() && !found.found; ++i) {
      if (go_on_ && !go_on_(static_cast<double>(i) / static_cast<double>(forms.size()))) {
        return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
      }
      Discriminator program{forms[i].text, state_of(forms[i].text), general_combiners, {}, {}, forms[i].fog_off};
      if (forms[i].texture_off >= 0) program.texture_off[static_cast<std::size_t>(forms[i].texture_off)] = true;
      if (!forms[i].is_constant) {
        if (auto status = find_bytes(program); !status) return status;
      }
      ++found.cases;
      const int a = program.shown(a_), b = program.shown(b_);
      if (a == b) continue;
      found.answer = ProofAnswer::refuted;
      found.a = a;
      found.b = b;
      found.found = std::move(program);
    }
    return {};
  }

  Discrimination found;

 private:
  // Sets the bytes to ones for which the profiles differ, if there are any.
  Status find_bytes(Discriminator& program) {
    EquivalenceOptions options;
    options.targets = {kShown};
    const auto answer = prove_equivalent({program.state, a_, program.texture_off, program.fog_off},
                                         {program.state, b_, program.texture_off, program.fog_off}, options);
    if (!answer) return answer.error();
    found.cases += answer->cases;
    if (!answer->counterexample) return {};
    for (const ProofInput& input : answer->counterexample->inputs) {
      for (std::size_t i = 0; i < kInputs.size(); ++i) {
        if (input.reg == kInputs[i]) program.bytes[i] = input.byte;
      }
    }
    return {};
  }

  const HardwareProfile &a_, &b_;
  const std::function<bool(double)>& go_on_;
};

}  // namespace

int Discriminator::shown(const HardwareProfile& profile) const {
  std::array<std::uint8_t, proof::kComponents> inputs{};
  for (std::size_t i = 0; i < kInputs.size(); ++i) {
    for (int c = 0; c < 4; ++c) inputs[static_cast<std::size_t>(proof::index_of(kInputs[i], c))] = bytes[i];
  }
  return proof::ProofSide({state, profile, texture_off, fog_off}).evaluate(kShown, inputs);
}

Result<Discrimination> discriminate(const HardwareProfile& a, const HardwareProfile& b,
                                    const std::function<bool(double done)>& go_on) {
  const proof::StepAgreement steps = proof::compare_steps(a, b);
  Search search(a, b, go_on);
  search.found.cases = steps.cases;
  if (steps.any_length()) {
    search.found.answer = ProofAnswer::proved;
    return std::move(search.found);
  }
  if (!steps.without_stages()) {
    if (auto status = search.look_among(proof::programs_without_stages(), 0); !status) return status.error();
  }
  if (!search.found.found && !steps.one_stage()) {
    if (auto status = search.look_among(proof::programs_of_one_stage(), 1); !status) return status.error();
  }
  if (!search.found.found) {
    if (auto status = search.look_among(proof::programs_of_two_stages(), 2); !status) return status.error();
  }
  if (!search.found.found) {
    search.found.reason =
        "steps of the arithmetic differ, but no program that was searched shows it: up to two general combiners with "
        "one product each, all mappings, scales and biases, all bytes";
    return std::move(search.found);
  }
  const int length = search.found.found->general_combiners;
  search.found.shortest = length == 0 || (length == 1 && steps.without_stages()) || (length == 2 && steps.one_stage());
  return std::move(search.found);
}

}  // namespace ninebit
