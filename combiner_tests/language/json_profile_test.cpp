// A caller's own profile: what may be replaced, which combinations are refused, where, and who owns its strings.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/profile_fields.h"

namespace ninebit {
namespace {

Parsed<OwnedProfile> parse(const std::string& text) {
  return parse_json_profile({text, "mine.json"});
}

HardwareProfile good(const std::string& text) {
  static std::vector<OwnedProfile> kept;
  const auto parsed = parse(text);
  if (!parsed) {
    ADD_FAILURE() << text << '\n' << parsed.faults()[0].text();
    return profiles::geforce2;
  }
  kept.push_back(*parsed);
  return kept.back().profile;
}

// All faults, a line each.
std::string faults_of(const std::string& text) {
  const auto parsed = parse(text);
  EXPECT_FALSE(parsed) << text;
  return test::all_faults(parsed);
}

// The statements of a profile file.
std::string names_of_keys() {
  std::string names = "ninebit, version, base, name, chip";
  for (const ProfileField& field : profile_fields()) names.append(", ").append(field.name);
  return names;
}

// A profile on geforce2 with more keys.
std::string with(const std::string& keys) {
  return R"({"base": "geforce2", "name": "mine", )" + keys + "}";
}

TEST(JsonProfile, ABaseAndANameAreItsCopy) {
  for (const HardwareProfile& base : hardware_profiles()) {
    const HardwareProfile p = good(R"({"name": "mine", "base": ")" + std::string(base.name) + "\"}");
    EXPECT_EQ(p.name, "mine");
    EXPECT_EQ(p.chip, "none: a variation of " + std::string(base.name));

    EXPECT_EQ(datapath_of(p), datapath_of(base)) << base.name;
    EXPECT_EQ(p.general_combiners.value, base.general_combiners.value);
    EXPECT_EQ(name_of(p.one.evidence), name_of(base.one.evidence));
  }
}

TEST(JsonProfile, EveryFieldCanBeReplaced) {
  const HardwareProfile p = good(R"({
    "ninebit": "profile", "version": 1, "base": "geforce2", "name": "a.b-c_9", "chip": "a chip",
    "arithmetic": "integer", "byte_shift": 1, "one": 127, "lowest": -128, "lowest_output": -128, "half": 63, "expand_offset": 128,
    "general_narrowing": "nearest-halves-up", "narrowing_point": "before-scale", "final_narrowing": "toward-zero",
    "general_combiners": 5, "texture_units": 3, "per_stage_constants": true, "blue_to_alpha": true,
    "mux_by_lowest_bit": true, "color_sum_inverts": true, "spare0_alpha_without_texture0": 1, "disabled_texture_alpha": 2, "secondary_alpha": "as-given",
    "fog_alpha_without_fog": 3, "subpixel_bits": 0, "line_shape": "diamonds", "point_shape": "whole-pixels", "vertex_color_mantissa_bits": 23,
    "polygon_offset_slope": "root", "polygon_offset_fraction": "rounded", "color_interpolation": "affine", "color_weights": "exact", "depth_narrowing": "nearest-halves-up", "fog_byte": "nearest",
    "texture_weight_bits": 5, "texture_weight_narrowing": "nearest-halves-up", "texture_filter_rounding": "once",
    "texture_bias_narrowing": "nearest-halves-up",
    "dxt1_palette": "rgb888"})");
  EXPECT_EQ(p.name, "a.b-c_9");
  EXPECT_EQ(p.chip, "a chip");
  Datapath d;
  d.one = 127;
  d.lowest = d.lowest_output = -128;
  d.half = 63;
  d.expand_offset = 128;
  d.general_narrowing = Narrowing::nearest_halves_up;
  d.narrowing_point = NarrowingPoint::before_scale;
  d.final_narrowing = Narrowing::toward_zero;
  EXPECT_EQ(datapath_of(p), d);
  EXPECT_EQ(p.byte_shift.value, 1);
  EXPECT_EQ(p.general_combiners.value, 5);
  EXPECT_EQ(p.texture_units.value, 3);
  EXPECT_TRUE(p.per_stage_constants.value);
  EXPECT_TRUE(p.blue_to_alpha.value);
  EXPECT_TRUE(p.mux_by_lowest_bit.value);
  EXPECT_TRUE(p.color_sum_inverts.value);
  EXPECT_EQ(p.spare0_alpha_without_texture0.value, 1);
  EXPECT_EQ(p.disabled_texture_alpha.value, 2);
  EXPECT_EQ(p.secondary_alpha.value, SecondaryAlpha::as_given);
  EXPECT_EQ(p.fog_alpha_without_fog.value, 3);
  EXPECT_EQ(p.subpixel_bits.value, 0);
  EXPECT_EQ(p.line_shape.value, LineShape::diamonds);
  EXPECT_EQ(p.point_shape.value, PointShape::whole_pixels);
  EXPECT_EQ(p.vertex_color_mantissa_bits.value, 23);
  EXPECT_EQ(p.polygon_offset_slope.value, OffsetSlope::root);
  EXPECT_EQ(p.color_interpolation.value, ColorInterpolation::affine);
  EXPECT_EQ(p.color_weights.value, ColorWeights::exact);
  EXPECT_EQ(p.depth_narrowing.value, Narrowing::nearest_halves_up);
  EXPECT_EQ(p.polygon_offset_fraction.value, OffsetFraction::rounded);
  EXPECT_EQ(p.fog_byte.value, StageByte::nearest);
  EXPECT_EQ(p.texture_weight_bits.value, 5);
  EXPECT_EQ(p.texture_weight_narrowing.value, Narrowing::nearest_halves_up);
  EXPECT_EQ(p.texture_filter_rounding.value, FilterRounding::once);
  EXPECT_EQ(p.texture_bias_narrowing.value, Narrowing::nearest_halves_up);
  EXPECT_EQ(p.dxt1_palette.value, Dxt1Palette::rgb888);
}

TEST(JsonProfile, WhatIsReplacedIsAssumedAndNamesTheFile) {
  const HardwareProfile p = good(with(R"("half": 127)"));
  EXPECT_EQ(p.half.value, 127);
  EXPECT_EQ(p.half.evidence, Evidence::assumed);
  EXPECT_EQ(p.half.source, "mine.json");
  EXPECT_EQ(p.one.evidence, Evidence::measured);
  EXPECT_EQ(p.one.source, profiles::geforce2.one.source);
}

TEST(JsonProfile, StringsLiveAsLongAsACopy) {
  OwnedProfile copy;
  {
    auto text = std::string(R"({"base": "nv2a", "name": "short", "half": 127, "chip": "a chip with a longer name than )"
                            R"(any small string holds"})");
    const auto parsed = parse_json_profile({text, std::string("a/file.json")});
    ASSERT_TRUE(parsed);
    copy = *parsed;
    text.assign(text.size(), 'x');
  }
  EXPECT_EQ(copy.profile.name, "short");
  EXPECT_EQ(copy.profile.chip, "a chip with a longer name than any small string holds");
  EXPECT_EQ(copy.profile.half.source, "a/file.json");
}

TEST(JsonProfile, OtherArithmeticsTakeCodesOfFewerBits) {
  const HardwareProfile p = good(R"({"base": "ideal", "name": "mine", "byte_shift": 4, "one": 15})");
  EXPECT_EQ(p.arithmetic.value, Arithmetic::exact);
  EXPECT_EQ(p.lowest.value, -15);
  EXPECT_EQ(p.lowest_output.value, -15);
  const HardwareProfile q = good(R"({"base": "ideal", "name": "mine", "arithmetic": "integer", "half": 127})");
  EXPECT_EQ(q.half.value, 127);
  EXPECT_EQ(q.lowest.source, "mine.json") << "the base says that it does not read it";
  const HardwareProfile r = good(with(R"("arithmetic": "float32")"));
  EXPECT_EQ(r.half.source, "not read by this arithmetic");
}

TEST(JsonProfile, RangesAreChecked) {
  const std::vector<std::pair<std::string_view, std::vector<int>>> bad{{"half", {-1, 256}},
                                                                       {"lowest", {-257, -254, 0, 255}},
                                                                       {"lowest_output", {-256, -254, 0}},
                                                                       {"expand_offset", {254, 257, 0}},
                                                                       {"byte_shift", {-1, 5}},
                                                                       {"one", {0, 256, 254, 127, -255}},
                                                                       {"general_combiners", {0, 9}},
                                                                       {"texture_units", {0, 5}},
                                                                       {"spare0_alpha_without_texture0", {-1, 256}},
                                                                       {"disabled_texture_alpha", {-1, 256}},
                                                                       {"fog_alpha_without_fog", {-1, 256}},
                                                                       {"subpixel_bits", {-1, 5}},
                                                                       {"vertex_color_mantissa_bits", {0, 24}},
                                                                       {"texture_weight_bits", {0, 9}}};
  for (const auto& [key, values] : bad) {
    for (const int value : values) {
      const std::string text = with("\"" + std::string(key) + "\": " + std::to_string(value));
      const auto parsed = parse(text);
      ASSERT_EQ(parsed.faults().size(), 1U) << text << (parsed ? "" : faults_of(text));
      EXPECT_EQ(parsed.faults()[0].line, 1);
      EXPECT_EQ(parsed.faults()[0].column, static_cast<int>(text.find(": ", text.find(key)) + 3));
      EXPECT_TRUE(test::has(parsed.faults()[0].message, key));
    }
  }
  for (const int half : {0, 127, 255}) EXPECT_EQ(good(with("\"half\": " + std::to_string(half))).half.value, half);
  EXPECT_EQ(good(with(R"("lowest": -256, "expand_offset": 256)")).lowest.value, -256);
  EXPECT_EQ(good(with(R"("lowest": -256)")).lowest_output.value, -255);
  EXPECT_EQ(good(with(R"("lowest": -256, "lowest_output": -256)")).lowest_output.value, -256);
}

TEST(JsonProfile, CodesMustFitTogether) {
  EXPECT_EQ(faults_of(with(R"("byte_shift": 1)")),
            "mine.json:1:52: one is 255; with byte_shift 1 it must be 127, so that a byte of 255 is 1.0\n");
  EXPECT_EQ(
      faults_of(with("\n\"byte_shift\": 1, \"one\": 127")),
      "mine.json:2:25: lowest of the base is -255, but with this value it must be -128 to -127; set it as well\n"
      "mine.json:2:25: lowest_output of the base is -255, but with this value it must be -128 to -127; set it as well\n"
      "mine.json:2:25: half of the base is 128, but with this value it must be 0 to 127; set it as well\n"
      "mine.json:2:25: expand_offset of the base is 255, but with this value it must be 127 to 128; set it as well\n");
}

TEST(JsonProfile, EveryFaultHasItsPlace) {
  EXPECT_EQ(
      faults_of("{\n  \"base\": \"gefroce2\",\n  \"name\": \"nv2a\",\n  \"haf\": 3,\n  \"one\": \"255\",\n"
                "  \"secondary_alpha\": \"two\",\n  \"blue_to_alpha\": 1, \"texture_units\": 2.0\n}"),
      "mine.json:2:11: \"gefroce2\" is not a shipped profile; expected one of geforce2, geforce2-early-truncation, "
      "geforce256-8bit, nv2a, ideal, float-shader\n"
      "mine.json:3:11: \"nv2a\" is the name of a shipped profile\n"
      "mine.json:4:3: unknown key \"haf\"; the keys here are " +
          names_of_keys() +
          "\n"
          "mine.json:5:10: one must be a whole number, not a string\n"
          "mine.json:6:22: \"two\" is not a valid secondary_alpha; expected one of one, as-given\n"
          "mine.json:7:20: blue_to_alpha must be true or false, not a number\n"
          "mine.json:7:40: texture_units must be a whole number from 1 to 4\n");
  EXPECT_EQ(faults_of(with(R"("arithmetic": "exact", "half": 127)")),
            "mine.json:1:61: half is not read by this arithmetic; remove it\n");
}

TEST(JsonProfile, BadTextsAreFaultsAndNothingElse) {
  const std::string long_name(65, 'n');
  for (const std::string& text : {std::string(),
                                  std::string("{"),
                                  std::string("[]"),
                                  std::string("null"),
                                  std::string("{} {}"),
                                  std::string("\0{}", 3),
                                  std::string("{\"name\": \"\xFF\"}"),
                                  std::string(1000000, '['),
                                  std::string("{}"),
                                  std::string(R"({"base": "nv2a"})"),
                                  std::string(R"({"base": "nv2a", "name": ""})"),
                                  std::string(R"({"base": "nv2a", "name": "a b"})"),
                                  R"({"base": "nv2a", "name": ")" + long_name + "\"}",
                                  with(R"("chip": "\u0007")"),
                                  with(R"("half": 127, "half": 128)"),
                                  with(R"("half": 99999999999999999999)"),
                                  with(R"("half": [127])"),
                                  with(R"("half": 1e2)"),
                                  with(R"("version": 2)"),
                                  with(R"("ninebit": "program")"),
                                  std::string((std::size_t{16} << 20) + 1, ' ')}) {
    const auto parsed = parse(text);
    ASSERT_FALSE(parsed) << text.substr(0, 100);
    ASSERT_FALSE(parsed.faults().empty());
    EXPECT_GE(parsed.faults()[0].line, 1);
    EXPECT_GE(parsed.faults()[0].column, 1);
    EXPECT_FALSE(parsed.faults()[0].message.empty());
  }
}

TEST(JsonProfile, AProfileFromAFileComputes) {
  const HardwareProfile p = good(with(R"("general_narrowing": "nearest-halves-up")"));
  CombinerState state;
  state.general[0].rgb.b = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  state.final_combiner.a = state.final_combiner.c = {};
  state.final_combiner.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  RegisterFile registers;
  registers[Register::primary] = registers[Register::texture0] = {20, 20, 20, 0};
  EXPECT_EQ(evaluate(normalize(state, p), registers)[0], 2) << "400 / 255 = 1.57";
  EXPECT_EQ(evaluate(normalize(state, profiles::geforce2), registers)[0], 1);
}

}  // namespace
}  // namespace ninebit
