#include "ninebit/study/datapath_error.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "src/study/datapath/datapath_report.h"
#include "src/study/datapath/operations.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

StudyRow errors_of(const HardwareProfile& profile, const DatapathOperation& operation) {
  const Datapath d = datapath_of(profile);
  std::uint64_t cases = 0, exact = 0;
  std::set<int> codes;
  int last = 0;
  double most = 0.0, sum = 0.0, sum_of_sizes = 0.0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < operation.cases; ++i) {
    const std::uint64_t weight = operation.weight(i);
    const int code = operation.code(d, i);
    if (i == 0 || code != last) codes.insert(code);
    last = code;
    const double error = static_cast<double>(code) / d.one - operation.exact(i);
    // An exact result may differ from operation.exact by the last bit of a double.
    const double size = std::fabs(error) < 1e-12 ? 0.0 : std::fabs(error);
    cases += weight;
    if (size == 0.0) exact += weight;
    sum_of_sizes += static_cast<double>(weight) * size;
    if (size != 0.0) sum += static_cast<double>(weight) * error;
    // Larger by more than rounding: so the first case of several equal ones wins.
    if (size > most + 1e-12) {
      most = size;
      worst = i;
    }
  }
  const double bias = sum / static_cast<double>(cases);
  return {.table = "rows",
          .fields = {{"profile", std::string(profile.name)},
                     {"operation", std::string(operation.name)},
                     {"form", operation.form},
                     {"cases", cases},
                     {"exact", exact},
                     {"distinct", static_cast<std::uint64_t>(codes.size())},
                     {"max_error", most},
                     {"mean_error", sum_of_sizes / static_cast<double>(cases)},
                     {"mean_bias", std::fabs(bias) < 1e-12 ? 0.0 : bias},
                     {"worst", operation.inputs(worst)},
                     {"worst_code", static_cast<std::int64_t>(operation.code(d, worst))},
                     {"worst_exact", operation.exact(worst)}}};
}

StudyRow differences_of(const HardwareProfile& first, const HardwareProfile& second,
                        const DatapathOperation& operation) {
  const Datapath a = datapath_of(first), b = datapath_of(second);
  std::uint64_t cases = 0, differ = 0;
  for (std::size_t i = 0; i < operation.cases; ++i) {
    const std::uint64_t weight = operation.weight(i);
    cases += weight;
    if (operation.code(a, i) != operation.code(b, i)) differ += weight;
  }
  return {.table = "differences",
          .fields = {{"first", std::string(first.name)},
                     {"second", std::string(second.name)},
                     {"operation", std::string(operation.name)},
                     {"form", operation.form},
                     {"cases", cases},
                     {"differ", differ}}};
}

// Limits for rows from files. Results and exact values are clamped to [-1, 1]; a dot product's bias may go a little
// beyond.
constexpr double kMostValue = 16.0, kMostCode = 65536.0, kMostCases = 0x1p63, kLongestInputs = 4096.0;

RowRule errors_rule(const HardwareProfile& profile, std::string_view operation, const std::string& form) {
  return {.fields = {exactly("profile", std::string(profile.name)), exactly("operation", std::string(operation)),
                     exactly("form", form), count_up_to("cases", kMostCases), count_up_to("exact", kMostCases),
                     count_up_to("distinct", kMostCode), real_in("max_error", 0.0, kMostValue),
                     real_in("mean_error", 0.0, kMostValue), real_in("mean_bias", -kMostValue, kMostValue),
                     text_up_to("worst", kLongestInputs), whole_in("worst_code", -kMostCode, kMostCode),
                     real_in("worst_exact", -kMostValue, kMostValue)}};
}

RowRule differences_rule(const HardwareProfile& first, const HardwareProfile& second, std::string_view operation,
                         const std::string& form) {
  return {.table = "differences",
          .fields = {exactly("first", std::string(first.name)), exactly("second", std::string(second.name)),
                     exactly("operation", std::string(operation)), exactly("form", form),
                     count_up_to("cases", kMostCases), count_up_to("differ", kMostCases)}};
}

class DatapathStudy final : public Study {
 public:
  DatapathStudy(StudyQuestion question, std::vector<HardwareProfile> profiles)
      : question_(std::move(question)), profiles_(std::move(profiles)) {
    // The name of a profile from a file may not live as long as the study.
    for (HardwareProfile& profile : profiles_) profile.name = names_.emplace_back(profile.name);
    for (const HardwareProfile& profile : profiles_) operations_.try_emplace(profile.one, profile.one);
    const auto add = [&](const HardwareProfile& first, const HardwareProfile* second) {
      for (std::size_t kind = 0; kind < kOperations.size(); ++kind) units_.push_back({&first, second, kind});
    };
    for (const HardwareProfile& profile : profiles_) add(profile, nullptr);
    for (std::size_t i = 0; i < profiles_.size(); ++i) {
      for (std::size_t k = i + 1; k < profiles_.size(); ++k) {
        if (profiles_[i].one.value == profiles_[k].one.value) add(profiles_[i], &profiles_[k]);
      }
    }
  }

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return units_.size(); }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    const Unit& u = units_[unit];
    if (u.second == nullptr) return fmt::format("{}, {}", u.first->name, kOperations[u.kind]);
    return fmt::format("{} against {}, {}", u.first->name, u.second->name, kOperations[u.kind]);
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const Unit& u = units_[unit];
    const std::vector<DatapathOperation>& forms = operations_.at(u.first->one).of(u.kind);
    // Each form writes its row to its own place, so the result does not depend on threads.
    std::vector<StudyRow> rows(forms.size());
    std::atomic<bool> stopped = false;
    parallel_for(forms.size(), [&](std::size_t i) {
      if (stopped) return;
      rows[i] = u.second == nullptr ? errors_of(*u.first, forms[i]) : differences_of(*u.first, *u.second, forms[i]);
      if (go_on && !go_on()) stopped = true;
    });
    if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    return rows;
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const Unit& u = units_[unit];
    std::vector<RowRule> rules;
    for (const std::string& form : forms_of(u.kind)) {
      rules.push_back(u.second == nullptr ? errors_rule(*u.first, kOperations[u.kind], form)
                                          : differences_rule(*u.first, *u.second, kOperations[u.kind], form));
    }
    return rules;
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    return datapath_report(profiles_, rows, done, units_.size());
  }

 private:
  struct Unit {
    const HardwareProfile* first;
    const HardwareProfile* second;  // nullptr: the unit measures the errors of `first`
    std::size_t kind;               // index into kOperations
  };

  StudyQuestion question_;
  std::deque<std::string> names_;
  std::vector<HardwareProfile> profiles_;
  mutable std::map<int, Operations> operations_;  // by `one`
  std::vector<Unit> units_;
};

}  // namespace

Result<std::unique_ptr<Study>> datapath_study(StudyQuestion question, std::span<const HardwareProfile> profiles) {
  std::vector<HardwareProfile> measured;
  for (const HardwareProfile& profile : profiles) {
    if (profile.arithmetic == Arithmetic::integer) measured.push_back(profile);
  }
  if (measured.empty()) {
    return Diagnostic{.message = fmt::format("the profile {} has no datapath to measure: it computes in real numbers",
                                             profiles.empty() ? "" : profiles.front().name)};
  }
  return std::unique_ptr<Study>(std::make_unique<DatapathStudy>(std::move(question), std::move(measured)));
}

}  // namespace ninebit
