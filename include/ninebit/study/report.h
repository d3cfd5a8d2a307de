// A report for people and programs: sentences, tables, plots, heat maps and pictures.
//
// The rows are the study's result; everything else is derived from them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The value of a field. std::monostate: the row has no value here, such as an error count without a ground truth.
using StudyValue = std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string>;

// One result. All rows of a table have the same fields in the same order.
struct StudyRow {
  std::string table = "rows";  // the table's name, also of its CSV file; "rows" is the main table
  std::vector<std::pair<std::string, StudyValue>> fields{};  // name and value

  // The value of that name; std::monostate if there is none.
  [[nodiscard]] const StudyValue& operator[](std::string_view name) const;
  // The value as a number, 0 if it is not one; as text.
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] std::uint64_t count(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name) const;

  friend bool operator==(const StudyRow&, const StudyRow&) = default;
};

// A value as CSV and tables show it: integers in full, reals with enough digits to read the same double back,
// std::monostate as an empty text.
[[nodiscard]] std::string text_of(const StudyValue& value);

// One line, or all bars of one colour.
struct PlotSeries {
  std::string name;                               // for the legend
  std::vector<std::pair<double, double>> points;  // x, y
};

// Series over common axes.
struct Plot {
  std::string file;              // the name, without ".png", under which the page saves the plot: "false-matches-rgb"
  std::string title;             // shown above the plot
  std::string x_label, y_label;  // names of the axes
  std::vector<std::string> x_names{};  // labels of the bars at x = 1, 2, …; if empty, bars show their numbers
  bool bars = false;                   // bars at each x instead of lines between points
  bool log_x = false, log_y = false;   // points at 0 or below are left out on a logarithmic axis
  bool even_x = false;                 // equal distances between the x of all points, whatever their values
  std::vector<PlotSeries> series;      // in the order of the legend
  std::string caption{};               // shown below the plot; may be empty
};

// One value per pixel: width × height, the top row first.
struct HeatMap {
  std::string file;                    // name of the PNG file without ".png"
  std::string title;                   // shown above the map
  std::string x_label, y_label;        // names of the axes
  double x_first = 0.0, x_last = 0.0;  // the coordinates of the leftmost and the rightmost column
  double y_first = 0.0, y_last = 0.0;  // the coordinates of the top and the bottom row
  int width = 0, height = 0;           // columns and rows
  std::vector<float> values;           // width × height
  // The values at the ends of the colour scale. If low < 0, negative and positive values differ in hue, and 0 is white.
  float low = 0.0F, high = 1.0F;
  std::string caption{};                       // shown below the map; may be empty
  std::string none = "none";                   // the page's word for a NaN, which is drawn grey
  std::vector<double> x_values{}, y_values{};  // coordinates of the columns and rows, where they are not evenly spaced
};

// The trace of a pixel of a picture.
struct PictureTrace {
  int x = 0, y = 0;     // counted from the top left
  std::string command;  // `ninebit trace … --pixel X,Y --ground-truth`
  std::string text{};   // what the command prints; may be empty: the page then shows the command alone
};

// A picture that is shown unchanged.
struct ReportPicture {
  std::string file;       // name of the PNG file without ".png"
  std::string title;      // shown above the picture
  Image8 image;           // the top row first
  std::string caption{};  // shown below the picture; may be empty
  Image8 causes{};        // of wrong pixels, grey: 0, or an ErrorCause's number, plus 128 if falsely lit; may be empty
  std::vector<PictureTrace> traces{};  // of some of these; may be empty
};

// A file of its own beside the page.
struct ReportFile {
  std::string name;     // with its ending: "error.csv"
  std::string content;  // its bytes
};

// A table for people, made from rows: those of one table, or a choice of fields.
struct ReportTable {
  std::string title;                          // shown above the table
  std::vector<std::string> columns;           // column headings
  std::vector<std::vector<StudyValue>> rows;  // each with one value per column
  std::string caption{};                      // shown below the table; may be empty
  std::string kept{};                         // heading of the column that stays in view when the table scrolls
};

// A study's report for people: answers first, then the data behind them.
struct StudyReport {
  std::string title;                 // "Index steps"
  std::vector<std::string> answers;  // sentences that answer the study's question
  // The page's opening sentences instead of `answers`, and the tables under them: for answers with many figures.
  std::vector<std::string> headlines{};
  std::vector<ReportTable> summary{};
  std::vector<ReportTable> tables{};      // in the order shown
  std::vector<Plot> plots{};              // in the order shown
  std::vector<HeatMap> heat_maps{};       // in the order shown
  std::vector<ReportPicture> pictures{};  // in the order shown
  std::vector<ReportFile> files{};        // written as they are; the page does not show them
  std::vector<StudyRow> rows{};           // of further tables; in JSON and CSV behind the units' rows
};

}  // namespace ninebit
