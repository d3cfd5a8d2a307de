#include "src/study/digits/digit_classes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <span>
#include <string>

#include "src/combiner/exact_field.h"
#include "src/combiner/real_rules.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::size_t kBytes = 256;
constexpr std::size_t kPairs = kBytes * kBytes;

// The error message for a component that depends on several digits; empty if there is none.
std::string mixed_component(const Program& program, const ByComponent<unsigned>& after) {
  const ByComponent<bool> read = read_from_stage(program, 1);
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (!read[r][c] || std::popcount(after[r][c]) < 2) continue;
      return std::string(name_of(static_cast<Register>(r))) + "." + "rgba"[c] +
             " depends on more than one channel of the index after the first general combiner: there are too many "
             "cases to count; expected a first stage that keeps the channels apart, or a format with one "
             "channel";
    }
  }
  return {};
}

// Numbers the pairs in the order of their keys; pairs with equal keys share a number. Returns one pair for each number.
std::vector<PairClass> number_pairs(const std::vector<double>& keys, std::size_t width,
                                    std::vector<std::uint32_t>& of_pair) {
  using Key = std::span<const double>;
  struct Less {
    bool operator()(Key x, Key y) const { return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end()); }
  };
  struct Found {
    std::size_t pair;  // the first with this key
    std::uint32_t number = 0;
  };
  std::map<Key, Found, Less> found;
  std::vector<const Found*> by_pair;
  by_pair.reserve(kPairs);
  for (std::size_t pair = 0; pair < kPairs; ++pair) {
    const Key key = Key(keys).subspan(pair * width, width);
    by_pair.push_back(&found.try_emplace(key, Found{.pair = pair}).first->second);
  }
  std::vector<PairClass> classes;
  for (auto& [key, one] : found) {
    one.number = static_cast<std::uint32_t>(classes.size());
    classes.push_back({static_cast<std::uint8_t>(one.pair / kBytes), static_cast<std::uint8_t>(one.pair % kBytes)});
  }
  of_pair.clear();
  for (const Found* one : by_pair) of_pair.push_back(one->number);
  return classes;
}

}  // namespace

Result<DigitClasses> DigitClasses::of(const Program& program, const HardwareProfile& profile, StudyFormat format,
                                      const std::optional<DigitSum>& sum, const GoOn& go_on) {
  const ByComponent<unsigned> after = digits_after_first_stage(program, digits_before_first_stage(format));
  if (std::string mixed = mixed_component(program, after); !mixed.empty()) {
    return Diagnostic{.message = std::move(mixed)};
  }
  DigitClasses result;
  result.digits_.resize(digits_of(format).size());
  std::atomic<bool> stopped = false;
  for (std::size_t d = 0; d < result.digits_.size(); ++d) {
    const std::size_t width = DigitKeys(program, after, sum).width(d);
    std::vector<double> keys(kPairs * width);
    parallel_ranges(kBytes, 16, [&](std::size_t begin, std::size_t end) {
      if (stopped || (go_on && !go_on())) {
        stopped = true;
        return;
      }
      DigitKeys maker(program, after, sum);
      DigitBytes own{}, other{};
      for (std::size_t pair = begin * kBytes; pair < end * kBytes; ++pair) {
        own[d] = static_cast<std::uint8_t>(pair / kBytes);
        other[d] = static_cast<std::uint8_t>(pair % kBytes);
        maker.write(comparison_registers(profile, format, own, other), d, keys.data() + pair * width);
      }
    });
    if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    result.digits_[d].classes = number_pairs(keys, width, result.digits_[d].of_pair);
  }
  return result;
}

std::vector<PairClass> DigitClasses::among(std::size_t digit, std::span<const std::uint8_t> values) const {
  const OfDigit& of = digits_[digit];
  std::vector<PairClass> classes = of.classes;
  for (PairClass& one : classes) one.pairs = one.equal = 0;
  for (const std::uint8_t own : values) {
    for (const std::uint8_t other : values) {
      PairClass& found = classes[of.of_pair[own * kBytes + other]];
      ++found.pairs;
      if (own == other) ++found.equal;
    }
  }
  std::erase_if(classes, [](const PairClass& one) { return one.pairs == 0; });
  return classes;
}

// Evaluates the first stage, or the first two, in one arithmetic.
class DigitKeys::Numbers {
 public:
  virtual ~Numbers() = default;
  virtual void run(const RegisterFile& registers, bool second_stage) = 0;
  // After the first stage.
  [[nodiscard]] virtual double component(std::size_t reg, std::size_t component) const = 0;
  // A product of the second stage.
  [[nodiscard]] virtual double product(const ProductTerm& term) = 0;
};

namespace {

class IntegerNumbers final : public DigitKeys::Numbers {
 public:
  explicit IntegerNumbers(const Program& program) : program_(program), first_(program) {
    first_.num_general_combiners = 1;
  }
  void run(const RegisterFile& registers, bool /*second_stage*/) override {
    registers_ = registers;
    evaluate_general(first_, registers_);
  }
  [[nodiscard]] double component(std::size_t reg, std::size_t component) const override {
    return registers_.value[reg][component];
  }
  [[nodiscard]] double product(const ProductTerm& term) override {
    const ProgramStage& stage = program_.general[1];
    const Portion& portion = term.channel == kAlpha ? stage.alpha : stage.rgb;
    const auto mapped = [&](const CombinerInput& in) {
      const int component = reference::component_of(in.usage, static_cast<int>(term.channel));
      const int code = reference::fetch(registers_, in.reg, component, stage.constant0, stage.constant1);
      return reference::map_input(program_.datapath, in.mapping, code);
    };
    return term.cd ? mapped(portion.c) * mapped(portion.d) : mapped(portion.a) * mapped(portion.b);
  }

 private:
  const Program& program_;
  Program first_;
  RegisterFile registers_;
};

double number(FloatField& /*field*/, float x) {
  return static_cast<double>(x);
}

// The numerator over the denominator 2^6 · one^4. Codes are n / one. Two stages with biases of one half, scales of one
// half and products of two factors give no larger denominator, and the numerators stay below 2^53.
double number(ExactField<SmallIntegers>& field, const ExactField<SmallIntegers>::Number& x) {
  SmallIntegers& integers = field.integers();
  return static_cast<double>(integers.mul(integers.shift(x.n, 6 - x.twos), integers.power(4 - x.ones)));
}

template <class Field>
class RealNumbers final : public DigitKeys::Numbers {
 public:
  explicit RealNumbers(const Program& program) : program_(program), field_(program.datapath.one), combiners_(field_) {}

  void run(const RegisterFile& registers, bool second_stage) override {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) registers_[r][c] = field_.of_code(registers.value[r][c]);
    }
    combiners_.run_general(program_.general[0], registers_, stage_);
    if (second_stage) combiners_.run_general(program_.general[1], registers_, stage_);
  }
  [[nodiscard]] double component(std::size_t reg, std::size_t component) const override {
    return number(field_, registers_[reg][component]);
  }
  [[nodiscard]] double product(const ProductTerm& term) override {
    const auto& in = stage_.channel[term.channel].input;
    return number(field_, term.cd ? field_.mul(in[2], in[3]) : field_.mul(in[0], in[1]));
  }

 private:
  const Program& program_;
  mutable Field field_;
  RealCombiners<Field> combiners_;
  typename RealCombiners<Field>::Registers registers_{};
  typename RealCombiners<Field>::Stage stage_{};
};

std::unique_ptr<DigitKeys::Numbers> numbers_of(const Program& program) {
  switch (program.datapath.arithmetic) {
    case Arithmetic::exact:
      return std::make_unique<RealNumbers<ExactField<SmallIntegers>>>(program);
    case Arithmetic::float32:
      return std::make_unique<RealNumbers<FloatField>>(program);
    case Arithmetic::integer:
      break;
  }
  return std::make_unique<IntegerNumbers>(program);
}

}  // namespace

DigitKeys::DigitKeys(const Program& program, const ByComponent<unsigned>& after, const std::optional<DigitSum>& sum)
    : sum_(sum), numbers_(numbers_of(program)) {
  const ByComponent<bool> read = read_from_stage(program, 1);
  for (std::size_t d = 0; d < places_.size(); ++d) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (read[r][c] && after[r][c] == 1U << d) places_[d].push_back({r, c});
      }
    }
  }
}

DigitKeys::~DigitKeys() = default;

std::size_t DigitKeys::width(std::size_t digit) const {
  if (sum_) return sum_->of_digit[digit] ? 1 : 0;
  return places_[digit].size();
}

void DigitKeys::write(const RegisterFile& registers, std::size_t digit, double* key) {
  numbers_->run(registers, sum_.has_value());
  if (sum_) {
    if (sum_->of_digit[digit]) *key = numbers_->product(*sum_->of_digit[digit]);
    return;
  }
  for (const Place& place : places_[digit]) *key++ = numbers_->component(place.reg, place.component);
}

}  // namespace ninebit
