#include "src/tools/verify/verify_vectors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "ninebit/study/vectors.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/input_file.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

// The longest pack and the longest results that are read.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

Result<std::string> text_in(const std::string& path) {
  auto input = InputFile::open(path);
  if (!input) return input.error();
  std::string text;
  while (true) {
    const auto piece = input->read();
    if (!piece) return piece.error();
    if (piece->empty()) return text;
    text += *piece;
    if (text.size() > kMostBytes) return Diagnostic{.message = "the file has more than 1 GiB", .file = path};
  }
}

struct JudgedResults {
  VectorPack pack;
  VectorResults results;
  VectorVerdict verdict;
};

std::string pack_file(const VectorResultsFlags& flags) {
  namespace fs = std::filesystem;
  if (flags.pack.empty()) return (fs::path(flags.results).parent_path() / "vectors.txt").string();
  std::error_code ignored;
  return fs::is_directory(flags.pack, ignored) ? (fs::path(flags.pack) / "vectors.txt").string() : flags.pack;
}

// The profile that the pack names: the one of --profile, or a shipped one.
Result<const HardwareProfile*> profile_named(const std::string& name, const std::string& file,
                                             const VectorResultsFlags& flags) {
  const CommonFlags& common = *flags.common;
  if (name.empty()) {
    return Diagnostic{.message = "expected a pack of `ninebit vectors`, which begins with 'ninebit-vectors 1'",
                      .file = file,
                      .line = 1};
  }
  if (flags.profile_given) {
    if (common.profile == name) return &profile_of(common);
    return Diagnostic{
        .message = fmt::format("the pack is of profile {}, not of {}", name, common.profile), .file = file, .line = 2};
  }
  if (const HardwareProfile* const shipped = find_profile(name)) return shipped;
  return Diagnostic{
      .message = fmt::format("the pack is of profile {}; give its file with --profile", name), .file = file, .line = 2};
}

Result<JudgedResults> judge_results(const VectorResultsFlags& flags) {
  ProgressLine progress(flags.common->quiet || flags.common->json);
  const std::string file = pack_file(flags);
  const auto text = text_in(file);
  if (!text) return text.error();
  const auto profile = profile_named(vector_pack_profile(*text), file, flags);
  if (!profile) return profile.error();
  auto pack = read_vector_pack(*text, file, **profile);
  if (!pack) return pack.error();
  const auto results_text = text_in(flags.results);
  if (!results_text) return results_text.error();
  auto results = read_vector_results(*results_text, flags.results, *pack);
  if (!results) return results.error();
  auto verdict = judge_vectors(*pack, *results, static_cast<std::size_t>(flags.most),
                               [&](double done) { return progress.step("fragments", done); });
  if (!verdict) return verdict.error();
  return JudgedResults{std::move(*pack), std::move(*results), std::move(*verdict)};
}

const Bytes4& shown_color(const JudgedResults& judged, const VectorVerdict::Place& place) {
  return judged.results.programs.at(place.program).colors[place.fragment];
}

std::string with_rules(const std::string& text, const std::string& rules) {
  if (rules.empty()) return text;
  return fmt::format("{} (rule{} {})", text, rules.find(',') == std::string::npos ? "" : "s", rules);
}

std::string text_of(const JudgedResults& judged, const std::string& file) {
  const auto& [pack, results, verdict] = judged;
  std::string text;
  for (const VectorVerdict::Place& place : verdict.first) {
    const VectorProgram& program = pack.programs[place.program];
    text += fmt::format("{}:{}: program {}, fragment {} ({}): shows {}, expected {}\n", printable(file),
                        results.programs.at(place.program).line, place.program + 1, place.fragment + 1,
                        pack.groups[program.group].name, fmt::join(shown_color(judged, place), " "),
                        fmt::join(program.expected[place.fragment], " "));
  }
  if (verdict.differ > verdict.first.size()) {
    text += fmt::format("… and {} more fragments\n", verdict.differ - verdict.first.size());
  }
  text += fmt::format("{} fragments of {} programs: {} agree, {} differ\n", verdict.fragments, results.programs.size(),
                      verdict.fragments - verdict.differ, verdict.differ);
  if (verdict.differ == 0) return text;
  text += fmt::format("\n{:<40}{:>10}{:>10}\n", "groups that differ", "fragments", "differ");
  bool is_first = true;
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorVerdict::GroupCount& count = verdict.groups[g];
    if (count.differ == 0) continue;
    text += fmt::format("  {:<38}{:>10}{:>10}\n", pack.groups[g].name, count.fragments, count.differ);
    if (is_first) text += fmt::format("    {}\n", with_rules(pack.groups[g].what, pack.groups[g].rules));
    is_first = false;
  }
  if (verdict.mistakes.empty()) return text + "\nNo known mistake explains more fragments than it breaks.\n";
  text += fmt::format("\n{:<62}{:>9}  {}\n", "with this mistake", "explains", "fragments that then agree");
  for (const VectorMistake& mistake : verdict.mistakes) {
    text +=
        fmt::format("  {:<60}{:>9}{:>27}\n", with_rules(mistake.name, mistake.rules), mistake.explains, mistake.agree);
  }
  const VectorMistake& best = verdict.mistakes.front();
  if (best.agree < verdict.fragments) return text + "\nNo single mistake explains all of them.\n";
  return text + fmt::format("\nOne mistake explains all of them: {}\n", with_rules(best.name, best.rules));
}

Json json_of(const JudgedResults& judged, const VectorResultsFlags& flags) {
  const auto& [pack, results, verdict] = judged;
  Json groups = Json::array(), mistakes = Json::array(), rows = Json::array();
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    groups.push_back({{"group", pack.groups[g].name},
                      {"rules", pack.groups[g].rules},
                      {"fragments", verdict.groups[g].fragments},
                      {"differ", verdict.groups[g].differ}});
  }
  for (const VectorMistake& mistake : verdict.mistakes) {
    mistakes.push_back({{"mistake", mistake.name},
                        {"rules", mistake.rules},
                        {"explains", mistake.explains},
                        {"agree_then", mistake.agree}});
  }
  for (const VectorVerdict::Place& place : verdict.first) {
    const VectorProgram& program = pack.programs[place.program];
    rows.push_back({{"line", results.programs.at(place.program).line},
                    {"program", place.program + 1},
                    {"fragment", place.fragment + 1},
                    {"group", pack.groups[program.group].name},
                    {"shown", shown_color(judged, place)},
                    {"expected", program.expected[place.fragment]}});
  }
  return {{"command", "verify"},
          {"version", NINEBIT_VERSION},
          {"profile", pack.profile.name},
          {"table", flags.results},
          {"pack", pack.id},
          {"programs", results.programs.size()},
          {"count", verdict.fragments},
          {"agree", verdict.fragments - verdict.differ},
          {"differ", verdict.differ},
          {"groups", std::move(groups)},
          {"mistakes", std::move(mistakes)},
          {"rows", std::move(rows)}};
}

}  // namespace

bool begins_as_vector_results(const std::string& file) {
  // Bytes of a pipe could not be read again.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  auto input = InputFile::open(file);
  if (!input) return false;
  const auto piece = input->read();
  return piece.ok() && are_vector_results(*piece);
}

int verify_vector_results(const VectorResultsFlags& flags) {
  const ThreadLimit limit(flags.common->threads);
  const auto judged = judge_results(flags);
  if (!judged) return report(judged.error());
  const int code = flags.common->json
                       ? answer(json_of(*judged, flags))
                       : answer_exactly(text_of(*judged, flags.results == "-" ? "standard input" : flags.results));
  if (code != kDone) return code;
  return judged->verdict.differ == 0 ? kDone : kDifference;
}

}  // namespace ninebit::tools
