// Texture-shader stages in the JSON form: round trips, defaults, the schema, faults with their places.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/json_schema.h"
#include "combiner_tests/support/random_stages.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/json.h"
#include "ninebit/language/program_text.h"

namespace ninebit::test {
namespace {

std::string stage_complaint(const Json& value) {
  static const Json root = [] {
    std::ifstream file(NINEBIT_SOURCE_DIR "/docs/program.schema.json");
    return Json::parse(file);
  }();
  return schema_complaint(root, root, value, "");
}

std::string with_stages(const std::string& value) {
  return "{\"ninebit\": \"program\", \"version\": 1,\n\"texture_shader\": " + value + "}";
}

// "LINE:COLUMN MESSAGE" of the only fault.
std::string stage_fault(const std::string& value, const HardwareProfile& profile = profiles::nv2a) {
  const auto parsed = parse_json_program({with_stages(value), "f"}, profile);
  if (parsed.faults().size() != 1) return std::to_string(parsed.faults().size()) + " faults: " + all_faults(parsed);
  const TextFault& fault = parsed.faults()[0];
  return std::to_string(fault.line) + ':' + std::to_string(fault.column) + ' ' + fault.message;
}

TEST(TextureShaderJson, RandomStagesComeBackTheSame) {
  for (int i = 0; i < (kSlowBuild ? 200 : 1500); ++i) {
    Random random(61, static_cast<std::uint64_t>(i));
    const TextureShaderState stages = random_stages(random);
    const CombinerState state = random_state(random, profiles::nv2a);
    const std::string text = print_json_program(state, {}, stages);
    TextureShaderState back;
    const auto parsed = parse_json_program({text, "f"}, profiles::nv2a, nullptr, &back);
    ASSERT_TRUE(parsed) << all_faults(parsed) << text;
    ASSERT_EQ(*parsed, state);
    ASSERT_EQ(back, stages) << text;
    ASSERT_EQ(print_json_program(*parsed, {}, back), text);
    if (i % 8 == 0) {
      ASSERT_EQ(stage_complaint(Json::parse(text)), "") << text;
    }
    const auto program = parse_program({text, "f"}, ProgramForm::json, profiles::nv2a);
    ASSERT_TRUE(program);
    ASSERT_EQ(program->texture_shader, stages);
    ASSERT_TRUE(validate(*program, profiles::nv2a).empty());
  }
}

TEST(TextureShaderJson, DefaultsAreLeftOut) {
  TextureShaderState stages;
  EXPECT_EQ(print_json_program({}, {}, stages), print_json_program({}));
  stages.enabled = true;
  EXPECT_TRUE(has(print_json_program({}, {}, stages), "  },\n  \"texture_shader\": {\n    \"stages\": []\n  }\n}\n"));
  stages.stage[1].operation = TextureOperation::offset_2d;
  stages.stage[1].matrix = {0.5F, 0.0F, -0.25F, 1e-10F};
  stages.rules = StageRules::nv2a;
  EXPECT_TRUE(has(print_json_program({}, {}, stages),
                  "    \"stages\": [\n      {\"operation\": \"none\"},\n"
                  "      {\"operation\": \"offset_2d\", \"matrix\": [0.5, 0, -0.25, 1e-10]}\n    ],\n"
                  "    \"rules\": \"nv2a\"\n  }\n}\n"));
}

TEST(TextureShaderJson, TheSchemaHasTheNamesOfTheOperations) {
  std::ifstream file(NINEBIT_SOURCE_DIR "/docs/program.schema.json");
  const Json schema = Json::parse(file);
  const Json& listed = schema["$defs"]["texture_stage"]["properties"]["operation"]["enum"];
  ASSERT_EQ(listed.size(), texture_operations().size());
  for (std::size_t i = 0; i < listed.size(); ++i) EXPECT_EQ(listed[i], texture_operations()[i].name);
}

TEST(TextureShaderJson, FaultsHaveTheirPlaces) {
  EXPECT_EQ(stage_fault("3"), "2:19 texture_shader must be an object, not a number");
  EXPECT_EQ(stage_fault(R"({"stages": {}})"), "2:30 stages must be an array, not an object");
  EXPECT_EQ(stage_fault(R"({"stage": []})"),
            "2:20 unknown key \"stage\"; the keys here are stages, rules, depth_unit, converts_yuv");
  EXPECT_EQ(stage_fault(R"({"stages": [{}, {}, {}, {}, {}]})"), "2:47 there are at most 4 texture-shader stages");
  EXPECT_EQ(
      stage_fault(R"({"stages": [{"operation": "texture_2"}]})"),
      "2:45 \"texture_2\" is not an operation of texture-shader stages; expected none, texture_2d, …; did you mean "
      "'texture_2d'?");
  EXPECT_EQ(stage_fault(R"({"stages": [{"previous": 4}]})"), "2:44 previous must be a whole number from 0 to 3");
  EXPECT_EQ(stage_fault(R"({"stages": [{"eye": [1, 2]}]})"), "2:39 eye must be an array of 3 numbers: x, y, z");
  EXPECT_EQ(stage_fault(R"({"stages": [{"scale": 1e39}]})"), "2:41 \"1e39\" is too large for a number of 32 bits");
  EXPECT_EQ(stage_fault(R"({"rules": "d3d"})"), "2:29 \"d3d\" is not a valid rule; expected one of open_gl, nv2a");
  // What GL refuses, at the stage.
  EXPECT_EQ(stage_fault(R"({"stages": [{}, {"operation": "dot_product_3d"}]})"),
            "2:35 texture stage 1: dot_product_3d is for stage 3 only");
  EXPECT_EQ(
      stage_fault(R"({"stages": [{"operation": "texture_2d"}]})", profiles::geforce2),
      "2:19 profile geforce2 has no texture shaders (NV_texture_shader); expected a profile that has, such as nv2a");
}

TEST(TextureShaderJson, FormsWithoutStagesRefuseThem) {
  TextProgram program;
  program.texture_shader.enabled = true;
  program.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  EXPECT_TRUE(find_form("words")->print(program, ChipClass::nv10, profiles::nv2a));  // what units do without stages
  program.texture_shader.stage[0].operation = TextureOperation::pass_through;
  const auto text = find_form("words")->print(program, ChipClass::nv10, profiles::nv2a);
  ASSERT_FALSE(text);
  EXPECT_TRUE(has(text.error().message, "texture-shader stages"));
}

}  // namespace
}  // namespace ninebit::test
