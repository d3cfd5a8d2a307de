// Damaged texts of the JSON forms.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/damage.h"
#include "ninebit/language/json.h"

namespace ninebit::test {
namespace {

// One value replaced by a word that the form knows.
void exchange_value(std::string& text, Random& random) {
  const std::size_t start = text.find(": ", static_cast<std::size_t>(random.below(static_cast<int>(text.size()))));
  const std::size_t end = start == std::string::npos ? start : text.find_first_of(",}\n", start);
  if (end == std::string::npos) return;
  text.replace(start + 2, end - start - 2,
               random.pick<std::string>({"\"zero\"", "\"fog\"", "\"e_times_f\"", "\"rgb\"", "\"alpha\"", "\"blue\"",
                                         "\"texture3\"", "true", "false", "null", "0.5", "-1", "\"spare0\"", "\"none\"",
                                         "\"discard\"", "1e-50", "[]", "{}", "\"scale_by_four\""}));
}

TEST(DamagedJson, Programs) {
  for (const HardwareProfile* const profile : {&profiles::geforce2, &profiles::nv2a}) {
    const auto printed = [&](Random& random) {
      CombinerState state = random_state(random, *profile);
      for (std::size_t stage = 2; stage < state.general.size(); ++stage) state.general[stage] = {};
      std::string text = print_json_program(state);
      for (int i = random.below(3); i > 0; --i) exchange_value(text, random);
      return text;
    };
    for (const int edits : {0, 2}) {
      expect_states_or_faults({.seed = 22,
                               .whole = printed,
                               .bytes = "{}[]\",:.0123456789eE+-\\u tnr\n\x01\x80\xff",
                               .parse = [&](const SourceText& text) { return parse_json_program(text, *profile); },
                               .states = edits == 0 ? 30 : 5,
                               .refused = 300,
                               .texts = 2000,
                               .edits = edits,
                               .profile = *profile});
    }
  }
}

TEST(DamagedJson, RegisterWords) {
  const auto printed = [](Random& random) {
    return *print_json_register_words(random_state(random, profiles::nv2a), ChipClass::nv20, profiles::nv2a);
  };
  const auto parse = [](const SourceText& text) {
    return parse_json_register_words(text, ChipClass::nv20, profiles::nv2a);
  };
  expect_states_or_faults({.seed = 32,
                           .whole = printed,
                           .bytes = "{}[]\",:.0123456789abcdefx\\u \n\x80",
                           .parse = parse,
                           .states = 60,
                           .refused = 2000});
}

}  // namespace
}  // namespace ninebit::test
