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

#include "ninebit/combiner/evaluate.h"
#include "src/combiner/real_batch.h"
#include "src/study/datapath/datapath_report.h"
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

// The errors of one fragment after another, in codes. Not thread-safe.
class FragmentErrors {
 public:
  FragmentErrors(const Program& program, const Fragments& fragments) : program_(program), fragments_(fragments) {}
  // Not copyable: exact_ refers to program_.
  FragmentErrors(const FragmentErrors&) = delete;
  FragmentErrors& operator=(const FragmentErrors&) = delete;

  // Of the whole colour; 0 where the numbers are not more certain.
  std::array<float, 4> operator()(std::size_t fragment) {
    if (constants_) fragments_.put_constants(fragment, program_);
    const RegisterFile registers = fragments_.registers(fragment);
    const RealColor ideal = exact_(registers);
    const Rgba9 codes = evaluate(program_, registers);
    std::array<float, 4> errors{};
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = static_cast<double>(codes[c]) - ideal[c] * program_.datapath.one;
      errors[c] = std::fabs(error) < 1e-7 ? 0.0F : static_cast<float>(error);
    }
    return errors;
  }

 private:
  Program program_;
  const Fragments& fragments_;
  bool constants_ = fragments_.have_constants();
  ExactColors exact_{program_};
};

bool is_of(const StudyRow& row, const char* table, std::size_t c) {
  return row.table == table && row.text("component") == std::string(1, "rgba"[c]);
}

class ProgramReportWriter {
 public:
  ProgramReportWriter(const Program& program, std::span<const RegisterComponent> asked,
                      std::span<const MeasuredColor> colors, std::span<const StudyRow> rows)
      : program_(program), asked_(asked), colors_(colors), rows_(rows), one_(program.datapath.one) {}

  StudyReport write() {
    out_.title = "Error of a program, by stage";
    ReportTable totals{
        .title = "Error of the colour",
        .columns = {"component", "fragments", "exact, %", "misrounded, %", "max, codes", "mean, codes", "bias, codes",
                    "worst at, codes", "gives, code", "exact, codes"},
        .rows = {},
        .caption = fmt::format("Code {} is 1.0. Misrounded: another code is nearer to the exact value.", one_)};
    ReportTable stages{.title = "Error that each stage adds, and error that remains if all later stages are exact",
                       .columns = {"component", "stage", "name", "added: max, codes", "mean, codes", "bias, codes",
                                   "adds most at, codes", "remaining: max, codes", "mean, codes", "bias, codes"},
                       .rows = {},
                       .caption =
                           "For every fragment, the errors that the stages add sum to the colour's error; so "
                           "their biases sum to its bias."};
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
    const std::map<std::int64_t, std::size_t> bars = bars_of_errors();
    for (const auto& [codes, position] : bars) histogram.x_names.push_back(std::to_string(codes));
    for (std::size_t c = 0; c < 4; ++c) {
      const bool wrong = add_total(c, totals);
      PlotSeries adds{kComponentNames[c], {}};
      PlotSeries remains = adds;
      std::string sentence;
      for (int k = 1; k <= program_.num_general_combiners + 1; ++k) {
        sentence += add_stage(c, k, stages, adds, remains);
      }
      if (wrong) out_.answers.push_back(fmt::format("{}: on average {}.", name_in_answers(c), sentence));
      added.series.push_back(std::move(adds));
      remaining.series.push_back(std::move(remains));
      add_histogram(c, bars, histogram);
    }
    if (separated()) {
      if (const std::string unused = left_out(); !unused.empty()) {
        out_.answers.push_back(fmt::format("No component of the colour depends on {}.", unused));
      }
      for (ReportTable* table : {&totals, &stages}) table->columns.insert(table->columns.begin() + 1, "over");
      for (Plot* plot : {&histogram, &added, &remaining}) {
        plot->caption += (plot->caption.empty() ? "" : " ") + counted_over();
      }
    }
    out_.tables.push_back(std::move(totals));
    out_.tables.push_back(std::move(stages));
    out_.plots.push_back(std::move(histogram));
    out_.plots.push_back(std::move(added));
    out_.plots.push_back(std::move(remaining));
    return std::move(out_);
  }

 private:
  // Whether a component of the colour is measured over fewer inputs than were asked for.
  [[nodiscard]] bool separated() const {
    return std::any_of(colors_.begin(), colors_.end(),
                       [&](const MeasuredColor& one) { return one.fragments.components().size() < asked_.size(); });
  }

  // The inputs over which a component of the colour is measured.
  [[nodiscard]] const Fragments& fragments_of(std::size_t c) const {
    const auto its = [&](const MeasuredColor& one) { return one.components[c]; };
    return std::find_if(colors_.begin(), colors_.end(), its)->fragments;
  }

  // "red over primary.r, tex0.r" if components have inputs of their own, else "red".
  [[nodiscard]] std::string name_with_inputs(std::size_t c) const {
    return separated() ? fmt::format("{} over {}", kComponentNames[c], fragments_of(c).names()) : kComponentNames[c];
  }
  // The same, but "red" if no input varies.
  [[nodiscard]] std::string name_in_answers(std::size_t c) const {
    return fragments_of(c).components().empty() ? kComponentNames[c] : name_with_inputs(c);
  }

  // The inputs that were asked for and that no component of the colour is measured over: "tex1.r, tex1.g".
  [[nodiscard]] std::string left_out() const {
    std::string out;
    for (const RegisterComponent& one : asked_) {
      const auto varies_it = [&](const MeasuredColor& color) {
        const std::vector<RegisterComponent>& components = color.fragments.components();
        return std::find(components.begin(), components.end(), one) != components.end();
      };
      if (std::none_of(colors_.begin(), colors_.end(), varies_it)) out += (out.empty() ? "" : ", ") + one.name();
    }
    return out;
  }

  // "Each component is measured over the inputs that it depends on: red over primary.r, tex0.r; …; alpha over none."
  [[nodiscard]] std::string counted_over() const {
    std::string out = "Each component is measured over the inputs that it depends on: ";
    for (std::size_t c = 0; c < 4; ++c) out += (c == 0 ? "" : "; ") + name_with_inputs(c);
    return out + '.';
  }

  // Adds a row about a component of the colour, with its inputs if components have their own.
  void add_row(std::size_t c, ReportTable& table, std::vector<StudyValue> values) const {
    if (separated()) values.insert(values.begin(), fragments_of(c).names());
    values.insert(values.begin(), std::string(kComponentNames[c]));
    table.rows.push_back(std::move(values));
  }

  // Adds the component's row and answer. Returns true if the component has an error.
  bool add_total(std::size_t c, ReportTable& table) {
    Summary sum;
    std::uint64_t exact = 0, misrounded = 0, fragments = 0;
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "rows", c)) continue;
      sum.add(row, "max_error_codes", "mean_error_codes", "mean_bias_codes");
      exact += row.count("exact");
      misrounded += row.count("misrounded");
      fragments += row.count("fragments");
    }
    if (sum.worst == nullptr) return false;
    add_row(c, table,
            {fragments, percent(exact, fragments), percent(misrounded, fragments), sum.most, sum.mean(), sum.bias(),
             (*sum.worst)["worst"], (*sum.worst)["worst_code"], (*sum.worst)["worst_exact_codes"]});
    const std::string name = name_in_answers(c);
    const bool varies = !fragments_of(c).components().empty();
    if (exact == fragments) {
      out_.answers.push_back(varies ? fmt::format("{}: exact for all {} fragments.", name, fragments)
                                    : fmt::format("{} depends on no input that varies: exact.", name));
      return false;
    }
    if (!varies) {
      out_.answers.push_back(
          fmt::format("{} depends on no input that varies: it is {}, exact {:.3f}, error {:.3f} codes.", name,
                      sum.worst->text("worst_code"), sum.worst->number("worst_exact_codes"), plain(sum.bias())));
      return true;
    }
    out_.answers.push_back(fmt::format(
        "{}: exact for {:.2f} % of {} fragments, not the nearest code for {:.2f} %; largest error {:.3f} "
        "codes ({} give {}, exact {:.3f}), mean error "
        "{:.3f}, bias {:.3f} codes.",
        name, percent(exact, fragments), fragments, percent(misrounded, fragments), sum.most, sum.worst->text("worst"),
        sum.worst->text("worst_code"), sum.worst->number("worst_exact_codes"), sum.mean(), plain(sum.bias())));
    return true;
  }

  // Adds the stage's row and points. Returns its part of a sentence.
  std::string add_stage(std::size_t c, int k, ReportTable& table, PlotSeries& adds, PlotSeries& remains) const {
    Summary added, remaining;
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "stages", c) || row.count("stage") != static_cast<std::uint64_t>(k)) continue;
      added.add(row, "added_max_codes", "added_mean_codes", "added_bias_codes");
      remaining.add(row, "remaining_max_codes", "remaining_mean_codes", "remaining_bias_codes");
    }
    if (added.worst == nullptr) return {};
    add_row(c, table,
            {static_cast<std::int64_t>(k), (*added.worst)["name"], added.most, added.mean(), added.bias(),
             (*added.worst)["worst"], remaining.most, remaining.mean(), remaining.bias()});
    adds.points.emplace_back(k, added.mean());
    remains.points.emplace_back(k, remaining.mean());
    return fmt::format("{}{} adds {:.3f} codes", k == 1 ? "" : ", ", added.worst->text("name"), added.mean());
  }

  // The bars of the histogram: the positions, from 1, of the whole numbers of codes up to the largest error of all
  // components.
  [[nodiscard]] std::map<std::int64_t, std::size_t> bars_of_errors() const {
    double reach = 1.0;
    for (const StudyRow& row : rows_) {
      if (row.table == "histogram" && row.count("count") > 0)
        reach = std::max(reach, std::abs(row.number("error_codes")));
    }
    std::map<std::int64_t, std::size_t> bars;
    for (const StudyRow& row : rows_) {
      if (row.table != "histogram" || std::abs(row.number("error_codes")) > reach) continue;
      bars[static_cast<std::int64_t>(row.number("error_codes"))] = 0;
    }
    std::size_t position = 0;
    for (auto& bar : bars) bar.second = ++position;
    return bars;
  }

  void add_histogram(std::size_t c, const std::map<std::int64_t, std::size_t>& bars, Plot& plot) const {
    std::map<std::int64_t, std::uint64_t> counts;
    std::uint64_t all = 0;
    for (const StudyRow& row : rows_) {
      if (!is_of(row, "histogram", c)) continue;
      const auto codes = static_cast<std::int64_t>(row.number("error_codes"));
      if (!bars.contains(codes)) continue;
      counts[codes] += row.count("count");
      all += row.count("count");
    }
    PlotSeries series{kComponentNames[c], {}};
    for (const auto& [codes, count] : counts) {
      series.points.emplace_back(static_cast<double>(bars.at(codes)), percent(count, all));
    }
    plot.series.push_back(std::move(series));
  }

  const Program& program_;
  std::span<const RegisterComponent> asked_;
  std::span<const MeasuredColor> colors_;
  std::span<const StudyRow> rows_;
  int one_;
  StudyReport out_;
};

// The heat maps and files of a report on all fragments.
class ProgramDrawings {
 public:
  ProgramDrawings(const Program& program, std::span<const MeasuredColor> colors, std::span<const StudyRow> rows,
                  const DrawProgress& progress, StudyReport& out)
      : program_(program), colors_(colors), rows_(rows), progress_(progress), out_(out), one_(program.datapath.one) {}

  Status draw() {
    for (const MeasuredColor& color : colors_) {
      if (!shown(color).empty()) work_ += color.fragments.count();
      if (is_listed(color.fragments)) work_ += color.fragments.count();
    }
    for (const MeasuredColor& color : colors_) {
      if (Status added = add_heat_maps(color); !added) return added;
      if (Status added = add_error_files(color); !added) return added;
    }
    return {};
  }

 private:
  // Between two calls of the progress; enough for several threads.
  static constexpr std::size_t kFragmentsOfAStep = std::size_t{1} << 14;

  // After `fragments` more.
  Status step(std::size_t fragments) {
    done_ += fragments;
    if (!progress_ || progress_(static_cast<double>(done_) / static_cast<double>(work_))) return {};
    return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }

  // The components of the colour that have errors and a map.
  [[nodiscard]] std::vector<std::size_t> shown(const MeasuredColor& color) const {
    if (!color.fragments.all() || color.fragments.components().size() < 2) return {};
    std::vector<std::size_t> out;
    for (const std::size_t c : color.measured()) {
      const auto is_wrong = [&](const StudyRow& row) {
        return is_of(row, "rows", c) && row.count("exact") != row.count("fragments");
      };
      if (std::any_of(rows_.begin(), rows_.end(), is_wrong)) out.push_back(c);
    }
    return out;
  }

  static bool is_listed(const Fragments& fragments) {
    return !fragments.components().empty() && fragments.count() <= kMostListed;
  }

  // Maps of the components that have errors. The first input runs to the right, the second upward. Of several fragments
  // in a pixel, which differ in further inputs, the first with the largest error is shown.
  Status add_heat_maps(const MeasuredColor& color) {
    const Fragments& fragments = color.fragments;
    const std::vector<std::size_t> components = shown(color);
    if (components.empty()) return {};
    std::vector<HeatMap> maps;
    for (const std::size_t c : components) maps.push_back(empty_map(c, fragments));
    const std::size_t width = fragments.values(0), height = fragments.values(1);
    const std::size_t in_pixel = fragments.count() / (width * height);
    const std::size_t at_a_time = std::max<std::size_t>(1, kFragmentsOfAStep / (width * in_pixel));  // rows
    const std::size_t grain = std::max<std::size_t>(1, kFragmentsAtATime / in_pixel);                // pixels
    for (std::size_t top = 0; top < height; top += at_a_time) {
      const std::size_t rows = std::min(at_a_time, height - top);
      parallel_ranges(rows * width, grain, [&](std::size_t begin, std::size_t end) {
        FragmentErrors errors_of(program_, fragments);
        for (std::size_t pixel = top * width + begin; pixel != top * width + end; ++pixel) {
          const std::size_t row = pixel / width, column = pixel % width;
          const std::size_t first = (column * height + (height - 1 - row)) * in_pixel;
          for (std::size_t i = first; i != first + in_pixel; ++i) {
            const std::array<float, 4> errors = errors_of(i);
            for (std::size_t k = 0; k < components.size(); ++k) {
              float& value = maps[k].values[pixel];
              if (std::fabs(errors[components[k]]) > std::fabs(value)) value = errors[components[k]];
            }
          }
        }
      });
      if (Status status = step(rows * width * in_pixel); !status) return status;
    }
    for (HeatMap& map : maps) {
      float span = 0.0F;
      for (const float v : map.values) span = std::max(span, std::fabs(v));
      map.low = -span;
      map.high = span;
      out_.heat_maps.push_back(std::move(map));
    }
    return {};
  }

  // A file for each form, with the errors of the components that these fragments measure.
  Status add_error_files(const MeasuredColor& color) {
    const Fragments& fragments = color.fragments;
    if (!is_listed(fragments)) return {};
    const std::vector<std::size_t> measured = color.measured();
    std::vector<float> errors(measured.size() * fragments.count());
    for (std::size_t first = 0; first < fragments.count(); first += kFragmentsOfAStep) {
      const std::size_t count = std::min(kFragmentsOfAStep, fragments.count() - first);
      parallel_ranges(count, kFragmentsAtATime, [&](std::size_t begin, std::size_t end) {
        FragmentErrors errors_of(program_, fragments);
        for (std::size_t i = first + begin; i != first + end; ++i) {
          const std::array<float, 4> all = errors_of(i);
          for (std::size_t k = 0; k < measured.size(); ++k) errors[measured.size() * i + k] = all[measured[k]];
        }
      });
      if (Status status = step(count); !status) return status;
    }
    std::string csv, shape, letters;
    const std::size_t columns = fragments.components().size();
    for (std::size_t i = 0; i < columns; ++i) csv += fragments.components()[i].name() + ',';
    for (std::size_t k = 0; k < measured.size(); ++k) {
      const char letter = "rgba"[measured[k]];
      csv += fmt::format("{}error.{}", k == 0 ? "" : ",", letter);
      letters += letter;
    }
    csv += '\n';
    for (std::size_t fragment = 0; fragment < fragments.count(); ++fragment) {
      for (std::size_t i = 0; i < columns; ++i)
        fmt::format_to(std::back_inserter(csv), "{},", fragments.code(fragment, i));
      const float* const e = &errors[measured.size() * fragment];
      fmt::format_to(std::back_inserter(csv), "{}\n", fmt::join(e, e + measured.size(), ","));
    }
    for (std::size_t i = 0; fragments.all() && i < columns; ++i) shape += fmt::format("{}, ", fragments.values(i));
    if (!fragments.all()) shape = fmt::format("{}, ", fragments.count());
    // "error.csv"; "error-rg.csv" if other components have other inputs.
    const std::string name = measured.size() < 4 ? "error-" + letters : "error";
    out_.files.push_back({name + ".csv", std::move(csv)});
    out_.files.push_back({name + ".npy", npy_of(fmt::format("{}{}", shape, measured.size()), errors)});
    return {};
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

  [[nodiscard]] HeatMap empty_map(std::size_t c, const Fragments& fragments) const {
    const std::vector<RegisterComponent>& inputs = fragments.components();
    std::string others;
    for (std::size_t i = 2; i < inputs.size(); ++i) {
      others += (i == 2 ? "" : i + 1 == inputs.size() ? " and " : ", ") + inputs[i].name();
    }
    return {.file = fmt::format("error-{}", kComponentNames[c]),
            .title = others.empty()
                         ? fmt::format("Error of {}", kComponentNames[c])
                         : fmt::format("Largest error of {} over all values of {}", kComponentNames[c], others),
            .x_label = inputs[0].name() + ", as code",
            .y_label = inputs[1].name() + ", as code",
            .x_first = static_cast<double>(fragments.lowest(0)),
            .x_last = static_cast<double>(one_),
            .y_first = static_cast<double>(one_),
            .y_last = static_cast<double>(fragments.lowest(1)),
            .width = static_cast<int>(fragments.values(0)),
            .height = static_cast<int>(fragments.values(1)),
            .values = std::vector<float>(fragments.values(0) * fragments.values(1)),
            .caption = "In codes: 1 is a register's last bit. " +
                       (others.empty()
                            ? std::string("One pixel per fragment.")
                            : fmt::format("One pixel for all values of {}: the error of the largest size.", others))};
  }

  const Program& program_;
  std::span<const MeasuredColor> colors_;
  std::span<const StudyRow> rows_;
  const DrawProgress& progress_;
  StudyReport& out_;
  int one_;
  std::size_t work_ = 0, done_ = 0;  // in fragments
};

}  // namespace

StudyReport program_report(const Program& program, std::span<const RegisterComponent> asked,
                           std::span<const MeasuredColor> colors, std::span<const StudyRow> rows, std::size_t done,
                           std::size_t units) {
  StudyReport report = ProgramReportWriter(program, asked, colors, rows).write();
  if (done < units) {
    report.answers.insert(report.answers.begin(), fmt::format("Only {} of {} units were measured.", done, units));
  }
  return report;
}

Status draw_program(const Program& program, std::span<const MeasuredColor> colors, std::span<const StudyRow> rows,
                    const DrawProgress& progress, StudyReport& report) {
  return ProgramDrawings(program, colors, rows, progress, report).draw();
}

}  // namespace ninebit
