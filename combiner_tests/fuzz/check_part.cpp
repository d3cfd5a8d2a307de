// Parts of a study.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "combiner_tests/fuzz/memory_file.h"
#include "combiner_tests/fuzz/small_studies.h"
#include "ninebit/study/report_files.h"
#include "ninebit/study/study_part.h"
#include "src/study/part/part_text.h"
#include "src/system/hashing/openssl.h"

namespace ninebit::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuild = "0.1.0 fuzzed";

// Three units of one row each; corpora hold parts of it.
class Counting : public Study {
 public:
  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return 3; }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override { return std::to_string(unit); }
  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn&) const override {
    return std::vector<StudyRow>{{.table = "rows", .fields = {{"unit", std::uint64_t{unit}}}}};
  }
  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    return {{.fields = {exactly("unit", std::uint64_t{unit})}}};
  }
  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow>, std::size_t) const override {
    return StudyReport{};
  }

 private:
  StudyQuestion question_{.study = "counting", .profile = "all", .options = {{"--steps", "1-2"}}};
};

std::string wrong_with_diagnostic(const Diagnostic& why, const fs::path& file) {
  if (why.file != file.string()) return "a fault names the file '" + why.file + "'";
  return wrong_with_message(why.message);
}

// The lines of a part, as a run would write them.
std::string written(const StudyPart& part) {
  std::string text = header_line(part.header);
  for (const FinishedUnit& unit : part.units) text += unit_line(unit);
  if (part.complete) text += end_line(part.units.size(), sha256(text));
  return text;
}

std::string wrong_with_rows(const std::vector<StudyRow>& rows, const StudyQuestion& question) {
  if (report_json(question, "1", {}, rows).empty()) return "the rows are not JSON";
  for (const auto& [table, text] : report_csv({}, rows)) {
    if (text.empty()) return "table '" + table + "' is not CSV";
  }
  return "";
}

// Rows that are read for their study are those that its rules allow, and its report must stand them.
std::string wrong_with_studying(std::string_view text) {
  const MemoryFile file(text);
  const Study* asked = nullptr;
  const auto part = read_part(file.path(), [&](const PartHeader& header) -> Result<const Study*> {
    for (const auto& study : small_studies()) {
      if (study->question() == header.question) asked = study.get();
    }
    if (asked == nullptr) return Diagnostic{.message = "asks what no study answers"};
    return asked;
  });
  if (!part) return wrong_with_diagnostic(part.error(), file.path());
  for (const FinishedUnit& unit : part->units) {
    const std::string wrong = ninebit::wrong_with_rows(asked->row_rules(unit.unit), unit.rows);
    if (!wrong.empty()) return "rows are read that do not follow the rules: " + wrong;
  }
  const auto report = asked->report(rows_of(*part), part->units.size());
  return report ? "" : wrong_with_message(report.error().message);
}

std::string wrong_with_part(const StudyPart& part) {
  const std::string text = written(part);
  const MemoryFile file(text);
  const auto back = read_part(file.path());
  if (!back) return "a part that ninebit wrote is refused: " + back.error().text() + "\n" + text;
  if (written(*back) != text) return "another part comes back:\n" + text;
  const auto joined = join_parts({&*back, 1});
  if (!joined) return wrong_with_message(joined.error().message);
  if (!part.complete || part.header.shard.count != 1) return "a part that is not all of its study joins to it";
  if (*joined != rows_of(*back)) return "the rows of a whole part are others than those that it joins to";
  const std::vector<StudyPart> twice{*back, *back};
  if (join_parts(twice)) return "a part joins with itself";
  return wrong_with_rows(*joined, part.header.question);
}

std::string wrong_with_reading(std::string_view text) {
  const MemoryFile file(text);
  const auto part = read_part(file.path());
  return part ? wrong_with_part(*part) : wrong_with_diagnostic(part.error(), file.path());
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A folder of this process, where a run finds the text as its part.
class Folder {
 public:
  explicit Folder(std::string_view text) {
    fs::create_directories(path_);
    std::ofstream(part_, std::ios::binary | std::ios::trunc) << text;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] const fs::path& part() const { return part_; }

 private:
  fs::path path_ = fs::temp_directory_path() / ("ninebit-fuzzed-part-" + std::to_string(::getpid()));
  fs::path part_ = path_ / part_file_name({1, 1});
};

std::string wrong_with_going_on(std::string_view text) {
  const Folder folder(text);
  const Counting study;
  const auto part = run_part(study, kBuild, {}, folder.path(), {}, {});
  const std::string now = bytes_of(folder.part());
  if (!part) {
    if (now != text) return "a part that is refused was altered";
    return wrong_with_diagnostic(part.error(), folder.part());
  }
  if (!part->complete || part->units.size() != study.units()) return "a run ended before its end";
  // Text behind the last whole line may go, and nothing else.
  if (!now.starts_with(text.substr(0, text.rfind('\n') + 1))) return "a run altered what was finished";
  const auto back = read_part(folder.part());
  if (!back) return "a run left what it cannot read: " + back.error().text();
  return back->complete && rows_of(*back) == rows_of(*part) ? "" : "a run left another part than it says";
}

}  // namespace

std::string with_hashes(std::string_view bytes) {
  constexpr std::string_view kEnd = R"({"end":)";
  std::string text;
  std::size_t units = 0;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    std::string line(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    const bool whole = end != std::string_view::npos;
    if (line.starts_with('!')) {
      text += line.substr(1) + (whole ? "\n" : "");
    } else if (line.starts_with(kEnd)) {
      text += end_line(units, sha256(text));
      if (!whole) text.pop_back();
    } else {
      if (!text.empty()) ++units;
      const std::string hash = sha256(line);
      if (!line.empty()) line.pop_back();
      text += line + ",\"sha256\":\"" + hash + "\"}" + (whole ? "\n" : "");
    }
  }
  return text;
}

std::string check_part(std::string_view bytes) {
  const std::string fitting = with_hashes(bytes);
  return first_of(
      wrong_with_reading(bytes), [&] { return wrong_with_reading(fitting); },
      [&] { return wrong_with_studying(fitting); }, [&] { return wrong_with_going_on(bytes); },
      [&] { return wrong_with_going_on(fitting); });
}

}  // namespace ninebit::fuzz
