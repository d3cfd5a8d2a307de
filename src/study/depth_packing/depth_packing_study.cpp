#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ninebit/study/depth_packing_error.h"
#include "src/study/depth_packing/depth_packing_report.h"

namespace ninebit {
namespace {

StudyRow error_row(const DepthPacking& packing, ChannelStorage storage, DepthSet set, const RoundTripError& e) {
  return {.fields = {{"packing", std::string(packing.name)},
                     {"source", std::string(packing.source)},
                     {"storage", std::string(name_of(storage))},
                     {"depths", std::string(name_of(set))},
                     {"count", e.depths},
                     {"exact", e.exact},
                     {"distinct", e.distinct},
                     {"inversions", e.inversions},
                     {"max_error", e.max_error},
                     {"mean_error", e.mean_error},
                     {"mean_bias", e.mean_bias},
                     {"worst_depth", double{e.worst_depth}},
                     {"worst_reads_as", double{e.worst_back}},
                     {"zero_reads_as", double{e.zero_back}},
                     {"one_reads_as", double{e.one_back}}}};
}

std::vector<StudyRow> second_digit_rows(const DepthPacking& packing, ChannelStorage storage) {
  std::vector<StudyRow> rows;
  for (std::int64_t digit = 0; digit < 256; ++digit) {
    const TwoDigits stored = store_two_digits(packing, storage, kChartDigit, static_cast<int>(digit));
    rows.push_back({.table = std::string(kSecondDigitTable),
                    .fields = {{"packing", std::string(packing.name)},
                               {"storage", std::string(name_of(storage))},
                               {"digit", digit},
                               {"highest_byte", std::int64_t{stored.highest_byte}},
                               {"second_byte", std::int64_t{stored.second_byte}},
                               {"shift", stored.shift}}});
  }
  return rows;
}

// Depths go from 0 to 1. A packing with a wrong order of digits reads back a few times that at most.
constexpr double kMostDepth = 16.0;

RowRule error_rule(const DepthPacking& packing, ChannelStorage storage, DepthSet set, std::uint64_t depths) {
  const auto most = static_cast<double>(depths);
  return {.fields = {exactly("packing", std::string(packing.name)), exactly("source", std::string(packing.source)),
                     exactly("storage", std::string(name_of(storage))), exactly("depths", std::string(name_of(set))),
                     exactly("count", depths), count_up_to("exact", most), count_up_to("distinct", most),
                     count_up_to("inversions", most), real_in("max_error", 0.0, kMostDepth),
                     real_in("mean_error", 0.0, kMostDepth), real_in("mean_bias", -kMostDepth, kMostDepth),
                     real_in("worst_depth", 0.0, 1.0), real_in("worst_reads_as", -kMostDepth, kMostDepth),
                     real_in("zero_reads_as", -kMostDepth, kMostDepth),
                     real_in("one_reads_as", -kMostDepth, kMostDepth)}};
}

std::vector<RowRule> second_digit_rules(const DepthPacking& packing, ChannelStorage storage) {
  constexpr double kMostShift = 65536.0 * kMostDepth;
  std::vector<RowRule> rules;
  for (std::int64_t digit = 0; digit < 256; ++digit) {
    rules.push_back(
        {.table = std::string(kSecondDigitTable),
         .fields = {exactly("packing", std::string(packing.name)), exactly("storage", std::string(name_of(storage))),
                    exactly("digit", digit), whole_in("highest_byte", 0, 255), whole_in("second_byte", 0, 255),
                    real_in("shift", -kMostShift, kMostShift)}});
  }
  return rules;
}

template <class Value>
std::string names_of(const std::vector<Value>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const Value value : values) names.emplace_back(name_of(value));
  return fmt::format("{}", fmt::join(names, ","));
}

class DepthPackingStudy final : public Study {
 public:
  explicit DepthPackingStudy(DepthPackingOptions options) : options_(std::move(options)) {
    question_.study = "depth-packing";
    question_.profile = "all";  // packings are float shaders: no profile changes a row
    question_.options = {{"--packings", fmt::format("{}", fmt::join(options_.packings, ","))},
                         {"--storages", names_of(options_.storages)},
                         {"--depths", names_of(options_.sets)},
                         {"--float-step", std::to_string(options_.float_step)}};
  }

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override {
    return options_.packings.size() * options_.storages.size() * parts();
  }

  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    const Unit u = at(unit);
    const std::string what = u.part == options_.sets.size() ? fmt::format("highest digit {}", kChartDigit)
                             : options_.sets[u.part] == DepthSet::floats
                                 ? "floats"
                                 : fmt::format("{} bits", name_of(options_.sets[u.part]));
    return fmt::format("{}, {}, {}", u.packing->name, name_of(u.storage), what);
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const Unit u = at(unit);
    if (u.part == options_.sets.size()) return second_digit_rows(*u.packing, u.storage);
    const DepthSet set = options_.sets[u.part];
    const auto error = measure_round_trip(*u.packing, u.storage, set, options_.float_step, go_on);
    if (!error) return error.error();
    return std::vector{error_row(*u.packing, u.storage, set, *error)};
  }

  // A unit of digits takes as long as a few depths.
  [[nodiscard]] double weight(std::size_t unit) const override {
    const Unit u = at(unit);
    if (u.part == options_.sets.size()) return 1024.0;
    return static_cast<double>(depth_count(options_.sets[u.part], options_.float_step));
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const Unit u = at(unit);
    if (u.part == options_.sets.size()) return second_digit_rules(*u.packing, u.storage);
    const DepthSet set = options_.sets[u.part];
    return {error_rule(*u.packing, u.storage, set, depth_count(set, options_.float_step))};
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t) const override {
    return depth_packing_report(options_, rows);
  }

 private:
  struct Unit {
    const DepthPacking* packing;
    ChannelStorage storage;
    std::size_t part;  // index of a set; the number of sets stands for the digits
  };

  [[nodiscard]] std::size_t parts() const { return options_.sets.size() + 1; }
  [[nodiscard]] Unit at(std::size_t unit) const {
    const std::size_t pair = unit / parts();
    return {.packing = find_depth_packing(options_.packings[pair / options_.storages.size()]),
            .storage = options_.storages[pair % options_.storages.size()],
            .part = unit % parts()};
  }

  DepthPackingOptions options_;
  StudyQuestion question_;
};

}  // namespace

DepthPackingOptions all_depth_packings() {
  DepthPackingOptions all;
  for (const DepthPacking& packing : depth_packings()) all.packings.emplace_back(packing.name);
  all.storages = {ChannelStorage::round, ChannelStorage::truncate};
  all.sets = {kDepthSets.begin(), kDepthSets.end()};
  return all;
}

Result<std::unique_ptr<Study>> make_depth_packing_study(const DepthPackingOptions& options) {
  for (const std::string& name : options.packings) {
    if (find_depth_packing(name) != nullptr) continue;
    return Diagnostic{.message = fmt::format("'{}' is not a depth packing; expected one of {}", name,
                                             fmt::join(all_depth_packings().packings, ", "))};
  }
  if (options.packings.empty() || options.storages.empty() || options.sets.empty()) {
    return Diagnostic{.message = "nothing to study: expected at least one packing, storage and set of depths"};
  }
  if (options.float_step == 0) return Diagnostic{.message = "the step between floats is 0; expected 1 or more"};
  return std::unique_ptr<Study>(std::make_unique<DepthPackingStudy>(options));
}

}  // namespace ninebit
