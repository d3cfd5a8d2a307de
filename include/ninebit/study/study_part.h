// Units of a study on disk: a part holds the units that one run has finished so far.
//
// A part is a text file of JSON lines: first a header (question, build, units, shard), then a line for each finished
// unit with its rows and their SHA-256, last the SHA-256 of all lines before it. A part without its last line comes
// from an interrupted run; the next run resumes it. An incomplete line at the end, left when the machine stopped, is
// dropped; an altered line is reported.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// The units of one run: those whose number modulo count is index - 1.
struct Shard {
  std::size_t index = 1;  // 1 to count
  std::size_t count = 1;  // number of shards of the study
  friend bool operator==(const Shard&, const Shard&) = default;
};

// "part-2-of-8.jsonl"
[[nodiscard]] std::string part_file_name(const Shard& shard);

// The contents of a part's first line.
struct PartHeader {
  StudyQuestion question;  // the question that the rows answer
  std::string build;       // identifies the build of the program: parts of two builds are not joined
  std::size_t units = 0;   // of the whole study
  Shard shard;             // the shard that these units belong to
  friend bool operator==(const PartHeader&, const PartHeader&) = default;
};

// A finished unit.
struct FinishedUnit {
  std::size_t unit = 0;        // its number in the study
  std::vector<StudyRow> rows;  // in the unit's order
  int line = 0;                // its line in the file that it was read from
};

// A part read from a file.
struct StudyPart {
  std::filesystem::path file;       // the part's file
  PartHeader header;                // its first line
  std::vector<FinishedUnit> units;  // in the order in which they finished
  bool complete = false;            // true if the last line is present
};

// Returns the study for a part's first line, or an error if there is none. The study must outlive the reading.
using StudyOfPart = std::function<Result<const Study*>(const PartHeader&)>;

// Reads a part. A unit that is repeated with the same bytes counts once. Reports, with file and line, a file that is
// not a part, a damaged part (a wrong hash, an incomplete line before the last) and a line longer than 1 MiB; with
// `study_of`, also a number of units other than its study's, and rows that do not follow the study's row_rules().
// Memory and time are bounded by a multiple of the file's bytes.
[[nodiscard]] Result<StudyPart> read_part(const std::filesystem::path& file, const StudyOfPart& study_of = {});

// Called between units with the name of the next unit and the finished share (0 to 1). Returns false to end the work.
using StudyProgress = std::function<bool(const std::string& unit, double done)>;

// The limits that may end a run early.
struct PartLimits {
  std::optional<double> seconds{};  // no unit begins after this time; the part then stays incomplete
  GoOn go_on{};                     // called within units
};

// Runs the shard's units that the part in `folder` does not hold yet, and appends each as soon as it is finished.
// Reports a part that another run is writing, a part of another question or build, a damaged part, a failure to write,
// and Fault::cancelled; finished units stay in the part. Returns the part, incomplete if the limits ended the run.
[[nodiscard]] Result<StudyPart> run_part(const Study& study, std::string_view build, const Shard& shard,
                                         const std::filesystem::path& folder, const PartLimits& limits,
                                         const StudyProgress& progress);

// The rows of the units that a part holds, in the order of the units.
[[nodiscard]] std::vector<StudyRow> rows_of(const StudyPart& part);

// The rows of all units in their order. Reports an incomplete part, a part of another question or build than the first,
// a repeated part, and a missing part.
[[nodiscard]] Result<std::vector<StudyRow>> join_parts(std::span<const StudyPart> parts);

}  // namespace ninebit
