// validate and compile on whole states. The legality of single settings is tested through the GL entry points.
#include "ninebit/combiner/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kCard = profiles::geforce2;

bool found(const std::vector<StateDiagnostic>& all, std::optional<int> stage, std::optional<PortionName> portion,
           std::optional<Variable> variable, GlError error) {
  return std::any_of(all.begin(), all.end(), [&](const StateDiagnostic& d) {
    return d.stage == stage && d.portion == portion && d.variable == variable && d.gl_error == error &&
           !d.message.empty();
  });
}

CombinerState faulty_state() {
  CombinerState state;
  state.num_general_combiners = 0;
  state.per_stage_constants = true;
  state.general[0].rgb.a.usage = ComponentUsage::blue;
  state.general[0].rgb.b.reg = Register::e_times_f;
  state.general[0].alpha.c = alpha_of(Register::fog);
  state.general[0].alpha.out.ab_dot_product = true;
  state.general[1].rgb.d.reg = Register::texture2;
  state.general[1].rgb.out.ab = Register::spare0;
  state.general[1].alpha.a.usage = ComponentUsage::rgb;
  state.general[1].alpha.out.scale = Scale::by_four;
  state.general[1].alpha.out.bias = Bias::by_negative_one_half;
  state.general[1].alpha.out.cd = Register::fog;
  state.final_combiner.a = rgb_of(Register::spare0_plus_secondary);
  state.final_combiner.b.mapping = InputMapping::expand_normal;
  state.final_combiner.c.usage = ComponentUsage::blue;
  state.final_combiner.e = rgb_of(Register::e_times_f);
  state.final_combiner.f = rgb_of(Register::discard);
  state.final_combiner.g.usage = ComponentUsage::rgb;
  return state;
}

TEST(Validate, DefaultsAreValidEverywhere) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    EXPECT_TRUE(validate(CombinerState{}, profile).empty()) << profile.name;
    CombinerState most;
    most.num_general_combiners = profile.general_combiners;
    EXPECT_TRUE(validate(most, profile).empty()) << profile.name;
    ++most.num_general_combiners;
    EXPECT_EQ(validate(most, profile).size(), 1U) << profile.name;
  }
}

TEST(Validate, AllFaultsOfAStateAreReportedWithTheirPlaces) {
  using enum GlError;
  using enum PortionName;
  const std::vector<StateDiagnostic> all = validate(faulty_state(), kCard);
  EXPECT_EQ(all.size(), 17U);
  EXPECT_TRUE(found(all, {}, {}, {}, invalid_value)) << "no general combiner at all";
  EXPECT_TRUE(found(all, {}, {}, {}, invalid_enum)) << "per-stage constants";
  EXPECT_TRUE(found(all, 0, rgb, Variable::a, invalid_operation)) << "blue in an RGB portion";
  EXPECT_TRUE(found(all, 0, rgb, Variable::b, invalid_enum)) << "E·F in a general combiner";
  EXPECT_TRUE(found(all, 0, alpha, Variable::c, invalid_operation)) << "fog alpha";
  EXPECT_TRUE(found(all, 0, alpha, {}, invalid_value)) << "dot product of alpha";
  EXPECT_TRUE(found(all, 1, rgb, Variable::d, invalid_enum)) << "texture unit 2 of two";
  EXPECT_TRUE(found(all, 1, rgb, {}, invalid_operation)) << "two outputs to spare0";
  EXPECT_TRUE(found(all, 1, alpha, Variable::a, invalid_operation)) << "rgb in an alpha portion";
  EXPECT_TRUE(found(all, 1, alpha, {}, invalid_operation)) << "bias with scale by four";
  EXPECT_TRUE(found(all, 1, alpha, {}, invalid_enum)) << "fog as an output";
  EXPECT_TRUE(found(all, {}, {}, Variable::a, invalid_operation)) << "colour sum in A";
  EXPECT_TRUE(found(all, {}, {}, Variable::b, invalid_enum)) << "a signed mapping";
  EXPECT_TRUE(found(all, {}, {}, Variable::c, invalid_operation)) << "blue outside G";
  EXPECT_TRUE(found(all, {}, {}, Variable::e, invalid_operation)) << "E·F in E";
  EXPECT_TRUE(found(all, {}, {}, Variable::f, invalid_enum)) << "discard as an input";
  EXPECT_TRUE(found(all, {}, {}, Variable::g, invalid_operation)) << "rgb in G";
}

// Features that the NV2A's registers have and GL does not.
TEST(Validate, AProfileWithoutTheBitRefusesIt) {
  CombinerState state;
  state.mux_by_lowest_bit = true;
  for (const HardwareProfile& profile : hardware_profiles()) {
    const std::vector<StateDiagnostic> all = validate(state, profile);
    if (profile.mux_by_lowest_bit) {
      EXPECT_TRUE(all.empty()) << profile.name;
      continue;
    }
    ASSERT_EQ(all.size(), 1U) << profile.name;
    EXPECT_EQ(all[0].parameter, StateParameter::mux_by_lowest_bit);
    EXPECT_EQ(all[0].gl_error, GlError::invalid_enum);
    EXPECT_EQ(all[0].message,
              "profile " + std::string(profile.name) + " has no mux by the lowest bit of spare0's alpha (NV2A)");
  }
}

TEST(Validate, AColorSumWithoutInvertsRefusesThem) {
  for (const bool spare0 : {true, false}) {
    CombinerState state;
    (spare0 ? state.color_sum_invert_spare0 : state.color_sum_invert_secondary) = true;
    for (const HardwareProfile& profile : hardware_profiles()) {
      const std::vector<StateDiagnostic> all = validate(state, profile);
      ASSERT_EQ(all.size(), profile.color_sum_inverts ? 0U : 1U) << profile.name;
      if (all.empty()) continue;
      EXPECT_EQ(all[0].parameter, StateParameter::color_sum_inverts);
      EXPECT_EQ(all[0].gl_error, GlError::invalid_enum);
      EXPECT_EQ(all[0].message, "profile " + std::string(profile.name) + " has no 1 - x in the colour sum (NV2A)");
    }
  }
}

TEST(Validate, BlueToAlphaIsOfRgbPortionsAndOfProfilesThatHaveIt) {
  CombinerState state;
  state.general[1].rgb.out.ab_blue_to_alpha = true;
  for (const HardwareProfile& profile : hardware_profiles()) {
    const std::vector<StateDiagnostic> all = validate(state, profile);
    ASSERT_EQ(all.size(), profile.blue_to_alpha ? 0U : 1U) << profile.name;
    if (all.empty()) continue;
    EXPECT_TRUE(found(all, 1, PortionName::rgb, {}, GlError::invalid_enum));
    EXPECT_NE(all[0].message.find("has no blue-to-alpha outputs (NV2A)"), std::string::npos);
  }
  state.general[1].alpha.out.cd_blue_to_alpha = true;
  const std::vector<StateDiagnostic> all = validate(state, profiles::nv2a);
  EXPECT_EQ(all.size(), 1U);
  EXPECT_TRUE(found(all, 1, PortionName::alpha, {}, GlError::invalid_value));
}

TEST(Validate, MessagesNameThePlace) {
  const std::vector<StateDiagnostic> all = validate(faulty_state(), kCard);
  const auto message_of = [&](std::optional<int> stage, std::optional<Variable> variable) {
    for (const StateDiagnostic& d : all) {
      if (d.stage == stage && d.variable == variable) return d.message;
    }
    return std::string();
  };
  EXPECT_NE(message_of(1, Variable::d).find("general combiner 1, RGB portion, variable D"), std::string::npos);
  EXPECT_NE(message_of(1, Variable::d).find("texture2"), std::string::npos);
  EXPECT_NE(message_of({}, Variable::g).find("final combiner, variable G"), std::string::npos);
}

TEST(Validate, CompileReportsEveryFaultOnItsOwnLine) {
  const Result<Program> program = compile(faulty_state(), kCard);
  ASSERT_FALSE(program.ok());
  const std::string& text = program.error().message;
  const std::vector<StateDiagnostic> all = validate(faulty_state(), kCard);
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1, all.size());
  for (const StateDiagnostic& d : all) EXPECT_NE(text.find(d.message), std::string::npos) << d.message;
  EXPECT_EQ(program.error().fault, Fault::invalid_input);
}

TEST(Validate, CompileGivesTheNormalizedProgramOfAValidState) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    const Result<Program> program = compile(CombinerState{}, profile);
    ASSERT_TRUE(program.ok());
    EXPECT_EQ(*program, normalize(CombinerState{}, profile));
  }
}

TEST(Validate, StagesThatDoNotRunAreCheckedToo) {
  CombinerState state;
  state.general[1].rgb.a.usage = ComponentUsage::blue;
  EXPECT_EQ(validate(state, kCard).size(), 1U);
}

TEST(Validate, NumbersWithoutANameAreReported) {
  using enum GlError;
  CombinerState state;
  Portion& rgb = state.general[0].rgb;
  rgb.a.reg = static_cast<Register>(200);
  rgb.b.mapping = static_cast<InputMapping>(8);
  rgb.c.usage = static_cast<ComponentUsage>(3);
  rgb.out.ab = static_cast<Register>(15);
  rgb.out.scale = static_cast<Scale>(4);
  state.general[0].alpha.out.bias = static_cast<Bias>(2);
  state.final_combiner.d.reg = static_cast<Register>(99);
  state.final_combiner.e.mapping = static_cast<InputMapping>(250);
  state.final_combiner.f.usage = static_cast<ComponentUsage>(77);
  const std::vector<StateDiagnostic> all = validate(state, kCard);
  EXPECT_EQ(all.size(), 9U);
  for (const StateDiagnostic& d : all) {
    EXPECT_EQ(d.gl_error, invalid_enum) << d.message;
    EXPECT_NE(d.message.find("unknown"), std::string::npos) << d.message;
  }
}

TEST(Validate, NamesOfErrors) {
  EXPECT_EQ(name_of(GlError::no_error), "GL_NO_ERROR");
  EXPECT_EQ(name_of(GlError::invalid_enum), "GL_INVALID_ENUM");
  EXPECT_EQ(name_of(GlError::invalid_value), "GL_INVALID_VALUE");
  EXPECT_EQ(name_of(GlError::invalid_operation), "GL_INVALID_OPERATION");
}

// The oracles must not know what they judge: they include headers of plain data, and each other; those of the combiners
// only each other.
TEST(Oracle, IncludesNothingButPlainHeaders) {
  const std::set<std::string> combiner{"ninebit/combiner/registers.h", "ninebit/combiner/state.h",
                                       "ninebit/numerics/hardware_profile.h"};
  const std::set<std::string> others{"ninebit/combiner/initial_registers.h",
                                     "ninebit/numerics/hardware_profile.h",
                                     "ninebit/raster/pipeline_state.h",
                                     "ninebit/raster/sampler.h",
                                     "ninebit/raster/surface.h",
                                     "ninebit/texture_shader/stage_program.h",
                                     "ninebit/texture_shader/stage_state.h"};
  const std::set<std::string> of_combiner{"combiner_oracle.h", "combiner_oracle.cpp", "real_oracle.h",
                                          "exact_oracle.cpp", "float_oracle.cpp"};
  const std::string folder = "combiner_tests/oracle/";
  int ours = 0, files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(NINEBIT_SOURCE_DIR) / folder)) {
    const std::string name = entry.path().filename().string();
    const std::set<std::string>& allowed = of_combiner.count(name) != 0 ? combiner : others;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (line.rfind("#include", 0) != 0) continue;
      const std::size_t begin = line.find_first_of("<\"") + 1;
      const std::string header = line.substr(begin, line.find_first_of(">\"", begin) - begin);
      const bool in_folder = header.rfind(folder, 0) == 0;
      const bool beside = in_folder && (&allowed == &others || of_combiner.count(header.substr(folder.size())) != 0);
      if (beside || (line[begin - 1] == '<' && header.find("ninebit") == std::string::npos)) continue;
      EXPECT_EQ(allowed.count(header), 1U) << name << ": " << header;
      ++ours;
    }
    ++files;
  }
  EXPECT_GE(files, 16);
  EXPECT_GE(ours, 13);
}

}  // namespace
}  // namespace ninebit::test
