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

void expect_states_or_faults(const Damage& damage) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "the fuzzers do this with the same sanitizers";
  constexpr int kStep = kSlowBuild ? 8 : 1, kAskedOfOthers = 16;
  int states = 0, refused = 0;
  for (int i = 0; i < damage.texts; i += kStep) {
    Random random(damage.seed, static_cast<std::uint64_t>(i));
    std::string text = damage.whole(random);
    const int edits = damage.edits == 0 ? 0 : 1 + random.below(damage.edits);
    for (int k = 0; k < edits; ++k) edit(text, damage, random);
    const auto parsed = damage.parse({text, fuzz::kFile});
    std::string wrong = fuzz::wrong_with_answer(parsed, text);
    if (wrong.empty() && parsed && !validate(*parsed, damage.profile).empty()) wrong = "GL refuses the state";
    if (wrong.empty() && parsed && states % kAskedOfOthers == 0)
      wrong = fuzz::wrong_with_state(*parsed, damage.profile);
    ASSERT_EQ(wrong, "") << "seed " << damage.seed << " case " << i << '\n' << text;
    (parsed ? states : refused) += kStep;
  }
  EXPECT_GE(states, damage.states);
  EXPECT_GE(refused, damage.refused);
}

}  // namespace ninebit::test
