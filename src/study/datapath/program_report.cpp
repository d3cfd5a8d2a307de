#include "src/study/datapath/program_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "src/study/datapath/datapath_report.h"
#include "src/study/part/staged_colors.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::size_t kMostListed = std::size_t{1} << 20;  // fragments in files
constexpr std::size_t kFragmentsAtATime = 256;
constexpr std::array kComponentNames{"red", "green", "blue", "alpha"};

// One kind of error over all units: a maximum with its row, and means weighted by fragments.
struct Summary {
  double most = 0.0;
  const StudyRow* worst = nullptr;
  double sizes = 0.0, errors = 0.0, fragments = 0.0;

  void add(const StudyRow& row, const std::string& max, const std::string& mean, const std::string& bias) {
    const double count = row.number("fragments");
    if (worst == nullptr || row.number(max) > most + 1e-10) {
      most = row.number(max);
      worst = &row;
    }
    sizes += row.number(mean) * count;
    errors += row.number(bias) * count;
    fragments += count;
  }
  [[nodiscard]] double mean() const { return sizes / fragments; }
  [[nodiscard]] double bias() const { return errors / fragments; }
};

class ProgramReportWriter {
 public:
  ProgramReportWriter(const Program& program, const Fragments& fragments, std::span<const StudyRow> rows)
      : program_(program), fragments_(fragments), rows_(rows), one_(program.datapath.one) {}

  StudyReport write() {
    out_.title = "Error of a program, by stage";
    ReportTable totals{.title = "Error of the colour",
                       .columns = {"component", "fragments", "exact, %", "misrounded, %", "max", "mean", "bias",
                                   "worst at", "gives", "exact"},
                       .rows = {},
                       .caption = fmt::format(
                           "Max, mean, bias and the exact value are in codes; code {} is 1.0. Misrounded: another code "
                           "is nearer to the exact value.",
                           one_)};
    ReportTable stages{.title = "Error that each stage adds, and error that remains if all later stages are exact",
                       .columns = {"component", "stage", "name", "added, max", "added, mean", "added, bias",
                                   "adds most at", "remaining, max", "remaining, mean", "remaining, bias"},
                       .rows = {},
                       .caption =
                           "In codes. For every fragment, the errors that the stages add sum to the colour's error; "
                           "so their biases sum to its bias."};
    Plot histogram{.file = "histogram",
                   .title = "Errors of the colour",
                   .x_label = "error, in codes, to the nearest whole number",
                   .y_label = "fragments, in %",
                   .bars = true,
                   .series = {},
                   .caption = "Bars at 8 and -8 have larger errors, too."};
    Plot added{.file = "added-by-stage",
               .title = "Error that each stage adds",
               .x_label = "stage",
               .y_label = "mean size, in codes",
               .bars = true,
               .series = {}};
    Plot remaining{.file = "remaining-by-stage",
                   .title = "Error that remains if all later stages are exact",
                   .x_label = "last stage computed as in the profile",
                   .y_label = "mean size, in codes",
                   .bars = true,
                   .series = {}};
    for (int k = 0; k < program_.num_general_combiners; ++k) added.x_names.push_back(fmt::format("general {}", k + 1));
    added.x_names.emplace_back("final");
    remaining.x_names = added.x_names;
    for (std::size_t c = 0; c < 4; ++c) {
      const bool wrong = add_total(c, totals);
      PlotSeries adds{kComponentNames[c], {}};
      PlotSeries remains = adds;
      std::string sentence;
      for (int k = 1; k <= program_.num_general_combiners + 1; ++k) {
        sentence += add_stage(c, k, stages, adds, remains);
      }
      if (wrong) out_.answers.push_back(fmt::format("{}: on average {}.", kComponentNames[c], sentence));
      added.series.push_back(std::move(adds));
      remaining.series.push_back(std::move(remains));
      if (wrong && fragments_.all() && fragments_.components().size() == 2) out_.heat_maps.push_back(map_of(c));
      add_histogram(c, histogram);
    }
    add_error_files();
    out_.tables.push_back(std::move(totals));
    out_.tables.push_back(std::move(stages));
    out_.plots.push_back(std::move(histogram));
    out_.plots.push_back(std::move(added));
    out_.plots.push_back(std::move(remaining));
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_of(const StudyRow& row, const char* table, std::size_t c) const {
    return row.table == table && row.text("component") == std::string(1, "rgba"[c]);
  }

  // Adds the component's row and answer. Returns true if the component has an error.
  bool add_total(std::size_t c, ReportTable& table) {
    Summary sum;
    std::uint64_t exact = 0, misrounded = 0, fragments = 0;
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "rows", c)) continue;
      sum.add(row, "max_error", "mean_error", "mean_bias");
      exact += row.count("exact");
      misrounded += row.count("misrounded");
      fragments += row.count("fragments");
    }
    if (sum.worst == nullptr) return false;
    const double worst_exact = sum.worst->number("worst_exact") * one_;
    table.rows.push_back({std::string(kComponentNames[c]), fragments, percent(exact, fragments),
                          percent(misrounded, fragments), sum.most * one_, sum.mean() * one_, sum.bias() * one_,
                          (*sum.worst)["worst"], (*sum.worst)["worst_code"], worst_exact});
    if (exact == fragments) {
      out_.answers.push_back(fmt::format("{}: exact for all {} fragments.", kComponentNames[c], fragments));
      return false;
    }
    out_.answers.push_back(
        fmt::format("{}: exact for {:.2f} % of {} fragments, not the nearest code for {:.2f} %; largest error {:.3f} "
                    "codes ({} give {}, exact {:.3f}), mean error "
                    "{:.3f}, bias {:.3f} codes.",
                    kComponentNames[c], percent(exact, fragments), fragments, percent(misrounded, fragments),
                    sum.most * one_, sum.worst->text("worst"), sum.worst->text("worst_code"), worst_exact,
                    sum.mean() * one_, plain(sum.bias() * one_)));
    return true;
  }

  // Adds the stage's row and points. Returns its part of a sentence.
  std::string add_stage(std::size_t c, int k, ReportTable& table, PlotSeries& adds, PlotSeries& remains) const {
    Summary added, remaining;
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "stages", c) || row.count("stage") != static_cast<std::uint64_t>(k)) continue;
      added.add(row, "added_max", "added_mean", "added_bias");
      remaining.add(row, "remaining_max", "remaining_mean", "remaining_bias");
    }
    if (added.worst == nullptr) return {};
    table.rows.push_back({std::string(kComponentNames[c]), static_cast<std::int64_t>(k), (*added.worst)["name"],
                          added.most * one_, added.mean() * one_, added.bias() * one_, (*added.worst)["worst"],
                          remaining.most * one_, remaining.mean() * one_, remaining.bias() * one_});
    adds.points.emplace_back(k, added.mean() * one_);
    remains.points.emplace_back(k, remaining.mean() * one_);
    return fmt::format("{}{} adds {:.3f} codes", k == 1 ? "" : ", ", added.worst->text("name"), added.mean() * one_);
  }

  void add_histogram(std::size_t c, Plot& plot) const {
    std::map<std::int64_t, std::uint64_t> counts;
    std::uint64_t all = 0;
    double reach = 1.0;  // of the errors of all components
    for (const StudyRow& row : rows_) {
      if (row.table == "histogram" && row.count("count") > 0) reach = std::max(reach, std::abs(row.number("codes")));
    }
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "histogram", c) || std::abs(row.number("codes")) > reach) continue;
      counts[static_cast<std::int64_t>(row.number("codes"))] += row.count("count");
      all += row.count("count");
    }
    PlotSeries series{kComponentNames[c], {}};
    std::vector<std::string> names;
    for (const auto& [codes, count] : counts) {
      names.push_back(std::to_string(codes));
      series.points.emplace_back(static_cast<double>(names.size()), percent(count, all));
    }
    plot.x_names = std::move(names);
    plot.series.push_back(std::move(series));
  }

  // The errors of all fragments, in codes: red, green, blue, alpha of each.
  [[nodiscard]] std::vector<float> errors_of_fragments() const {
    std::vector<float> errors(4 * fragments_.count());
    parallel_ranges(fragments_.count(), kFragmentsAtATime, [&](std::size_t begin, std::size_t end) {
      StagedColors staged(program_);
      for (std::size_t i = begin; i != end; ++i) {
        staged.change_constants([&](Program& program) { fragments_.put_constants(i, program); });
        const std::vector<RealColor>& colors = staged(fragments_.registers(i));
        for (std::size_t c = 0; c < 4; ++c) errors[4 * i + c] = in_codes(colors.back()[c] - colors[0][c]);
      }
    });
    return errors;
  }

  void add_error_files() {
    if (fragments_.count() > kMostListed) return;
    const std::vector<float> errors = errors_of_fragments();
    std::string csv, shape;
    const std::size_t columns = fragments_.components().size();
    for (std::size_t i = 0; i < columns; ++i) csv += fragments_.components()[i].name() + ',';
    csv += "error.r,error.g,error.b,error.a\n";
    for (std::size_t fragment = 0; fragment < fragments_.count(); ++fragment) {
      for (std::size_t i = 0; i < columns; ++i)
        fmt::format_to(std::back_inserter(csv), "{},", fragments_.code(fragment, i));
      const float* const e = &errors[4 * fragment];
      fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", e[0], e[1], e[2], e[3]);
    }
    for (std::size_t i = 0; fragments_.all() && i < columns; ++i) shape += fmt::format("{}, ", fragments_.values(i));
    if (!fragments_.all()) shape = fmt::format("{}, ", fragments_.count());
    out_.files.push_back({"error.csv", std::move(csv)});
    out_.files.push_back({"error.npy", npy_of(shape + "4", errors)});
  }

  // NumPy's format, version 1.0: floats of 32 bits, the lowest byte first.
  static std::string npy_of(const std::string& shape, const std::vector<float>& values) {
    constexpr std::size_t kBefore = 10, kMultiple = 64;
    std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", shape);
    header.append(kMultiple - 1 - (kBefore + header.size()) % kMultiple, ' ');
    header += '\n';
    std::string out("\x93NUMPY\x01\x00", 8);
    out += static_cast<char>(header.size() % 256);
    out += static_cast<char>(header.size() / 256);
    out += header;
    for (const float value : values) {
      const auto bits = std::bit_cast<std::uint32_t>(value);
      for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>(bits >> shift & 0xFFU);
    }
    return out;
  }

  // An error in codes; 0 where the numbers are not more certain.
  [[nodiscard]] float in_codes(double error) const {
    const double codes = error * one_;
    return std::fabs(codes) < 1e-7 ? 0.0F : static_cast<float>(codes);
  }

  // The first component runs to the right, the second upward.
  [[nodiscard]] HeatMap map_of(std::size_t c) const {
    const std::size_t width = fragments_.values(0), height = fragments_.values(1);
    HeatMap map{.file = fmt::format("error-{}", kComponentNames[c]),
                .title = fmt::format("Error of {}", kComponentNames[c]),
                .x_label = fragments_.components()[0].name() + ", as code",
                .y_label = fragments_.components()[1].name() + ", as code",
                .x_first = static_cast<double>(fragments_.lowest(0)),
                .x_last = static_cast<double>(one_),
                .y_first = static_cast<double>(one_),
                .y_last = static_cast<double>(fragments_.lowest(1)),
                .width = static_cast<int>(width),
                .height = static_cast<int>(height),
                .values = std::vector<float>(width * height),
                .caption = "In codes: 1 is a register's last bit. One pixel per fragment."};
    parallel_ranges(height, 1, [&](std::size_t begin, std::size_t end) {
      StagedColors staged(program_);
      for (std::size_t row = begin; row != end; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
          const std::size_t fragment = column * height + (height - 1 - row);
          staged.change_constants([&](Program& program) { fragments_.put_constants(fragment, program); });
          const std::vector<RealColor>& colors = staged(fragments_.registers(fragment));
          map.values[row * width + column] = in_codes(colors.back()[c] - colors[0][c]);
        }
      }
    });
    float span = 0.0F;
    for (const float v : map.values) span = std::max(span, std::fabs(v));
    map.low = -span;
    map.high = span;
    return map;
  }

  const Program& program_;
  const Fragments& fragments_;
  std::span<const StudyRow> rows_;
  int one_;
  StudyReport out_;
};

}  // namespace

StudyReport program_report(const Program& program, const Fragments& fragments, std::span<const StudyRow> rows,
                           std::size_t done, std::size_t units) {
  StudyReport report = ProgramReportWriter(program, fragments, rows).write();
  if (done < units) {
    report.answers.insert(report.answers.begin(), fmt::format("Only {} of {} units were measured.", done, units));
  }
  return report;
}

}  // namespace ninebit
