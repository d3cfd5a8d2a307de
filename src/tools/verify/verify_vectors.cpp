#include "src/tools/verify/verify_vectors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/register_words.h"
#include "ninebit/study/stage_vectors.h"
#include "ninebit/study/vectors.h"
#include "src/system/lines.h"
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

// A fragment that differs.
struct Shown {
  int line = 0;  // of the results
  std::size_t group = 0;
  std::string shown, expected;             // for people
  Json shown_values{}, expected_values{};  // the same
  std::string calls{};                     // the program as GL calls, or as register words if GL has none for it
  std::string inputs{};                    // the registers that it reads, as `trace --set` takes them
};

// Results of a pack of either half of a pixel.
struct JudgedResults {
  std::string id, profile;
  std::vector<VectorGroup> groups;
  std::size_t programs = 0;  // that the results have
  VectorVerdict verdict;
  std::vector<Shown> first{};     // by VectorVerdict::first
  std::vector<Shown> steps{};     // by VectorVerdict::plan
  std::size_t pack_programs = 0;  // that the pack has
  std::size_t first_missing = 0;  // of these, the first one without results, counted from 0
  int missing_line = 2;           // where they would stand: below those of the program before it
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

// The results of a pack whose text is known to be one.
struct Texts {
  std::string pack, pack_file, results, results_file;
  const HardwareProfile* profile = nullptr;
  std::size_t most = 0;
};

// `show(value)` gives a value for people and as JSON.
template <class Pack, class Results, class Show>
JudgedResults judged(const Pack& pack, const Results& results, VectorVerdict verdict, const Show& show) {
  JudgedResults out{pack.id, std::string(pack.profile.name), pack.groups, results.programs.size(), std::move(verdict)};
  out.pack_programs = pack.programs.size();
  for (const auto& [program, given] : results.programs) {
    if (program != out.first_missing) break;
    ++out.first_missing;
    out.missing_line = given.line + 1;
  }
  for (const VectorVerdict::Place& place : out.verdict.first) out.first.push_back(show(place));
  for (const VectorVerdict::Step& step : out.verdict.plan) out.steps.push_back(show({step.program, step.fragment}));
  return out;
}

std::string calls_of(const VectorPack& pack, CombinerState state) {
  // Calls of stages that do not run are left out.
  for (auto i = static_cast<std::size_t>(state.num_general_combiners); i < state.general.size(); ++i) {
    state.general[i] = {};
  }
  auto text = print_gl_calls(state, pack.profile);
  if (!text) text = print_register_words(state, pack.chip, pack.profile);
  return text ? *text : std::string();
}

std::string inputs_of(const VectorPack& pack, const CombinerState& state, const RegisterFile& input) {
  const Program program = normalize(state, pack.profile);
  std::set<Register> read;
  const auto add = [&](const CombinerInput& in) { read.insert(in.reg); };
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    for (const Portion* const portion : {&stage.rgb, &stage.alpha}) {
      for (const CombinerInput* const in : {&portion->a, &portion->b, &portion->c, &portion->d}) add(*in);
      if (portion->out.mux_sum) read.insert(Register::spare0);
    }
  }
  const FinalCombiner& f = program.final_combiner;
  for (const CombinerInput* const in : {&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g}) add(*in);
  if (read.contains(Register::spare0_plus_secondary)) read.insert({Register::spare0, Register::secondary});
  std::string text;
  for (const Register r : kVectorRegisters) {
    if (!read.contains(r)) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", short_name(r), fmt::join(input[r], ","));
  }
  return text;
}

Result<JudgedResults> judge_colors(const Texts& texts, const VectorProgress& go_on) {
  const auto pack = read_vector_pack(texts.pack, texts.pack_file, *texts.profile);
  if (!pack) return pack.error();
  const auto results = read_vector_results(texts.results, texts.results_file, *pack);
  if (!results) return results.error();
  auto verdict = judge_vectors(*pack, *results, texts.most, go_on);
  if (!verdict) return verdict.error();
  return judged(*pack, *results, *std::move(verdict), [&](const VectorVerdict::Place& place) {
    const VectorProgram& program = pack->programs[place.program];
    const auto& given = results->programs.at(place.program);
    const Bytes4 &shown = given.colors[place.fragment], &expected = program.expected[place.fragment];
    return Shown{given.line,
                 program.group,
                 fmt::format("{}", fmt::join(shown, " ")),
                 fmt::format("{}", fmt::join(expected, " ")),
                 shown,
                 expected,
                 calls_of(*pack, program.state),
                 inputs_of(*pack, program.state, pack->inputs[program.first_input + place.fragment])};
  });
}

std::string text_of(const StageOutput& output) {
  if (output.is_culled) return "culled";
  std::string text;
  for (std::size_t i = 0; i < output.texture.size(); ++i) {
    text += fmt::format("{}tex{} {}", i == 0 ? "" : ", ", i, fmt::join(output.texture[i], " "));
  }
  return output.depth ? fmt::format("{}, depth {}", text, *output.depth) : text;
}

Json json_of(const StageOutput& output) {
  Json texture = Json::array();
  for (const Rgba9& unit : output.texture) texture.push_back(unit);
  return {{"culled", output.is_culled},
          {"texture", output.is_culled ? Json() : texture},
          {"depth", output.depth ? Json(*output.depth) : Json()}};
}

Result<JudgedResults> judge_stages(const Texts& texts, const VectorProgress& go_on) {
  const auto pack = read_stage_vector_pack(texts.pack, texts.pack_file, *texts.profile);
  if (!pack) return pack.error();
  const auto results = read_stage_vector_results(texts.results, texts.results_file, *pack);
  if (!results) return results.error();
  auto verdict = judge_stage_vectors(*pack, *results, texts.most, go_on);
  if (!verdict) return verdict.error();
  return judged(*pack, *results, *std::move(verdict), [&](const VectorVerdict::Place& place) {
    const StageVectorProgram& program = pack->programs[place.program];
    const auto& given = results->programs.at(place.program);
    const StageOutput &shown = given.outputs[place.fragment], &expected = program.expected[place.fragment];
    return Shown{given.line, program.group, text_of(shown), text_of(expected), json_of(shown), json_of(expected)};
  });
}

Result<JudgedResults> judge_results(const VectorResultsFlags& flags) {
  ProgressLine progress(flags.common->quiet || flags.common->json);
  Texts texts;
  texts.pack_file = pack_file(flags);
  texts.results_file = flags.results;
  texts.most = static_cast<std::size_t>(flags.most);
  auto text = text_in(texts.pack_file);
  if (!text) return text.error();
  const auto profile = profile_named(vector_pack_profile(*text), texts.pack_file, flags);
  if (!profile) return profile.error();
  texts.pack = *std::move(text);
  texts.profile = *profile;
  auto results = text_in(flags.results);
  if (!results) return results.error();
  texts.results = *std::move(results);
  const auto go_on = [&](double done) { return progress.step("fragments", done); };
  return is_stage_vector_pack(texts.pack) ? judge_stages(texts, go_on) : judge_colors(texts, go_on);
}

std::string with_rules(const std::string& text, const std::string& rules) {
  if (rules.empty()) return text;
  return fmt::format("{} (rule{} {})", text, rules.find(',') == std::string::npos ? "" : "s", rules);
}

double share_of(std::size_t fragments, const VectorVerdict& verdict) {
  return verdict.differ == 0 ? 0 : static_cast<double>(fragments) / static_cast<double>(verdict.differ);
}

// For results that no plan explains.
std::string mistakes_text(const VectorVerdict& verdict) {
  if (verdict.mistakes.empty()) return "\nNo known mistake explains more fragments than it breaks.\n";
  std::string text = fmt::format("\n{:<62}{:>9}  {}\n", "with this mistake", "explains", "fragments that then agree");
  for (const VectorMistake& mistake : verdict.mistakes) {
    text +=
        fmt::format("  {:<60}{:>9}{:>27}\n", with_rules(mistake.name, mistake.rules), mistake.explains, mistake.agree);
  }
  return text + "\nNo single mistake explains all of them.\n";
}

std::string indented(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (const std::string_view line = take_line(text); !line.empty()) out.append("     ").append(line) += '\n';
  }
  return out;
}

std::string plan_text(const JudgedResults& judged) {
  const VectorVerdict& verdict = judged.verdict;
  std::string text = "\nmistakes, in the order in which to mend them\n";
  for (std::size_t i = 0; i < verdict.plan.size(); ++i) {
    const VectorVerdict::Step& step = verdict.plan[i];
    const Shown& one = judged.steps[i];
    text += fmt::format("{}. {}: explains {:.1f} %, {} fragments\n", i + 1,
                        with_rules(step.mistake.name, step.mistake.rules),
                        100 * share_of(step.mistake.explains, verdict), step.mistake.explains);
    if (!step.same.empty()) text += fmt::format("   the same: {}\n", fmt::join(step.same, "; "));
    text += fmt::format("   program {}, fragment {} ({}): shows {}, expected {}\n", step.program + 1, step.fragment + 1,
                        judged.groups[one.group].name, one.shown, one.expected);
    if (!one.inputs.empty()) text += fmt::format("   {}\n", one.inputs);
    text += indented(one.calls);
  }
  if (verdict.unexplained != 0) {
    return text + fmt::format("{:.1f} % unexplained, {} fragments\n", 100 * share_of(verdict.unexplained, verdict),
                              verdict.unexplained);
  }
  if (verdict.plan.size() > 1) return text + "Together they explain all of them.\n";
  const VectorMistake& only = verdict.plan.front().mistake;
  return text + fmt::format("One mistake explains all of them: {}\n", with_rules(only.name, only.rules));
}

std::string text_of(const JudgedResults& judged, const std::string& file) {
  const VectorVerdict& verdict = judged.verdict;
  std::string text;
  for (std::size_t i = 0; i < judged.first.size(); ++i) {
    const Shown& one = judged.first[i];
    text += fmt::format("{}:{}: program {}, fragment {} ({}): shows {}, expected {}\n", printable(file), one.line,
                        verdict.first[i].program + 1, verdict.first[i].fragment + 1, judged.groups[one.group].name,
                        one.shown, one.expected);
  }
  if (verdict.differ > verdict.first.size()) {
    text += fmt::format("… and {} more fragments\n", verdict.differ - verdict.first.size());
  }
  if (judged.programs < judged.pack_programs) {
    text += fmt::format("{}:{}: program {} is missing; {} of {} programs have results\n", printable(file),
                        judged.missing_line, judged.first_missing + 1, judged.programs, judged.pack_programs);
  }
  text += fmt::format("{} fragments of {} programs: {} agree, {} differ\n", verdict.fragments, judged.programs,
                      verdict.fragments - verdict.differ, verdict.differ);
  if (verdict.differ == 0) return text;
  text += fmt::format("\n{:<40}{:>10}{:>10}\n", "groups that differ", "fragments", "differ");
  bool is_first = true;
  for (std::size_t g = 0; g < judged.groups.size(); ++g) {
    const VectorVerdict::GroupCount& count = verdict.groups[g];
    if (count.differ == 0) continue;
    text += fmt::format("  {:<38}{:>10}{:>10}\n", judged.groups[g].name, count.fragments, count.differ);
    if (is_first) text += fmt::format("    {}\n", with_rules(judged.groups[g].what, judged.groups[g].rules));
    is_first = false;
  }
  return text + (verdict.plan.empty() ? mistakes_text(verdict) : plan_text(judged));
}

Json plan_json(const JudgedResults& judged) {
  const VectorVerdict& verdict = judged.verdict;
  Json plan = Json::array();
  for (std::size_t i = 0; i < verdict.plan.size(); ++i) {
    const VectorVerdict::Step& step = verdict.plan[i];
    const Shown& one = judged.steps[i];
    plan.push_back({{"mistake", step.mistake.name},
                    {"rules", step.mistake.rules},
                    {"group", step.mistake.group},
                    {"explains", step.mistake.explains},
                    {"share", share_of(step.mistake.explains, verdict)},
                    {"breaks", step.breaks},
                    {"same", step.same},
                    {"program", step.program + 1},
                    {"fragment", step.fragment + 1},
                    {"shown", one.shown_values},
                    {"expected", one.expected_values},
                    {"calls", one.calls},
                    {"inputs", one.inputs}});
  }
  return plan;
}

Json json_of(const JudgedResults& judged, const VectorResultsFlags& flags) {
  const VectorVerdict& verdict = judged.verdict;
  Json groups = Json::array(), mistakes = Json::array(), rows = Json::array();
  for (std::size_t g = 0; g < judged.groups.size(); ++g) {
    groups.push_back({{"group", judged.groups[g].name},
                      {"rules", judged.groups[g].rules},
                      {"fragments", verdict.groups[g].fragments},
                      {"differ", verdict.groups[g].differ}});
  }
  for (const VectorMistake& mistake : verdict.mistakes) {
    mistakes.push_back({{"mistake", mistake.name},
                        {"rules", mistake.rules},
                        {"explains", mistake.explains},
                        {"agree_then", mistake.agree}});
  }
  for (std::size_t i = 0; i < judged.first.size(); ++i) {
    const Shown& one = judged.first[i];
    rows.push_back({{"line", one.line},
                    {"program", verdict.first[i].program + 1},
                    {"fragment", verdict.first[i].fragment + 1},
                    {"group", judged.groups[one.group].name},
                    {"shown", one.shown_values},
                    {"expected", one.expected_values}});
  }
  Json missing;
  if (judged.programs < judged.pack_programs) {
    missing = {{"programs", judged.pack_programs - judged.programs},
               {"first", judged.first_missing + 1},
               {"line", judged.missing_line}};
  }
  return {{"command", "verify"},
          {"version", NINEBIT_VERSION},
          {"profile", judged.profile},
          {"table", flags.results},
          {"pack", judged.id},
          {"programs", judged.programs},
          {"missing", std::move(missing)},
          {"count", verdict.fragments},
          {"agree", verdict.fragments - verdict.differ},
          {"differ", verdict.differ},
          {"groups", std::move(groups)},
          {"plan", plan_json(judged)},
          {"unexplained", verdict.unexplained},
          {"unexplained_share", share_of(verdict.unexplained, verdict)},
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
