// docs/program.schema.json against the names of the code and against printed programs.
#include "combiner_tests/support/json_schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/language/json.h"

namespace ninebit::test {
namespace {

Json schema() {
  std::ifstream file(NINEBIT_SOURCE_DIR "/docs/program.schema.json");
  return Json::parse(file);
}

std::string complaint(const Json& value) {
  static const Json root = schema();
  return schema_complaint(root, root, value, "");
}

template <class Enum>
std::set<std::string> names(int first, int last) {
  std::set<std::string> found;
  for (int i = first; i <= last; ++i) found.insert(std::string(name_of(static_cast<Enum>(i))));
  return found;
}

std::set<std::string> listed(const char* definition) {
  return schema().at("$defs").at(definition).at("enum").get<std::set<std::string>>();
}

template <class Enum>
int number(Enum value) {
  return static_cast<int>(value);
}

TEST(JsonSchema, ListsTheNamesOfTheCode) {
  auto general = names<Register>(0, number(Register::texture3));
  EXPECT_EQ(listed("general_register"), general);
  EXPECT_EQ(listed("final_register"), names<Register>(0, number(Register::spare0_plus_secondary)));
  std::set<std::string> written{"discard"};
  for (int i = number(Register::primary); i <= number(Register::texture3); ++i) {
    written.insert(std::string(name_of(static_cast<Register>(i))));
  }
  EXPECT_EQ(listed("output_register"), written);
  EXPECT_EQ(listed("mapping"), names<InputMapping>(0, number(InputMapping::signed_negate)));
  EXPECT_EQ(listed("final_mapping"), names<InputMapping>(0, number(InputMapping::unsigned_invert)));
  EXPECT_EQ(listed("rgb_usage"), names<ComponentUsage>(0, number(ComponentUsage::alpha)));
  EXPECT_EQ(listed("alpha_usage"), names<ComponentUsage>(1, number(ComponentUsage::blue)));
  EXPECT_EQ(listed("scale"), names<Scale>(0, number(Scale::by_one_half)));
  EXPECT_EQ(listed("bias"), names<Bias>(0, number(Bias::by_negative_one_half)));
  // The ranges above are whole: what follows has no name.
  EXPECT_EQ(name_of(static_cast<Register>(number(Register::discard) + 1)), "unknown");
  EXPECT_EQ(name_of(static_cast<InputMapping>(8)), "unknown");
  EXPECT_EQ(name_of(static_cast<ComponentUsage>(3)), "unknown");
  EXPECT_EQ(name_of(static_cast<Scale>(4)), "unknown");
  EXPECT_EQ(name_of(static_cast<Bias>(2)), "unknown");
}

TEST(JsonSchema, AcceptsWhatIsPrinted) {
  EXPECT_EQ(complaint(Json::parse(print_json_program({}))), "");
  for (int i = 0; i < 1000; ++i) {
    Random random(41, static_cast<std::uint64_t>(i));
    const HardwareProfile& profile = i % 2 == 0 ? profiles::geforce2 : profiles::nv2a;
    const CombinerState state = random_state(random, profile);
    ASSERT_EQ(complaint(Json::parse(print_json_program(state))), "") << "state " << i;
  }
}

TEST(JsonSchema, DescribesTheOtherWords) {
  const Json names = schema().at("properties").at("other_words").at("properties");
  ASSERT_EQ(names.size(), kOtherWordNames.size());
  std::vector<RegisterWord> words;
  for (const std::string_view name : kOtherWordNames) {
    EXPECT_TRUE(names.contains(name)) << name;
    words.push_back({std::string(name), 0x89abcdef, {}});
  }
  Json whole = Json::parse(print_json_program({}, words));
  EXPECT_EQ(complaint(whole), "");
  whole["other_words"]["PSTextureModes"] = 33;
  EXPECT_EQ(complaint(whole), "");
  std::vector<RegisterWord> back;
  ASSERT_TRUE(parse_json_program({whole.dump(), ""}, profiles::nv2a, &back));
  ASSERT_EQ(back.size(), words.size());
  const Json wrongs[] = {"33", "0x", "0xg", -1, 4294967296, 1.5, true, nullptr};
  for (const Json& wrong : wrongs) {
    whole["other_words"]["PSTextureModes"] = wrong;
    EXPECT_NE(complaint(whole), "") << wrong;
    EXPECT_FALSE(parse_json_program({whole.dump(), ""}, profiles::nv2a)) << wrong;
  }
  whole["other_words"] = {{"PSTextureMode", 1}};
  EXPECT_NE(complaint(whole), "");
  EXPECT_FALSE(parse_json_program({whole.dump(), ""}, profiles::nv2a));
}

TEST(JsonSchema, RefusesEveryKeyWithALetterMore) {
  const Json whole = Json::parse(print_json_program({}));
  const Json leaves = whole.flatten();
  int keys = 0;
  for (const auto& [pointer, leaf] : leaves.items()) {
    Json wrong = whole;
    const Json::json_pointer at(pointer);
    if (!wrong[at.parent_pointer()].is_object()) continue;
    wrong[at.parent_pointer()][at.back() + 'x'] = leaf;
    EXPECT_NE(complaint(wrong), "") << pointer;
    EXPECT_FALSE(parse_json_program({wrong.dump(), ""}, profiles::geforce2)) << pointer;
    ++keys;
  }
  EXPECT_EQ(keys, 5 + 2 * (4 * 3 + 8) + 7 * 3);
}

TEST(JsonSchema, RefusesWhatTheParserRefuses) {
  const Json whole = Json::parse(print_json_program({}));
  const std::pair<const char*, Json> wrongs[] = {
      {"/ninebit", "words"},
      {"/version", 2},
      {"/num_general_combiners", 0},
      {"/num_general_combiners", 9},
      {"/num_general_combiners", 1.5},
      {"/color_sum_clamp", 1},
      {"/constant_color0", {0, 0, 0}},
      {"/constant_color0/2", 1.25},
      {"/constant_color1/0", "0"},
      {"/general_combiners", Json::object()},
      {"/general_combiners/0", 3},
      {"/general_combiners/0/rgb/a/input", "e_times_f"},
      {"/general_combiners/0/rgb/a/usage", "blue"},
      {"/general_combiners/0/alpha/b/usage", "rgb"},
      {"/general_combiners/0/alpha/output/ab_dot_product", true},
      {"/general_combiners/0/rgb/output/sum", "zero"},
      {"/general_combiners/0/rgb/output/scale", "by_two"},
      {"/final_combiner/a/mapping", "expand_normal"},
      {"/final_combiner/e/input", "e_times_f"},
      {"/final_combiner/g/usage", "rgb"},
  };
  for (const auto& [pointer, value] : wrongs) {
    Json wrong = whole;
    wrong[Json::json_pointer(pointer)] = value;
    EXPECT_NE(complaint(wrong), "") << pointer;
    EXPECT_FALSE(parse_json_program({wrong.dump(), ""}, profiles::nv2a)) << pointer;
  }
  for (const char* key : {"ninebit", "version"}) {
    Json lacking = whole;
    lacking.erase(key);
    EXPECT_NE(complaint(lacking), "") << key;
  }
}

}  // namespace
}  // namespace ninebit::test
