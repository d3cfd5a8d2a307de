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
  ProgramErrorStudy(StudyQuestion question, const HardwareProfile& profile, const Program& program, Fragments fragments)
      : question_(std::move(question)), profile_(profile.name), program_(program), fragments_(std::move(fragments)) {}

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return (fragments_.count() + kUnit - 1) / kUnit; }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    return fmt::format("{}, fragments from {}", profile_, unit * kUnit);
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const std::size_t first = unit * kUnit, end = std::min(first + kUnit, fragments_.count());
    std::vector<Errors> chunks((end - first + kFragmentsPerChunk - 1) / kFragmentsPerChunk, no_errors(first));
    std::atomic<bool> stopped = false;
    parallel_for(chunks.size(), [&](std::size_t i) {
      if (stopped) return;
      const std::size_t from = first + i * kFragmentsPerChunk;
      measure(from, std::min(from + kFragmentsPerChunk, end), chunks[i]);
      if (go_on && !go_on()) stopped = true;
    });
    if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    Errors all = no_errors(first);
    for (const Errors& chunk : chunks) add(chunk, all);
    return rows_of(all, first, end - first);
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const std::size_t first = unit * kUnit, count = std::min(kUnit, fragments_.count() - first);
    std::vector<RowRule> rules;
    const auto begin = [&](const char* table, std::size_t c) -> std::vector<FieldRule>& {
      const RowRule rule{
          .table = table,
          .fields = {exactly("profile", profile_), exactly("component", std::string(1, "rgba"[c])),
                     exactly("first", std::uint64_t{first}), exactly("fragments", std::uint64_t{count})}};
      return rules.emplace_back(rule).fields;
    };
    const auto add_errors = [](std::vector<FieldRule>& fields, std::array<const char*, 3> names) {
      fields.push_back(real_in(names[0], 0.0, kMostValue));
      fields.push_back(real_in(names[1], 0.0, kMostValue));
      fields.push_back(real_in(names[2], -kMostValue, kMostValue));
    };
    for (std::size_t c = 0; c < 4; ++c) {
      auto& fields = begin("rows", c);
      fields.push_back(count_up_to("exact", static_cast<double>(count)));
      fields.push_back(count_up_to("misrounded", static_cast<double>(count)));
      add_errors(fields, {"max_error", "mean_error", "mean_bias"});
      fields.push_back(text_up_to("worst", kLongestInputs));
      fields.push_back(whole_in("worst_code", -kMostCode, kMostCode));
      fields.push_back(real_in("worst_exact", -kMostValue, kMostValue));
    }
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 1; k <= stages(); ++k) {
        auto& fields = begin("stages", c);
        fields.push_back(exactly("stage", std::uint64_t{k}));
        fields.push_back(exactly("name", name_of_stage(k)));
        add_errors(fields, {"added_max", "added_mean", "added_bias"});
        fields.push_back(text_up_to("worst", kLongestInputs));
        add_errors(fields, {"remaining_max", "remaining_mean", "remaining_bias"});
      }
    }
    for (std::size_t c = 0; c < 4; ++c) {
      for (int codes = -kMostCodes; codes <= kMostCodes; ++codes) {
        auto& fields = begin("histogram", c);
        fields.push_back(exactly("codes", std::int64_t{codes}));
        fields.push_back(count_up_to("count", static_cast<double>(count)));
      }
    }
    return rules;
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    return program_report(program_, fragments_, rows, done, units());
  }

 private:
  // Limits for rows from files. Registers hold -1 to 1; the sums before the last clamp go a little beyond.
  static constexpr double kMostValue = 64.0, kMostCode = 65536.0, kLongestInputs = 65536.0;

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

  void measure(std::size_t from, std::size_t end, Errors& errors) const {
    StagedColors staged(program_);
    const bool constants = fragments_.have_constants();
    for (std::size_t i = from; i < end; ++i) {
      if (constants) staged.change_constants([&](Program& program) { fragments_.put_constants(i, program); });
      const std::vector<RealColor>& colors = staged(fragments_.registers(i));
      for (std::size_t c = 0; c < 4; ++c) {
        errors[c].total.add(colors.back()[c] - colors[0][c], i);
        errors[c].count((colors.back()[c] - colors[0][c]) * program_.datapath.one);
        for (std::size_t k = 0; k < stages(); ++k) {
          errors[c].added[k].add(colors[k + 1][c] - colors[k][c], i);
          errors[c].remaining[k].add(colors[k + 1][c] - colors[0][c], i);
        }
      }
    }
  }

  [[nodiscard]] std::vector<StudyRow> rows_of(const Errors& errors, std::size_t first, std::size_t count) const {
    std::vector<StudyRow> rows;
    const auto mean = [&](double sum) { return sum / static_cast<double>(count); };
    const auto begin = [&](const char* table, std::size_t c) -> StudyRow& {
      return rows.emplace_back(StudyRow{.table = table,
                                        .fields = {{"profile", profile_},
                                                   {"component", std::string(1, "rgba"[c])},
                                                   {"first", static_cast<std::uint64_t>(first)},
                                                   {"fragments", static_cast<std::uint64_t>(count)}}});
    };
    for (std::size_t c = 0; c < 4; ++c) {
      const ErrorSums& total = errors[c].total;
      StagedColors staged(program_);
      staged.change_constants([&](Program& program) { fragments_.put_constants(total.worst, program); });
      const std::vector<RealColor>& colors = staged(fragments_.registers(total.worst));
      auto& fields = begin("rows", c).fields;
      fields.emplace_back("exact", total.exact);
      fields.emplace_back("misrounded", errors[c].misrounded);
      fields.emplace_back("max_error", total.most);
      fields.emplace_back("mean_error", mean(total.sizes));
      fields.emplace_back("mean_bias", mean(total.errors));
      fields.emplace_back("worst", fragments_.text(total.worst));
      fields.emplace_back("worst_code",
                          static_cast<std::int64_t>(std::lround(colors.back()[c] * program_.datapath.one)));
      fields.emplace_back("worst_exact", colors[0][c]);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < stages(); ++k) {
        const ErrorSums &added = errors[c].added[k], &remaining = errors[c].remaining[k];
        auto& fields = begin("stages", c).fields;
        fields.emplace_back("stage", static_cast<std::uint64_t>(k + 1));
        fields.emplace_back("name", name_of_stage(k + 1));
        fields.emplace_back("added_max", added.most);
        fields.emplace_back("added_mean", mean(added.sizes));
        fields.emplace_back("added_bias", mean(added.errors));
        fields.emplace_back("worst", fragments_.text(added.worst));
        fields.emplace_back("remaining_max", remaining.most);
        fields.emplace_back("remaining_mean", mean(remaining.sizes));
        fields.emplace_back("remaining_bias", mean(remaining.errors));
      }
    }
    for (std::size_t c = 0; c < 4; ++c) {
      for (int codes = -kMostCodes; codes <= kMostCodes; ++codes) {
        auto& fields = begin("histogram", c).fields;
        fields.emplace_back("codes", std::int64_t{codes});
        fields.emplace_back("count", errors[c].histogram[static_cast<std::size_t>(codes + kMostCodes)]);
      }
    }
    return rows;
  }

  StudyQuestion question_;
  std::string profile_;
  Program program_;
  Fragments fragments_;
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
  auto fragments = Fragments::of(profile, std::move(inputs));
  if (!fragments) return fragments.error();
  Program with_fixed = program;
  fragments->put_fixed_constants(with_fixed);
  return std::unique_ptr<Study>(
      std::make_unique<ProgramErrorStudy>(std::move(question), profile, with_fixed, std::move(*fragments)));
}

}  // namespace ninebit
