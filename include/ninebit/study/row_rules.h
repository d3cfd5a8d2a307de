// What the rows of a study's unit look like, so that rows which come from a file are checked before they are used.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ninebit/numerics/visibility.h"
#include "ninebit/study/report.h"

namespace NINEBIT_PUBLIC ninebit {

// One field of a row: its name, and the values that it may have.
struct FieldRule {
  // Which values there may be.
  enum class Kind : std::uint8_t {
    exact,  // `value` alone
    count,  // a whole number from 0
    whole,  // a whole number
    real,   // a real number
    text    // valid UTF-8 without control characters
  };
  std::string name;                    // as the row gives it
  Kind kind = Kind::exact;             // which of the members below count
  StudyValue value{};                  // of Kind::exact; whole numbers of either sign compare by value
  double least = 0.0, greatest = 0.0;  // of numbers, inclusive; of a text, `greatest` bytes at most
  bool may_be_nothing = false;         // whether the row may have no value here
};

// A field that has this value.
[[nodiscard]] FieldRule exactly(std::string name, StudyValue value);
// A whole number from 0 to `greatest`.
[[nodiscard]] FieldRule count_up_to(std::string name, double greatest);
// A whole number from `least` to `greatest`.
[[nodiscard]] FieldRule whole_in(std::string name, double least, double greatest);
// A real number from `least` to `greatest`; never NaN.
[[nodiscard]] FieldRule real_in(std::string name, double least, double greatest);
// A text of at most so many bytes.
[[nodiscard]] FieldRule text_up_to(std::string name, double bytes);
// The same rule for a field that may also have no value.
[[nodiscard]] FieldRule or_nothing(FieldRule rule);

// One row: its table, and its fields in order.
struct RowRule {
  std::string table = "rows";       // the name of the table that the row belongs to
  std::vector<FieldRule> fields{};  // all fields that the row has
};

// What is wrong with rows, as "row 2: packing is 'x'; expected 'rgba8-mod'"; empty if they follow the rules, one a row.
[[nodiscard]] std::string wrong_with_rows(std::span<const RowRule> rules, std::span<const StudyRow> rows);

}  // namespace ninebit
