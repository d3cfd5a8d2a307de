// Definitions with random damage.
#include <gtest/gtest.h>

#include "combiner_tests/language/damage.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

Parsed<CombinerState> parse(const SourceText& source, const HardwareProfile& profile) {
  return parse_xbox_pixel_shader(source, profile);
}

TEST(XboxDamage, DamagedTextsAreRefusedOrMeanAValidState) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "the fuzzers do this with the same sanitizers";
  const std::vector<Shape> shapes = all_shapes();
  const auto any_shape = [&](Random& random) {
    return shapes[static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())))].text(random_words(random));
  };
  const DamagedTexts found =
      parse_damaged({.seed = 85, .whole = any_shape, .bytes = "0123456789abcdefxX{}[]()=,;.|<>-~+ \n\"/*#:&PSRGB"},
                    profiles::nv2a, parse);
  EXPECT_GT(found.states, 1000);
  EXPECT_GT(found.refused, 1000);
}

TEST(XboxDamage, DamagedMacrosAreRefusedOrMeanAValidState) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const auto printed = [](Random& random) {
    std::vector<RegisterWord> words;
    const auto state = parse_xbox_pixel_shader({as_bytes(random_words(random)), ""}, profiles::nv2a, &words);
    return *print_xbox_pixel_shader(*state, profiles::nv2a, words);
  };
  const DamagedTexts found = parse_damaged(
      {.seed = 86, .texts = cases_here(10'000), .whole = printed, .bytes = "0123{}()=,|<>-~ \n_PSREGITZC"},
      profiles::nv2a, parse);
  EXPECT_GT(found.states, cases_here(200));
  EXPECT_GT(found.refused, cases_here(1000));
}

}  // namespace
}  // namespace ninebit::test
