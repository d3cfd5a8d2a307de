// The tables of combiner_tests/hardware: what pictures from an NV2A show, run under the profile nv2a by every path.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/hardware/csv.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kXbox = profiles::nv2a;

// Whether `allowed`, one number or several between bars, holds the value.
bool allows(const std::string& allowed, int value) {
  std::istringstream numbers(allowed);
  for (std::string number; std::getline(numbers, number, '|');) {
    if (std::stoi(number) == value) return true;
  }
  return false;
}

TEST(HardwareRows, GeneralCombinerOutputOptions) {
  const std::map<std::string, std::pair<Scale, Bias>> options{
      {"IDENTITY", {Scale::none, Bias::none}}, {"BIAS", {Scale::none, Bias::by_negative_one_half}},
      {"SHL1", {Scale::by_two, Bias::none}},   {"SHL1_BIAS", {Scale::by_two, Bias::by_negative_one_half}},
      {"SHL2", {Scale::by_four, Bias::none}},  {"SHR1", {Scale::by_one_half, Bias::none}}};
  int rows = 0;
  for (const auto& row : read_hardware_table("nv2a_combiner_ops")) {
    const auto& [scale, bias] = options.at(row.at("op"));
    CombinerState state =
        rgb_stage({rgb_of(Register::constant0), kOne, kZero, kZero, ab_to(Register::spare0, scale, bias)});
    state.general[0].alpha = of_alpha(state.general[0].rgb);
    state.general[0].alpha.a.usage = ComponentUsage::blue;
    state.constant0 = color_of(25, 63, 255, 0);
    state.final_combiner = final_of(Register::spare0);
    const Rgba9 color = judged(state, kXbox, RegisterFile{}).color;
    const std::string& channel = row.at("channel");
    const int actual = color[channel == "R" ? 0 : channel == "G" ? 1 : channel == "B" ? 2 : 3];
    EXPECT_TRUE(allows(row.at("hw_out"), actual)) << row.at("op") << ' ' << channel << ": " << actual;
    EXPECT_EQ(actual, std::stoi(row.at("model_out")));
    ++rows;
  }
  EXPECT_EQ(rows, 24);
}

TEST(HardwareRows, MuxByTheHighestAndByTheLowestBit) {
  int rows = 0;
  for (const auto& row : read_hardware_table("nv2a_mux")) {
    CombinerState state = silent_state(2);
    state.mux_by_lowest_bit = row.at("mux_select") == "LSB";
    state.per_stage_constants = true;
    state.general[0].constant0 = color_of(0, 0, 0, std::stoi(row.at("spare0_alpha_byte")));
    state.general[0].alpha = {alpha_of(Register::constant0), kOneAlpha, kZeroAlpha, kZeroAlpha,
                              ab_to(Register::spare0)};
    state.general[1].constant0 = color_of(255, 0, 0, 0);
    state.general[1].constant1 = color_of(0, 0, 255, 0);
    state.general[1].rgb = {rgb_of(Register::constant0), kOne, rgb_of(Register::constant1), kOne,
                            mux_to(Register::primary)};
    state.final_combiner = final_of(Register::primary);
    state.final_combiner.g = alpha_of(Register::zero, InputMapping::unsigned_invert);
    EXPECT_EQ(judged(state, kXbox, RegisterFile{}).color,
              codes(std::stoi(row.at("R")), std::stoi(row.at("G")), std::stoi(row.at("B")), std::stoi(row.at("A"))))
        << row.at("mux_select") << ' ' << row.at("spare0_alpha_byte");
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

// The state and registers that a row's case describes; false: no such case.
bool case_of(const std::string& name, CombinerState& state, RegisterFile& registers) {
  state = silent_state(1);
  registers = {};
  FinalCombiner& f = state.final_combiner;
  f.a = f.e = rgb_of(Register::constant0);
  f.b = rgb_of(Register::spare0_plus_secondary);
  f.f = rgb_of(Register::constant1);
  if (name == "Uncapped" || name == "Capped") {
    state.color_sum_clamp = name == "Capped";
    state.constant0 = color_of(127, 127, 127, 0);
    registers[Register::spare0] = registers[Register::secondary] = codes(255, 255, 255, 0);
  } else if (name == "Normal R0" || name == "V1" || name == "1-R0" || name == "1-V1") {
    state.constant0 = color_of(255, 255, 255, 0);
    registers[name.ends_with("V1") ? Register::secondary : Register::spare0] = codes(191, 191, 191, 0);
    state.color_sum_invert_spare0 = name == "1-R0";
    state.color_sum_invert_secondary = name == "1-V1";
  } else if (name == "EFProd") {
    f.a = f.b = kZero;
    f.d = rgb_of(Register::e_times_f);
    state.constant0 = color_of(255, 191, 127, 0);
    state.constant1 = color_of(127, 127, 127, 0);
  } else if (name == "SUM" || name == "SUM inv R0" || name == "SUM inv V1") {
    state.color_sum_invert_spare0 = name == "SUM inv R0";
    state.color_sum_invert_secondary = name == "SUM inv V1";
    f.a = f.b = kZero;
    f.d = rgb_of(Register::spare0_plus_secondary);
    registers[Register::spare0] = codes(63, 127, 191, 0);
    registers[Register::secondary] = codes(178, 127, 38, 0);
  } else if (name == "R1=old R0") {
    state.constant0 = color_of(255, 0, 0, 0);
    registers[Register::spare0] = codes(0, 255, 0, 0);
    state.general[0].rgb = {rgb_of(Register::constant0),
                            kOne,
                            rgb_of(Register::spare0),
                            kOne,
                            {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard}};
    f = final_of(Register::spare1);
  } else if (name == "alpha reads old R0.blue") {
    // Blended by alpha 0, the picture shows the diffuse colour below: all of it.
    state.constant0 = color_of(0, 0, 255, 0);
    state.general[0].rgb = {rgb_of(Register::constant0), kOne, kZero, kZero, ab_to(Register::spare0)};
    state.general[0].alpha = {blue_of(Register::spare0), kOneAlpha, kZeroAlpha, kZeroAlpha, ab_to(Register::spare0)};
    registers[Register::primary] = codes(25, 255, 25, 255);
    // Frame-buffer blending's formula, in the final combiner: alpha 0 keeps C.
    f = final_of(Register::zero);
    f.a = alpha_of(Register::spare0);
    f.b = rgb_of(Register::spare0);
    f.c = rgb_of(Register::primary);
  } else if (name == "blue->alpha CD" || name == "blue->alpha AB") {
    state = silent_state(3);
    state.per_stage_constants = true;
    state.general[0].constant0 = color_of(0, 0, 63, 0);
    state.general[1].constant0 = color_of(0, 0, 191, 0);
    state.general[0].rgb = {rgb_of(Register::constant0), kOne, kZero, kZero, ab_to(Register::spare0)};
    state.general[1].rgb = {rgb_of(Register::constant0),
                            kOne,
                            rgb_of(Register::spare0),
                            kOne,
                            {.ab = Register::spare0,
                             .cd = Register::spare1,
                             .sum = Register::discard,
                             .ab_blue_to_alpha = true,
                             .cd_blue_to_alpha = true}};
    const Register shown = name == "blue->alpha AB" ? Register::spare0 : Register::spare1;
    state.general[2].rgb = {alpha_of(shown), kOne, kZero, kZero, ab_to(shown)};
    f = final_of(shown);
  } else if (name == "tex0 rgb unbound" || name == "tex0 alpha unbound") {
    registers = initial_registers(kXbox, {});
    f = final_of(Register::texture0);
    if (name == "tex0 alpha unbound") f.d = alpha_of(Register::texture0);
  } else {
    return false;
  }
  return true;
}

TEST(HardwareRows, FinalCombinerFlagsAndSpecialInputs) {
  int rows = 0;
  for (const auto& row : read_hardware_table("nv2a_final_flags_special")) {
    CombinerState state;
    RegisterFile registers;
    ASSERT_TRUE(case_of(row.at("case"), state, registers)) << row.at("case");
    const Rgba9 color = judged(state, kXbox, registers).color;
    EXPECT_EQ(codes(color[0], color[1], color[2], 0),
              codes(std::stoi(row.at("R")), std::stoi(row.at("G")), std::stoi(row.at("B")), 0))
        << row.at("case");
    ++rows;
  }
  EXPECT_EQ(rows, 16);
}

TEST(HardwareRows, FinalCombinerProductOfTexelAndVertexColor) {
  int rows = 0;
  for (const auto& row : read_hardware_table("nv2a_final_AB_pointparams")) {
    const std::uint8_t diffuse = byte_of_vertex_color(kXbox, std::stof(row.at("diffuse_float")));
    CombinerState state = silent_state(1);
    state.final_combiner.a = rgb_of(Register::texture3);
    state.final_combiner.b = rgb_of(Register::primary);
    for (const auto& [texel, column] : {std::pair{255, "hw_full"}, std::pair{51, "hw_dim"}}) {
      FragmentInputs inputs;
      inputs.primary = {diffuse, diffuse, diffuse, 255};
      const auto byte = static_cast<std::uint8_t>(texel);
      inputs.texture[3] = Texel{.value = {byte, byte, byte, byte}};
      const int expected = std::stoi(row.at(column));
      const Rgba9 color = judged(state, kXbox, initial_registers(kXbox, inputs)).color;
      EXPECT_EQ(codes(color[0], color[1], color[2], 0), codes(expected, expected, expected, 0))
          << row.at("diffuse_float") << ' ' << column;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 273);
}

}  // namespace
}  // namespace ninebit::test
