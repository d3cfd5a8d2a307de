#include "ninebit/study/program_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/combiner/given_registers.h"
#include "src/study/datapath/program_inputs.h"
#include "src/study/datapath/program_report.h"
#include "src/study/part/staged_colors.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::size_t kUnit = std::size_t{1} << 18;
constexpr int kMostCodes = 8;  // of the histogram, to either side
// Sums are built from sums over chunks of kFragmentsPerChunk fragments, so that no bit depends on threads.
constexpr std::size_t kFragmentsPerChunk = std::size_t{1} << 12;

struct ErrorSums {
  std::uint64_t exact = 0;
  double most = 0.0;
  std::size_t worst = 0;  // the first fragment with the largest error
  double sizes = 0.0, errors = 0.0;

  void add(double error, std::size_t fragment) {
    const double size = std::fabs(error);
    if (size < 1e-10) {
      ++exact;
      return;
    }
    take_worse(size, fragment);
    sizes += size;
    errors += error;
  }
  void add(const ErrorSums& other) {
    exact += other.exact;
    take_worse(other.most, other.worst);
    sizes += other.sizes;
    errors += other.errors;
  }

 private:
  // Larger by more than the uncertainty of the numbers.
  void take_worse(double size, std::size_t fragment) {
    if (size <= most + 1e-10) return;
    most = size;
    worst = fragment;
  }
};

// The errors of one component of the colour.
struct ComponentErrors {
  ErrorSums total;
  std::vector<ErrorSums> added, remaining;  // by stage
  std::uint64_t misrounded = 0;
  std::array<std::uint64_t, 2 * kMostCodes + 1> histogram{};  // from -kMostCodes codes on

  void count(double codes) {
    if (std::fabs(codes) > 0.5 + 1e-7) ++misrounded;
    const auto whole = std::clamp<long>(std::lround(codes), -kMostCodes, kMostCodes);
    ++histogram[static_cast<std::size_t>(whole + kMostCodes)];
  }
};
using Errors = std::array<ComponentErrors, 4>;

class ProgramErrorStudy final : public Study {
 public:
  ProgramErrorStudy(StudyQuestion question, const HardwareProfile& profile, const Program& program,
                    std::vector<RegisterComponent> asked, std::vector<MeasuredColor> colors)
      : question_(std::move(question)),
        profile_(profile.name),
        program_(program),
        asked_(std::move(asked)),
        colors_(std::move(colors)) {}

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override {
    std::size_t all = 0;
    for (const MeasuredColor& one : colors_) all += units_of(one);
    return all;
  }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    const Unit at = place_of(unit);
    const std::string over = at.color->fragments.components().size() == asked_.size()
                                 ? ""
                                 : fmt::format(" over {},", at.color->fragments.names());
    return fmt::format("{},{} fragments from {}", profile_, over, at.first);
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const Unit at = place_of(unit);
    const std::size_t first = at.first, end = first + at.count;
    std::vector<Errors> chunks((at.count + kFragmentsPerChunk - 1) / kFragmentsPerChunk, no_errors(first));
    std::atomic<bool> stopped = false;
    parallel_for(chunks.size(), [&](std::size_t i) {
      if (stopped) return;
      const std::size_t from = first + i * kFragmentsPerChunk;
      measure(*at.color, from, std::min(from + kFragmentsPerChunk, end), chunks[i]);
      if (go_on && !go_on()) stopped = true;
    });
    if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    Errors all = no_errors(first);
    for (const Errors& chunk : chunks) add(chunk, all);
    return rows_of(all, at);
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const Unit at = place_of(unit);
    const std::size_t count = at.count;
    std::vector<RowRule> rules;
    const auto begin = [&](const char* table, std::size_t c) -> std::vector<FieldRule>& {
      const RowRule rule{
          .table = table,
          .fields = {exactly("profile", profile_), exactly("component", std::string(1, "rgba"[c])),
                     exactly("over", at.color->fragments.names()), exactly("first", std::uint64_t{at.first}),
                     exactly("fragments", std::uint64_t{count})}};
      return rules.emplace_back(rule).fields;
    };
    const auto add_errors = [](std::vector<FieldRule>& fields, std::array<const char*, 3> names) {
      fields.push_back(real_in(names[0], 0.0, kMostError));
      fields.push_back(real_in(names[1], 0.0, kMostError));
      fields.push_back(real_in(names[2], -kMostError, kMostError));
    };
    for (const std::size_t c : at.color->measured()) {
      auto& fields = begin("rows", c);
      fields.push_back(count_up_to("exact", static_cast<double>(count)));
      fields.push_back(count_up_to("misrounded", static_cast<double>(count)));
      add_errors(fields, {"max_error_codes", "mean_error_codes", "mean_bias_codes"});
      fields.push_back(text_up_to("worst", kLongestInputs));
      fields.push_back(whole_in("worst_code", -kMostCode, kMostCode));
      fields.push_back(real_in("worst_exact_codes", -kMostError, kMostError));
    }
    for (const std::size_t c : at.color->measured()) {
      for (std::size_t k = 1; k <= stages(); ++k) {
        auto& fields = begin("stages", c);
        fields.push_back(exactly("stage", std::uint64_t{k}));
        fields.push_back(exactly("name", name_of_stage(k)));
        add_errors(fields, {"added_max_codes", "added_mean_codes", "added_bias_codes"});
        fields.push_back(text_up_to("worst", kLongestInputs));
        add_errors(fields, {"remaining_max_codes", "remaining_mean_codes", "remaining_bias_codes"});
      }
    }
    for (const std::size_t c : at.color->measured()) {
      for (int codes = -kMostCodes; codes <= kMostCodes; ++codes) {
        auto& fields = begin("histogram", c);
        fields.push_back(exactly("error_codes", std::int64_t{codes}));
        fields.push_back(count_up_to("count", static_cast<double>(count)));
      }
    }
    return rules;
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    return program_report(program_, asked_, colors_, rows, done, units());
  }

  [[nodiscard]] Status draw(std::span<const StudyRow> rows, const DrawProgress& progress,
                            StudyReport& report) const override {
    return draw_program(program_, colors_, rows, progress, report);
  }

 private:
  // Limits for rows from files, in codes. Registers hold -1 to 1; the sums before the last clamp go a little beyond.
  static constexpr double kMostCode = 65536.0, kMostError = 64.0 * kMostCode, kLongestInputs = 65536.0;

  // The fragments of a unit: those of `color` from `first` on.
  struct Unit {
    const MeasuredColor* color;
    std::size_t first, count;
  };
  static std::size_t units_of(const MeasuredColor& one) { return (one.fragments.count() + kUnit - 1) / kUnit; }
  [[nodiscard]] Unit place_of(std::size_t unit) const {
    auto one = colors_.begin();
    for (; unit >= units_of(*one); ++one) unit -= units_of(*one);
    const std::size_t first = unit * kUnit;
    return {&*one, first, std::min(kUnit, one->fragments.count() - first)};
  }

  [[nodiscard]] std::size_t stages() const { return static_cast<std::size_t>(program_.num_general_combiners) + 1; }

  // The name of stage k, counted from 1.
  [[nodiscard]] std::string name_of_stage(std::size_t k) const {
    return k == stages() ? "final" : fmt::format("general {}", k);
  }

  [[nodiscard]] Errors no_errors(std::size_t first) const {
    Errors out;
    for (ComponentErrors& errors : out) {
      errors.total.worst = first;
      errors.added.assign(stages(), errors.total);
      errors.remaining.assign(stages(), errors.total);
    }
    return out;
  }

  static void add(const Errors& chunk, Errors& all) {
    for (std::size_t c = 0; c < 4; ++c) {
      all[c].total.add(chunk[c].total);
      all[c].misrounded += chunk[c].misrounded;
      for (std::size_t h = 0; h < all[c].histogram.size(); ++h) all[c].histogram[h] += chunk[c].histogram[h];
      for (std::size_t k = 0; k < all[c].added.size(); ++k) {
        all[c].added[k].add(chunk[c].added[k]);
        all[c].remaining[k].add(chunk[c].remaining[k]);
      }
    }
  }

  void measure(const MeasuredColor& color, std::size_t from, std::size_t end, Errors& errors) const {
    const Fragments& fragments = color.fragments;
    const std::vector<std::size_t> measured = color.measured();
    StagedColors staged(program_);
    const bool constants = fragments.have_constants();
    for (std::size_t i = from; i < end; ++i) {
      if (constants) staged.change_constants([&](Program& program) { fragments.put_constants(i, program); });
      const std::vector<RealColor>& colors = staged(fragments.registers(i));
      for (const std::size_t c : measured) {
        errors[c].total.add(colors.back()[c] - colors[0][c], i);
        errors[c].count((colors.back()[c] - colors[0][c]) * program_.datapath.one);
        for (std::size_t k = 0; k < stages(); ++k) {
          errors[c].added[k].add(colors[k + 1][c] - colors[k][c], i);
          errors[c].remaining[k].add(colors[k + 1][c] - colors[0][c], i);
        }
      }
    }
  }

  // The rows of a unit. Errors are in codes.
  [[nodiscard]] std::vector<StudyRow> rows_of(const Errors& errors, const Unit& unit) const {
    std::vector<StudyRow> rows;
    const Fragments& fragments = unit.color->fragments;
    const double one = program_.datapath.one;
    const auto add_errors = [&](auto& fields, std::array<const char*, 3> names, const ErrorSums& sums) {
      const auto count = static_cast<double>(unit.count);
      fields.emplace_back(names[0], sums.most * one);
      fields.emplace_back(names[1], sums.sizes / count * one);
      fields.emplace_back(names[2], sums.errors / count * one);
    };
    const auto begin = [&](const char* table, std::size_t c) -> StudyRow& {
      return rows.emplace_back(StudyRow{.table = table,
                                        .fields = {{"profile", profile_},
                                                   {"component", std::string(1, "rgba"[c])},
                                                   {"over", fragments.names()},
                                                   {"first", static_cast<std::uint64_t>(unit.first)},
                                                   {"fragments", static_cast<std::uint64_t>(unit.count)}}});
    };
    for (const std::size_t c : unit.color->measured()) {
      const ErrorSums& total = errors[c].total;
      StagedColors staged(program_);
      staged.change_constants([&](Program& program) { fragments.put_constants(total.worst, program); });
      const std::vector<RealColor>& colors = staged(fragments.registers(total.worst));
      auto& fields = begin("rows", c).fields;
      fields.emplace_back("exact", total.exact);
      fields.emplace_back("misrounded", errors[c].misrounded);
      add_errors(fields, {"max_error_codes", "mean_error_codes", "mean_bias_codes"}, total);
      fields.emplace_back("worst", fragments.text(total.worst));
      fields.emplace_back("worst_code", static_cast<std::int64_t>(std::lround(colors.back()[c] * one)));
      fields.emplace_back("worst_exact_codes", colors[0][c] * one);
    }
    for (const std::size_t c : unit.color->measured()) {
      for (std::size_t k = 0; k < stages(); ++k) {
        const ErrorSums &added = errors[c].added[k], &remaining = errors[c].remaining[k];
        auto& fields = begin("stages", c).fields;
        fields.emplace_back("stage", static_cast<std::uint64_t>(k + 1));
        fields.emplace_back("name", name_of_stage(k + 1));
        add_errors(fields, {"added_max_codes", "added_mean_codes", "added_bias_codes"}, added);
        fields.emplace_back("worst", fragments.text(added.worst));
        add_errors(fields, {"remaining_max_codes", "remaining_mean_codes", "remaining_bias_codes"}, remaining);
      }
    }
    for (const std::size_t c : unit.color->measured()) {
      for (int codes = -kMostCodes; codes <= kMostCodes; ++codes) {
        auto& fields = begin("histogram", c).fields;
        fields.emplace_back("error_codes", std::int64_t{codes});
        fields.emplace_back("count", errors[c].histogram[static_cast<std::size_t>(codes + kMostCodes)]);
      }
    }
    return rows;
  }

  StudyQuestion question_;
  std::string profile_;
  Program program_;
  std::vector<RegisterComponent> asked_;  // the inputs that vary
  std::vector<MeasuredColor> colors_;
};

// Adds the components of constants that are not set to those of which all combinations are run. A table must have them.
std::optional<Diagnostic> complete(const Program& program, ProgramInputs& inputs) {
  std::string missing;
  for (const UnsetComponent& one : unset_components(program)) {
    const RegisterComponent named{one.reg, one.component};
    if (std::find(inputs.components.begin(), inputs.components.end(), named) != inputs.components.end()) continue;
    const auto is_it = [&](const auto& fixed) { return fixed.first == named; };
    if (std::any_of(inputs.fixed.begin(), inputs.fixed.end(), is_it)) continue;
    if (!varying_constants(program)) {
      return Diagnostic{.message = fmt::format("{} is not set, and another constant of the same number is read, too; "
                                               "set all constants of the general combiners in the program",
                                               name_of_constant(one.name))};
    }
    if (!inputs.codes) {
      inputs.components.push_back(named);
    } else {
      missing += (missing.empty() ? "" : ", ") + named.name();
    }
  }
  if (missing.empty()) return std::nullopt;
  return Diagnostic{.message = fmt::format("the program reads constants that it does not set; expected {} among the "
                                           "columns of the table of inputs",
                                           missing)};
}

}  // namespace

Result<std::unique_ptr<Study>> program_error_study(StudyQuestion question, const HardwareProfile& profile,
                                                   const Program& program, ProgramInputs inputs) {
  if (profile.arithmetic != Arithmetic::integer) {
    return Diagnostic{.message = fmt::format("the profile {} has no stage errors to measure: it computes in real "
                                             "numbers",
                                             profile.name)};
  }
  if (auto fault = complete(program, inputs)) return *fault;
  auto colors = measured_colors(profile, program, inputs);
  if (!colors) return colors.error();
  Program with_fixed = program;
  colors->front().fragments.put_fixed_constants(with_fixed);
  return std::unique_ptr<Study>(std::make_unique<ProgramErrorStudy>(std::move(question), profile, with_fixed,
                                                                    std::move(inputs.components), *std::move(colors)));
}

}  // namespace ninebit
