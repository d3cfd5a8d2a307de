// Tables of what pictures of a chip show: of its combiners, and of blending, textures and smooth colours. `ninebit
// verify` knows them by their header.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/input/csv_lines.h"

namespace ninebit::tools {

struct MeasuredColumn {
  enum class Kind {
    note,      // what somebody computed; not read
    word,      // one of the format's words, or a name
    whole,     // a whole number
    real,      // a number, or a number and a note in parentheses
    digits,    // hexadecimal, with or without 0x
    measured,  // of the picture: whole numbers of 32 bits separated by |, or empty, which is not compared
    word_hex,  // of the picture: up to four hexadecimal digits
    extent,    // of the picture: a whole number, or empty, where nothing is drawn
    runs,      // of the picture: runs of pixels, such as 3-5 7-7; how many pixels differ is compared with 0
    counts,    // whole numbers with how many pixels have each, such as 16:8121;0:144879
    most,      // of the picture: the same; the number of the most pixels, but 0 where another one is there
    match      // 0: the row lies outside of the rule that was found, and is skipped
  };
  std::string_view name;
  Kind kind = Kind::note;
  std::int64_t low = 0, high = 0;  // the range of a whole number
  bool may_be_empty = false;       // an empty cell is 0
};

// A quantity of a whole table, which its comments state: after "# NAME:", or after words that the published tables
// have before it.
struct StatedValue {
  enum class Kind {
    real,
    digits,  // hexadecimal
    list,    // numbers in parentheses: "(32,32,32,255)", or "(160,398) (220,388)"
    rows     // numbers separated by spaces, in rows separated by semicolons: "1 0 1; 0 1 0"
  };
  std::string_view name, before;
  Kind kind = Kind::real;
  double low = 0.0, high = 255.0;  // the range of its numbers
  std::string_view example;        // of the value
  std::size_t count = 0;           // of a list or of rows: how many numbers; 0: pairs, two at least
  bool may_be_missing = false;     // where not every row needs it
};

// The cells of a row by column.
class MeasuredRow {
 public:
  struct Cell {
    std::string text;
    std::int64_t whole = 0;  // of a whole number, or of digits
    double real = 0.0;
    std::vector<double> list{};  // of a stated list
  };
  void set(std::string_view column, Cell cell) { cells_.insert_or_assign(std::string(column), std::move(cell)); }

  // The cells of another row that this one does not have.
  void add(const MeasuredRow& other) { cells_.insert(other.cells_.begin(), other.cells_.end()); }

  [[nodiscard]] bool has(std::string_view column) const { return cells_.find(column) != cells_.end(); }

  // The value of a column that the row's format has.
  [[nodiscard]] const std::string& text(std::string_view column) const { return cell(column).text; }
  [[nodiscard]] int whole(std::string_view column) const { return static_cast<int>(cell(column).whole); }
  [[nodiscard]] double real(std::string_view column) const { return cell(column).real; }
  [[nodiscard]] const std::vector<double>& list(std::string_view column) const { return cell(column).list; }
  [[nodiscard]] std::uint8_t byte(std::string_view column) const { return static_cast<std::uint8_t>(whole(column)); }
  [[nodiscard]] std::uint32_t digits(std::string_view column) const {
    return static_cast<std::uint32_t>(cell(column).whole);
  }

 private:
  [[nodiscard]] const Cell& cell(std::string_view column) const { return cells_.find(column)->second; }
  std::map<std::string, Cell, std::less<>> cells_;
};

// The word for an unknown extent.
inline constexpr int kNothingDrawn = -9999;

// Pixels first to last of a row.
struct PixelRun {
  int first = 0, last = 0;
};

// The runs of a cell; empty: it has something else.
[[nodiscard]] std::optional<std::vector<PixelRun>> pixel_runs(std::string_view text);

// A number, and how many pixels have it.
struct PixelCount {
  std::int64_t value = 0, pixels = 0;
};

// The counts of a cell; empty: it has something else.
[[nodiscard]] std::optional<std::vector<PixelCount>> pixel_counts(std::string_view text);

// Whether a column is of the picture, and the values that its cell allows; none: it is not compared.
[[nodiscard]] bool is_of_the_picture(const MeasuredColumn& column);
[[nodiscard]] std::vector<int> allowed_values(const MeasuredColumn& column, const std::string& text);

// A kind of measured table.
struct MeasuredFormat {
  std::string_view place;  // "blending", for the report
  std::vector<MeasuredColumn> columns;
  // The profile's values of the measured columns, in their order.
  std::vector<int> (*draw)(const MeasuredRow& row, const HardwareProfile& profile);
  // The fault of a row, for a profile; null: there never is one.
  std::string (*wrong)(const MeasuredRow& row, const HardwareProfile& profile) = nullptr;
  // More cells of every row.
  std::vector<StatedValue> stated{};
  // Another table, in the same folder, that has more of each row's cells; empty: none. Both have the column `key`.
  std::string_view beside{}, key{};
  std::vector<MeasuredColumn> columns_beside{};
  // By how much a row's values may differ, where the rule is known no better; null: not at all.
  int (*tolerance)(const MeasuredRow& row) = nullptr;
};

// The names of columns, separated by commas.
[[nodiscard]] std::string header_of(const std::vector<MeasuredColumn>& columns);

// The measured things of the tables, separated by commas.
[[nodiscard]] std::string measured_places();

// The format with this header; null: none.
[[nodiscard]] const MeasuredFormat* measured_format(std::string_view header);

// Reads what the comments of a table state. Reports a value that is missing, is out of range, or is stated differently.
[[nodiscard]] Status read_stated(const std::vector<StatedValue>& stated, const std::vector<std::string>& comments,
                                 const std::string& file, int line, MeasuredRow& row);

// Reads fields into a row. Reports a wrong number of fields, and values that the columns do not have.
[[nodiscard]] Status read_measured(const std::vector<MeasuredColumn>& columns,
                                   const std::vector<std::string_view>& fields, const std::string& file, int line,
                                   MeasuredRow& row);

// The rows of the table beside another, by key. `columns` is its format.
[[nodiscard]] Result<std::map<std::string, MeasuredRow>> read_beside(const std::string& file,
                                                                     const MeasuredFormat& format);

// A text that is a whole number.
[[nodiscard]] std::optional<int> number_of(std::string_view text);

// The fields of a line between commas, trimmed; a field in quotes may have commas.
[[nodiscard]] std::vector<std::string_view> quoted_pieces(std::string_view text);

// The pieces of a line between separators, trimmed.
[[nodiscard]] std::vector<std::string_view> pieces(std::string_view text, char separator);

}  // namespace ninebit::tools
