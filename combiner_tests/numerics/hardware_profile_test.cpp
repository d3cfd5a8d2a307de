// The shipped profiles: names, values and evidence words are those of the table in docs/numerics.md.
#include "ninebit/numerics/hardware_profile.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "ninebit/numerics/datapath.h"

namespace ninebit {
namespace {

using enum Evidence;

template <class T>
void expect_choice(const Choice<T>& choice, T value, Evidence evidence, const char* field) {
  EXPECT_EQ(choice.value, value) << field;
  EXPECT_EQ(name_of(choice.evidence), name_of(evidence)) << field;
  EXPECT_FALSE(choice.source.empty()) << field;
}

template <class T>
void expect_same_value(const Choice<T>& a, const Choice<T>& b, const char* field) {
  EXPECT_EQ(a.value, b.value) << field;
}

TEST(Profiles, DefaultComesFirstAndAllAreFoundByTheirUniqueNames) {
  ASSERT_EQ(hardware_profiles().size(), 6U);
  EXPECT_EQ(hardware_profiles()[0].name, "geforce2");
  std::set<std::string_view> names;
  for (const HardwareProfile& profile : hardware_profiles()) {
    EXPECT_TRUE(names.insert(profile.name).second) << profile.name;
    EXPECT_FALSE(profile.chip.empty());
    EXPECT_EQ(find_profile(profile.name), &profile);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"geforce2", "geforce2-early-truncation", "geforce256-8bit", "nv2a",
                                               "ideal", "float-shader"}));
}

TEST(Profiles, UnknownNamesGiveNull) {
  EXPECT_EQ(find_profile(""), nullptr);
  EXPECT_EQ(find_profile("GeForce2"), nullptr);
  EXPECT_EQ(find_profile("geforce2 "), nullptr);
  EXPECT_EQ(find_profile("geforce"), nullptr);
}

TEST(Profiles, EvidenceWords) {
  EXPECT_EQ(name_of(specified), "specified");
  EXPECT_EQ(name_of(seed), "seed");
  EXPECT_EQ(name_of(measured), "measured");
  EXPECT_EQ(name_of(inferred), "inferred");
  EXPECT_EQ(name_of(assumed), "assumed");
}

TEST(Profiles, Geforce2IsTheTable) {
  const HardwareProfile& p = profiles::geforce2;
  expect_choice(p.arithmetic, Arithmetic::integer, specified, "arithmetic");
  expect_choice(p.one, 255, measured, "one");
  expect_choice(p.lowest, -255, inferred, "lowest");
  expect_choice(p.lowest_output, -255, specified, "lowest_output");
  expect_choice(p.half, 128, inferred, "half");
  expect_choice(p.expand_offset, 255, inferred, "expand_offset");
  expect_choice(p.byte_shift, 0, measured, "byte_shift");
  expect_choice(p.general_narrowing, Narrowing::toward_zero, seed, "general_narrowing");
  expect_choice(p.narrowing_point, NarrowingPoint::after_scale, seed, "narrowing_point");
  expect_choice(p.final_narrowing, Narrowing::nearest_halves_up, inferred, "final_narrowing");
  expect_choice(p.general_combiners, 2, specified, "general_combiners");
  expect_choice(p.texture_units, 2, specified, "texture_units");
  expect_choice(p.per_stage_constants, false, specified, "per_stage_constants");
  // The measurement is the NV2A's; that this chip's extension has no such output is specified.
  expect_choice(p.blue_to_alpha, false, specified, "blue_to_alpha");
  expect_choice(p.mux_by_lowest_bit, false, specified, "mux_by_lowest_bit");
  expect_choice(p.color_sum_inverts, false, specified, "color_sum_inverts");
  expect_choice(p.spare0_alpha_without_texture0, 255, assumed, "spare0_alpha_without_texture0");
  expect_choice(p.disabled_texture_alpha, 255, inferred, "disabled_texture_alpha");
  expect_choice(p.secondary_alpha, SecondaryAlpha::one, inferred, "secondary_alpha");
  expect_choice(p.fog_alpha_without_fog, 255, specified, "fog_alpha_without_fog");
  expect_choice(p.subpixel_bits, 4, inferred, "subpixel_bits");
  expect_choice(p.line_shape, LineShape::rectangles, inferred, "line_shape");
  expect_choice(p.point_shape, PointShape::squares, inferred, "point_shape");
  expect_choice(p.vertex_color_mantissa_bits, 13, inferred, "vertex_color_mantissa_bits");
  expect_choice(p.polygon_offset_slope, OffsetSlope::larger, inferred, "polygon_offset_slope");
  expect_choice(p.color_interpolation, ColorInterpolation::perspective, inferred, "color_interpolation");
  expect_choice(p.color_weights, ColorWeights::eight_bits, inferred, "color_weights");
  expect_choice(p.depth_narrowing, Narrowing::toward_zero, inferred, "depth_narrowing");
  expect_choice(p.fog_narrowing, Narrowing::toward_zero, inferred, "fog_narrowing");
  expect_choice(p.texture_weight_bits, 8, inferred, "texture_weight_bits");
  expect_choice(p.texture_weight_narrowing, Narrowing::toward_zero, inferred, "texture_weight_narrowing");
  expect_choice(p.texture_filter_rounding, FilterRounding::each_blend, inferred, "texture_filter_rounding");
  expect_choice(p.texture_bias_narrowing, Narrowing::toward_zero, inferred, "texture_bias_narrowing");
  expect_choice(p.dxt1_palette, Dxt1Palette::rgb565, inferred, "dxt1_palette");
}

TEST(Profiles, Nv2aIsTheTable) {
  const HardwareProfile& p = profiles::nv2a;
  expect_choice(p.arithmetic, Arithmetic::integer, specified, "arithmetic");
  expect_choice(p.one, 255, measured, "one");
  expect_choice(p.lowest, -256, specified, "lowest");
  expect_choice(p.lowest_output, -255, specified, "lowest_output");
  expect_choice(p.half, 128, measured, "half");
  expect_choice(p.expand_offset, 255, inferred, "expand_offset");
  expect_choice(p.byte_shift, 0, measured, "byte_shift");
  expect_choice(p.general_narrowing, Narrowing::nearest_halves_up, inferred, "general_narrowing");
  expect_choice(p.narrowing_point, NarrowingPoint::after_scale, inferred, "narrowing_point");
  expect_choice(p.final_narrowing, Narrowing::nearest_halves_up, measured, "final_narrowing");
  expect_choice(p.general_combiners, 8, specified, "general_combiners");
  expect_choice(p.texture_units, 4, specified, "texture_units");
  expect_choice(p.per_stage_constants, true, specified, "per_stage_constants");
  expect_choice(p.blue_to_alpha, true, measured, "blue_to_alpha");
  expect_choice(p.mux_by_lowest_bit, true, measured, "mux_by_lowest_bit");
  expect_choice(p.color_sum_inverts, true, measured, "color_sum_inverts");
  expect_choice(p.spare0_alpha_without_texture0, 255, assumed, "spare0_alpha_without_texture0");
  expect_choice(p.disabled_texture_alpha, 255, measured, "disabled_texture_alpha");
  expect_choice(p.secondary_alpha, SecondaryAlpha::as_given, specified, "secondary_alpha");
  expect_choice(p.fog_alpha_without_fog, 255, specified, "fog_alpha_without_fog");
  expect_choice(p.subpixel_bits, 4, measured, "subpixel_bits");
  expect_choice(p.line_shape, LineShape::rectangles, measured, "line_shape");
  expect_choice(p.point_shape, PointShape::squares, measured, "point_shape");
  expect_choice(p.vertex_color_mantissa_bits, 13, measured, "vertex_color_mantissa_bits");
  expect_choice(p.polygon_offset_slope, OffsetSlope::larger, inferred, "polygon_offset_slope");
  expect_choice(p.color_interpolation, ColorInterpolation::perspective, measured, "color_interpolation");
  expect_choice(p.color_weights, ColorWeights::eight_bits, measured, "color_weights");
  expect_choice(p.depth_narrowing, Narrowing::toward_zero, measured, "depth_narrowing");
  expect_choice(p.fog_narrowing, Narrowing::toward_zero, measured, "fog_narrowing");
  expect_choice(p.texture_weight_bits, 8, measured, "texture_weight_bits");
  expect_choice(p.texture_weight_narrowing, Narrowing::toward_zero, measured, "texture_weight_narrowing");
  expect_choice(p.texture_filter_rounding, FilterRounding::each_blend, measured, "texture_filter_rounding");
  expect_choice(p.texture_bias_narrowing, Narrowing::toward_zero, measured, "texture_bias_narrowing");
  expect_choice(p.dxt1_palette, Dxt1Palette::dithered565, measured, "dxt1_palette");
}

TEST(Profiles, EarlyTruncationIsGeforce2WithAnotherNarrowingPoint) {
  HardwareProfile p = profiles::geforce2_early_truncation;
  expect_choice(p.narrowing_point, NarrowingPoint::before_scale, assumed, "narrowing_point");
  p.narrowing_point = profiles::geforce2.narrowing_point;
  EXPECT_EQ(datapath_of(p), datapath_of(profiles::geforce2));
  expect_same_value(p.general_combiners, profiles::geforce2.general_combiners, "general_combiners");
  expect_same_value(p.texture_units, profiles::geforce2.texture_units, "texture_units");
}

TEST(Profiles, EightBitsHalveEveryCode) {
  const HardwareProfile& p = profiles::geforce256_8bit;
  expect_choice(p.one, 127, assumed, "one");
  expect_choice(p.lowest, -127, assumed, "lowest");
  expect_choice(p.lowest_output, -127, assumed, "lowest_output");
  expect_choice(p.half, 64, assumed, "half");
  expect_choice(p.expand_offset, 127, assumed, "expand_offset");
  expect_choice(p.byte_shift, 1, assumed, "byte_shift");
  expect_same_value(p.general_narrowing, profiles::geforce2.general_narrowing, "general_narrowing");
  expect_same_value(p.narrowing_point, profiles::geforce2.narrowing_point, "narrowing_point");
  expect_same_value(p.final_narrowing, profiles::geforce2.final_narrowing, "final_narrowing");
  expect_same_value(p.general_combiners, profiles::geforce2.general_combiners, "general_combiners");
}

TEST(Profiles, RealNumbersAreTheTable) {
  for (const HardwareProfile& p : {profiles::ideal, profiles::float_shader}) {
    const bool exact = p.name == "ideal";
    expect_choice(p.arithmetic, exact ? Arithmetic::exact : Arithmetic::float32, exact ? specified : assumed,
                  "arithmetic");
    expect_choice(p.one, 255, specified, "one");
    expect_choice(p.byte_shift, 0, specified, "byte_shift");
    expect_choice(p.half, 128, assumed, "half");
    expect_choice(p.general_combiners, 8, specified, "general_combiners");
    expect_choice(p.texture_units, 4, assumed, "texture_units");
    expect_choice(p.per_stage_constants, true, specified, "per_stage_constants");
    expect_choice(p.blue_to_alpha, true, assumed, "blue_to_alpha");
    expect_choice(p.mux_by_lowest_bit, true, assumed, "mux_by_lowest_bit");
    expect_choice(p.color_sum_inverts, true, assumed, "color_sum_inverts");
    expect_choice(p.disabled_texture_alpha, 255, assumed, "disabled_texture_alpha");
    expect_choice(p.secondary_alpha, SecondaryAlpha::as_given, specified, "secondary_alpha");
    expect_choice(p.subpixel_bits, 4, assumed, "subpixel_bits");
    expect_choice(p.line_shape, LineShape::diamonds, specified, "line_shape");
    expect_choice(p.point_shape, PointShape::whole_pixels, specified, "point_shape");
    expect_choice(p.vertex_color_mantissa_bits, 23, assumed, "vertex_color_mantissa_bits");
    expect_choice(p.polygon_offset_slope, OffsetSlope::larger, assumed, "polygon_offset_slope");
    expect_choice(p.color_interpolation, ColorInterpolation::perspective, assumed, "color_interpolation");
    expect_choice(p.color_weights, ColorWeights::exact, specified, "color_weights");
    expect_choice(p.depth_narrowing, Narrowing::nearest_halves_up, specified, "depth_narrowing");
    expect_choice(p.fog_narrowing, Narrowing::nearest_halves_up, specified, "fog_narrowing");
    expect_choice(p.texture_weight_bits, 8, assumed, "texture_weight_bits");
    expect_choice(p.texture_weight_narrowing, Narrowing::nearest_halves_up, assumed, "texture_weight_narrowing");
    expect_choice(p.texture_filter_rounding, FilterRounding::once, specified, "texture_filter_rounding");
    expect_choice(p.texture_bias_narrowing, Narrowing::nearest_halves_up, specified, "texture_bias_narrowing");
    expect_choice(p.dxt1_palette, Dxt1Palette::rgb888, specified, "dxt1_palette");
    for (const auto& choice : {p.lowest, p.lowest_output, p.half, p.expand_offset}) {
      EXPECT_NE(choice.evidence, measured);
    }
  }
}

TEST(Profiles, DatapathTakesEveryFieldThatTheArithmeticReads) {
  HardwareProfile p = profiles::geforce2;
  const Datapath before = datapath_of(p);
  EXPECT_EQ(before, Datapath{}) << "the default datapath is the default profile's";
  p.arithmetic.value = Arithmetic::exact;
  EXPECT_EQ(datapath_of(p).arithmetic, Arithmetic::exact);
  p.one.value = 254;
  EXPECT_EQ(datapath_of(p).one, 254);
  p.lowest.value = -256;
  EXPECT_EQ(datapath_of(p).lowest, -256);
  EXPECT_EQ(datapath_of(p).lowest_output, -255);
  p.lowest_output.value = -256;
  EXPECT_EQ(datapath_of(p).lowest_output, -256);
  p.half.value = 127;
  EXPECT_EQ(datapath_of(p).half, 127);
  p.expand_offset.value = 256;
  EXPECT_EQ(datapath_of(p).expand_offset, 256);
  p.general_narrowing.value = Narrowing::nearest_halves_up;
  EXPECT_EQ(datapath_of(p).general_narrowing, Narrowing::nearest_halves_up);
  p.narrowing_point.value = NarrowingPoint::before_scale;
  EXPECT_EQ(datapath_of(p).narrowing_point, NarrowingPoint::before_scale);
  p.final_narrowing.value = Narrowing::toward_zero;
  EXPECT_EQ(datapath_of(p).final_narrowing, Narrowing::toward_zero);
}

}  // namespace
}  // namespace ninebit
