#include "ninebit/study/exhaustive_sum.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/study/datapath/datapath_report.h"
#include "src/study/datapath/sum_kernels.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// Limits for rows from files: results are clamped to [-1, 1]; sums are whole numbers below 2^47.
constexpr double kMostError = 16.0 * 65536.0, kMostSum = 0x1p47;

class ExhaustiveSum final : public Study {
 public:
  ExhaustiveSum(StudyQuestion question, const HardwareProfile& profile, std::span<const OutputForm> forms)
      : question_(std::move(question)),
        profile_(profile.name),
        datapath_(datapath_of(profile)),
        forms_(forms.begin(), forms.end()) {}

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return forms_.size() * codes(); }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    return fmt::format("{}, {}, A = {}", profile_, form_of(unit).name, a_of(unit));
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const OutputForm& form = form_of(unit);
    const int a = a_of(unit);
    std::vector<SumTotals> by_b(codes());
    std::atomic<bool> stopped = false;
    parallel_for(by_b.size(), [&](std::size_t i) {
      if (stopped) return;
      by_b[i] = sum_totals(datapath_, form, a, static_cast<int>(i) - datapath_.one);
      if (go_on && !go_on()) stopped = true;
    });
    if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    SumTotals all;
    for (const SumTotals& totals : by_b) all.add(totals);
    return std::vector<StudyRow>{{.table = "rows",
                                  .fields = {{"profile", profile_},
                                             {"form", std::string(form.name)},
                                             {"a", static_cast<std::int64_t>(a)},
                                             {"cases", all.cases},
                                             {"exact", all.cases - all.inexact},
                                             {"inexact", all.inexact},
                                             {"max_error_codes", static_cast<double>(all.max_error) * codes_of_unit()},
                                             {"sum_of_sizes_codes_times_4one", all.sum_of_sizes},
                                             {"sum_of_errors_codes_times_4one", all.sum_of_errors},
                                             {"sum_of_codes", all.sum_of_codes},
                                             {"sum_of_squares", all.sum_of_squares}}}};
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const std::uint64_t cases = std::uint64_t{codes()} * codes() * codes();
    const auto most = static_cast<double>(cases);
    return {{.fields = {exactly("profile", profile_), exactly("form", std::string(form_of(unit).name)),
                        exactly("a", std::int64_t{a_of(unit)}), exactly("cases", cases), count_up_to("exact", most),
                        count_up_to("inexact", most), real_in("max_error_codes", 0.0, kMostError),
                        whole_in("sum_of_sizes_codes_times_4one", 0.0, kMostSum),
                        whole_in("sum_of_errors_codes_times_4one", -kMostSum, kMostSum),
                        whole_in("sum_of_codes", -kMostSum, kMostSum), whole_in("sum_of_squares", 0.0, kMostSum)}}};
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    StudyReport out{.title = "AB + CD, every case", .answers = {}};
    ReportTable table{.title = "All cases by output form",
                      .columns = {"profile", "form", "values of A", "cases", "exact", "inexact", "exact, %",
                                  "max, codes", "mean, codes", "bias, codes", "sum of codes", "sum of codes²"},
                      .rows = {}};
    Plot exact{.file = "exact-by-a",
               .title = "Share of exact results by A",
               .x_label = "A, as code",
               .y_label = "exact, %",
               .series = {}};
    Plot mean{.file = "mean-error-by-a",
              .title = "Mean error by A",
              .x_label = "A, as code",
              .y_label = "mean error, in codes",
              .series = {}};
    for (const OutputForm& form : forms_) {
      Sum sum;
      PlotSeries shares{std::string(form.name), {}};
      PlotSeries means = shares;
      for (const StudyRow& row : rows) {
        if (row.text("form") != form.name) continue;
        Sum one_a;
        one_a.add(row);
        sum.add(row);
        shares.points.emplace_back(row.number("a"), percent(one_a.exact, one_a.cases));
        means.points.emplace_back(row.number("a"), one_a.per_case(one_a.sizes) * codes_of_unit());
      }
      if (sum.cases == 0) continue;
      out.answers.push_back(
          fmt::format("{}, {}: {} of {} cases of AB + CD are exact ({:.3f} %); largest error {:.4f} codes, mean error "
                      "over all cases {:.4f} codes; the sum of the codes' squares is {}.",
                      profile_, form.name, sum.exact, sum.cases, percent(sum.exact, sum.cases), sum.max_error,
                      sum.per_case(sum.sizes) * codes_of_unit(), sum.squares));
      table.rows.push_back({profile_, std::string(form.name), sum.values, sum.cases, sum.exact, sum.cases - sum.exact,
                            percent(sum.exact, sum.cases), sum.max_error, sum.per_case(sum.sizes) * codes_of_unit(),
                            sum.per_case(sum.errors) * codes_of_unit(), sum.codes, sum.squares});
      exact.series.push_back(std::move(shares));
      mean.series.push_back(std::move(means));
    }
    if (done < units()) {
      out.answers.insert(out.answers.begin(), fmt::format("Only {} of {} units were evaluated.", done, units()));
    }
    out.tables.push_back(std::move(table));
    out.plots.push_back(std::move(exact));
    out.plots.push_back(std::move(mean));
    return out;
  }

 private:
  // The sum of rows. A row's sums are whole numbers below 2^47, exact in a double; those of all rows are below 2^56.
  struct Sum {
    std::uint64_t values = 0, cases = 0, exact = 0;
    double max_error = 0.0;
    std::int64_t sizes = 0, errors = 0, codes = 0, squares = 0;

    void add(const StudyRow& row) {
      ++values;
      cases += row.count("cases");
      exact += row.count("exact");
      max_error = std::max(max_error, row.number("max_error_codes"));
      sizes += sum_in(row, "sum_of_sizes_codes_times_4one");
      errors += sum_in(row, "sum_of_errors_codes_times_4one");
      codes += sum_in(row, "sum_of_codes");
      squares += sum_in(row, "sum_of_squares");
    }
    // An altered part can hold any number.
    static std::int64_t sum_in(const StudyRow& row, std::string_view name) {
      return static_cast<std::int64_t>(std::clamp(row.number(name), -kMostSum, kMostSum));
    }
    [[nodiscard]] double per_case(std::int64_t sum) const {
      return static_cast<double>(sum) / static_cast<double>(cases);
    }
  };

  [[nodiscard]] std::size_t codes() const { return static_cast<std::size_t>(2 * datapath_.one + 1); }
  [[nodiscard]] const OutputForm& form_of(std::size_t unit) const { return forms_[unit / codes()]; }
  [[nodiscard]] int a_of(std::size_t unit) const { return static_cast<int>(unit % codes()) - datapath_.one; }
  [[nodiscard]] double codes_of_unit() const { return 1.0 / (4.0 * datapath_.one); }

  StudyQuestion question_;
  std::string profile_;
  Datapath datapath_;
  std::vector<OutputForm> forms_;
};

}  // namespace

Result<std::unique_ptr<Study>> exhaustive_sum_study(StudyQuestion question, const HardwareProfile& profile,
                                                    std::span<const OutputForm> forms) {
  if (profile.arithmetic != Arithmetic::integer) {
    return Diagnostic{
        .message = fmt::format("the profile {} has no datapath to measure: it computes in real numbers", profile.name)};
  }
  if (forms.empty()) return Diagnostic{.message = "no output form given; expected at least one"};
  return std::unique_ptr<Study>(std::make_unique<ExhaustiveSum>(std::move(question), profile, forms));
}

}  // namespace ninebit
