#include "ninebit/study/datapath_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
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
                     {"max_error_codes", most * d.one},
                     {"mean_error_codes", sum_of_sizes / static_cast<double>(cases) * d.one},
                     {"mean_bias_codes", std::fabs(bias) < 1e-12 ? 0.0 : bias * d.one},
                     {"worst", operation.inputs(worst)},
                     {"worst_code", static_cast<std::int64_t>(operation.code(d, worst))},
                     {"worst_exact_codes", operation.exact(worst) * d.one}}};
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
constexpr double kMostCode = 65536.0, kMostErrorInCodes = 16.0 * kMostCode, kMostCases = 0x1p63,
                 kLongestInputs = 4096.0;

RowRule errors_rule(const HardwareProfile& profile, std::string_view operation, const std::string& form) {
  return {.fields = {exactly("profile", std::string(profile.name)), exactly("operation", std::string(operation)),
                     exactly("form", form), count_up_to("cases", kMostCases), count_up_to("exact", kMostCases),
                     count_up_to("distinct", kMostCode), real_in("max_error_codes", 0.0, kMostErrorInCodes),
                     real_in("mean_error_codes", 0.0, kMostErrorInCodes),
                     real_in("mean_bias_codes", -kMostErrorInCodes, kMostErrorInCodes),
                     text_up_to("worst", kLongestInputs), whole_in("worst_code", -kMostCode, kMostCode),
                     real_in("worst_exact_codes", -kMostErrorInCodes, kMostErrorInCodes)}};
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

// Heat maps of the datapath's operations with two inputs.

namespace {

// A map over the codes `first` to one: x to the right, y upward. Its colours range from -span to span, where span is
// the largest absolute value.
HeatMap map_of(int first, int one, const std::function<double(int x, int y)>& value) {
  HeatMap map;
  map.width = map.height = one - first + 1;
  map.x_first = map.y_last = first;
  map.x_last = map.y_first = one;
  const auto size = static_cast<std::size_t>(map.width);
  map.values.resize(size * size);
  parallel_for(size, [&](std::size_t row) {
    for (int column = 0; column < map.width; ++column) {
      map.values[row * size + static_cast<std::size_t>(column)] =
          static_cast<float>(value(first + column, one - static_cast<int>(row)));
    }
  });
  float span = 0.0F;
  for (const float v : map.values) span = std::max(span, std::fabs(v));
  map.low = -span;
  map.high = span;
  return map;
}

// A form as part of a file name: "x4", "x1by2", "biased-x2".
std::string file_part(const OutputForm& form) {
  const char* scale = form.scale == Scale::none      ? "x1"
                      : form.scale == Scale::by_two  ? "x2"
                      : form.scale == Scale::by_four ? "x4"
                                                     : "x1by2";
  return std::string(form.bias == Bias::none ? "" : "biased-") + scale;
}

int output_code(const Datapath& d, const OutputForm& form, int wide) {
  return reference::combiner_output(d, form.scale, form.bias, wide);
}

// The error in codes: 1 is a register's last bit. Rounding of doubles counts as 0.
double error_in_codes(int code, double exact, int one) {
  const double error = code - exact * one;
  return std::fabs(error) < 1e-9 ? 0.0 : error;
}

// An operation of two codes x and y, given by its wide value: A · B or, with B = D = 1, A + C.
struct TwoInputs {
  const char* name;
  const char* file;
  const char* x_label;
  const char* y_label;
  int (*wide)(int one, int x, int y);
};
constexpr std::array kTwoInputs{
    TwoInputs{"A · B", "product", "A, as code", "B, as code", [](int, int x, int y) { return x * y; }},
    TwoInputs{"A + C", "sum", "A, as code", "C, as code", [](int one, int x, int y) { return (x + y) * one; }}};

class Maps {
 public:
  void add_errors(const HardwareProfile& profile) {
    const Datapath d = datapath_of(profile);
    const double square = static_cast<double>(d.one) * d.one;
    for (const TwoInputs& operation : kTwoInputs) {
      for (const OutputForm& form : kOutputForms) {
        HeatMap map = map_of(-d.one, d.one, [&](int x, int y) {
          const int wide = operation.wide(d.one, x, y);
          return error_in_codes(output_code(d, form, wide), exact_output(form, wide / square), d.one);
        });
        add(std::move(map), fmt::format("{}-{}-{}", operation.file, file_part(form), profile.name),
            fmt::format("Error of {}, {}, on {}", operation.name, form.name, profile.name), operation);
      }
    }
    HeatMap map = map_of(
        0, d.one, [&](int x, int y) { return error_in_codes(reference::e_times_f(d, x, y), x * y / square, d.one); });
    add(std::move(map), fmt::format("e-times-f-{}", profile.name), fmt::format("Error of E · F on {}", profile.name),
        {"", "", "E, as code", "F, as code", nullptr});
  }

  void add_differences(const HardwareProfile& first, const HardwareProfile& second) {
    const Datapath a = datapath_of(first), b = datapath_of(second);
    // Products without a scale, and with the scale of the article's program.
    for (const OutputForm& form : {kOutputForms[0], kOutputForms[2]}) {
      HeatMap map = map_of(-a.one, a.one,
                           [&](int x, int y) { return output_code(b, form, x * y) - output_code(a, form, x * y); });
      add(std::move(map), fmt::format("product-{}-{}-minus-{}", file_part(form), second.name, first.name),
          fmt::format("A · B, {}: {} minus {}", form.name, second.name, first.name), kTwoInputs[0]);
    }
  }

  [[nodiscard]] std::vector<HeatMap> take() { return std::move(maps_); }

 private:
  void add(HeatMap map, std::string file, std::string title, const TwoInputs& operation) {
    if (map.high == 0.0F) return;
    map.file = std::move(file);
    map.title = std::move(title);
    map.x_label = operation.x_label;
    map.y_label = operation.y_label;
    map.caption = "In codes: 1 is a register's last bit. One pixel per case.";
    maps_.push_back(std::move(map));
  }

  std::vector<HeatMap> maps_;
};

}  // namespace

std::vector<HeatMap> datapath_maps(std::span<const HardwareProfile> profiles) {
  Maps maps;
  const auto known =
      std::find_if(profiles.begin(), profiles.end(), [](const auto& p) { return p.name == profiles::geforce2.name; });
  maps.add_errors(known != profiles.end() ? *known : profiles.front());
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    for (std::size_t k = i + 1; k < profiles.size(); ++k) {
      if (profiles[i].one.value == profiles[k].one.value) maps.add_differences(profiles[i], profiles[k]);
    }
  }
  return maps.take();
}

}  // namespace ninebit
