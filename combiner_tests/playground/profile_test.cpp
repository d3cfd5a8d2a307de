// Profiles of one's own, changed field by field: every step is a valid profile.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

#include "combiner_tests/playground/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/numerics/profile_fields.h"

namespace ninebit::test {
namespace {

PageJson edited(const PageJson& profile, const std::string& field, const PageJson& value) {
  return ask({{"do", "edit_profile"}, {"profile", profile}, {"field", field}, {"value", value}});
}

PageJson fields_of(const PageJson& profile) {
  return ask({{"do", "profile"}, {"profile", profile}})["fields"];
}

PageJson field_of(const PageJson& profile, const std::string& name) {
  for (const PageJson& field : fields_of(profile)) {
    if (field["name"] == name) return field;
  }
  return {};
}

TEST(PlaygroundProfile, AnEditTakesTheDependentFieldsAlong) {
  const PageJson answer = edited("nv2a", "byte_shift", 1);
  ASSERT_EQ(fault_of_answer(answer), "");
  const PageJson expected{{"base", "nv2a"},        {"name", "mine"}, {"one", 127},           {"lowest", -128},
                          {"lowest_output", -127}, {"half", 64},     {"expand_offset", 127}, {"byte_shift", 1}};
  EXPECT_EQ(PageJson::parse(answer["profile"].dump(), nullptr), expected);
  std::string names;
  for (const PageJson& other : answer["coupled"]) names += other["name"].get<std::string>() + " ";
  EXPECT_EQ(names, "one lowest lowest_output half expand_offset ");
  EXPECT_EQ(field_of(answer["profile"], "half")["range"], (PageJson{0, 127}));
  EXPECT_EQ(edited(answer["profile"], "byte_shift", 0)["profile"], "nv2a") << "back";
}

TEST(PlaygroundProfile, LowestTakesLowestOutputAlongWhereItMust) {
  const PageJson low = edited("nv2a", "lowest_output", -256)["profile"];
  ASSERT_EQ(field_of(low, "lowest_output")["value"], -256);
  const PageJson moved = edited(low, "lowest", -255);
  EXPECT_EQ(moved["coupled"], PageJson::parse(R"([{"name": "lowest_output", "value": -255}])"));
  EXPECT_EQ(moved["profile"], (PageJson{{"base", "nv2a"}, {"name", "mine"}, {"lowest", -255}}));
  const PageJson alone = edited("geforce2", "lowest", -256);
  EXPECT_TRUE(alone["coupled"].empty()) << alone;
  EXPECT_EQ(field_of(alone["profile"], "lowest_output")["value"], -255);
  EXPECT_EQ(field_of(alone["profile"], "lowest_output")["range"], (PageJson{-256, -255}));
  EXPECT_EQ(field_of("geforce2", "lowest_output")["range"], (PageJson{-255, -255}));
}

TEST(PlaygroundProfile, WhatFitsStaysAlone) {
  const PageJson answer = edited("geforce2", "general_narrowing", "nearest-halves-up");
  EXPECT_EQ(answer["profile"],
            (PageJson{{"base", "geforce2"}, {"name", "mine"}, {"general_narrowing", "nearest-halves-up"}}));
  EXPECT_TRUE(answer["coupled"].empty());
  const PageJson other = edited(answer["profile"], "dxt1_palette", "rgb888");
  EXPECT_EQ(other["profile"]["general_narrowing"], "nearest-halves-up");
  EXPECT_EQ(other["profile"]["dxt1_palette"], "rgb888");
}

TEST(PlaygroundProfile, FieldsThatTheArithmeticDoesNotReadGo) {
  const PageJson half = edited("nv2a", "half", 127)["profile"];
  const PageJson answer = edited(half, "arithmetic", "float32");
  EXPECT_EQ(answer["profile"], (PageJson{{"base", "nv2a"}, {"name", "mine"}, {"arithmetic", "float32"}}));
  EXPECT_EQ(answer["coupled"], PageJson::parse(R"([{"name": "half", "value": 128}])"));
  EXPECT_EQ(field_of(answer["profile"], "half")["read"], false);
  EXPECT_EQ(edited(answer["profile"], "arithmetic", "integer")["profile"], "nv2a");
}

// Any field to any value that its control offers, again and again.
TEST(PlaygroundProfile, EveryStepIsValid) {
  std::mt19937 random(1);
  constexpr int kSteps = ninebit::test::kSlowBuild ? 30 : 150;
  int coupled = 0;
  for (const char* base : {"geforce2", "nv2a", "geforce256-8bit", "float-shader", "ideal"}) {
    PageJson profile = base;
    for (int step = 0; step < kSteps; ++step) {
      const PageJson fields = fields_of(profile);
      ASSERT_TRUE(fields.is_array()) << profile;
      // Half of the steps change one of the fields that others depend on.
      PageJson field = fields[random() % fields.size()];
      if (step % 2 == 0) field = field_of(profile, step % 4 == 0 ? "byte_shift" : "lowest");
      if (step % 15 == 0) field = field_of(profile, "arithmetic");
      if (!field["read"]) continue;
      PageJson value;
      if (field.contains("choices")) {
        value = field["choices"][random() % field["choices"].size()];
      } else if (field["value"].is_boolean()) {
        value = random() % 2 == 0;
      } else {
        const int lowest = field["range"][0], highest = field["range"][1];
        value = lowest + static_cast<int>(random() % static_cast<unsigned>(highest - lowest + 1));
      }
      const PageJson answer = edited(profile, field["name"], value);
      ASSERT_EQ(fault_of_answer(answer), "") << profile << ": " << field["name"] << " " << value;
      coupled += answer["coupled"].empty() ? 0 : 1;
      profile = answer["profile"];
      ASSERT_EQ(field_of(profile, field["name"])["value"], value) << profile;
    }
  }
  EXPECT_GT(coupled, kSteps / 3);
}

TEST(PlaygroundProfile, ExactCombinersHaveTheArithmeticOfIdealAlone) {
  const std::set<std::string> arithmetic{"arithmetic",
                                         "one",
                                         "lowest",
                                         "lowest_output",
                                         "half",
                                         "expand_offset",
                                         "byte_shift",
                                         "general_narrowing",
                                         "narrowing_point",
                                         "final_narrowing"};
  for (const HardwareProfile& profile : hardware_profiles()) {
    const HardwareProfile exact = with_exact_combiners(profile);
    EXPECT_EQ(exact.name, profile.name);
    for (const ProfileField& field : profile_fields()) {
      const bool replaced = arithmetic.contains(std::string(field.name));
      const Choice<int> row = field.get(exact), expected = field.get(replaced ? profiles::ideal : profile);
      EXPECT_EQ(row.value, expected.value) << profile.name << ": " << field.name;
      EXPECT_EQ(row.source, expected.source) << profile.name << ": " << field.name;
    }
  }
}

TEST(PlaygroundProfile, RefusesWhatIsNoEdit) {
  EXPECT_NE(fault_of_answer(edited("nv2a", "colour", 1)).find("is not a field"), std::string::npos);
  EXPECT_NE(fault_of_answer(edited("nv2a", "half", 300)).find("from -256 to 256"), std::string::npos);
  EXPECT_NE(fault_of_answer(edited("nv2a", "half", -3)), "");
  EXPECT_NE(fault_of_answer(edited("nv2a", "byte_shift", 40)).find("from 0 to 4"), std::string::npos);
  EXPECT_NE(fault_of_answer(edited("nv2a", "line_shape", "round")), "");
  EXPECT_NE(fault_of_answer(edited("nv2a", "blue_to_alpha", 1)), "");
  EXPECT_NE(fault_of_answer(edited(PageJson{{"base", "nv2a"}}, "half", 1)).find("name"), std::string::npos);
}

}  // namespace
}  // namespace ninebit::test
