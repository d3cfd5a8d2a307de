// `ninebit study index-steps`: counts the pairs of different indices that a comparison finds equal.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "ninebit/language/profile_json.h"
#include "ninebit/study/index_steps.h"
#include "src/system/number_list.h"
#include "src/tools/common/program_file.h"
#include "src/tools/study/study.h"

namespace ninebit::tools {
namespace {

struct IndexStepsFlags {
  StudyFlags study;
  std::string steps = "1-16";
  std::string formats, variants;
  std::string program;
  std::vector<std::string> defines;  // as ProgramFlags::defines
};

std::vector<std::string> all_formats() {
  std::vector<std::string> names;
  names.reserve(kStudyFormats.size());
  for (const StudyFormat format : kStudyFormats) names.emplace_back(name_of(format));
  return names;
}

std::vector<std::string> all_variants() {
  std::vector<std::string> names;
  for (const IndexVariant& variant : index_variants()) names.emplace_back(variant.name);
  return names;
}

// The first and the last step of a list without gaps, such as 1-16 or 1,2,3.
std::optional<std::pair<int, int>> steps_of(const std::string& text) {
  const auto n = whole_numbers_in(text);
  if (!n || n->front() < 1 || n->back() > 255) return std::nullopt;
  for (std::size_t i = 1; i < n->size(); ++i) {
    if ((*n)[i] != (*n)[i - 1] + 1) return std::nullopt;
  }
  return std::pair{n->front(), n->back()};
}

// Keeps the elements that the list names, in their own order; an empty list keeps all.
template <class T, class Name>
void keep_named(std::vector<T>& all, const std::string& list, const Name& name) {
  if (list.empty()) return;
  const std::vector<std::string> wanted = items_of(list);
  std::erase_if(all, [&](const T& one) { return std::find(wanted.begin(), wanted.end(), name(one)) == wanted.end(); });
}

// The file's program for a profile. For a text with faults, reports the first.
Result<CombinerState> read_state(const std::string& name, const std::vector<std::string>& defines,
                                 const HardwareProfile& profile) {
  auto file = read_program_file({.file = name, .defines = defines}, profile);
  if (!file) return file.error();
  if (file->parsed) return file->parsed->state;
  const std::vector<TextFault>& faults = file->parsed.faults();
  TextFault first = faults.front();
  first.file.clear();
  std::string message = first.text();
  if (faults.size() > 1) message += fmt::format(" (the first of {} faults)", faults.size());
  return Diagnostic{.message = std::move(message), .file = file->name};
}

Result<std::unique_ptr<Study>> make_index_steps(const IndexStepsFlags& flags) {
  auto question = question_of(flags.study, "index-steps");
  if (!question) return question.error();
  IndexStepsOptions options{.profiles = profiles_of(flags.study), .question = *std::move(question)};
  if (flags.study.common.own_profile) options.profile_text = flags.study.common.own_profile->text;
  std::tie(options.first_step, options.last_step) = *steps_of(flags.steps);
  keep_named(options.formats, flags.formats, [](StudyFormat format) { return name_of(format); });
  keep_named(options.variants, flags.variants, [](const IndexVariant& variant) { return variant.name; });
  if (!flags.program.empty()) {
    if (const Status added = add_content(options.question, flags.program); !added) return added.error();
    for (const std::string& one : flags.defines) options.question.options.emplace_back("--define", one);
    options.program = IndexProgram{.file = flags.program, .states = {}};
    for (const HardwareProfile& profile : options.profiles) {
      auto state = read_state(flags.program, flags.defines, profile);
      if (!state) return state.error();
      options.program->states.push_back(*std::move(state));
    }
  }
  return index_steps_study(std::move(options));
}

// Separate comparisons differ from the other variants only if an index has several channels.
void check_variants(const IndexStepsFlags& flags) {
  if (flags.formats.empty() || flags.variants.empty()) return;
  const std::vector<std::string> formats = items_of(flags.formats), variants = items_of(flags.variants);
  const bool several = std::any_of(kStudyFormats.begin(), kStudyFormats.end(), [&](StudyFormat format) {
    return channels_of(format) > 1 && std::find(formats.begin(), formats.end(), name_of(format)) != formats.end();
  });
  const auto all = index_variants();
  const bool any = std::any_of(all.begin(), all.end(), [&](const IndexVariant& variant) {
    return !variant.separate && std::find(variants.begin(), variants.end(), variant.name) != variants.end();
  });
  if (several || any) return;
  throw CLI::ValidationError(
      fmt::format("--variants {}: separate comparisons differ from the others only if an index "
                  "has several channels; expected --formats rgb or la, or another variant",
                  flags.variants));
}

}  // namespace

void add_study_index_steps(CLI::App& verbs, StudyRequest& request) {
  CLI::App* verb = verbs.add_subcommand("index-steps", "Count false matches of index comparisons, by step");
  verb->footer(
      "Examples:\n"
      "  ninebit study index-steps\n"
      "  ninebit study index-steps --profile geforce2 --formats channel,rgb --steps 1-4 --json\n"
      "  ninebit study index-steps --program docs/programs/index_compare.gl --formats rgb -o out");
  auto flags = std::make_shared<IndexStepsFlags>();
  add_study_flags(*verb, flags->study);
  verb->add_option("--steps", flags->steps, "Steps between indices to measure, such as 1-4")
      ->type_name("LIST")
      ->capture_default_str()
      ->check(list_by(&steps_of, "consecutive whole numbers from 1 to 255, such as 1-16"));
  verb->add_option("--formats", flags->formats, "Formats of an index (default: all): channel,rgb,la,l,a")
      ->type_name("LIST")
      ->check(list_of(all_formats()));
  CLI::Option* variants =
      verb->add_option("--variants", flags->variants, "Variants of the article's program (default: all)")
          ->type_name("LIST")
          ->check(list_of(all_variants()));
  const auto check_file = [](const std::string& text) -> std::string {
    return text.empty() || text == "-" ? "a study reads its program more than once; expected a file's name" : "";
  };
  CLI::Option* program = verb->add_option("--program", flags->program,
                                          "Own program: compares primary with texture 0, gives alpha 0 if equal")
                             ->type_name("FILE")
                             ->check(CLI::Validator(check_file, ""))
                             ->excludes(variants);
  add_define_flag(*verb, flags->defines);
  verb->get_option("--define")->needs(program);
  verb->callback([flags, &request] {
    check_variants(*flags);
    request.flags = &flags->study;
    request.make = [flags] { return make_index_steps(*flags); };
  });
}

}  // namespace ninebit::tools
