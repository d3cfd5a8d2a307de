// The fuzzers' corpora of the JSON forms and of any form, replayed without libFuzzer.
#include <gtest/gtest.h>

#include "combiner_tests/fuzz/corpus.h"
#include "ninebit/language/json.h"
#include "ninebit/language/profile_json.h"
#include "ninebit/language/program_text.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Json) {
  replay("json", check_json, [](std::string_view text) {
    return parse_json_program({text, ""}, profiles::nv2a) ||
           parse_json_register_words({text, ""}, ChipClass::nv20, profiles::nv2a);
  });
}

TEST(Corpus, AnyForm) {
  for (const char* const name : {"form", "gl", "rc10", "ps", "source", "words", "xbox", "log", "json"}) {
    SCOPED_TRACE(name);
    replay(name, check_form, [](std::string_view text) {
      return bool(parse_program({text, ""}, form_of(text), profiles::nv2a));
    });
  }
}

TEST(Corpus, Profile) {
  replay("profile", check_profile, [](std::string_view text) { return bool(parse_json_profile({text, ""})); });
}

}  // namespace
}  // namespace ninebit::fuzz
