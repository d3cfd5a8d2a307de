// The interface of all studies: a question, units of work whose rows answer it, and a report made from all rows.
//
// A unit's rows depend only on the question. Units may therefore run in any order, on any machine, in any number of
// runs: the report has the same bytes. study_part.h keeps units on disk; report.h describes the contents of a report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/report.h"
#include "ninebit/study/row_rules.h"

namespace NINEBIT_PUBLIC ninebit {

// Called now and then, by any thread: returns false to cancel the work. May be empty.
using GoOn = std::function<bool()>;

// Called now and then, by the caller's thread, with the share of a drawing that is done, 0 to 1: returns false to
// cancel the drawing. May be empty.
using DrawProgress = std::function<bool(double done)>;

// The question of a study: everything that can change a row, as the flags of an equivalent command line.
struct StudyQuestion {
  std::string study;    // "index-steps"
  std::string profile;  // a profile's name, or "all"
  // Flags with their values in a fixed order, including defaults: {"--steps", "1-16"}. A flag without a value has an
  // empty one. An entry that does not begin with '-' is not a flag but a fact, such as {"sha256 of room.gltf", "…"}:
  // a part made from other content belongs to another question.
  std::vector<std::pair<std::string, std::string>> options{};
  std::string arguments{};  // the arguments before the flags: a scene's file

  // {"index-steps", "--steps", "1-16", "--profile", "geforce2"}: the arguments after `ninebit study`.
  [[nodiscard]] std::vector<std::string> words() const;
  // The same as one line for a shell.
  [[nodiscard]] std::string command() const;
  friend bool operator==(const StudyQuestion&, const StudyQuestion&) = default;
};

// The maximum number of units of a study: it bounds the memory that a part's first line can request.
inline constexpr std::size_t kMaxStudyUnits = std::size_t{1} << 24;

// A question that can be answered in pieces.
class Study {
 public:
  virtual ~Study() = default;

  // The study's question; valid as long as the study.
  [[nodiscard]] virtual const StudyQuestion& question() const = 0;
  // The number of units, 1 to kMaxStudyUnits. Units are numbered from 0; a unit takes at most seconds if the work can
  // be divided so far.
  [[nodiscard]] virtual std::size_t units() const = 0;
  // A unit's name for people: "geforce2, rgb".
  [[nodiscard]] virtual std::string unit_name(std::size_t unit) const = 0;
  // The relative duration of a unit in any measure, for estimates of the remaining time.
  [[nodiscard]] virtual double weight(std::size_t unit) const;
  // Runs one unit, on all threads if useful, and returns its rows. Reports Fault::cancelled if go_on returns false.
  [[nodiscard]] virtual Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const = 0;
  // The rules for the rows of one unit, without running it. Rows from a file are used only if they follow the rules.
  [[nodiscard]] virtual std::vector<RowRule> row_rules(std::size_t unit) const = 0;
  // The report on all rows in the order of their units; `done` of units() units were run. Reports errors in reading
  // rows and in drawing, such as pictures of a scene.
  [[nodiscard]] virtual Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const = 0;
  // Adds the heat maps and files that take long to make to the report on the rows of all units. Needed only where a
  // report is written or shown as a page. Reports Fault::cancelled if progress returns false. Default: adds nothing.
  [[nodiscard]] virtual Status draw(std::span<const StudyRow> rows, const DrawProgress& progress,
                                    StudyReport& report) const;
};

}  // namespace ninebit
