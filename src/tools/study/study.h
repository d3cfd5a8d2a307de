// Shared by the studies: their flags, lists in flags, and running and reporting a study.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/study.h"
#include "ninebit/study/study_part.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct StudyFlags {
  CommonFlags common;
  CLI::Option* profile = nullptr;     // --profile; null: the study has none
  std::vector<std::string> profiles;  // of a list of several names; else empty
  std::string folder;                 // -o; empty: the answers go to stdout, and nothing is saved
  std::string shard = "1/1";
  std::optional<double> budget;  // seconds
};

// The study that a command line requests, and its flags. The verb of the study sets it while the command line is
// parsed; `flags` lives as long as `make`.
struct StudyRequest {
  std::function<Result<std::unique_ptr<Study>>()> make;
  const StudyFlags* flags = nullptr;
};

// Adds the common flags, -o, --shard and --budget. Without --profile, a study measures all shipped profiles; a study
// of other things than the hardware has no --profile.
enum class StudyProfiles { none, one, several };
void add_study_flags(CLI::App& verb, StudyFlags& flags, StudyProfiles profiles = StudyProfiles::several);
[[nodiscard]] std::vector<HardwareProfile> profiles_of(const StudyFlags& flags);
[[nodiscard]] Shard shard_of(const StudyFlags& flags);

// A question with its profile; the caller adds the study's own options.
[[nodiscard]] Result<StudyQuestion> question_of(const StudyFlags& flags, std::string study);

// Adds the hash of a file that the question depends on. Reports a file that cannot be read.
[[nodiscard]] Status add_content(StudyQuestion& question, const std::string& file);

void add_study_index_steps(CLI::App& verbs, StudyRequest& request);
void add_study_datapath(CLI::App& verbs, StudyRequest& request);
void add_study_depth_packing(CLI::App& verbs, StudyRequest& request);
void add_study_shadows(CLI::App& verbs, StudyRequest& request);

// Adds the verbs of all studies; also used to parse the question of a part.
void add_studies(CLI::App& verbs, StudyRequest& request);

// Runs the study, prints the answer and returns the exit code.
[[nodiscard]] int run_study(const StudyRequest& request);

// `ninebit study merge`: joins parts into the same files as a single run.
void add_study_merge(CLI::App& verbs, int& exit_code);

}  // namespace ninebit::tools
