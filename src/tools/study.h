// What the studies share: which profiles they look at, and how a list in a flag is read.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/program.h"

namespace ninebit::tools {

struct StudyFlags {
  CommonFlags common;
  CLI::Option* profile = nullptr;  // --profile: given or not
};

// Adds the common flags; without --profile a study looks at all shipped profiles.
void add_study_flags(CLI::App& verb, StudyFlags& flags);
[[nodiscard]] std::vector<HardwareProfile> profiles_of(const StudyFlags& flags);

// The items of a list with commas between; a validator that demands each to be one of `known`.
[[nodiscard]] std::vector<std::string> items_of(const std::string& list);
[[nodiscard]] CLI::Validator list_of(std::vector<std::string> known);

void add_study_index_steps(CLI::App& study, int& exit_code);
void add_study_datapath(CLI::App& study, int& exit_code);
void add_study_depth_packing(CLI::App& study, int& exit_code);
void add_study_shadows(CLI::App& study, int& exit_code);

}  // namespace ninebit::tools
