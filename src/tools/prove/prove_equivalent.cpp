// `ninebit prove equivalent`: whether two programs leave the same for all inputs.
#include <fmt/format.h>

#include <memory>

#include "src/system/nearest_name.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/printable.h"
#include "src/tools/prove/opaque_texels.h"
#include "src/tools/prove/prove.h"

namespace ninebit::tools {
namespace {

struct EquivalentFlags {
  ProofFlags proof;
  ProgramFlags a, b;
  std::vector<std::string> defines;  // as ProgramFlags::defines
  ProfileChoice other;               // of B; not given: that of A
  std::vector<std::string> outputs;
};

// Every component that may be compared, by its name.
std::vector<std::pair<std::string, ProofTarget>> all_targets(int units) {
  std::vector<std::pair<std::string, ProofTarget>> all;
  const auto add = [&](std::optional<Register> reg) {
    for (int c = 0; c < 4; ++c) all.emplace_back(component_name(reg, c), ProofTarget{reg, c});
  };
  add(std::nullopt);
  for (const Register r : {Register::spare0, Register::spare1, Register::primary, Register::secondary}) add(r);
  for (int unit = 0; unit < units; ++unit) add(texture_register(unit));
  return all;
}

std::string check_target(const std::string& text) {
  std::vector<std::string> names;
  for (const auto& [name, target] : all_targets(4)) {
    if (name == text) return {};
    names.push_back(name);
  }
  return fmt::format("unknown output '{}'; expected out.r to out.a, or a component of a register, such as spare0.a{}",
                     text, did_you_mean(text, names));
}

std::vector<ProofTarget> targets_of(const std::vector<std::string>& names) {
  std::vector<ProofTarget> targets;
  for (const auto& [name, target] : all_targets(4)) {
    if (std::find(names.begin(), names.end(), name) != names.end()) targets.push_back(target);
  }
  return targets;
}

Json json_of(const EquivalenceAnswer& proof, const EquivalentFlags& flags, const HardwareProfile& other,
             const TexelsOfStages& texels) {
  Json out = proof_json("equivalent", proof.answer, proof.method, proof.cases);
  out["profile"] = flags.proof.common.profile;
  out["other_profile"] = other.name;
  out["programs"] = {flags.a.file, flags.b.file};
  if (proof.counterexample) out["counterexample"] = counterexample_json(*proof.counterexample);
  if (!proof.reason.empty()) out["reason"] = proof.reason;
  if (!texels.opaque.empty()) out["opaque"] = texels.opaque;
  return out;
}

std::string text_of(const EquivalenceAnswer& proof, const EquivalentFlags& flags) {
  const std::string a = printable(flags.a.file), b = printable(flags.b.file);
  switch (proof.answer) {
    case ProofAnswer::proved:
      return fmt::format("proved: {} and {} give the same for all inputs ({}, {} cases run)\n", a, b,
                         proof.method == ProofMethod::smt ? "by formulas" : "all cases", proof.cases);
    case ProofAnswer::refuted:
      return fmt::format("refuted: {} and {} differ\n{}\n", a, b, counterexample_text(*proof.counterexample));
    case ProofAnswer::unknown:
      break;
  }
  return fmt::format("unknown: {}\n", proof.reason);
}

std::optional<TextProgram> program_in(Result<ProgramSource> source, const ProgramFlags& flags,
                                      const HardwareProfile& profile, bool quiet, int& exit_code) {
  if (source) return load_text_program(std::move(*source), flags, profile, quiet, exit_code);
  exit_code = report(source.error());
  return std::nullopt;
}

// Programs whose stages give other texels are not compared.
Result<EquivalenceAnswer> answer_of(const TextProgram& a, const HardwareProfile& profile, const TextProgram& b,
                                    const HardwareProfile& other, const TexelsOfStages& texels,
                                    const EquivalenceOptions& options) {
  if (texels.reason.empty())
    return prove_equivalent({a.state, profile, {}, false}, {b.state, other, {}, false}, options);
  EquivalenceAnswer unknown;
  unknown.reason = texels.reason;
  return unknown;
}

int run(const EquivalentFlags& flags) {
  const CommonFlags& common = flags.proof.common;
  const HardwareProfile &profile = profile_of(common),
                        &other = flags.other.name.empty() ? profile : profile_of(flags.other);
  ProgramFlags of_a = flags.a, of_b = flags.b;
  of_a.defines = of_b.defines = flags.defines;
  of_b.allow_outside = of_a.allow_outside;
  auto source_of_a = open_program(of_a), source_of_b = open_program(of_b);
  // Definitions are for both programs or for one of them; if neither takes them, the first says so.
  const auto takes = [](const Result<ProgramSource>& source) {
    return source && form_row(source->form).takes_definitions;
  };
  if (!takes(source_of_a) && takes(source_of_b)) of_a.defines.clear();
  if (!takes(source_of_b)) of_b.defines.clear();
  int exit_code = kDone;
  auto a = program_in(std::move(source_of_a), of_a, profile, common.quiet, exit_code),
       b = program_in(std::move(source_of_b), of_b, other, common.quiet, exit_code);
  if (!a || !b) return exit_code;
  const ThreadLimit limit(common.threads);
  ProgressLine progress(common.quiet || common.json);
  EquivalenceOptions options = options_of(flags.proof, progress);
  options.targets = targets_of(flags.outputs);
  const Status chosen = choose_inputs(flags.proof, {{flags.a.file, &a->state}, {flags.b.file, &b->state}}, options);
  if (!chosen) throw CLI::ValidationError(chosen.error().message);
  const TexelsOfStages texels =
      texels_of_stages({{flags.a.file, &*a, &profile}, {flags.b.file, &*b, &other}}, options.targets);
  apply_texels(texels, common.quiet, options.fixed);
  const auto proof = answer_of(*a, profile, *b, other, texels, options);
  if (!proof) return report(proof.error());
  const int code = common.json ? answer(json_of(*proof, flags, other, texels)) : answer_exactly(text_of(*proof, flags));
  return code != kDone ? code : exit_code_of(proof->answer);
}

}  // namespace

void add_prove_equivalent(CLI::App& prove, int& exit_code) {
  CLI::App* verb = prove.add_subcommand("equivalent", "Prove that two programs give the same for all inputs");
  verb->footer(
      "Inputs are bytes: colours, fog, texels, and constants that a program does not set (const0.r to const0.a; const5 "
      "is\n"
      "c5 of a pixel shader; stage1.const0 is that of a general combiner with constants of its own). A constant that "
      "both\n"
      "programs do not set is one input. --set fixes an input, --free makes a constant that a program sets one.\n"
      "What a texture-shader stage reads through another texel is an opaque input, if both programs read it alike; "
      "the\n"
      "answer is unknown if they do not.\n"
      "Inputs that no output depends on are left out. Up to 2^34 cases are run, more by independent parts; beyond "
      "that\n"
      "the solver z3 is asked, if it is installed.\n"
      "Exit codes: 0 proved, 1 refuted or unknown, 3 a program cannot be read or is invalid.\n"
      "Examples:\n"
      "  ninebit prove equivalent compare.gl shorter.gl\n"
      "  ninebit prove equivalent compare.gl compare.gl --other-profile nv2a --json\n"
      "  ninebit prove equivalent tint.rc1 tint.psh --set const0=255,128,0,255");
  auto flags = std::make_shared<EquivalentFlags>();
  add_proof_flags(*verb, flags->proof);
  add_program_argument(*verb, "a", flags->a);
  add_program_argument(*verb, "b", flags->b);
  add_define_flag(*verb, flags->defines);
  add_include_flag(*verb, flags->a.allow_outside);
  add_profile_option(*verb, "--other-profile", flags->other,
                     "Profile of the second program (default: that of the first)");
  verb->add_option("--outputs", flags->outputs,
                   "Compare only these: components of the colour, out.r to out.a, or of registers after the last "
                   "general combiner (default: the colour)")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(CLI::Validator(check_target, ""));
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
