// `ninebit study`: what nine bits do, counted and measured.
#include "src/tools/study.h"

#include <fmt/format.h>

#include <utility>

namespace ninebit::tools {

void add_study_flags(CLI::App& verb, StudyFlags& flags) {
  add_common_flags(verb, flags.common);
  flags.profile = verb.get_option("--profile");
}

std::vector<HardwareProfile> profiles_of(const StudyFlags& flags) {
  if (flags.profile->count() > 0) return {profile_of(flags.common)};
  const auto all = hardware_profiles();
  return {all.begin(), all.end()};
}

std::vector<std::string> items_of(const std::string& list) {
  std::vector<std::string> items(1);
  for (const char c : list) {
    if (c == ',') {
      items.emplace_back();
    } else {
      items.back() += c;
    }
  }
  return items;
}

CLI::Validator list_of(std::vector<std::string> known) {
  const auto check = [known = std::move(known)](const std::string& text) -> std::string {
    for (const std::string& item : items_of(text)) {
      if (std::find(known.begin(), known.end(), item) != known.end()) continue;
      return fmt::format("'{}' is none of {}", item, fmt::join(known, ", "));
    }
    return {};
  };
  return CLI::Validator(check, "");
}

void add_study(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("study", "What nine bits do: lost indices, errors of the datapath");
  verb->require_subcommand(1);
  verb->footer("Example: ninebit study index-steps\n`ninebit study PART --help` tells a part's flags.");
  add_study_index_steps(*verb, exit_code);
  add_study_datapath(*verb, exit_code);
  add_study_depth_packing(*verb, exit_code);
  add_study_shadows(*verb, exit_code);
}

}  // namespace ninebit::tools
