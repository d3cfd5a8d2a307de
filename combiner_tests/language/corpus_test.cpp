// The fuzzers' corpora, replayed without libFuzzer; and that the checks see what is wrong.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "combiner_tests/fuzz/common.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Gl) {
  replay("gl", check_gl, [](std::string_view text) { return bool(parse_gl_calls({text, ""}, profiles::nv2a)); });
}

TEST(Corpus, Rc10) {
  replay("rc10", check_rc10, [](std::string_view text) { return bool(parse_rc10({text, ""}, profiles::nv2a)); });
}

TEST(Corpus, Ps) {
  replay("ps", check_ps, [](std::string_view text) { return bool(parse_pixel_shader({text, ""}, profiles::nv2a)); });
}

TEST(Corpus, Source) {
  replay("source", check_source, [](std::string_view text) {
    return bool(parse_source_code({text, ""}, {}, profiles::nv2a));
  });
}

TEST(Corpus, Words) {
  replay("words", check_words, [](std::string_view text) {
    return bool(parse_register_words({text, ""}, ChipClass::nv20, profiles::nv2a));
  });
}

TEST(Corpus, Xbox) {
  replay("xbox", check_xbox, [](std::string_view text) {
    return bool(parse_xbox_pixel_shader({text, ""}, profiles::nv2a));
  });
}

TEST(Corpus, Log) {
  replay("log", check_log, [](std::string_view text) { return bool(parse_register_log({text, ""})); });
}

TEST(Corpus, State) {
  // Any bytes are a state, which need not be valid.
  replay("state", check_state, [](std::string_view bytes) { return bytes.size() < 300; });
}

TEST(Corpus, PlacesOutsideTheTextAreSeen) {
  EXPECT_EQ(wrong_with_place({1, 1}, ""), "");
  EXPECT_EQ(wrong_with_place({2, 3}, "a\nbc"), "");
  EXPECT_EQ(wrong_with_place({1, 2}, "a\nbc"), "");
  for (const TextPlace place : {TextPlace{0, 1}, {1, 0}, {1, 3}, {2, 4}, {3, 1}, {-1, 1}}) {
    EXPECT_NE(wrong_with_place(place, "a\nbc"), "") << place.line << ":" << place.column;
  }
}

TEST(Corpus, WrongFaultsAreSeen) {
  const TextFault good{std::string(kFile), 1, 1, "m"}, below{std::string(kFile), 2, 1, "m"};
  EXPECT_EQ(wrong_with_faults({good, below}, "a\nb"), "");
  EXPECT_NE(wrong_with_faults({}, "a\nb"), "");
  EXPECT_NE(wrong_with_faults({below, good}, "a\nb"), "");
  EXPECT_NE(wrong_with_faults({good, below}, "a"), "");
  EXPECT_NE(wrong_with_faults({{std::string(kFile), 1, 1, ""}}, "a"), "");
  EXPECT_NE(wrong_with_faults({{std::string(kFile), 1, 1, "a\nb"}}, "a"), "");
  EXPECT_NE(wrong_with_faults({{"another", 1, 1, "m"}}, "a"), "");
  EXPECT_NE(wrong_with_faults(std::vector<TextFault>(kMaxTextFaults + 1, good), "a"), "");
  EXPECT_NE(wrong_with_answer(Parsed<int>(std::vector<TextFault>{}), "a"), "");
}

TEST(Corpus, WrongStatesAreSeen) {
  EXPECT_EQ(wrong_with_state({}, profiles::geforce2), "");
  CombinerState state;
  state.num_general_combiners = 3;
  EXPECT_NE(wrong_with_state(state, profiles::geforce2), "");
  EXPECT_EQ(wrong_with_state(state, profiles::nv2a), "");
  state.constant0[1] = 2.0F;  // GL holds 1, so another state comes back
  EXPECT_NE(wrong_with_state(state, profiles::nv2a), "");
}

}  // namespace
}  // namespace ninebit::fuzz
