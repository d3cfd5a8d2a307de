// The shipped profiles: names, values and evidence words are those of the table in docs/numerics.md.
#include "ninebit/numerics/hardware_profile.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/profile_fields.h"

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

// A field's row of the table in docs/numerics.md.
std::string row_of(const ProfileField& field) {
  std::string row = "| `" + std::string(field.name) + "` | ";
  if (field.kind == FieldKind::number) {
    const FieldNumbers range = field.range(profiles::geforce2);
    row += std::to_string(range.first) + (range.first == range.second ? "" : " to " + std::to_string(range.second));
  } else if (field.kind == FieldKind::flag) {
    row += "`true`, `false`";
  } else {
    for (const FieldWord& word : field.words) {
      row += (&word == field.words.data() ? "`" : ", `") + std::string(word.word) + "`";
    }
  }
  for (const HardwareProfile& profile :
       {profiles::geforce2, profiles::geforce256_8bit, profiles::nv2a, profiles::ideal}) {
    const Choice<int> choice = field.get(profile);
    std::string text = field.text_of(choice.value);
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    row += " | " + text + " (" + std::string(name_of(choice.evidence)) + ")";
  }
  return row + " |";
}

TEST(Profiles, ThePageHasEveryFieldWithItsEvidence) {
  std::ifstream in(NINEBIT_SOURCE_DIR "/docs/numerics.md");
  std::vector<std::string> found;
  bool in_table = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| field | may be | `geforce2`")) in_table = true;
    if (in_table && line.empty()) break;
    if (in_table && line.starts_with("| `")) found.push_back(line);
  }
  std::vector<std::string> expected;
  for (const ProfileField& field : profile_fields()) expected.push_back(row_of(field));
  EXPECT_EQ(found, expected);
}

// The evidence words are pinned here, too: a page that follows a wrong table is as wrong.
TEST(Profiles, WhatEvidenceCarriesTheTwoChips) {
  const auto fields_with = [](const HardwareProfile& profile, Evidence evidence) {
    std::string names;
    for (const ProfileField& field : profile_fields()) {
      if (field.get(profile).evidence == evidence) names += std::string(field.name) + " ";
    }
    return names;
  };
  const HardwareProfile& card = profiles::geforce2;
  EXPECT_EQ(fields_with(card, seed), "general_narrowing narrowing_point ");
  EXPECT_EQ(fields_with(card, measured), "one byte_shift ");
  EXPECT_EQ(fields_with(card, assumed),
            "multisampling spare0_alpha_without_texture0 coverage_narrowing stage_byte negative_stage_number cull_zero "
            "dot_divisors dependent_divisor ahead_mapping replaced_depth_narrowing ");
  EXPECT_EQ(fields_with(card, specified),
            "arithmetic lowest_output general_combiners texture_units per_stage_constants blue_to_alpha "
            "mux_by_lowest_bit color_sum_inverts texture_shaders point_sprites fog_alpha_without_fog ");
  const HardwareProfile& xbox = profiles::nv2a;
  EXPECT_EQ(fields_with(xbox, seed), "");
  EXPECT_EQ(fields_with(xbox, assumed),
            "spare0_alpha_without_texture0 coverage_narrowing negative_stage_number cull_zero dot_divisors "
            "dependent_divisor ahead_mapping ");
  EXPECT_EQ(fields_with(xbox, inferred), "expand_offset general_narrowing narrowing_point polygon_offset_slope ");
  EXPECT_EQ(fields_with(xbox, specified),
            "arithmetic lowest lowest_output general_combiners texture_units per_stage_constants texture_shaders "
            "secondary_alpha fog_alpha_without_fog ");
}

TEST(Profiles, EveryFieldReadsAndWritesItsMember) {
  for (const ProfileField& field : profile_fields()) {
    EXPECT_EQ(find_profile_field(field.name), &field);
    HardwareProfile profile = profiles::geforce2;
    const int other = field.kind == FieldKind::word ? 1 - field.get(profile).value % 2 : field.get(profile).value ^ 1;
    field.set(profile, {other, assumed, "a test"});
    EXPECT_EQ(field.get(profile).value, other) << field.name;
    EXPECT_EQ(field.get(profile).source, "a test") << field.name;
    for (const ProfileField& second : profile_fields()) {
      if (&second == &field) continue;
      EXPECT_EQ(second.get(profile).value, second.get(profiles::geforce2).value) << field.name << ' ' << second.name;
    }
    for (int value = 0; value < static_cast<int>(field.words.size()); ++value) {
      EXPECT_EQ(field.value_of(field.word_of(value)), value) << field.name;
    }
    EXPECT_EQ(field.value_of("no word"), std::nullopt);
  }
  EXPECT_EQ(find_profile_field("colour"), nullptr);
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

TEST(Profiles, FloatShaderIsIdealInFloats) {
  for (const ProfileField& field : profile_fields()) {
    const Choice<int> real = field.get(profiles::float_shader);
    const bool differs = field.name == "arithmetic";
    EXPECT_EQ(real.value != field.get(profiles::ideal).value, differs) << field.name;
    if (differs) continue;
    EXPECT_EQ(name_of(real.evidence), name_of(field.get(profiles::ideal).evidence)) << field.name;
  }
  EXPECT_EQ(profiles::float_shader.arithmetic.value, Arithmetic::float32);
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
