// What all studies have in common: a question, units of work whose rows answer it, and a report made of all rows.
//
// A unit's rows depend on the question alone, so units may be done in any order, on any machine, in any number of runs:
// the report is the same bytes. study_part.h keeps units on the disk; report.h says what a report holds.
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

// Asked now and then, by any thread, whether to go on; may be empty.
using GoOn = std::function<bool()>;

// What was asked: everything that can change a row, as the flags of a command line that asks the same.
struct StudyQuestion {
  std::string study;    // "index-steps"
  std::string profile;  // a profile's name, or "all"
  // Flags with their values in a fixed order, completed by the defaults: {"--steps", "1-16"}; a flag that takes no
  // value has the empty one. What does not begin with '-' is no flag but a fact, such as {"sha256 of room.gltf", "…"}:
  // a part that was made from other content is another question.
  std::vector<std::pair<std::string, std::string>> options{};
  std::string arguments{};  // what stands before the flags: a scene's file

  // {"index-steps", "--steps", "1-16", "--profile", "geforce2"}: what the program takes after `ninebit study`.
  [[nodiscard]] std::vector<std::string> words() const;
  // The same as one line for a shell.
  [[nodiscard]] std::string command() const;
  friend bool operator==(const StudyQuestion&, const StudyQuestion&) = default;
};

// The most units that a study may have: what a part's first line says must not decide how much memory is taken.
inline constexpr std::size_t kMaxStudyUnits = std::size_t{1} << 24;

// A question that can be answered in pieces.
class Study {
 public:
  virtual ~Study() = default;

  // What was asked; valid as long as the study.
  [[nodiscard]] virtual const StudyQuestion& question() const = 0;
  // Units are numbered from 0 and take seconds at most, where the work allows. 1 to kMaxStudyUnits.
  [[nodiscard]] virtual std::size_t units() const = 0;
  // What a unit works on, for people: "geforce2, rgb".
  [[nodiscard]] virtual std::string unit_name(std::size_t unit) const = 0;
  // How long a unit takes, in any measure, for estimates of the time that is left.
  [[nodiscard]] virtual double weight(std::size_t unit) const;
  // The rows of one unit, which may use all threads. Reports Fault::cancelled where go_on says no.
  [[nodiscard]] virtual Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const = 0;
  // What the rows of one unit look like, known without running it. Rows from a file are used only if they follow this.
  [[nodiscard]] virtual std::vector<RowRule> row_rules(std::size_t unit) const = 0;
  // The report on all rows in the order of their units; `done` of units() units were run. Reports what it cannot read
  // or draw, such as pictures of a scene.
  [[nodiscard]] virtual Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const = 0;
};

}  // namespace ninebit
