// `ninebit prove`: questions about programs, answered for all inputs.
#include "src/tools/prove/prove.h"

#include <fmt/ranges.h>

#include "src/tools/common/number_flag.h"

namespace ninebit::tools {

void add_proof_flags(CLI::App& verb, ProofFlags& flags) {
  add_common_flags(verb, flags.common);
  verb.add_option("--timeout", flags.timeout_s, "Longest time of the solver; then the answer is unknown")
      ->capture_default_str()
      ->type_name("SECONDS")
      ->check(real_in_range(0.0, kMostSeconds));
}

EquivalenceOptions options_of(const ProofFlags& flags, ProgressLine& progress) {
  EquivalenceOptions options;
  options.timeout_s = flags.timeout_s;
  options.go_on = [&progress](double done) { return progress.step("cases", done); };
  return options;
}

std::string_view name_of(ProofAnswer answer) {
  return answer == ProofAnswer::proved ? "proved" : answer == ProofAnswer::refuted ? "refuted" : "unknown";
}

std::string_view name_of(ProofMethod method) {
  return method == ProofMethod::exhaustive ? "exhaustive" : "smt";
}

int exit_code_of(ProofAnswer answer) {
  return answer == ProofAnswer::proved ? kDone : kDifference;
}

Json proof_json(const std::string& question, ProofAnswer answer, ProofMethod method, std::uint64_t cases) {
  return {{"command", "prove"},        {"version", NINEBIT_VERSION}, {"question", question},
          {"answer", name_of(answer)}, {"method", name_of(method)},  {"cases", cases}};
}

Json counterexample_json(const Counterexample& example) {
  Json inputs = Json::object();
  for (const ProofInput& input : example.inputs) inputs[component_name(input.reg, input.component)] = input.byte;
  return {{"inputs", std::move(inputs)},
          {"outputs",
           {{"component", component_name(example.target.reg, example.target.component)},
            {"a", example.a},
            {"b", example.b}}}};
}

std::string counterexample_text(const Counterexample& example) {
  std::vector<std::string> inputs;
  for (const ProofInput& input : example.inputs) {
    inputs.push_back(fmt::format("{} = {}", component_name(input.reg, input.component), input.byte));
  }
  return fmt::format("{}{} is {} and {}", inputs.empty() ? "" : fmt::format("with {}: ", fmt::join(inputs, ", ")),
                     component_name(example.target.reg, example.target.component), example.a, example.b);
}

void add_prove(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("prove",
                                      "Answer questions about programs for all inputs: by a proof, or by an "
                                      "input that refutes it");
  verb->require_subcommand(1);
  verb->footer(
      "Exit codes: 0 proved, 1 refuted or unknown, 3 a program cannot be read or is invalid.\n"
      "Examples:\n"
      "  ninebit prove equivalent compare.gl shorter.gl\n"
      "  ninebit prove stable compare.gl\n"
      "  ninebit prove discriminate geforce2 nv2a\n"
      "  ninebit prove kit -o kit\n"
      "Run `ninebit prove QUESTION --help` for the flags of a question.");
  add_prove_equivalent(*verb, exit_code);
  add_prove_stable(*verb, exit_code);
  add_prove_discriminate(*verb, exit_code);
  add_prove_kit(*verb, exit_code);
}

}  // namespace ninebit::tools
