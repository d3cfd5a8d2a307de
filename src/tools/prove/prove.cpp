// `ninebit prove`: questions about programs, answered for all inputs.
#include "src/tools/prove/prove.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "src/system/number_list.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

// The inputs that a text of --set fixes: "const0=1,2,3,4", "tex0.r=16".
Result<std::vector<ProofInput>> inputs_of(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  std::string name = text.substr(0, equals);
  std::vector<int> components{kRed, kGreen, kBlue, kAlpha};
  constexpr std::string_view kLetters = "rgba";
  if (name.size() > 2 && name[name.size() - 2] == '.' && kLetters.find(name.back()) != std::string_view::npos) {
    components = {static_cast<int>(kLetters.find(name.back()))};
    name.resize(name.size() - 2);
  }
  std::vector<ProofInput> inputs;
  const std::optional<Register> reg = register_named(name);
  const bool is_register = reg && *reg >= Register::fog && *reg != Register::spare0 && *reg != Register::spare1;
  const auto constant = constant_called(reg ? short_name(*reg) : name);
  if (is_register) {
    for (const int c : components) inputs.push_back({*reg, c, 0, {}});
  }
  for (std::size_t i = 0; constant && i < components.size(); ++i) {
    inputs.push_back({Register::zero, components[i], 0, constant});
  }
  if (inputs.empty()) {
    return Diagnostic{.message =
                          fmt::format("--set {}: '{}' is not an input; expected fog, primary, secondary, tex0 to "
                                      "tex3, const0 or stage0.const0, or one of these with .r, .g, .b or .a",
                                      text, name)};
  }
  const auto bytes = numbers<int>(text.substr(std::min(equals + 1, text.size())), ',');
  const bool fits = bytes && bytes->size() == inputs.size() &&
                    std::all_of(bytes->begin(), bytes->end(), [](int n) { return n >= 0 && n <= 255; });
  if (!fits) {
    return Diagnostic{.message = fmt::format("--set {}: expected {} from 0 to 255", text,
                                             inputs.size() == 1 ? "a whole number" : "four whole numbers R,G,B,A")};
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i].byte = static_cast<std::uint8_t>((*bytes)[i]);
  return inputs;
}

}  // namespace

void add_proof_flags(CLI::App& verb, ProofFlags& flags) {
  add_common_flags(verb, flags.common);
  verb.add_option("--timeout", flags.timeout_s, "Longest time of the solver; then the answer is unknown")
      ->capture_default_str()
      ->type_name("SECONDS")
      ->check(real_in_range(0.0, kMostSeconds));
  verb.add_option("--set", flags.set,
                  "Fix an input: NAME=R,G,B,A or NAME.COMPONENT=BYTE, such as const0.r=128; repeat for more")
      ->type_name("INPUT=BYTES")
      ->allow_extra_args(false);
  verb.add_option("--free", flags.free,
                  "Make a constant that a program sets an input, such as const0 or stage1.const0; repeat for more")
      ->type_name("CONSTANT")
      ->allow_extra_args(false);
}

Status choose_inputs(const ProofFlags& flags, const std::vector<ProofProgram>& programs, EquivalenceOptions& options) {
  for (const std::string& text : flags.free) {
    const std::optional<Register> reg = register_named(text);
    const auto name = constant_called(reg ? short_name(*reg) : text);
    bool found = false;
    for (const ProofProgram& one : programs) found = (name && free_constant(*one.state, *name)) || found;
    if (!found) {
      return Diagnostic{.message = fmt::format("--free {}: no program of the question reads such a constant; expected "
                                               "a name such as const0 or stage1.const0",
                                               text)};
    }
  }
  std::vector<ConstantName> unset;
  for (const ProofProgram& one : programs) {
    std::vector<std::string> names;
    for (std::size_t which = 0; which < 2; ++which) {
      for (std::size_t place = 0; place <= kFinalConstants; ++place) {
        if (!one.state->origin[place][which].unset) continue;
        const ConstantName name = constant_name(*one.state, place, which);
        unset.push_back(name);
        std::string word = name_of_constant(name);
        if (std::find(names.begin(), names.end(), word) == names.end()) names.push_back(std::move(word));
      }
    }
    if (names.empty() || flags.common.quiet) continue;
    say(fmt::format("ninebit: note: {}: {} {} not set: {} of the question\n", printable(one.name),
                    fmt::join(names, ", "), names.size() == 1 ? "is" : "are",
                    names.size() == 1 ? "an input" : "inputs"));
  }
  for (const std::string& text : flags.set) {
    auto fixed = inputs_of(text);
    if (!fixed) return fixed.error();
    for (const ProofInput& input : *fixed) {
      const auto same = [&](const ProofInput& other) { return other.name() == input.name(); };
      if (std::any_of(options.fixed.begin(), options.fixed.end(), same)) {
        return Diagnostic{.message = fmt::format("--set {}: {} is set twice", text, input.name())};
      }
      if (input.constant && std::find(unset.begin(), unset.end(), *input.constant) == unset.end()) {
        const std::string name = name_of_constant(*input.constant);
        return Diagnostic{.message = fmt::format("--set {}: {} is not an input of the question, because no program "
                                                 "reads it without setting it; --free {} makes it one",
                                                 text, name, name)};
      }
      options.fixed.push_back(input);
    }
  }
  return {};
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
  for (const ProofInput& input : example.inputs) inputs[input.name()] = input.byte;
  return {{"inputs", std::move(inputs)},
          {"outputs",
           {{"component", component_name(example.target.reg, example.target.component)},
            {"a", example.a},
            {"b", example.b}}}};
}

std::string counterexample_text(const Counterexample& example) {
  std::vector<std::string> inputs;
  for (const ProofInput& input : example.inputs) {
    inputs.push_back(fmt::format("{} = {}", input.name(), input.byte));
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
