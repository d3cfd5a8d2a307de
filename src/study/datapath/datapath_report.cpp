#include "src/study/datapath/datapath_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/study/datapath/operations.h"

namespace ninebit {
namespace {

class Writer {
 public:
  Writer(std::span<const HardwareProfile> profiles, std::span<const StudyRow> rows)
      : profiles_(profiles), rows_(rows) {}

  StudyReport write() {
    out_.title = "Errors of the datapath";
    for (const HardwareProfile& profile : profiles_) {
      describe(profile);
      out_.tables.push_back(table_of(profile));
    }
    compare();
    if (profiles_.size() > 1) summarize();
    plot_operations("max-error-by-operation", "Largest error", "largest error, in codes", "max_error_codes");
    plot_operations("mean-error-by-operation", "Mean error", "mean error, in codes", "mean_error_codes");
    plot_forms();
    out_.heat_maps = datapath_maps(profiles_);
    return std::move(out_);
  }

 private:
  [[nodiscard]] const StudyRow* find(std::string_view profile, std::string_view operation,
                                     std::string_view form) const {
    for (const StudyRow& row : rows_) {
      if (row.table == "rows" && row.text("profile") == profile && row.text("operation") == operation &&
          row.text("form") == form) {
        return &row;
      }
    }
    return nullptr;
  }

  static std::string name_of_row(const StudyRow& row) {
    const std::string form = row.text("form");
    return row.text("operation") + (form.empty() ? "" : " (" + form + ")");
  }

  // The row of the operation with the largest error; nullptr if there is no row.
  [[nodiscard]] const StudyRow* worst_of(const HardwareProfile& profile) const {
    const StudyRow* worst = nullptr;
    for (const StudyRow& row : rows_) {
      if (row.table != "rows" || row.text("profile") != profile.name) continue;
      // Larger by more than rounding: so the first of several equal rows wins.
      if (worst == nullptr || row.number("max_error_codes") > worst->number("max_error_codes") + 1e-9) worst = &row;
    }
    return worst;
  }

  // The page's opening if several profiles are compared: their worst operations, and tables of what the answers say.
  void summarize() {
    ReportTable table{.title = "Products and the worst operation, by profile",
                      .columns = {"profile", "x1: exact, %", "x1: mean, codes", "x4: exact, %", "x4: mean, codes",
                                  "largest error, codes", "of operation", "at, codes"},
                      .rows = {},
                      .caption = "x1 and x4: a product with that scale."};
    double largest = -1.0;
    for (const HardwareProfile& profile : profiles_) {
      const StudyRow* worst = worst_of(profile);
      if (worst == nullptr) continue;
      std::vector<StudyValue>& values = table.rows.emplace_back();
      values.emplace_back(std::string(profile.name));
      for (const OutputForm& form : {kOutputForms[0], kOutputForms[2]}) {
        const StudyRow* product = find(profile.name, "product", form.name);
        values.resize(values.size() + 2);
        if (product == nullptr) continue;
        const auto last = values.end();
        last[-2] = percent(product->count("exact"), product->count("cases"));
        last[-1] = product->number("mean_error_codes");
      }
      const double error = worst->number("max_error_codes");
      values.insert(values.end(), {error, name_of_row(*worst), (*worst)["worst"]});
      if (error > largest) {
        out_.headlines = {
            fmt::format("The largest error of any operation and profile is {:.3f} codes, of {} at {} on {}.", error,
                        name_of_row(*worst), worst->text("worst"), profile.name)};
      }
      largest = std::max(largest, error);
    }
    out_.summary.push_back(std::move(table));
    if (!pairs_.rows.empty()) out_.summary.push_back(std::move(pairs_));
  }

  static std::string worst_in_words(const HardwareProfile& profile, const StudyRow& worst) {
    return fmt::format("{}: the largest error of any operation is {:.3f} codes, of {} at {}.", profile.name,
                       worst.number("max_error_codes"), name_of_row(worst), worst.text("worst"));
  }

  // Describes products, on which everything else is built, then the worst of all operations.
  void describe(const HardwareProfile& profile) {
    for (const OutputForm& form : {kOutputForms[0], kOutputForms[2]}) {
      const StudyRow* product = find(profile.name, "product", form.name);
      if (product == nullptr) continue;
      out_.answers.push_back(fmt::format(
          "{}: a product, {}, is exact for {:.2f} % of its {} inputs; largest error {:.3f} codes ({} gives {}, exact "
          "{:.3f}), mean error {:.3f}, bias {:.3f} codes.",
          profile.name, form.name, percent(product->count("exact"), product->count("cases")), product->count("cases"),
          product->number("max_error_codes"), product->text("worst"), product->text("worst_code"),
          product->number("worst_exact_codes"), product->number("mean_error_codes"),
          plain(product->number("mean_bias_codes"))));
    }
    if (const StudyRow* worst = worst_of(profile)) out_.answers.push_back(worst_in_words(profile, *worst));
  }

  [[nodiscard]] ReportTable table_of(const HardwareProfile& profile) const {
    ReportTable table{.title = fmt::format("Errors of {}", profile.name),
                      .columns = {"operation", "form", "inputs", "distinct codes", "exact, %", "max, codes",
                                  "mean, codes", "bias, codes", "worst at, codes", "gives, code", "exact, codes"},
                      .rows = {},
                      .caption = fmt::format("Code {} is 1.0.", profile.one.value)};
    for (const StudyRow& row : rows_) {
      if (row.table != "rows" || row.text("profile") != profile.name) continue;
      table.rows.push_back({row["operation"], row["form"], row["cases"], row["distinct"],
                            percent(row.count("exact"), row.count("cases")), row["max_error_codes"],
                            row["mean_error_codes"], row["mean_bias_codes"], row["worst"], row["worst_code"],
                            row["worst_exact_codes"]});
    }
    return table;
  }

  void compare() {
    ReportTable table{.title = "Inputs on which two profiles give different codes",
                      .columns = {"first", "second", "operation", "form", "inputs", "differ, inputs", "differ, %"},
                      .rows = {},
                      .caption = "Operations on which two profiles always agree are left out."};
    for (std::size_t i = 0; i < rows_.size();) {
      if (rows_[i].table != "differences") {
        ++i;
        continue;
      }
      const std::string first = rows_[i].text("first"), second = rows_[i].text("second");
      std::size_t all = 0, agree = 0;
      const StudyRow* most = nullptr;
      double most_share = 0.0;
      for (; i < rows_.size() && rows_[i].table == "differences" && rows_[i].text("first") == first &&
             rows_[i].text("second") == second;
           ++i) {
        const StudyRow& row = rows_[i];
        ++all;
        const double share = percent(row.count("differ"), row.count("cases"));
        if (row.count("differ") == 0) {
          ++agree;
          continue;
        }
        if (share > most_share) {
          most = &row;
          most_share = share;
        }
        table.rows.push_back(
            {row["first"], row["second"], row["operation"], row["form"], row["cases"], row["differ"], share});
      }
      std::string sentence =
          fmt::format("{} and {} agree on all inputs of {} of {} operations", first, second, agree, all);
      if (most != nullptr) {
        sentence += fmt::format("; they differ most in {}: on {:.3g} % of its inputs", name_of_row(*most), most_share);
      }
      out_.answers.push_back(sentence + ".");
      pairs_.rows.push_back({first, second, std::uint64_t{agree}, std::uint64_t{all},
                             most == nullptr ? StudyValue() : StudyValue(name_of_row(*most)),
                             most == nullptr ? StudyValue() : StudyValue(most_share)});
    }
    if (!table.rows.empty()) out_.tables.push_back(std::move(table));
  }

  // Plots the worst form of each operation, in codes, with one bar per profile.
  void plot_operations(const char* file, const char* title, const char* label, std::string_view field) {
    Plot plot{.file = file,
              .title = fmt::format("{} by operation, the worst form of each", title),
              .x_label = "operation",
              .y_label = label,
              .bars = true,
              .series = {}};
    plot.x_names.assign(kOperations.begin(), kOperations.end());
    for (const HardwareProfile& profile : profiles_) {
      PlotSeries series{std::string(profile.name), {}};
      for (std::size_t kind = 0; kind < kOperations.size(); ++kind) {
        std::optional<double> most;
        for (const StudyRow& row : rows_) {
          if (row.table != "rows" || row.text("profile") != profile.name ||
              row.text("operation") != kOperations[kind]) {
            continue;
          }
          most = std::max(most.value_or(0.0), row.number(field));
        }
        if (most) series.points.emplace_back(static_cast<double>(kind + 1), *most);
      }
      plot.series.push_back(std::move(series));
    }
    if (profiles_.size() == 1) plot.caption = fmt::format("On {}.", profiles_.front().name);
    out_.plots.push_back(std::move(plot));
  }

  void plot_forms() {
    Plot plot{.file = "product-error-by-form",
              .title = "Mean error of products by scale and bias",
              .x_label = "output form",
              .y_label = "mean error, in codes",
              .bars = true,
              .series = {}};
    for (const auto& form : kOutputForms) plot.x_names.emplace_back(form.name);
    for (const HardwareProfile& profile : profiles_) {
      PlotSeries series{std::string(profile.name), {}};
      for (std::size_t i = 0; i < kOutputForms.size(); ++i) {
        const StudyRow* row = find(profile.name, "product", kOutputForms[i].name);
        if (row != nullptr) series.points.emplace_back(static_cast<double>(i + 1), row->number("mean_error_codes"));
      }
      plot.series.push_back(std::move(series));
    }
    if (profiles_.size() == 1) plot.caption = fmt::format("On {}.", profiles_.front().name);
    out_.plots.push_back(std::move(plot));
  }

  std::span<const HardwareProfile> profiles_;
  std::span<const StudyRow> rows_;
  ReportTable pairs_{.title = "Agreement of profiles",
                     .columns = {"first", "second", "operations that agree", "of", "differ most in", "% of its inputs"},
                     .rows = {},
                     .caption = "Two profiles agree on an operation if it gives the same codes for all inputs."};
  StudyReport out_;
};

}  // namespace

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

StudyReport datapath_report(std::span<const HardwareProfile> profiles, std::span<const StudyRow> rows, std::size_t done,
                            std::size_t units) {
  StudyReport report = Writer(profiles, rows).write();
  if (done < units) {
    const std::string partial = fmt::format("Only {} of {} units were measured.", done, units);
    report.answers.insert(report.answers.begin(), partial);
    if (!report.headlines.empty()) report.headlines.insert(report.headlines.begin(), partial);
  }
  return report;
}

}  // namespace ninebit
