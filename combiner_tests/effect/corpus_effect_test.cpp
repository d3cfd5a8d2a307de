// The kept corpus of the fuzzer of effects.
#include <gtest/gtest.h>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/corpus.h"
#include "ninebit/effect/effect_json.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Effect) {
  const Check check = &check_effect;
  replay("effect", check, [](std::string_view text) { return bool(parse_effect({text, ""})); });
}

}  // namespace
}  // namespace ninebit::fuzz
