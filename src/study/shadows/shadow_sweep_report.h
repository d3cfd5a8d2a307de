// The report of a shadow sweep.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ninebit/study/report.h"
#include "src/study/part/sweep_axes.h"

namespace ninebit {

// The rows with the fewest and with the most wrong pixels, the first of several; nullptr if no row was drawn.
[[nodiscard]] const StudyRow* best_row(std::span<const StudyRow> rows);
[[nodiscard]] const StudyRow* worst_row(std::span<const StudyRow> rows);

// The drawn rows of a sweep, at least one, and the columns that the sweep changed.
struct SweepView {
  std::vector<const StudyRow*> rows;
  std::vector<std::string> columns;  // with at least two values
  std::vector<std::string> causes;
  const StudyRow* best;

  [[nodiscard]] bool changes(std::string_view column) const;
  // The row's values in the changed columns except `left_out`: "map_size 512, index_step 2".
  [[nodiscard]] std::string label(const StudyRow& row, std::span<const std::string> left_out = {}) const;
  // The rows that differ from this one in no column but these.
  [[nodiscard]] std::vector<const StudyRow*> beside(const StudyRow& row, std::span<const std::string> columns) const;
};

// For each numeric column that the sweep changed: a plot of wrong pixels with a series for each combination of the
// other columns, and a plot of the causes with the other columns as in the best row.
[[nodiscard]] std::vector<Plot> sweep_plots(const SweepView& view);

// Wrong pixels by factor and units, with the other columns as in the best row. Empty unless the sweep has every
// combination of several factors and units.
[[nodiscard]] std::vector<HeatMap> offset_maps(const SweepView& view);

// All points with the columns that differ among them; the caption has the others. Wrong pixels stay in view.
[[nodiscard]] ReportTable point_table(std::span<const StudyRow> rows);

// The fewest wrong pixels for each value of a column, and for index_step the most that are lost to truncation.
[[nodiscard]] ReportTable value_table(const SweepView& view, const std::string& column);

extern const std::vector<std::string> kOffsetColumns;

// The whole report except the pictures. At least one row was drawn.
[[nodiscard]] StudyReport shadow_sweep_report(const SweptSettings& known, std::span<const SweepAxis> axes,
                                              std::span<const StudyRow> rows, std::size_t done, std::size_t units);

}  // namespace ninebit
