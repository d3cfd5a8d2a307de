// Runs any study: either whole, or in a folder, in parts that are merged later.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "ninebit/study/report_files.h"
#include "src/study/part/part_text.h"
#include "src/system/hashing/openssl.h"
#include "src/system/inside_folder.h"
#include "src/system/process.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/host.h"
#include "src/tools/study/study.h"

namespace ninebit::tools {
namespace {

// Identifies the build: the version and a hash of the program file. Parts of different builds are not merged.
std::string build_of_program() {
  std::ifstream program(host() != nullptr ? host()->code_file() : posix::program_file(), std::ios::binary);
  Sha256 hash;
  std::vector<char> piece(1 << 16);
  while (program.read(piece.data(), static_cast<std::streamsize>(piece.size())), program.gcount() > 0) {
    hash.add(std::span(piece).first(static_cast<std::size_t>(program.gcount())));
  }
  return fmt::format("{} {}", NINEBIT_VERSION, hash.finish().substr(0, 16));
}

// The parts of the work.
constexpr const char* kMeasurements = "measurements";
constexpr const char* kMapsAndFiles = "maps and files";

// A progress line with an estimate of the remaining time of a part of the work: of the measurements, or of the maps and
// files that are made of them. If that is more than ten seconds, it is also printed once on a line of its own, even if
// stderr is not a terminal.
class UnitProgress {
 public:
  UnitProgress(const char* part, bool quiet) : part_(part), line_(quiet), quiet_(quiet) {}

  // Called before each unit with the share of the work that is done; returns false after an interrupt.
  bool step(const std::string& unit, double done) {
    if (first_ < 0.0) first_ = done;
    const double fresh = done - first_;  // work of an earlier run says nothing about the speed of this one
    if (fresh <= 0.0) return line_.step(fmt::format("{} ({:.0f} %)", unit, 100.0 * done), done);
    const std::chrono::duration<double> spent = Clock::now() - begin_;
    const double left = spent.count() * (1.0 - done) / fresh;
    constexpr double kLong = 10.0;
    if (left > kLong && !told_ && !quiet_) {
      told_ = true;
      say(fmt::format("{}: {:.0f} % done; about {:.0f} s left for them.\n", part_, 100.0 * done, left));
    }
    return line_.step(fmt::format("{} ({:.0f} %, {:.0f} s left)", unit, 100.0 * done, left), done);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const char* part_;
  ProgressLine line_;
  bool quiet_;
  bool told_ = false;
  double first_ = -1.0;
  Clock::time_point begin_ = Clock::now();
};

bool go_on() {
  return !ProgressLine::stopped();
}

// Runs all units and returns their rows without saving them.
Result<std::vector<StudyRow>> run_whole(const Study& study, bool quiet) {
  UnitProgress progress(kMeasurements, quiet);
  double all = 0.0, done = 0.0;
  for (std::size_t unit = 0; unit < study.units(); ++unit) all += study.weight(unit);
  std::vector<StudyRow> rows;
  for (std::size_t unit = 0; unit < study.units(); ++unit) {
    if (!progress.step(study.unit_name(unit), done / all)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    done += study.weight(unit);
    auto more = study.run(unit, go_on);
    if (!more) return more.error();
    rows.insert(rows.end(), std::make_move_iterator(more->begin()), std::make_move_iterator(more->end()));
  }
  return rows;
}

int answer_rows(const Study& study, const StudyReport& made, std::span<const StudyRow> rows, const CommonFlags& flags) {
  if (flags.json) return answer_exactly(report_json(study.question(), NINEBIT_VERSION, made, rows));
  std::string text;
  for (const std::string& line : made.answers) text += line + '\n';
  return answer(text);
}

// Writes the report on the rows of `done` units and prints the answer.
int finish(const Study& study, const std::string& folder, std::span<const StudyRow> rows, std::size_t done,
           const CommonFlags& flags) {
  auto made = study.report(rows, done);
  if (!made) return report(made.error());
  if (done == study.units() && (!folder.empty() || host() != nullptr)) {
    Status drawn;
    {
      UnitProgress progress(kMapsAndFiles, flags.quiet);
      drawn = study.draw(
          rows, [&](double share) { return progress.step(kMapsAndFiles, share); }, *made);
    }
    if (!drawn) return report(drawn.error());
  }
  if (!folder.empty()) {
    // From here on, the first signal does not interrupt: the report is finished.
    if (!ProgressLine(flags.quiet).step("report", 1.0)) {
      return report({.message = "interrupted", .fault = Fault::cancelled});
    }
    const auto files = write_report(folder, study.question(), NINEBIT_VERSION, *made, rows);
    if (!files) return report(files.error());
    for (const auto& file : *files) {
      if (!flags.quiet) say_written(file);
    }
  }
  if (host() != nullptr) {
    auto page = report_html(study.question(), NINEBIT_VERSION, *made, rows);
    if (!page) return report(page.error());
    host()->give("page", *std::move(page));
  }
  return answer_rows(study, *made, rows, flags);
}

int run_in_folder(const Study& study, const StudyFlags& flags) {
  const Shard shard = shard_of(flags);
  const std::size_t units = (study.units() - shard.index) / shard.count + 1;
  Result<StudyPart> part = StudyPart();
  {
    UnitProgress progress(kMeasurements, flags.common.quiet);
    part = run_part(study, build_of_program(), shard, flags.folder, {.seconds = flags.budget, .go_on = go_on},
                    [&](const std::string& unit, double done) { return progress.step(unit, done); });
  }
  if (!part) {
    if (part.error().fault == Fault::cancelled && !flags.common.quiet) {
      say("Progress is saved; run the same command to resume.\n");
    }
    return report(part.error());
  }
  if (!flags.common.quiet) say_written(part->file);
  if (!part->complete && !flags.common.quiet) {
    say(fmt::format("The time is up after {} of {} units; run the same command to resume.\n", part->units.size(),
                    units));
  }
  if (shard.count > 1) return kDone;
  return finish(study, flags.folder, rows_of(*part), part->units.size(), flags.common);
}

// The reason why a word of a command is refused: it names a file that is not below the working folder or is not a
// regular file. A word may hold several names, so each of its pieces is checked, whatever flag it belongs to.
std::optional<std::string> why_refused(std::string_view word) {
  constexpr std::string_view kBetweenNames = ",=";
  while (!word.empty()) {
    const std::size_t end = std::min(word.find_first_of(kBetweenNames), word.size());
    const std::string_view piece = word.substr(0, end);
    word.remove_prefix(std::min(end + 1, word.size()));
    // A folder beside the part is skipped: its name may be that of a study or a format, and no study reads folders.
    std::error_code error;
    const bool is_plain = piece.find('/') == std::string_view::npos && piece != "..";
    const bool is_folder = is_plain && std::filesystem::is_directory(std::filesystem::symlink_status(piece, error));
    if (piece.empty() || is_folder) continue;
    if (auto why = posix::why_outside("", piece)) return why;
  }
  return std::nullopt;
}

// The study of a part: its command is parsed like the command line of the user.
Result<std::unique_ptr<Study>> study_of(const StudyQuestion& question, bool allow_outside) {
  CLI::App verbs("", "study");
  StudyRequest request;
  add_studies(verbs, request);
  std::vector<std::string> words = question.words();
  constexpr const char* kAllowOutside = "--allow-outside";
  for (const std::string& word : words) {
    if (word.starts_with(kAllowOutside)) {
      return Diagnostic{.message =
                            fmt::format("its command has {}, which no part has; give it to the merge", kAllowOutside)};
    }
    const auto why = allow_outside ? std::nullopt : why_refused(word);
    if (why) return Diagnostic{.message = fmt::format("its command names a file: {}", *why)};
  }
  const auto takes_it = [&](const CLI::App* verb) {
    return verb->get_name() == question.study && verb->get_option_no_throw(kAllowOutside) != nullptr;
  };
  const bool can_allow = !std::as_const(verbs).get_subcommands(takes_it).empty();
  if (allow_outside && can_allow) words.emplace_back(kAllowOutside);  // for the files that a scene names
  std::reverse(words.begin(), words.end());                           // CLI11 expects the last word first
  try {
    verbs.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return Diagnostic{.message = fmt::format("its command, `{}`, is not valid: {}", quotable(question.command()),
                                             quotable(error.what()))};
  }
  if (!request.make)
    return Diagnostic{.message = fmt::format("its command, `{}`, does not name a study", quotable(question.command()))};
  auto study = request.make();
  if (study && (*study)->question() != question) {
    return Diagnostic{.message = fmt::format("the files that `{}` names have changed; expected them unchanged",
                                             quotable(question.command()))};
  }
  return study;
}

struct MergeFlags {
  CommonFlags common;
  std::vector<std::string> parts;
  std::string folder;
  bool allow_outside = false;
};

// The study of the first part, which all others must share.
class MergedStudy {
 public:
  explicit MergedStudy(bool allow_outside) : allow_outside_(allow_outside) {}

  Result<const Study*> of(const PartHeader& header) {
    if (study_) {
      const std::string why = why_foreign(header, first_);
      return why.empty() ? Result<const Study*>(study_.get()) : Diagnostic{.message = why};
    }
    if (const std::string own = build_of_program(); header.build != own) {
      return Diagnostic{.message = fmt::format("comes from another build of the program, {}; expected this one, {}",
                                               quotable(header.build), own)};
    }
    auto study = study_of(header.question, allow_outside_);
    if (!study) return Diagnostic{.message = study.error().text(), .fault = study.error().fault};
    study_ = std::move(study).value();
    first_ = header;
    return study_.get();
  }
  [[nodiscard]] const Study& study() const { return *study_; }

 private:
  bool allow_outside_;
  std::unique_ptr<Study> study_;
  PartHeader first_;
};

int merge(const MergeFlags& flags) {
  const ThreadLimit limit(flags.common.threads);
  MergedStudy merged(flags.allow_outside);
  std::vector<StudyPart> parts;
  for (const std::string& file : flags.parts) {
    auto part = read_part(file, [&](const PartHeader& header) { return merged.of(header); });
    if (!part) return report(explained_by_kind(part.error(), file, FileRole::part));
    parts.push_back(*std::move(part));
  }
  const auto rows = join_parts(parts);
  if (!rows) return report(rows.error());
  return finish(merged.study(), flags.folder, *rows, merged.study().units(), flags.common);
}

int run_on_stdout(const Study& study, const StudyFlags& flags) {
  const auto rows = run_whole(study, flags.common.quiet);
  if (!rows) return report(rows.error());
  return finish(study, "", *rows, study.units(), flags.common);
}

}  // namespace

int run_study(const StudyRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  const StudyFlags& flags = *request.flags;
  const ThreadLimit limit(flags.common.threads);
  const auto study = request.make();
  if (!study) return report(study.error());
  const int code = flags.folder.empty() ? run_on_stdout(**study, flags) : run_in_folder(**study, flags);
  // Beside the report, not in it: its bytes are the same on every machine.
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  if (code == kDone && !flags.folder.empty() && !flags.common.quiet)
    say(fmt::format("It took {:.1f} s.\n", spent.count()));
  return code;
}

void add_study_merge(CLI::App& verbs, int& exit_code) {
  CLI::App* verb = verbs.add_subcommand("merge", "Join the parts that runs with --shard wrote");
  verb->footer("Example: ninebit study merge out/part-*-of-4.jsonl -o out");
  auto flags = std::make_shared<MergeFlags>();
  add_answer_flags(*verb, flags->common);
  add_threads_flag(*verb, flags->common);
  verb->add_option("parts", flags->parts, "All parts of one study, in any order")->required()->type_name("PART");
  verb->add_option("-o,--output", flags->folder, "Folder to write into; created if missing")
      ->required()
      ->type_name("DIR");
  verb->add_flag("--allow-outside", flags->allow_outside,
                 "Also read files that the parts' command names outside of the working folder");
  verb->callback([flags, &exit_code] { exit_code = merge(*flags); });
}

}  // namespace ninebit::tools
