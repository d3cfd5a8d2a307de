// `ninebit prove stable`: whether a field of the profile that nobody has measured changes what a program computes.
#include <fmt/ranges.h>

#include <memory>

#include "ninebit/study/stability.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/printable.h"
#include "src/tools/prove/opaque_texels.h"
#include "src/tools/prove/prove.h"

namespace ninebit::tools {
namespace {

struct StableFlags {
  ProofFlags proof;
  ProgramFlags program;
};

std::string_view effect_word(ProofAnswer answer) {
  return answer == ProofAnswer::proved ? "no effect" : answer == ProofAnswer::refuted ? "matters" : "unknown";
}

std::string rival_words(const CombinerField& field) {
  std::vector<std::string> words;
  for (std::size_t i = 1; i < field.values.size(); ++i) words.push_back(field.values[i].word);
  return fmt::format("{}", fmt::join(words, ", "));
}

// "; with half = 127; unit 0 off", what an example needs besides its input.
std::string conditions_of(const FieldEffect& effect) {
  std::string text;
  for (const auto& [name, word] : effect.others) text += fmt::format("; {} = {}", name, word);
  if (effect.texture_off >= 0) text += fmt::format("; texture unit {} off", effect.texture_off);
  if (effect.fog_off) text += "; fog off";
  return text;
}

Json json_of(const StabilityAnswer& proof, const StableFlags& flags, const TexelsOfStages& texels) {
  Json out = proof_json("stable", proof.answer, proof.method, proof.cases);
  out["profile"] = flags.proof.common.profile;
  out["program"] = flags.program.file;
  out["combinations"] = proof.combinations;
  Json fields = Json::array();
  for (const FieldEffect& effect : proof.fields) {
    Json field{{"field", effect.field.name},
               {"evidence", name_of(effect.field.evidence)},
               {"value", effect.field.values.front().word},
               {"rivals", Json::array()},
               {"answer", name_of(effect.answer)}};
    for (std::size_t i = 1; i < effect.field.values.size(); ++i) field["rivals"].push_back(effect.field.values[i].word);
    if (effect.example) {
      field["rival"] = effect.field.values[effect.rival].word;
      field["others"] = Json::object();
      for (const auto& [name, word] : effect.others) field["others"][name] = word;
      if (effect.texture_off >= 0) field["texture_off"] = effect.texture_off;
      if (effect.fog_off) field["fog_off"] = true;
      field["counterexample"] = counterexample_json(*effect.example);
    }
    fields.push_back(std::move(field));
  }
  out["fields"] = std::move(fields);
  if (!proof.reason.empty()) out["reason"] = proof.reason;
  if (!texels.opaque.empty()) out["opaque"] = texels.opaque;
  return out;
}

std::string text_of(const StabilityAnswer& proof, const StableFlags& flags) {
  const std::string program = printable(flags.program.file);
  std::string text;
  if (proof.answer == ProofAnswer::proved) {
    text = fmt::format("proved: no open field of {} changes a colour of {}, for any input\n",
                       printable(flags.proof.common.profile), program);
  } else if (proof.answer == ProofAnswer::refuted) {
    text = fmt::format("refuted: colours of {} depend on what is open\n", program);
  } else {
    text = fmt::format("unknown: {}\n", proof.reason);
  }
  text += fmt::format("{} combinations of open fields, {} cases run\n\n{:<32}{:<10}{:<18}{:<18}{}\n",
                      proof.combinations, proof.cases, "field", "evidence", "value", "rivals", "effect");
  for (const FieldEffect& effect : proof.fields) {
    text += fmt::format("{:<32}{:<10}{:<18}{:<18}{}\n", effect.field.name, name_of(effect.field.evidence),
                        effect.field.values.front().word, rival_words(effect.field), effect_word(effect.answer));
    if (effect.example) text += fmt::format("  {}{}\n", counterexample_text(*effect.example), conditions_of(effect));
  }
  return text;
}

int run(const StableFlags& flags) {
  const CommonFlags& common = flags.proof.common;
  const HardwareProfile& profile = profile_of(common);
  int exit_code = kDone;
  auto program = load_text_program(flags.program, profile, common.quiet, exit_code);
  if (!program) return exit_code;
  const ThreadLimit limit(common.threads);
  ProgressLine progress(common.quiet || common.json);
  EquivalenceOptions options = options_of(flags.proof, progress);
  options.random_cases = 10'000'000;  // there are many proofs
  const Status chosen = choose_inputs(flags.proof, {{flags.program.file, &program->state}}, options);
  if (!chosen) throw CLI::ValidationError(chosen.error().message);
  TexelsOfStages texels = texels_of_stages({{flags.program.file, &*program, &profile}}, options.targets);
  if (!texels.opaque.empty()) {
    texels.notes.emplace_back("fields of the profile about texture-shader stages are not part of the question");
  }
  apply_texels(texels, common.quiet, options.fixed);
  const auto proof = prove_stable(program->state, profile, options);
  if (!proof) return report(proof.error());
  const int code = common.json ? answer(json_of(*proof, flags, texels)) : answer_exactly(text_of(*proof, flags));
  return code != kDone ? code : exit_code_of(proof->answer);
}

}  // namespace

void add_prove_stable(CLI::App& prove, int& exit_code) {
  CLI::App* verb = prove.add_subcommand(
      "stable", "Prove that no field of the profile that is inferred or assumed changes what a program computes");
  verb->footer(
      "All combinations of the values of these fields are compared, for all inputs, with all texture units on and "
      "with\n"
      "each unit off that the program reads; fog_alpha_without_fog, where it is open, with fog off. The answer names "
      "the\n"
      "fields that matter, each with an input. Constants that the program does not set are inputs; --set fixes an "
      "input,\n"
      "--free makes a constant that the program sets one.\n"
      "Exit codes: 0 none matters, 1 one matters or the answer is unknown, 3 the program cannot be read or is "
      "invalid.\n"
      "Examples:\n"
      "  ninebit prove stable compare.gl\n"
      "  ninebit prove stable compare.gl --profile nv2a --json");
  auto flags = std::make_shared<StableFlags>();
  add_proof_flags(*verb, flags->proof);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
