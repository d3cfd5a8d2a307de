// The JSON form of a program: round trips, defaults, faults with their places.
#include "ninebit/language/json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kCard = profiles::geforce2;
const HardwareProfile& kXbox = profiles::nv2a;

// A program of these keys.
std::string with(const std::string& keys) {
  return R"({"ninebit": "program", "version": 1)" + (keys.empty() ? "" : ",\n" + keys) + "}";
}

TEST(JsonProgram, RandomStatesComeBackTheSame) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  int more_than_used = 0;
  for (const HardwareProfile* profile : {&kCard, &kXbox}) {
    for (int i = 0; i < 1500; ++i) {
      Random random(21, static_cast<std::uint64_t>(i));
      CombinerState state = random_state(random, *profile);
      // From some stage on the defaults, so that texts of every length come up.
      for (std::size_t stage = static_cast<std::size_t>(random.below(9)); stage < state.general.size(); ++stage) {
        state.general[stage] = {};
      }
      for (float& component : state.constant1) {
        if (random.one_in(4)) component = std::bit_cast<float>(random.below(0x3f800001));  // any float in [0, 1]
      }
      const std::string text = print_json_program(state);
      const auto parsed = parse_json_program({text, "printed"}, *profile);
      ASSERT_TRUE(parsed) << "state " << i << '\n' << all_faults(parsed) << text;
      ASSERT_EQ(*parsed, state) << "state " << i << '\n' << text;
      ASSERT_EQ(print_json_program(*parsed), text);
      more_than_used += state.general[7] != GeneralCombiner{} && state.num_general_combiners < 8 ? 1 : 0;
    }
  }
  EXPECT_GT(more_than_used, 40);
}

TEST(JsonProgram, WhatGlDoesNotHaveIsThereWhereItIsAskedForAlone) {
  struct Key {
    std::string name;
    bool CombinerState::*flag;
    std::string fault;
  };
  const std::string sum = "no 1 - x in the colour sum", mux = "no mux by the lowest bit of spare0's alpha";
  for (const auto& [name, flag, fault] :
       {Key{"mux_by_lowest_bit", &CombinerState::mux_by_lowest_bit, mux},
        Key{"color_sum_invert_spare0", &CombinerState::color_sum_invert_spare0, sum},
        Key{"color_sum_invert_secondary", &CombinerState::color_sum_invert_secondary, sum}}) {
    const std::string keys = '"' + name + "\": true";
    CombinerState state;
    state.*flag = true;
    EXPECT_FALSE(has(print_json_program({}), name));
    EXPECT_TRUE(has(print_json_program(state), keys));
    EXPECT_EQ(*parse_json_program({with(keys), ""}, kXbox), state);
    const auto refused = parse_json_program({with(keys), "f.json"}, kCard);
    EXPECT_EQ(all_faults(refused), "f.json:2:" + std::to_string(name.size() + 5) +
                                       ": GL_INVALID_ENUM: profile geforce2 has " + fault + " (NV2A)\n");
  }
}

TEST(JsonProgram, BlueToAlpha) {
  const std::string keys = R"("general_combiners": [{"rgb": {"output": {"ab": "spare1", "ab_blue_to_alpha": true}}}])";
  CombinerState state;
  state.general[0].rgb.out.ab = Register::spare1;
  state.general[0].rgb.out.ab_blue_to_alpha = true;
  EXPECT_FALSE(has(print_json_program({}), "blue_to_alpha"));
  EXPECT_TRUE(has(print_json_program(state), R"("mux_sum": false, "ab_blue_to_alpha": true})"));
  EXPECT_EQ(*parse_json_program({with(keys), ""}, kXbox), state);
  EXPECT_TRUE(has(all_faults(parse_json_program({with(keys), "f.json"}, kCard)), "f.json:2:42: GL_INVALID_ENUM: "));
}

TEST(JsonProgram, MissingKeysAreTheDefaults) {
  for (const char* keys : {"", R"("general_combiners": [])", R"("general_combiners": [{}, {"rgb": {"a": {}}}])",
                           R"("final_combiner": {"g": {}}, "constant_color0": [0, 0.0, 0e5, -0.0])"}) {
    const auto parsed = parse_json_program({with(keys), ""}, kCard);
    ASSERT_TRUE(parsed) << keys << '\n' << all_faults(parsed);
    EXPECT_EQ(*parsed, CombinerState{}) << keys;
    EXPECT_EQ(print_json_program(*parsed), print_json_program({}));
  }
}

TEST(JsonProgram, ThePrintedFormIsTheDocumentedOne) {
  CombinerState state;
  state.constant0 = {1.0F, 0.1F, 1.0F / 3.0F, 0.0F};
  const std::string text = print_json_program(state);
  EXPECT_TRUE(text.starts_with(R"({
  "ninebit": "program",
  "version": 1,
  "num_general_combiners": 1,
  "color_sum_clamp": true,
  "per_stage_constants": false,
  "constant_color0": [1, 0.1, 0.33333334, 0],
  "constant_color1": [0, 0, 0, 0],
  "general_combiners": [
    {
      "rgb": {
        "a": {"input": "primary_color", "mapping": "unsigned_identity", "usage": "rgb"},
)")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 38);
}

TEST(JsonProgram, WhatGlWouldNotHoldIsPrintedAsGlWouldHoldIt) {
  CombinerState state;
  state.constant0 = {std::numeric_limits<float>::quiet_NaN(), -1.0F, 2.0F, std::numeric_limits<float>::infinity()};
  state.constant1 = {-0.0F, 0.0F, 0.0F, 0.0F};
  CombinerState held;
  held.constant0 = {0, 0, 1, 1};
  EXPECT_EQ(print_json_program(state), print_json_program(held));
}

struct JsonFault {
  std::string text;
  PlacedFault fault;
};

std::string nested(const std::string& open, int times, const std::string& close) {
  std::string text;
  for (int i = 0; i < times; ++i) text += open;
  for (int i = 0; i < times; ++i) text += close;
  return text;
}

const JsonFault kFaults[] = {
    // No JSON.
    {"", {1, 1, "not valid JSON"}},
    {"   ", {1, 4, "not valid JSON"}},
    {"{\n  \"ninebit\": NaN}", {2, 14, "not valid JSON: syntax error"}},
    {"{\"ninebit\": \"program\", \"version\": 1e999}", {1, 39, "number overflow"}},
    {"{\"ninebit\": \"program\",}", {1, 23, "not valid JSON"}},
    {"{\"ninebit\": \"program\"} x", {1, 24, "not valid JSON"}},
    {"{\"a\": \"\x80\"}", {1, 8, "ill-formed UTF-8"}},
    {std::string("{\0}", 3), {1, 2, "not valid JSON"}},
    {"{\"a\": \"b", {1, 9, "not valid JSON"}},
    {"// comment\n{}", {1, 1, "not valid JSON"}},
    {nested("[", 100'000, "]"), {1, 17, "nested more than 16 deep"}},
    {nested("{\"a\":", 50, "}"), {1, 81, "nested more than 16 deep"}},
    // Not this form.
    {"[]", {1, 1, "the value must be an object, not an array"}},
    {"3", {1, 1, "the value must be an object, not a number"}},
    {"\xEF\xBB\xBF {\"version\": 1}", {1, 5, "\"ninebit\": \"program\" is missing"}},
    {"{\"ninebit\": \"program\"}", {1, 1, "\"version\": 1 is missing"}},
    {"{\"ninebit\": \"register_words\", \"version\": 1}", {1, 13, "must be \"program\" here, not \"register_words\""}},
    {"{\"ninebit\": 1, \"version\": 1}", {1, 13, "ninebit must be a string, not a number"}},
    {"{\"ninebit\": \"program\", \"version\": 2}", {1, 35, "version \"2\" is not supported"}},
    {"{\"ninebit\": \"program\", \"version\": \"1\"}", {1, 35, "version must be a whole number, not a string"}},
    // Keys.
    {with("\"colour\": 1"), {2, 1, "unknown key \"colour\"; the keys here are ninebit, version"}},
    {with("\"color_sum_clamp\": true,\n\"color_sum_clamp\": true"), {3, 1, "given before, in line 2"}},
    {with("\"final_combiner\": {\"h\": {}}"), {2, 20, "unknown key \"h\"; the keys here are a, b, c"}},
    {with("\"\\u0000\\n\": 1"), {2, 1, "unknown key \"\\x00\\n\""}},
    // Types and ranges.
    {with("\"num_general_combiners\": 1.5"), {2, 26, "whole number from 1 to 8"}},
    {with("\"num_general_combiners\": 0"), {2, 26, "whole number from 1 to 8"}},
    {with("\"num_general_combiners\": 99999999999999999999"), {2, 26, "whole number from 1 to 8"}},
    {with("\"num_general_combiners\": \"2\""), {2, 26, "must be a whole number, not a string"}},
    {with("\"color_sum_clamp\": 1"), {2, 20, "color_sum_clamp must be true or false, not a number"}},
    {with("\"per_stage_constants\": null"), {2, 24, "per_stage_constants must be true or false, not null"}},
    {with("\"constant_color0\": [0, 0, 0]"), {2, 20, "array of 4 numbers"}},
    {with("\"constant_color0\": 0"), {2, 20, "array of 4 numbers"}},
    {with("\"constant_color0\": [0, 0, 1.5, 0]"), {2, 27, "from 0 to 1"}},
    {with("\"constant_color0\": [0, -1e-3, 0, 0]"), {2, 24, "from 0 to 1"}},
    {with("\"constant_color0\": [0, 1e300, 0, 0]"), {2, 24, "from 0 to 1"}},
    {with("\"constant_color1\": [0, 0, 0, true]"), {2, 30, "must be a number, not a boolean"}},
    {with("\"general_combiners\": {}"), {2, 22, "general_combiners must be an array, not an object"}},
    {with("\"general_combiners\": [{}, {}, {}, {}, {}, {}, {}, {}, {}]"), {2, 55, "at most 8"}},
    {with("\"general_combiners\": [{\"rgb\": []}]"), {2, 31, "rgb must be an object, not an array"}},
    {with("\"final_combiner\": {\"a\": {\"input\": 4}}"), {2, 35, "input must be a string, not a number"}},
    // Names.
    {with("\"final_combiner\": {\"a\": {\"input\": \"primary\"}}"),
     {2, 35, "\"primary\" is not a valid input; expected one of zero"}},
    {with("\"final_combiner\": {\"a\": {\"input\": \"discard\"}}"), {2, 35, "\"discard\" is not a valid input"}},
    {with("\"final_combiner\": {\"a\": {\"mapping\": \"expand\"}}"),
     {2, 37, "\"expand\" is not a valid input mapping"}},
    {with("\"final_combiner\": {\"a\": {\"usage\": \"red\"}}"),
     {2, 35, "\"red\" is not a valid component usage; expected one of rgb"}},
    {with("\"general_combiners\": [{\"rgb\": {\"output\": {\"ab\": \"zero\"}}}]"),
     {2, 49, "\"zero\" is not a valid output"}},
    {with("\"general_combiners\": [{\"rgb\": {\"output\": {\"scale\": \"2\"}}}]"),
     {2, 52, "\"2\" is not a valid scale; expected one of none"}},
    {with("\"general_combiners\": [{\"rgb\": {\"output\": {\"bias\": \"half\"}}}]"),
     {2, 51, "\"half\" is not a valid bias"}},
    // A call that GL refuses.
    {with("\"num_general_combiners\": 3"), {2, 26, "GL_INVALID_VALUE: num_general_combiners is 3"}},
    {with("\"per_stage_constants\": true"), {2, 24, "has no per-stage constants"}},
    {with("\"final_combiner\": {\"e\":\n{\"input\": \"e_times_f\"}}"),
     {3, 1, "GL_INVALID_OPERATION: final combiner, variable E"}},
    {with("\"general_combiners\": [{}, {\"alpha\": {\"c\": {\"usage\": \"rgb\"}}}]"),
     {2, 43, "general combiner 1, alpha portion, variable C"}},
    {with("\"general_combiners\": [{\"rgb\": {\"output\": {\"ab\": \"spare0\"}}}]"),
     {2, 42, "two outputs go to spare0"}},
};

TEST(JsonProgram, EveryFaultHasItsPlace) {
  for (const auto& [text, fault] : kFaults) expect_fault(parse_json_program({text, "f"}, kCard), fault, text);
}

TEST(JsonProgram, AllFaultsAreReportedInTheOrderOfTheText) {
  const auto parsed = parse_json_program(
      {with("\"color_sum_clamp\": 1,\n\"final_combiner\": {\"e\": {\"input\": \"e_times_f\"}},\n\"x\": 2,\n"
            "\"constant_color0\": [2, 3, 4, 5]"),
       ""},
      kCard);
  ASSERT_EQ(parsed.faults().size(), 7U) << all_faults(parsed);
  for (std::size_t i = 1; i < parsed.faults().size(); ++i) {
    EXPECT_LE(std::pair(parsed.faults()[i - 1].line, parsed.faults()[i - 1].column),
              std::pair(parsed.faults()[i].line, parsed.faults()[i].column));
  }
}

TEST(JsonProgram, LargeTextsAreBounded) {
  std::string many = "[0";
  while (many.size() < kMaxSourceBytes - 4) many += ",0";
  EXPECT_TRUE(has(all_faults(parse_json_program({many + "]", ""}, kCard)), "values"));
  std::string same = "{";
  for (int i = 0; i < 4000; ++i) same += "\"a\": 0,\n";
  EXPECT_EQ(parse_json_program({same + "\"a\": 0}", ""}, kCard).faults().size(), kMaxTextFaults);
  EXPECT_EQ(parse_json_program({std::string(kMaxSourceBytes + 1, '['), ""}, kCard).faults().size(), 1U);
  const auto brackets = parse_json_program({std::string(kMaxSourceBytes, '['), ""}, kCard);
  EXPECT_EQ(brackets.faults().size(), 1U);
}

}  // namespace
}  // namespace ninebit::test
