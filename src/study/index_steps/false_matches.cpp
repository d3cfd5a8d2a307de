#include "src/study/index_steps/false_matches.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <string>

#include "ninebit/numerics/fixed9.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// Limits of the number of evaluations: more would take many minutes.
constexpr double kMostByVectors = 1e12, kMostByRealNumbers = 2e9;

}  // namespace

// The pairs that compare equal, and those among them whose values are equal.
struct FalseMatchCounter::Found {
  std::uint64_t pairs = 0;
  std::uint64_t equal = 0;
  Found& operator+=(const Found& other) {
    pairs += other.pairs;
    equal += other.equal;
    return *this;
  }
};

// Evaluates every combination of classes. Within a batch only the last digit varies.
class FalseMatchCounter::Batches {
 public:
  Batches(const FalseMatchCounter& of, const Classes& classes) : of_(of), classes_(classes) {}

  // Evaluates all classes of the last digit with combination number `outer` of the other digits' classes.
  [[nodiscard]] Found count(std::size_t outer, RegisterBatch& registers, OutputBatch& out) const {
    DigitBytes own{}, other{};
    std::uint64_t pairs = 1, equal = 1;
    for (std::size_t d = 0; d + 1 < classes_.size(); ++d) {
      const PairClass& chosen = classes_[d][outer % classes_[d].size()];
      outer /= classes_[d].size();
      own[d] = chosen.own;
      other[d] = chosen.other;
      pairs *= chosen.pairs;
      equal *= chosen.equal;
    }
    const std::vector<PairClass>& last = classes_.back();
    Found found;
    for (std::size_t first = 0; first < last.size(); first += kBatchSize) {
      const std::size_t n = std::min(kBatchSize, last.size() - first);
      fill(comparison_registers(*of_.profile_, of_.format_, own, other), registers);  // real numbers overwrite them
      put_last(first, n, registers);
      of_.batch_.run(registers, n, out);
      for (std::size_t i = 0; i < n; ++i) {
        if (to_byte(*of_.profile_, out.plane[kAlpha][i]) != 0) continue;
        found.pairs += last[first + i].pairs;
        found.equal += last[first + i].equal;
      }
    }
    return {found.pairs * pairs, found.equal * equal};
  }

 private:
  void fill(const RegisterFile& file, RegisterBatch& registers) const {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) {
        const auto reg = static_cast<Register>(r);
        if (!of_.batch_.reads().contains(reg, c)) continue;
        std::fill_n(registers(reg, c), kBatchSize, file[reg][static_cast<std::size_t>(c)]);
      }
    }
  }

  void put_last(std::size_t first, std::size_t n, RegisterBatch& registers) const {
    for (const int c : digits_of(of_.format_).back().components()) {
      for (std::size_t i = 0; i < n; ++i) {
        registers(Register::primary, c)[i] = from_byte(*of_.profile_, classes_.back()[first + i].own);
        registers(Register::texture0, c)[i] = from_byte(*of_.profile_, classes_.back()[first + i].other);
        if (c == kAlpha) registers(Register::spare0, c)[i] = registers(Register::texture0, c)[i];
      }
    }
  }

  const FalseMatchCounter& of_;
  const Classes& classes_;
};

Result<FalseMatchCounter> FalseMatchCounter::prepare(const Program& program, const HardwareProfile& profile,
                                                     StudyFormat format, const GoOn& go_on, Way way) {
  std::optional<DigitSum> sum;
  if (way == Way::fastest) {
    sum = digit_sum(program, digits_after_first_stage(program, digits_before_first_stage(format)));
  }
  auto classes = DigitClasses::of(program, profile, format, sum, go_on);
  if (!classes) return classes.error();
  return FalseMatchCounter(program, profile, format, sum, std::move(*classes));
}

Result<FalseMatches> FalseMatchCounter::count(std::span<const std::uint8_t> values, bool separate,
                                              const GoOn& go_on) const {
  FalseMatches result{.codes = 1};
  Classes classes(classes_.digits());
  for (std::size_t d = 0; d < classes.size(); ++d) {
    result.codes *= values.size();
    classes[d] = classes_.among(d, values);
  }
  result.pairs = result.codes * (result.codes - 1);
  Found found{1, 1};
  if (!separate) {
    const auto together = found_among(classes, go_on);
    if (!together) return together.error();
    found = *together;
  }
  for (std::size_t d = 0; separate && d < classes.size(); ++d) {
    Classes alone(classes.size(), {PairClass{}});
    alone[d] = classes[d];
    const auto digit = found_among(alone, go_on);
    if (!digit) return digit.error();
    found.pairs *= digit->pairs;
    found.equal *= digit->equal;
  }
  result.false_matches = found.pairs - found.equal;
  return result;
}

Result<FalseMatchCounter::Found> FalseMatchCounter::found_among(const Classes& classes, const GoOn& go_on) const {
  if (sum_) {
    if (go_on && !go_on()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    return found_in_order(classes);
  }
  std::size_t outer = 1;
  double cases = 1.0;
  for (std::size_t d = 0; d < classes.size(); ++d) {
    if (d + 1 < classes.size()) outer *= classes[d].size();
    cases *= static_cast<double>(classes[d].size());
  }
  if (cases > (profile_->arithmetic == Arithmetic::integer ? kMostByVectors : kMostByRealNumbers)) {
    return Diagnostic{.message = "profile " + std::string(profile_->name) + ", format " +
                                 std::string(name_of(format_)) +
                                 ": there are too many cases to count; expected two general combiners, the second of "
                                 "which sums one product per channel, or fewer channels"};
  }
  std::atomic<bool> stopped = false;
  const Batches batches(*this, classes);
  // Integer sums do not depend on the order in which threads add them.
  const Found found = parallel_reduce(
      outer, 64, Found{},
      [&](std::size_t begin, std::size_t end) {
        Found sum;
        const auto registers = std::make_unique<RegisterBatch>();
        const auto out = std::make_unique<OutputBatch>();
        for (std::size_t i = begin; i != end && !stopped; ++i) {
          if (i % 64 == 0 && go_on && !go_on()) stopped = true;
          sum += batches.count(i, *registers, *out);
        }
        return sum;
      },
      [](Found a, const Found& b) { return a += b; });
  if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  return found;
}

// The classes of each digit are ordered by their products, and alpha grows monotonically with each product. So if a
// combination of classes compares equal, every combination of classes at or before them does. For a fixed class of the
// first digit, each step to the next class of the second leaves fewer classes of the last that compare equal; only the
// border of these classes is evaluated.
FalseMatchCounter::Found FalseMatchCounter::found_in_order(const Classes& classes) const {
  std::array<std::vector<PairClass>, kMostDigits> digit;
  digit.fill({PairClass{}});
  for (std::size_t d = 0; d < classes.size(); ++d) {
    digit[d] = classes[d];
    if (sum_->falling) std::reverse(digit[d].begin(), digit[d].end());
  }
  const std::vector<PairClass>& last = digit[2];
  std::vector<Found> until(last.size() + 1);  // sums over the classes before each
  for (std::size_t i = 0; i < last.size(); ++i) {
    until[i + 1] = until[i];
    until[i + 1] += {last[i].pairs, last[i].equal};
  }
  Found found;
  std::size_t most = last.size();  // classes that compare equal with the first class of the second digit
  for (const PairClass& a : digit[0]) {
    std::size_t border = most;
    for (const PairClass& b : digit[1]) {
      while (border > 0 &&
             !comes_out_equal({a.own, b.own, last[border - 1].own}, {a.other, b.other, last[border - 1].other})) {
        --border;
      }
      if (&b == digit[1].data()) most = border;
      if (border == 0) break;
      found += {a.pairs * b.pairs * until[border].pairs, a.equal * b.equal * until[border].equal};
    }
    if (most == 0) break;
  }
  return found;
}

bool FalseMatchCounter::comes_out_equal(const DigitBytes& own, const DigitBytes& other) const {
  const RegisterFile registers = comparison_registers(*profile_, format_, own, other);
  return to_byte(*profile_, evaluate_fragment(program_, registers).color[kAlpha]) == 0;
}

std::vector<std::uint8_t> values_of_step(int step) {
  std::vector<std::uint8_t> values;
  for (int value = 0; value <= 255; value += step) values.push_back(static_cast<std::uint8_t>(value));
  return values;
}

}  // namespace ninebit
