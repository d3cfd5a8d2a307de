// What the studies share: their flags, how a list in a flag is read, and how a study is run and reported.
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
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct StudyFlags {
  CommonFlags common;
  CLI::Option* profile = nullptr;  // --profile: given or not
  std::string folder;              // -o; empty: the answers go to stdout, and nothing is kept
  std::string shard = "1/1";
  std::optional<double> budget;  // seconds
};

// What a command line asks of `ninebit study`: which study, and the flags that say what becomes of it. Each study's
// verb fills it in while the command line is parsed; `flags` lives as long as `make` does.
struct StudyRequest {
  std::function<Result<std::unique_ptr<Study>>()> make;
  const StudyFlags* flags = nullptr;
};

// Adds the common flags, -o, --shard and --budget; without --profile a study looks at all shipped profiles.
void add_study_flags(CLI::App& verb, StudyFlags& flags);
[[nodiscard]] std::vector<HardwareProfile> profiles_of(const StudyFlags& flags);
[[nodiscard]] Shard shard_of(const StudyFlags& flags);

// A question with its profile; the study's own options are the caller's to add.
[[nodiscard]] Result<StudyQuestion> question_of(const StudyFlags& flags, std::string study);

// Notes the content of a file that the question depends on. Reports a file that cannot be read.
[[nodiscard]] Status add_content(StudyQuestion& question, const std::string& file);

// The items of a list with commas between; a validator that demands each to be one of `known`.
[[nodiscard]] std::vector<std::string> items_of(const std::string& list);
[[nodiscard]] CLI::Validator list_of(std::vector<std::string> known);

// Each study adds its verb.
void add_study_index_steps(CLI::App& verbs, StudyRequest& request);
void add_study_datapath(CLI::App& verbs, StudyRequest& request);
void add_study_depth_packing(CLI::App& verbs, StudyRequest& request);
void add_study_shadows(CLI::App& verbs, StudyRequest& request);

// Adds the verbs of all studies; also for a question that a part holds.
void add_studies(CLI::App& verbs, StudyRequest& request);

// Does what is asked and answers it; gives the exit code.
[[nodiscard]] int run_study(const StudyRequest& request);

// `ninebit study merge`: joins parts to what one run would have written.
void add_study_merge(CLI::App& verbs, int& exit_code);

}  // namespace ninebit::tools
