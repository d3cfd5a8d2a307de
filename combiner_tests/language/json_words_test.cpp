// Register words as JSON: the same states and the same faults as by lines.
#include <gtest/gtest.h>

#include <utility>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/json.h"

namespace ninebit::test {
namespace {

constexpr ChipClass k10 = ChipClass::nv10, k20 = ChipClass::nv20;

TEST(JsonWords, TheSameAsByLines) {
  for (int i = 0; i < cases_here(2000); ++i) {
    Random random(31, static_cast<std::uint64_t>(i));
    const ChipClass chip = i % 2 == 0 ? k10 : k20;
    const HardwareProfile& profile = chip == k10 ? profiles::geforce2 : profiles::nv2a;
    const CombinerState state = random_state(random, profile);
    const auto text = print_json_register_words(state, chip, profile);
    ASSERT_TRUE(text.ok());
    const auto parsed = parse_json_register_words({text.value(), "words"}, chip, profile);
    ASSERT_TRUE(parsed) << all_faults(parsed) << text.value();
    const auto lines = print_register_words(state, chip, profile);
    const auto by_lines = parse_register_words({lines.value(), ""}, chip, profile);
    ASSERT_TRUE(by_lines);
    ASSERT_EQ(*parsed, *by_lines);
    ASSERT_EQ(print_json_register_words(*parsed, chip, profile).value(), text.value());
  }
}

TEST(JsonWords, AHeadingIsOptionalAndNumbersCount) {
  const auto plain = parse_json_register_words({R"({"rc_in_color0": "0x08040000", "RC_COLOR[1]": 4286595104})", ""},
                                               k10, profiles::geforce2);
  ASSERT_TRUE(plain) << all_faults(plain);
  const auto lines =
      parse_register_words({"RC_IN_RGB[0] = 0x08040000\nRC_COLOR[1] = 0xff804020", ""}, k10, profiles::geforce2);
  EXPECT_EQ(*plain, *lines);
  EXPECT_TRUE(parse_json_register_words({"{}", ""}, k10, profiles::geforce2));
}

TEST(JsonWords, EveryFaultHasItsPlace) {
  const std::pair<const char*, PlacedFault> cases[] = {
      {"", {1, 1, "not valid JSON"}},
      {"[1]", {1, 1, "must be an object, not an array"}},
      {"{\"ninebit\": \"program\"}", {1, 13, "must be \"register_words\" here"}},
      {"{\"version\": 2}", {1, 13, "version \"2\" is not supported"}},
      {"{\"chip\": \"nv20\"}", {1, 10, "\"chip\" must be \"nv10\" here"}},
      {"{\n\"RC_IN_RGB[0]\": \"08040000\"}", {2, 17, "RC_IN_RGB[0] must be a string such as"}},
      {"{\"RC_IN_RGB[0]\": \"0x\"}", {1, 18, "must be a string such as"}},
      {"{\"RC_IN_RGB[0]\": \"0x100000000\"}", {1, 18, "must be a string such as"}},
      {"{\"RC_IN_RGB[0]\": 4294967296}", {1, 18, "whole number below 2^32"}},
      {"{\"RC_IN_RGB[0]\": -1}", {1, 18, "whole number below 2^32"}},
      {"{\"RC_IN_RGB[0]\": 1.5}", {1, 18, "whole number below 2^32"}},
      {"{\"RC_IN_RGB[0]\": {}}", {1, 18, "whole number below 2^32"}},
      {"{\"RC_IN_RGB[0]\": 0, \"RC_IN_RGB[0]\": 0}", {1, 21, "was given before"}},
      {"{\"RC_IN_RGB[0]\": 0,\n\"rc_in_color0\": 0}", {2, 1, "given before, in line 1 as RC_IN_RGB[0]"}},
      {"{\"RC_IN_\\u0007\": 0}", {1, 2, "\"RC_IN_\\x07\" is not a register word"}},
      {"{\"RC_IN_RGB[9]\": 0}", {1, 2, "is out of range for NV10"}},
      {"{\n \"RC_IN_RGB[0]\": \"0x06000000\"}", {2, 2, "register code 0x6"}},
      {"{\n \"RC_OUT_RGB[0]\": \"0x00000ccc\"}", {2, 2, "GL_INVALID_OPERATION"}},
  };
  for (const auto& [text, fault] : cases) {
    expect_fault(parse_json_register_words({text, "f"}, k10, profiles::geforce2), fault, text);
  }
}

}  // namespace
}  // namespace ninebit::test
