// `ninebit prove discriminate`: the shortest program that tells two profiles, or two values of a field, apart.
#include <fmt/ranges.h>

#include <memory>

#include "ninebit/study/combiner_fields.h"
#include "ninebit/study/discriminate.h"
#include "src/system/nearest_name.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/printable.h"
#include "src/tools/prove/prove.h"

namespace ninebit::tools {
namespace {

struct DiscriminateFlags {
  CommonFlags common;
  ProfileChoice a, b;
  std::string field;  // empty: not given
};

// A side of the question: a profile, and what it is called.
struct Side {
  HardwareProfile profile;
  std::string name;
};

std::vector<CombinerField> fields_of(const HardwareProfile& profile) {
  auto fields = arithmetic_fields(profile);
  for (CombinerField& field : register_fields(profile)) fields.push_back(std::move(field));
  return fields;
}

// The profile with its own value of a field, and with the rival.
std::array<Side, 2> sides_of_field(const HardwareProfile& profile, const std::string& name) {
  std::vector<std::string> names;
  for (const CombinerField& field : fields_of(profile)) {
    names.emplace_back(field.name);
    if (field.name != name) continue;
    Side own{profile, fmt::format("{} = {}", name, field.values[0].word)},
        rival{profile, fmt::format("{} = {}", name, field.values[1].word)};
    field.values[0].set(own.profile);
    field.values[1].set(rival.profile);
    return {own, rival};
  }
  throw CLI::ValidationError("--field",
                             fmt::format("unknown field '{}' of profile {}; expected one of {}{}", printable(name),
                                         printable(profile.name), fmt::join(names, ", "), did_you_mean(name, names)));
}

std::array<Side, 2> sides_of(const DiscriminateFlags& flags) {
  if (!flags.field.empty()) return sides_of_field(profile_of(flags.common), flags.field);
  const HardwareProfile &a = profile_of(flags.a), &b = profile_of(flags.b);
  return {Side{a, std::string(a.name)}, Side{b, std::string(b.name)}};
}

// The names of the fields of the arithmetic and of initial registers in which both differ.
std::vector<std::string> different_fields(const HardwareProfile& a, const HardwareProfile& b) {
  std::vector<std::string> names;
  const auto of_a = fields_of(a), of_b = fields_of(b);
  for (const CombinerField& field : of_a) {
    for (const CombinerField& other : of_b) {
      if (field.name == other.name && field.values[0].word != other.values[0].word) names.emplace_back(field.name);
    }
  }
  return names;
}

// The bytes that the program reads, by the name of their source.
Json inputs_of(const Discriminator& found) {
  Json inputs = Json::object();
  const std::array<std::pair<const char*, const char*>, 3> sources{
      {{"tex0", "tex0"}, {"tex1", "tex1"}, {"col0", "primary"}}};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto [written, name] = sources[i];
    const bool is_off = i < 2 && found.texture_off[i];
    if (!is_off && found.rc10.find(written) != std::string::npos) inputs[name] = found.bytes[i];
  }
  return inputs;
}

std::vector<int> units_off(const Discriminator& found) {
  std::vector<int> units;
  for (int unit = 0; unit < 4; ++unit) {
    if (found.texture_off[static_cast<std::size_t>(unit)]) units.push_back(unit);
  }
  return units;
}

Json json_of(const Discrimination& proof, const std::array<Side, 2>& sides) {
  Json out = proof_json("discriminate", proof.answer, ProofMethod::exhaustive, proof.cases);
  out["profiles"] = {sides[0].name, sides[1].name};
  out["fields"] = different_fields(sides[0].profile, sides[1].profile);
  if (proof.found) {
    out["program"] = proof.found->rc10;
    out["general_combiners"] = proof.found->general_combiners;
    out["shortest"] = proof.shortest;
    out["texture_off"] = units_off(*proof.found);
    if (proof.found->fog_off) out["fog_off"] = true;
    out["counterexample"] = {{"inputs", inputs_of(*proof.found)},
                             {"outputs", {{"component", "out.rgb"}, {"a", proof.a}, {"b", proof.b}}}};
  }
  if (!proof.reason.empty()) out["reason"] = proof.reason;
  return out;
}

std::string text_of(const Discrimination& proof, const std::array<Side, 2>& sides) {
  const std::string a = printable(sides[0].name), b = printable(sides[1].name);
  if (proof.answer == ProofAnswer::proved) {
    return fmt::format("proved: no program tells {} and {} apart: every step of the arithmetic agrees ({} cases run)\n",
                       a, b, proof.cases);
  }
  if (!proof.found) return fmt::format("unknown: {}\n", proof.reason);
  const Discriminator& found = *proof.found;
  std::string text = fmt::format("refuted: this program tells {} and {} apart\n{}", a, b, found.rc10);
  for (const int unit : units_off(found)) text += fmt::format("texture unit {} off\n", unit);
  if (found.fog_off) text += "fog off\n";
  std::vector<std::string> inputs;
  const Json read = inputs_of(found);
  for (const auto& [name, byte] : read.items()) inputs.push_back(fmt::format("{} = {}", name, byte.dump()));
  text += fmt::format("{}out.rgb is {} and {}\n",
                      inputs.empty() ? "" : fmt::format("with {}: ", fmt::join(inputs, ", ")), proof.a, proof.b);
  text += fmt::format("general combiners: {}{}; {} cases run\n", found.general_combiners,
                      proof.shortest ? ", the fewest possible" : "", proof.cases);
  return text;
}

int run(const DiscriminateFlags& flags) {
  const CommonFlags& common = flags.common;
  if (flags.field.empty() && flags.b.name.empty()) {
    throw CLI::RequiredError("two profiles, or --field");
  }
  const auto sides = sides_of(flags);
  const ThreadLimit limit(common.threads);
  ProgressLine progress(common.quiet || common.json);
  const auto proof =
      discriminate(sides[0].profile, sides[1].profile, [&](double done) { return progress.step("programs", done); });
  if (!proof) return report(proof.error());
  const int code = common.json ? answer(json_of(*proof, sides)) : answer_exactly(text_of(*proof, sides));
  return code != kDone ? code : exit_code_of(proof->answer);
}

}  // namespace

void add_prove_discriminate(CLI::App& prove, int& exit_code) {
  CLI::App* verb = prove.add_subcommand(
      "discriminate", "Find the shortest program that tells two profiles apart, or prove that there is none");
  verb->footer(
      "All steps of the arithmetic are compared over all codes. Where they agree, no program of any length differs.\n"
      "Else programs are searched: with no general combiner, one, two, each with one product.\n"
      "Exit codes: 0 no program differs, 1 one does or the answer is unknown.\n"
      "Examples:\n"
      "  ninebit prove discriminate geforce2 nv2a\n"
      "  ninebit prove discriminate --field half --profile nv2a --json");
  auto flags = std::make_shared<DiscriminateFlags>();
  add_common_flags(*verb, flags->common);
  CLI::Option* a = add_profile_option(*verb, "profile1", flags->a, "The first profile");
  CLI::Option* b = add_profile_option(*verb, "profile2", flags->b, "The second profile");
  CLI::Option* field =
      verb->add_option("--field", flags->field, "Compare the value that --profile has of this field with its rival")
          ->type_name("NAME");
  a->needs(b);
  field->excludes(a);
  a->excludes(verb->get_option("--profile"));
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
