// `ninebit study`: measures the effects of nine-bit arithmetic.
#include "src/tools/study/study.h"

#include <fmt/format.h>

#include <utility>

#include "src/system/hashing/openssl.h"
#include "src/system/number_list.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/input/input_file.h"

namespace ninebit::tools {
namespace {

std::optional<Shard> parse_shard(const std::string& text) {
  const auto n = numbers<std::size_t>(text, '/');
  if (!n || n->size() != 2 || n->front() < 1 || n->front() > n->back()) return std::nullopt;
  return Shard{n->front(), n->back()};
}

}  // namespace

void add_study_flags(CLI::App& verb, StudyFlags& flags, StudyProfiles profiles) {
  add_answer_flags(verb, flags.common);
  if (profiles != StudyProfiles::none) {
    add_profile_flag(verb, flags.common, profiles == StudyProfiles::several ? &flags.profiles : nullptr);
    flags.profile = verb.get_option("--profile");
  }
  if (profiles == StudyProfiles::several) {
    flags.profile->description(flags.profile->get_description() + " (default: all)")->default_str("");
  }
  add_threads_flag(verb, flags.common);
  CLI::Option* folder = verb.add_option("-o,--output", flags.folder,
                                        "Folder for report.html, rows.json, tables and pictures; created if missing. "
                                        "An interrupted run resumes there")
                            ->type_name("DIR");
  const auto check_shard = [](const std::string& text) -> std::string {
    return parse_shard(text) ? ""
                             : fmt::format("'{}' is not a shard; expected I/N with I from 1 to N, such as 2/8", text);
  };
  verb.add_option("--shard", flags.shard, "Run part I of N; `ninebit study merge` joins the parts")
      ->type_name("I/N")
      ->check(CLI::Validator(check_shard, ""))
      ->needs(folder);
  verb.add_option("--budget", flags.budget, "Start no new unit after this time; run the same command to resume")
      ->type_name("SECONDS")
      ->check(real_in_range(0.0, kMostSeconds))
      ->needs(folder);
}

std::vector<HardwareProfile> profiles_of(const StudyFlags& flags) {
  std::vector<HardwareProfile> named;
  for (const std::string& name : flags.profiles) named.push_back(*find_profile(name));
  if (!named.empty()) return named;
  if (flags.profile->count() > 0) return {profile_of(flags.common)};
  const auto all = hardware_profiles();
  return {all.begin(), all.end()};
}

Shard shard_of(const StudyFlags& flags) {
  return *parse_shard(flags.shard);
}

Result<StudyQuestion> question_of(const StudyFlags& flags, std::string study) {
  StudyQuestion question{.study = std::move(study), .profile = "all"};
  if (flags.profile->count() == 0) return question;
  question.profile = flags.common.profile;
  if (flags.common.own_profile) {
    question.profile = flags.common.profile_file;
    if (Status added = add_content(question, flags.common.profile_file); !added) return added.error();
  }
  return question;
}

Status add_content(StudyQuestion& question, const std::string& file) {
  auto input = InputFile::open(file);
  if (!input) return input.error();
  Sha256 hash;
  while (true) {
    const auto piece = input->read();
    if (!piece) return piece.error();
    if (piece->empty()) break;
    hash.add(*piece);
  }
  question.options.emplace_back("sha256 of " + file, hash.finish());
  return {};
}

void add_studies(CLI::App& verbs, StudyRequest& request) {
  add_study_index_steps(verbs, request);
  add_study_datapath(verbs, request);
  add_study_depth_packing(verbs, request);
  add_study_shadows(verbs, request);
}

void add_study(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("study", "Measure the effects of nine-bit arithmetic: false matches, errors, wrong pixels");
  verb->require_subcommand(1);
  verb->footer(
      "Examples:\n"
      "  ninebit study index-steps\n"
      "  ninebit study datapath -o out\n"
      "Run `ninebit study STUDY --help` for the flags of a study.");
  auto request = std::make_shared<StudyRequest>();
  add_studies(*verb, *request);
  add_study_merge(*verb, exit_code);
  verb->callback([request, &exit_code] {
    if (request->make) exit_code = run_study(*request);
  });
}

}  // namespace ninebit::tools
