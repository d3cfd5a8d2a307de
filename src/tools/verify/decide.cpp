#include "src/tools/verify/decide.h"

#include <fmt/ranges.h>

#include <charconv>

#include "ninebit/study/chip_kit.h"
#include "src/tools/common/kit_table.h"
#include "src/tools/common/output_file.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct Decided {
  ChipKit kit;
  KitResults results;
  KitVerdict verdict;
};

std::string names_of(const std::vector<std::size_t>& programs) {
  std::vector<std::string> names;
  for (const std::size_t program : programs) names.push_back(kit_name(program));
  return fmt::format("{}", fmt::join(names, ", "));
}

// "k1 = 53 and k4 = 0".
std::string colors_of(const std::vector<std::size_t>& programs, const std::vector<int>& shown) {
  std::vector<std::string> colors;
  for (const std::size_t i : programs) colors.push_back(fmt::format("{} = {}", kit_name(i), shown[i]));
  return fmt::format("{}", fmt::join(colors, " and "));
}

Result<Decided> judge(const DecideFlags& flags, ProgressLine& progress) {
  auto file = InputFile::open(flags.results);  // a wrong name is said before the kit is searched
  if (!file) return file.error();
  auto kit =
      make_chip_kit(profile_of_family(flags.family), [&](double done) { return progress.step("combinations", done); });
  if (!kit) return kit.error();
  auto results = read_kit_results(std::move(*file), *kit);
  if (!results) return results.error();
  auto verdict = decide(*kit, results->shown);
  if (verdict.fitting.empty()) {
    const bool is_one = verdict.contradiction.size() == 1;
    return Diagnostic{.message = fmt::format("no values of the fields of {} show {}{}", flags.family,
                                             colors_of(verdict.contradiction, results->shown),
                                             is_one ? "" : " together: these rows exclude each other"),
                      .file = flags.results};
  }
  return Decided{std::move(*kit), std::move(*results), std::move(verdict)};
}

Json json_of_word(const std::string& word) {
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size() ? Json(number) : Json(word);
}

// The renderer of the driver; empty: the table has none.
std::string chip_of(const KitResults& results) {
  constexpr std::string_view kRenderer = "renderer: ";
  for (const std::string& comment : results.comments) {
    if (comment.starts_with(kRenderer)) return comment.substr(kRenderer.size());
  }
  return {};
}

// The profile of the first combination that fits: the family's, and what differs from it.
Json profile_json(const Decided& decided, const DecideFlags& flags) {
  Json profile{{"base", flags.family}, {"name", flags.family + "-card"}};
  if (const std::string chip = chip_of(decided.results); !chip.empty()) profile["chip"] = chip;
  const auto& combination = decided.kit.combinations[decided.verdict.fitting.front()];
  for (std::size_t i = 0; i < combination.size(); ++i) {
    const CombinerField& field = decided.kit.fields[i];
    if (combination[i] != 0) profile[std::string(field.name)] = json_of_word(field.values[combination[i]].word);
  }
  return profile;
}

Status write_profile(const Json& profile, const std::string& path) {
  return write_output(path, profile.dump(2) + "\n");
}

Json json_of(const Decided& decided, const DecideFlags& flags) {
  Json fields = Json::array();
  for (std::size_t i = 0; i < decided.kit.fields.size(); ++i) {
    const CombinerField& field = decided.kit.fields[i];
    const FieldVerdict& verdict = decided.verdict.fields[i];
    Json fits = Json::array(), excluded = Json::array();
    for (std::size_t value = 0; value < field.values.size(); ++value) {
      const Json word = json_of_word(field.values[value].word);
      if (verdict.fits[value]) {
        fits.push_back(word);
        continue;
      }
      Json by = Json::array();
      for (const std::size_t program : verdict.excluded_by[value]) by.push_back(kit_name(program));
      excluded.push_back({{"value", word}, {"by", std::move(by)}});
    }
    fields.push_back({{"field", field.name}, {"fits", std::move(fits)}, {"excluded", std::move(excluded)}});
  }
  return {{"command", "verify"},
          {"version", NINEBIT_VERSION},
          {"table", flags.results},
          {"family", flags.family},
          {"card", decided.results.comments},
          {"rows", decided.results.shown.size()},
          {"combinations", decided.kit.combinations.size()},
          {"fitting", decided.verdict.fitting.size()},
          {"fields", std::move(fields)},
          {"profile", profile_json(decided, flags)},
          {"output", flags.output.empty() ? Json(nullptr) : Json(flags.output)}};
}

std::string text_of(const Decided& decided) {
  std::string text;
  for (const std::string& comment : decided.results.comments) text += printable(comment) + "\n";
  text += fmt::format("{} of {} combinations fit\n\n{:<32}{:<24}{:<24}{}\n", decided.verdict.fitting.size(),
                      decided.kit.combinations.size(), "field", "fits", "excluded", "by");
  for (std::size_t i = 0; i < decided.kit.fields.size(); ++i) {
    const CombinerField& field = decided.kit.fields[i];
    const FieldVerdict& verdict = decided.verdict.fields[i];
    std::vector<std::string> fits, excluded, by;
    for (std::size_t value = 0; value < field.values.size(); ++value) {
      const std::string& word = field.values[value].word;
      if (verdict.fits[value]) {
        fits.push_back(word);
      } else {
        excluded.push_back(word);
        by.push_back(names_of(verdict.excluded_by[value]));
      }
    }
    text += fmt::format("{:<32}{:<24}", field.name, fmt::format("{}", fmt::join(fits, ", ")));
    text += excluded.empty() ? std::string("nothing tells\n")
                             : fmt::format("{:<24}{}\n", fmt::format("{}", fmt::join(excluded, ", ")),
                                           fmt::format("{}", fmt::join(by, "; ")));
  }
  return text;
}

}  // namespace

int decide_fields(const DecideFlags& flags) {
  ProgressLine progress(flags.quiet || flags.json);
  const auto decided = judge(flags, progress);
  if (!decided) return report(decided.error());
  if (!flags.output.empty()) {
    if (Status written = write_profile(profile_json(*decided, flags), flags.output); !written) {
      return report(written.error());
    }
    if (!flags.json && !flags.quiet) say_written(flags.output);
  }
  return flags.json ? answer(json_of(*decided, flags)) : answer_exactly(text_of(*decided));
}

}  // namespace ninebit::tools
