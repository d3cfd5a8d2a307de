// Units of a study on the disk: a part holds what one run has finished, whole or not.
//
// A part is a text file of JSON lines: first what it is a part of (question, build, units, shard), then a line for each
// finished unit with its rows and their SHA-256, last the SHA-256 of all lines before it. A part without its last line
// is a run that was interrupted; the next run goes on from there. What the disk holds of a line that was being written
// when the machine stopped is dropped; a line that was altered is reported.
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

// Which units a run does: those whose number leaves the remainder index - 1 when divided by count.
struct Shard {
  std::size_t index = 1;  // 1 to count
  std::size_t count = 1;  // shards of the whole
  friend bool operator==(const Shard&, const Shard&) = default;
};

// "part-2-of-8.jsonl"
[[nodiscard]] std::string part_file_name(const Shard& shard);

// What a part says of itself in its first line.
struct PartHeader {
  StudyQuestion question;  // what the rows answer
  std::string build;       // tells builds of the program apart: parts of two builds are not joined
  std::size_t units = 0;   // of the whole study
  Shard shard;             // whose units these are
  friend bool operator==(const PartHeader&, const PartHeader&) = default;
};

// A unit that was run to its end.
struct FinishedUnit {
  std::size_t unit = 0;        // its number in the study
  std::vector<StudyRow> rows;  // in its order
  int line = 0;                // of the file that it was read from
};

// A part as it was read.
struct StudyPart {
  std::filesystem::path file;       // that it stands in
  PartHeader header;                // its first line
  std::vector<FinishedUnit> units;  // in the order of their ending
  bool complete = false;            // has its last line
};

// Gives the study that a part's first line asks for, or says why there is none. The study must outlive the reading.
using StudyOfPart = std::function<Result<const Study*>(const PartHeader&)>;

// Reads a part. A unit that stands there for the second time in the same bytes counts once. Reports, with file and
// line, what is not a part, damaged (a hash that does not fit, a line that is not the last and not complete) or has
// lines longer than 1 MiB; with `study_of`, also another number of units than its study has, and rows that do not
// follow the study's row_rules(). Memory and time are bounded by a multiple of the file's bytes.
[[nodiscard]] Result<StudyPart> read_part(const std::filesystem::path& file, const StudyOfPart& study_of = {});

// What a run is told between units: what comes next, and how much is done (0 to 1). False ends the work.
using StudyProgress = std::function<bool(const std::string& unit, double done)>;

// What may end a run early.
struct PartLimits {
  std::optional<double> seconds{};  // no unit is begun after so many; the part then stays incomplete
  GoOn go_on{};                     // asked within units
};

// Does the shard's units that the part in `folder` does not hold yet, and appends each as soon as it is finished.
// Reports a part that another run is writing, one of another question or build, a damaged one, what cannot be written,
// and Fault::cancelled; whatever was finished stays in the part. Gives the part, which is incomplete where the limits
// ended the run.
[[nodiscard]] Result<StudyPart> run_part(const Study& study, std::string_view build, const Shard& shard,
                                         const std::filesystem::path& folder, const PartLimits& limits,
                                         const StudyProgress& progress);

// The rows of the units that a part holds, in the order of the units.
[[nodiscard]] std::vector<StudyRow> rows_of(const StudyPart& part);

// The rows of all units in their order. Reports parts that are incomplete, of another question or build than the first,
// doubled, and units that none has.
[[nodiscard]] Result<std::vector<StudyRow>> join_parts(std::span<const StudyPart> parts);

}  // namespace ninebit
