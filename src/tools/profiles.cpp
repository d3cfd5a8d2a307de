// `ninebit profiles`: every modelled hardware behaviour and its evidence.
#include <fmt/format.h>

#include <iterator>
#include <memory>

#include "ninebit/numerics/profile_fields.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

constexpr int kSourceColumn = 67;  // of the rows that print_profiles prints

struct ProfileRow {
  std::string field, value, evidence, source;
};

std::vector<ProfileRow> rows_of(const HardwareProfile& p) {
  std::vector<ProfileRow> rows;
  for (const ProfileField& field : profile_fields()) {
    const Choice<int> choice = field.get(p);
    rows.push_back({std::string(field.name), field.text_of(choice.value), std::string(name_of(choice.evidence)),
                    std::string(choice.source)});
  }
  return rows;
}

// `chosen`: only the profile of --profile; else all that ninebit has.
int print_profiles(const CommonFlags& flags, bool chosen) {
  std::vector<HardwareProfile> profiles(hardware_profiles().begin(), hardware_profiles().end());
  if (chosen) profiles = {profile_of(flags)};
  if (!flags.json) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const HardwareProfile& profile : profiles) {
      fmt::format_to(out, "{}: {}\n", printable(profile.name), printable(profile.chip));
      for (const ProfileRow& r : rows_of(profile)) {
        fmt::format_to(out, "  {:<30} {:<22} {:<10} {}\n", r.field, r.value, r.evidence, printable(r.source));
      }
      text += '\n';
    }
    return answer(wrapped_for_terminal(text, kSourceColumn));
  }
  Json rows = Json::array();
  for (const HardwareProfile& profile : profiles) {
    for (const ProfileRow& r : rows_of(profile)) {
      rows.push_back({{"profile", profile.name},
                      {"field", r.field},
                      {"value", r.value},
                      {"evidence", r.evidence},
                      {"source", r.source}});
    }
  }
  const Json out{
      {"command", "profiles"}, {"version", NINEBIT_VERSION}, {"profile", flags.profile}, {"rows", std::move(rows)}};
  return answer(out);
}

}  // namespace

void add_profiles(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("profiles", "List the hardware profiles: every field, its value and its evidence");
  verb->footer(
      "Examples:\n  ninebit profiles --json\n  ninebit profiles --profile nv2a\n  ninebit profiles --profile "
      "mine.json");
  auto flags = std::make_shared<CommonFlags>();
  add_answer_flags(*verb, *flags);
  add_profile_flag(*verb, *flags);
  verb->get_option("--profile")
      ->description("List only this profile: a name, or a .json file (default: all that ninebit has)")
      ->default_str("");
  verb->callback([flags, verb, &exit_code] { exit_code = print_profiles(*flags, verb->count("--profile") > 0); });
}

}  // namespace ninebit::tools
