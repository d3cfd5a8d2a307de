#include "combiner_tests/language/damage.h"

#include <gtest/gtest.h>

#include "combiner_tests/fuzz/common.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/validate.h"

namespace ninebit::test {
namespace {

std::size_t any_below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.below(static_cast<int>(count)));
}

void edit(std::string& text, const Damage& damage, Random& random) {
  constexpr std::size_t kLongestCopy = 20, kMostErased = 10;
  if (text.size() <= damage.kept) return;
  const std::size_t at = damage.kept + any_below(random, text.size() - damage.kept);
  const char byte =
      random.one_in(4) ? static_cast<char>(random.byte()) : damage.bytes[any_below(random, damage.bytes.size())];
  switch (random.below(4)) {
    case 0:
      text[at] = byte;
      break;
    case 1:
      text.insert(at, 1, byte);
      break;
    case 2:
      text.insert(at, text.substr(damage.kept + any_below(random, text.size() - damage.kept), kLongestCopy));
      break;
    default:
      text.erase(at, 1 + any_below(random, kMostErased));
  }
}

}  // namespace

DamagedTexts parse_damaged(const Damage& damage, const HardwareProfile& profile,
                           Parsed<CombinerState> (*parse)(const SourceText&, const HardwareProfile&)) {
  constexpr int kStep = kSlowBuild ? 8 : 1;  // the fuzzers, which have sanitizers, damage texts, too
  DamagedTexts found;
  for (int i = 0; i < damage.texts; i += kStep) {
    Random random(damage.seed, static_cast<std::uint64_t>(i));
    std::string text = damage.whole(random);
    for (int edits = 1 + random.below(3); edits > 0; --edits) edit(text, damage, random);
    const auto parsed = parse({text, fuzz::kFile}, profile);
    std::string wrong = fuzz::wrong_with_answer(parsed, text);
    if (wrong.empty() && parsed && !validate(*parsed, profile).empty()) wrong = "GL refuses the state";
    if (!wrong.empty()) {
      ADD_FAILURE() << "seed " << damage.seed << " case " << i << ": " << wrong << "\n" << text;
      return found;
    }
    (parsed ? found.states : found.refused) += kStep;
  }
  return found;
}

}  // namespace ninebit::test
