// A report that people look at and programs read: sentences, tables, plots, heat maps and pictures.
//
// The rows are the study's result; everything else is made of them.
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

// Nothing is what a row does not have: an error count without a ground truth.
using StudyValue = std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string>;

// One result. All rows of a table have the same fields in the same order.
struct StudyRow {
  std::string table = "rows";  // "rows": the main table, and "rows.csv"; others have names of their own
  std::vector<std::pair<std::string, StudyValue>> fields{};  // name and value

  // The value of that name; std::monostate if there is none.
  [[nodiscard]] const StudyValue& operator[](std::string_view name) const;
  // The value as a number, 0 where it is none; as text.
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] std::uint64_t count(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name) const;

  friend bool operator==(const StudyRow&, const StudyRow&) = default;
};

// A value as CSV and tables show it: integers in full, reals with as many digits as bring the same double back, nothing
// as an empty text.
[[nodiscard]] std::string text_of(const StudyValue& value);

// One line, or the bars of one colour.
struct PlotSeries {
  std::string name;                               // for the legend
  std::vector<std::pair<double, double>> points;  // x, y
};

// Series over common axes.
struct Plot {
  std::string file;                    // its PNG's name without ".png": "false-matches-rgb"
  std::string title;                   // above it
  std::string x_label, y_label;        // at the axes
  std::vector<std::string> x_names{};  // of bars at x = 1, 2, …; empty: they show their numbers
  bool bars = false;                   // bars at each x instead of lines between points
  bool log_x = false, log_y = false;   // points at 0 or below are left out of a logarithmic axis
  std::vector<PlotSeries> series;      // in the order of the legend
  std::string caption{};               // below it; may be empty
};

// One value a pixel: width × height, the top row first.
struct HeatMap {
  std::string file;                    // its PNG's name without ".png"
  std::string title;                   // above it
  std::string x_label, y_label;        // at the axes
  double x_first = 0.0, x_last = 0.0;  // what the leftmost and the rightmost column stand for
  double y_first = 0.0, y_last = 0.0;  // the same of the top and the bottom row
  int width = 0, height = 0;           // columns and rows
  std::vector<float> values;           // width × height
  // The values at the ends of the colours: below 0 and above 0 have a colour each, and 0 is white where low < 0.
  float low = 0.0F, high = 1.0F;
  std::string caption{};  // below it; may be empty
};

// A picture that is shown as it is.
struct ReportPicture {
  std::string file;       // the PNG's name without ".png"
  std::string title;      // above it
  Image8 image;           // the top row first
  std::string caption{};  // below it; may be empty
};

// A table for people, made from rows: those of one table, or a choice of fields.
struct ReportTable {
  std::string title;                          // above it
  std::vector<std::string> columns;           // their heads
  std::vector<std::vector<StudyValue>> rows;  // of as many values as columns
  std::string caption{};                      // below it; may be empty
};

// What people see of a study: answers first, then what they rest on.
struct StudyReport {
  std::string title;                      // "Index steps"
  std::vector<std::string> answers;       // the study's question answered in sentences
  std::vector<ReportTable> tables{};      // in order
  std::vector<Plot> plots{};              // in order
  std::vector<HeatMap> heat_maps{};       // in order
  std::vector<ReportPicture> pictures{};  // in order
};

}  // namespace ninebit
