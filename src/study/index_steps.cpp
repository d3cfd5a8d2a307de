#include "ninebit/study/index_steps.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/shadow/index_cube.h"
#include "src/study/digits.h"

namespace ninebit {
namespace {

constexpr std::array kVariants{IndexVariant{"both-x4", Scale::by_four, Scale::by_four, false},
                               IndexVariant{"first-x4", Scale::by_four, Scale::none, false},
                               IndexVariant{"second-x4", Scale::none, Scale::by_four, false},
                               IndexVariant{"no-scale", Scale::none, Scale::none, false},
                               IndexVariant{"both-x4-separate", Scale::by_four, Scale::by_four, true},
                               IndexVariant{"first-x4-separate", Scale::by_four, Scale::none, true},
                               IndexVariant{"second-x4-separate", Scale::none, Scale::by_four, true},
                               IndexVariant{"no-scale-separate", Scale::none, Scale::none, true}};

using Classes = std::vector<std::vector<DigitClass>>;

// Pairs that come out equal, and those of them that are.
struct Found {
  std::uint64_t pairs = 0;
  std::uint64_t equal = 0;
  Found& operator+=(const Found& other) {
    pairs += other.pairs;
    equal += other.equal;
    return *this;
  }
};

// Evaluates combinations of classes: the last digit runs through a batch, the others stay.
class Comparison {
 public:
  Comparison(const Program& program, const HardwareProfile& profile, StudyFormat format, const Classes& classes)
      : profile_(profile),
        format_(format),
        classes_(classes),
        run_(program, {.color = {false, false, false, true}, .registers = false}) {}

  // All classes of the last digit with number `outer` of the combinations of the others.
  [[nodiscard]] Found count(std::size_t outer, RegisterBatch& registers, OutputBatch& out) const {
    std::array<std::uint8_t, 3> own{}, other{};
    std::uint64_t pairs = 1, equal = 1;
    for (std::size_t d = 0; d + 1 < classes_.size(); ++d) {
      const DigitClass& chosen = classes_[d][outer % classes_[d].size()];
      outer /= classes_[d].size();
      own[d] = chosen.own;
      other[d] = chosen.other;
      pairs *= chosen.pairs;
      equal *= chosen.equal;
    }
    fill(own, other, registers);
    const std::vector<DigitClass>& last = classes_.back();
    Found found;
    for (std::size_t first = 0; first < last.size(); first += kBatchSize) {
      const std::size_t n = std::min(kBatchSize, last.size() - first);
      put_last(first, n, registers);
      run_.run(registers, n, out);
      for (std::size_t i = 0; i < n; ++i) {
        if (to_byte(profile_, out.plane[kAlpha][i]) != 0) continue;
        found.pairs += last[first + i].pairs;
        found.equal += last[first + i].equal;
      }
    }
    return {found.pairs * pairs, found.equal * equal};
  }

 private:
  void fill(std::span<const std::uint8_t> own, std::span<const std::uint8_t> other, RegisterBatch& registers) const {
    const RegisterFile file = comparison_registers(profile_, format_, own, other);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) {
        const auto reg = static_cast<Register>(r);
        if (!run_.reads().contains(reg, c)) continue;
        std::fill_n(registers(reg, c), kBatchSize, file[reg][static_cast<std::size_t>(c)]);
      }
    }
  }

  void put_last(std::size_t first, std::size_t n, RegisterBatch& registers) const {
    const Digit digit = digits_of(format_).back();
    for (const int c : digit.components) {
      for (std::size_t i = 0; i < n; ++i) {
        registers(Register::primary, c)[i] = from_byte(profile_, classes_.back()[first + i].own);
        registers(Register::texture0, c)[i] = from_byte(profile_, classes_.back()[first + i].other);
        if (c == kAlpha) registers(Register::spare0, c)[i] = registers(Register::texture0, c)[i];
      }
    }
  }

  const HardwareProfile& profile_;
  StudyFormat format_;
  const Classes& classes_;
  BatchProgram run_;
};

Result<Found> count_together(const Comparison& comparison, const Classes& classes, const GoOn& go_on) {
  std::size_t outer = 1;
  for (std::size_t d = 0; d + 1 < classes.size(); ++d) outer *= classes[d].size();
  std::atomic<bool> stopped = false;
  // Sums of integers: the order in which threads add them changes nothing.
  const Found found = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, outer, 64), Found{},
      [&](const tbb::blocked_range<std::size_t>& range, Found sum) {
        const auto registers = std::make_unique<RegisterBatch>();
        const auto out = std::make_unique<OutputBatch>();
        for (std::size_t i = range.begin(); i != range.end() && !stopped; ++i) {
          if (i % 1024 == 0 && go_on && !go_on()) stopped = true;
          sum += comparison.count(i, *registers, *out);
        }
        return sum;
      },
      [](Found a, const Found& b) { return a += b; });
  if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  return found;
}

// Each digit compared while the others are 0 in both indices.
Found count_separately(const Program& program, const HardwareProfile& profile, StudyFormat format,
                       const Classes& classes) {
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const std::vector<DigitClass> zero{DigitClass{0, 0, 1, 1}};
  Found product{1, 1};
  for (std::size_t d = 0; d < classes.size(); ++d) {
    Found digit;
    for (const DigitClass& one : classes[d]) {
      Classes alone(classes.size(), zero);
      alone[d] = {one};
      digit += Comparison(program, profile, format, alone).count(0, *registers, *out);
    }
    product.pairs *= digit.pairs;
    product.equal *= digit.equal;
  }
  return product;
}

}  // namespace

std::string_view name_of(StudyFormat format) {
  constexpr std::array<std::string_view, 5> names{"channel", "rgb", "la", "l", "a"};
  return names[static_cast<std::size_t>(format)];
}

std::span<const IndexVariant> index_variants() {
  return kVariants;
}

Result<CombinerState> index_variant_state(const HardwareProfile& profile, StudyFormat format,
                                          const IndexVariant& variant) {
  const IndexFormat held = format == StudyFormat::luminance_alpha ? IndexFormat::luminance_alpha
                           : format == StudyFormat::luminance     ? IndexFormat::luminance
                           : format == StudyFormat::alpha         ? IndexFormat::alpha
                                                                  : IndexFormat::rgb;
  auto state = index_comparison_state(profile, held);
  if (!state) return state;
  const auto rescale = [](GeneralCombiner& stage, Scale scale) {
    for (Portion* portion : {&stage.rgb, &stage.alpha}) {
      if (is_live(portion->out)) portion->out.scale = scale;
    }
  };
  rescale(state->general[0], variant.first);
  rescale(state->general[1], variant.second);
  return state;
}

Result<FalseMatches> count_false_matches(const Program& program, const HardwareProfile& profile, StudyFormat format,
                                         int step, bool separate, const GoOn& go_on) {
  if (step < 1 || step > 255) {
    return Diagnostic{.message = "step " + std::to_string(step) + " is out of range; expected 1 to 255"};
  }
  const auto classes = digit_classes(program, profile, format, step);
  if (!classes) return classes.error();
  FalseMatches result{.codes = 1};
  for (std::size_t d = 0; d < classes->size(); ++d) result.codes *= static_cast<std::uint64_t>(255 / step + 1);
  result.pairs = result.codes * (result.codes - 1);
  Found found;
  if (separate) {
    found = count_separately(program, profile, format, *classes);
  } else {
    const auto together = count_together(Comparison(program, profile, format, *classes), *classes, go_on);
    if (!together) return together.error();
    found = *together;
  }
  result.false_matches = found.pairs - found.equal;
  return result;
}

std::optional<int> smallest_safe_step(std::span<const IndexStepRow> rows, std::string_view profile, StudyFormat format,
                                      std::string_view variant) {
  std::vector<std::pair<int, bool>> steps;  // step, and whether it loses nothing
  for (const IndexStepRow& row : rows) {
    if (row.profile == profile && row.format == format && row.variant == variant) {
      steps.emplace_back(row.step, row.count.false_matches == 0);
    }
  }
  std::sort(steps.begin(), steps.end());
  std::optional<int> safe;
  for (auto step = steps.rbegin(); step != steps.rend() && step->second; ++step) safe = step->first;
  return safe;
}

}  // namespace ninebit
