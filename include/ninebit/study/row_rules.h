// Rules for the rows of a study's unit: rows from a file are checked against them before they are used.
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
  // The kind of value that is allowed.
  enum class Kind : std::uint8_t {
    exact,  // only `value`
    count,  // a whole number from 0
    whole,  // a whole number
    real,   // a real number
    text    // valid UTF-8 without control characters
  };
  std::string name;                    // the field's name in the row
  Kind kind = Kind::exact;             // selects which of the members below apply
  StudyValue value{};                  // for Kind::exact; signed and unsigned whole numbers compare by value
  double least = 0.0, greatest = 0.0;  // range of a number, inclusive; `greatest`: maximum length of a text in bytes
  bool may_be_nothing = false;         // true if the row may have no value here
};

// A field that must have this value.
[[nodiscard]] FieldRule exactly(std::string name, StudyValue value);
// A whole number from 0 to `greatest`.
[[nodiscard]] FieldRule count_up_to(std::string name, double greatest);
// A whole number from `least` to `greatest`.
[[nodiscard]] FieldRule whole_in(std::string name, double least, double greatest);
// A real number from `least` to `greatest`; never NaN.
[[nodiscard]] FieldRule real_in(std::string name, double least, double greatest);
// A text of at most `bytes` bytes.
[[nodiscard]] FieldRule text_up_to(std::string name, double bytes);
// The same rule for a field that may also have no value.
[[nodiscard]] FieldRule or_nothing(FieldRule rule);

// One row: its table, and its fields in order.
struct RowRule {
  std::string table = "rows";       // the name of the row's table
  std::vector<FieldRule> fields{};  // all fields of the row
};

// Checks rows against rules, one rule per row. Returns the first error, such as
// "row 2: packing is 'x'; expected 'rgba8-mod'", or an empty text.
[[nodiscard]] std::string wrong_with_rows(std::span<const RowRule> rules, std::span<const StudyRow> rows);

}  // namespace ninebit
