// Shared by the questions of `ninebit prove`: their flags, and how answers are told.
#pragma once

#include <string>

#include "ninebit/study/equivalence.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct ProofFlags {
  CommonFlags common;
  double timeout_s = 60;
  std::vector<std::string> set, free;
};

// Adds the common flags, --timeout, --set and --free.
void add_proof_flags(CLI::App& verb, ProofFlags& flags);
// A program of a question and its name.
struct ProofProgram {
  std::string name;
  CombinerState* state;
};
// Makes the constants of --free unset in the programs, and puts the inputs of --set into the options. Notes which
// constants are inputs. The Diagnostic is wrong usage.
[[nodiscard]] Status choose_inputs(const ProofFlags& flags, const std::vector<ProofProgram>& programs,
                                   EquivalenceOptions& options);
// The options of a question, whose progress is shown.
[[nodiscard]] EquivalenceOptions options_of(const ProofFlags& flags, ProgressLine& progress);

[[nodiscard]] std::string_view name_of(ProofAnswer answer);
[[nodiscard]] std::string_view name_of(ProofMethod method);

// The exit code of an answer: 0 proved, 1 refuted or unknown.
[[nodiscard]] int exit_code_of(ProofAnswer answer);

// The head of an answer: command, version, question, answer, method, cases.
[[nodiscard]] Json proof_json(const std::string& question, ProofAnswer answer, ProofMethod method, std::uint64_t cases);
// {inputs, outputs}: bytes and values by name.
[[nodiscard]] Json counterexample_json(const Counterexample& example);
// "with tex0.r = 16, tex1.r = 14: out.a is 0 and 1".
[[nodiscard]] std::string counterexample_text(const Counterexample& example);

// The questions.
void add_prove_equivalent(CLI::App& prove, int& exit_code);
void add_prove_stable(CLI::App& prove, int& exit_code);
void add_prove_discriminate(CLI::App& prove, int& exit_code);
void add_prove_kit(CLI::App& prove, int& exit_code);

}  // namespace ninebit::tools
