// `ninebit verify`: compares the results of another implementation, or of a chip, with ninebit, row by row.
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "src/tools/common/kit_table.h"
#include "src/tools/input/printable.h"
#include "src/tools/verify/decide.h"
#include "src/tools/verify/verify_rules.h"
#include "src/tools/verify/verify_table.h"
#include "src/tools/verify/verify_vectors.h"

namespace ninebit::tools {
namespace {

struct VerifyFlags {
  CommonFlags common;
  DecideFlags decide;
  std::string table;
  ProgramFlags program;
  std::string vectors;         // the pack of a runner's results
  bool profile_given = false;  // on the command line
  int most = 20;
  bool allow_outside = false;
};

struct Difference {
  VerifyRow row;
  std::vector<int> codes;
  std::vector<std::size_t> explained_by;  // indices of the rivals under which the row agrees
};

struct Verdict {
  std::vector<Rival> rivals;
  std::size_t rows = 0, agree = 0, skipped = 0;
  std::size_t near = 0;                            // of those that agree, the ones that do for their tolerance alone
  std::int64_t farthest = 0;                       // of those, the largest difference
  std::vector<Difference> differences;             // the first --most
  std::map<std::string, std::size_t> where;        // number of rows by the first place that differs
  std::vector<std::size_t> explained, agree_then;  // per rival: of the differing rows; of all rows
};

// The place of a value: "general combiner 0, rgb", "output, alpha".
std::string place_of(const VerifyRow& row, const Expectation& expected) {
  if (row.format != nullptr) return std::string(row.format->place);
  const char* const portion = expected.component == kAlpha ? "alpha" : "rgb";
  if (!expected.stage) return fmt::format("output, {}", portion);
  return fmt::format("general combiner {}, {}", *expected.stage, portion);
}

void judge(const VerifyRow& row, const HardwareProfile& profile, std::size_t most, Verdict& verdict) {
  const std::vector<Rival>& rivals = verdict.rivals;
  ++verdict.rows;
  std::vector<int> codes = computed(row, profile);
  const bool agree = agrees(row, codes);
  std::vector<std::size_t> explained_by;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (!agrees(row, computed(row, rivals[i].profile))) continue;
    ++verdict.agree_then[i];
    if (agree) continue;
    ++verdict.explained[i];
    explained_by.push_back(i);
  }
  if (agree) {
    ++verdict.agree;
    std::int64_t farthest = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) farthest = std::max(farthest, row.expected[i].distance(codes[i]));
    if (farthest > 0) ++verdict.near;
    verdict.farthest = std::max(verdict.farthest, farthest);
    return;
  }
  std::size_t first = 0;
  while (row.expected[first].allows(codes[first])) ++first;
  ++verdict.where[place_of(row, row.expected[first])];
  if (verdict.differences.size() < most) verdict.differences.push_back({row, std::move(codes), explained_by});
}

Result<Verdict> judge_table(const VerifyFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  auto table = VerifyTable::open(flags.table, flags.program, flags.allow_outside, profile);
  if (!table) return table.error();
  Verdict verdict;
  verdict.rivals = rivals_of(profile);
  if (table->is_measured()) {
    if (!flags.profile_given && !flags.common.quiet) {
      say(fmt::format("ninebit: note: {}: compared with profile {}; --profile names another\n",
                      printable(table->name()), profile.name));
    }
    for (Rival& rival : pixel_rivals_of(profile)) verdict.rivals.push_back(std::move(rival));
  }
  verdict.explained.resize(verdict.rivals.size());
  verdict.agree_then.resize(verdict.rivals.size());
  ProgressLine progress(flags.common.quiet);
  while (true) {
    auto row = table->next();
    if (!row) return row.error();
    if (!*row) break;
    // The table owns the programs' states; a difference keeps only the name of the file.
    judge(**row, profile, static_cast<std::size_t>(flags.most), verdict);
    constexpr std::size_t kRowsPerStep = 1024;
    const bool goes_on = verdict.rows % kRowsPerStep == 0 ? progress.step(fmt::format("{} rows", verdict.rows), 0.0)
                                                          : !ProgressLine::stopped();
    if (!goes_on) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }
  verdict.skipped = table->skipped();
  if (verdict.rows == 0) return csv_fault(table->name(), 1, 1, "the table has no rows");
  return verdict;
}

// The rivals that explain at least one row, those that explain most first.
std::vector<std::size_t> explaining(const Verdict& verdict) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < verdict.explained.size(); ++i) {
    if (verdict.explained[i] > 0) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(verdict.explained[a], verdict.agree_then[a]) >
           std::pair(verdict.explained[b], verdict.agree_then[b]);
  });
  return found;
}

std::string rule_text(const Rival& rival) {
  const std::string numbers =
      rival.rules.empty()
          ? ""
          : fmt::format(" (rule{} {})", rival.rules.find(',') != std::string::npos ? "s" : "", rival.rules);
  return fmt::format("{} = {}{}", rival.field, rival.value, numbers);
}

std::string difference_text(const Difference& d, const std::string& table, const std::vector<Rival>& rivals) {
  std::string text = fmt::format("{}:{}: {}", printable(table), d.row.line,
                                 printable(d.row.name.empty() ? d.row.program_file : d.row.name));
  const char* separator = ": ";
  for (std::size_t i = 0; i < d.codes.size(); ++i) {
    const Expectation& expected = d.row.expected[i];
    if (expected.allows(d.codes[i])) continue;
    text += fmt::format("{}{} is {}, expected {}", separator, expected.column, d.codes[i],
                        fmt::join(expected.allowed, " or "));
    separator = "; ";
  }
  std::vector<std::string> names;
  for (const std::size_t i : d.explained_by) names.push_back(fmt::format("{} = {}", rivals[i].field, rivals[i].value));
  return text + (names.empty() ? "\n" : fmt::format(" [as with {}]\n", fmt::join(names, ", or ")));
}

std::string text_of(const Verdict& verdict, const std::string& table) {
  const std::vector<Rival>& rivals = verdict.rivals;
  const std::size_t differ = verdict.rows - verdict.agree;
  std::string text;
  for (const Difference& difference : verdict.differences) text += difference_text(difference, table, rivals);
  if (differ > verdict.differences.size()) {
    text += fmt::format("… and {} more rows\n", differ - verdict.differences.size());
  }
  text += fmt::format("{} rows: {} agree, {} differ", verdict.rows, verdict.agree, differ);
  if (verdict.near > 0) {
    text += fmt::format("; {} of those that agree are off by {}{}", verdict.near, verdict.farthest == 1 ? "" : "up to ",
                        verdict.farthest);
  }
  text += verdict.skipped == 0 ? "\n" : fmt::format("; {} with match 0 skipped\n", verdict.skipped);
  if (differ == 0) return text;
  text += fmt::format("\n{:<54}{:>8}\n", "first difference in", "rows");
  for (const auto& [place, count] : verdict.where) text += fmt::format("  {:<52}{:>8}\n", place, count);
  const auto found = explaining(verdict);
  if (found.empty()) return text + "\nNo single rule with another value explains any of them.\n";
  text += fmt::format("\n{:<54}{:>8}  {}\n", "with this rule instead", "explains", "rows that then agree");
  for (const std::size_t i : found) {
    text += fmt::format("  {:<52}{:>8}{:>22}\n", rule_text(rivals[i]), verdict.explained[i], verdict.agree_then[i]);
  }
  return text;
}

Json json_of(const Verdict& verdict, const VerifyFlags& flags) {
  const std::vector<Rival>& rivals = verdict.rivals;
  Json places = Json::array(), rules = Json::array(), rows = Json::array();
  for (const auto& [place, count] : verdict.where) places.push_back({{"place", place}, {"rows", count}});
  for (const std::size_t i : explaining(verdict)) {
    rules.push_back({{"field", rivals[i].field},
                     {"value", rivals[i].value},
                     {"rules", rivals[i].rules},
                     {"explains", verdict.explained[i]},
                     {"agree_then", verdict.agree_then[i]}});
  }
  for (const Difference& d : verdict.differences) {
    Json values = Json::array(), by = Json::array();
    for (std::size_t i = 0; i < d.codes.size(); ++i) {
      const Expectation& expected = d.row.expected[i];
      if (expected.allows(d.codes[i])) continue;
      values.push_back({{"column", expected.column}, {"expected", expected.allowed}, {"computed", d.codes[i]}});
    }
    for (const std::size_t i : d.explained_by) by.push_back(rivals[i].field);
    rows.push_back({{"line", d.row.line},
                    {"name", d.row.name},
                    {"program", d.row.program_file},
                    {"differences", std::move(values)},
                    {"explained_by", std::move(by)}});
  }
  return {{"command", "verify"},
          {"version", NINEBIT_VERSION},
          {"profile", flags.common.profile},
          {"table", flags.table},
          {"count", verdict.rows},
          {"agree", verdict.agree},
          {"differ", verdict.rows - verdict.agree},
          {"near", verdict.near},
          {"skipped", verdict.skipped},
          {"places", std::move(places)},
          {"rules", std::move(rules)},
          {"rows", std::move(rows)}};
}

int run(const VerifyFlags& flags) {
  if (!flags.decide.results.empty()) {
    DecideFlags decide = flags.decide;
    decide.json = flags.common.json;
    decide.quiet = flags.common.quiet;
    return decide_fields(decide);
  }
  if (flags.table.empty()) throw CLI::RequiredError("a table, or --decide");
  if (!flags.vectors.empty() || begins_as_vector_results(flags.table)) {
    return verify_vector_results({&flags.common, flags.profile_given, flags.table, flags.vectors, flags.most});
  }
  const auto verdict = judge_table(flags);
  if (!verdict) return report(verdict.error());
  const bool agree = verdict->agree == verdict->rows;
  const int code = flags.common.json ? answer(json_of(*verdict, flags))
                                     : answer(text_of(*verdict, flags.table == "-" ? "standard input" : flags.table));
  if (code != kDone) return code;
  return agree ? kDone : kDifference;
}

// --decide and its own flags; those of the other tables exclude it.
void add_decide_flags(CLI::App& verb, VerifyFlags& flags, CLI::Option& table) {
  CLI::Option* decide =
      verb.add_option("--decide", flags.decide.results,
                      "Decide fields of a profile by what the kit of `ninebit prove kit` showed on a card")
          ->type_name("FILE.csv")
          ->excludes(&table);
  for (const char* flag : {"--profile", "--threads", "--program", "--from", "--define", "--chip", "--allow-outside",
                           "--most", "--vectors"}) {
    decide->excludes(verb.get_option(flag));
  }
  add_family_flag(verb, flags.decide.family);
  verb.get_option("--family")->needs(decide);
  verb.add_option("-o,--output", flags.decide.output, "Write the decided profile to this file")
      ->type_name("FILE")
      ->needs(decide);
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("verify", "Compare the results of another implementation, or of a chip, with ninebit's");
  verb->footer(
      "The table has a header and rows of whole numbers. Its columns:\n"
      "  program           file of the row's program, in any form, below the folder of the table\n"
      "  name              name of the row, for the report\n"
      "  tex0.r, const0.a  inputs, as in `ninebit eval`; an empty field is the default\n"
      "  out.r             expected output\n"
      "  stage0.spare0.r   expected register after general combiner 0\n"
      "It may also be a table measured on a chip (nv2a_blend.csv, nv2a_mux.csv), which is known by its header; rows\n"
      "with match 0 are skipped, and quantities of the whole table stand in its comments (# width: 8). Or it is what\n"
      "the runner of a pack of `ninebit vectors` wrote: the report then names the first group of programs that fails,\n"
      "and the mistake that explains it.\n"
      "An expected value of 62|63 accepts either; an empty field is not compared. The report lists where rows first\n"
      "differ, and which single rule of the profile would explain the differences if it had another value.\n"
      "Exit codes: 0 all rows agree, 1 some differ, 3 the table or a program cannot be read.\n"
      "Examples:\n"
      "  ninebit verify results.csv --profile nv2a\n"
      "  ninebit verify results.csv --program compare.gl --json\n"
      "  ninebit verify results.txt --vectors pack\n"
      "  ninebit verify --decide results.csv --family geforce2 -o card.json");
  auto flags = std::make_shared<VerifyFlags>();
  add_common_flags(*verb, flags->common);
  const CLI::Validator named(
      [](const std::string& text) { return std::string(text.empty() ? "the file name is empty" : ""); }, "");
  CLI::Option* table = verb->add_option("table", flags->table, "Table to check; - reads standard input")
                           ->type_name("FILE.csv")
                           ->check(named);
  verb->add_option("--program", flags->program.file, "Program of the rows that name none")->type_name("PROGRAM");
  verb->add_option("--from", flags->program.from, "Form of the programs (default: detected from the content)")
      ->check(CLI::IsMember(read_form_names()));
  add_define_flag(*verb, flags->program.defines);
  verb->add_option("--chip", flags->program.chip, "Chip whose register words are read (default: from the profile)")
      ->check(CLI::IsMember({"nv10", "nv20"}));
  CLI::Option* vectors =
      verb->add_option("--vectors", flags->vectors,
                       "Pack whose results the table has (default: vectors.txt beside results of a pack)")
          ->type_name("DIR|FILE");
  verb->add_flag("--allow-outside", flags->allow_outside,
                 "Also read programs that are not below the folder of the table");
  verb->add_option("--most", flags->most, "Maximum number of differing rows to list")
      ->capture_default_str()
      ->check(whole_in_range(0, 1'000'000));
  for (const char* flag : {"--program", "--from", "--define", "--chip", "--allow-outside"})
    vectors->excludes(verb->get_option(flag));
  add_decide_flags(*verb, *flags, *table);
  verb->callback([flags, verb, &exit_code] {
    flags->profile_given = verb->count("--profile") > 0;
    exit_code = run(*flags);
  });
}

}  // namespace ninebit::tools
