#include "src/study/digits/digit_classes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <span>
#include <string>

#include "src/study/digits/digit_keys.h"
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

}  // namespace ninebit
