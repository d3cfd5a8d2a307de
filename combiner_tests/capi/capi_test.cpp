// The C interface gives what the library gives, and refuses what cannot be meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "combiner_tests/capi/support.h"
#include "ninebit/capi/combiner.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/trace_json.h"

namespace ninebit::test {
namespace {

TEST(Capi, RandomProgramsGiveTheLibrarysBits) {
  constexpr std::size_t kFragments = 700;  // two batches and a piece of one
  int different_colors = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    SCOPED_TRACE(index);
    Random random(0xCA91, index);
    const auto profiles = hardware_profiles();
    const HardwareProfile& profile =
        profiles[static_cast<std::size_t>(random.below(static_cast<int>(profiles.size())))];
    const CombinerState state = random_state(random, profile);
    const ProgramHandle program = compiled(profile, state);
    ASSERT_NE(program, nullptr);
    const Program expected = *compile(state, profile);

    std::vector<RegisterFile> fragments;
    std::array<std::array<std::vector<std::int16_t>, 4>, NINEBIT_REGISTERS> inputs;
    for (std::size_t i = 0; i < kFragments; ++i) {
      fragments.push_back(random_registers(random, profile));
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) inputs[r][c].push_back(fragments.back().value[r][c]);
      }
    }
    std::array<std::vector<std::int16_t>, 4> colors;
    colors.fill(std::vector<std::int16_t>(kFragments, -1));
    ninebit_planes planes{};
    planes.struct_size = sizeof planes;
    planes.count = kFragments;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = 0; r < kRegisterCount; ++r) planes.input[r][c] = inputs[r][c].data();
      planes.color[c] = colors[c].data();
    }
    ASSERT_EQ(ninebit_evaluate_planes(program.get(), &planes, nullptr), NINEBIT_OK);
    for (std::size_t i = 0; i < kFragments; ++i) {
      const EvaluatedFragment right = evaluate_fragment(expected, fragments[i]);
      const Rgba9 color{colors[0][i], colors[1][i], colors[2][i], colors[3][i]};
      ASSERT_EQ(color, right.color) << i;
      different_colors += color != Rgba9{} ? 1 : 0;
    }
    const ninebit_registers registers = registers_of(fragments[0]);
    ninebit_registers after{};
    after.struct_size = sizeof after;
    std::array<std::int16_t, 4> color{};
    ASSERT_EQ(ninebit_evaluate(program.get(), &registers, color.data(), &after, nullptr), NINEBIT_OK);
    const EvaluatedFragment right = evaluate_fragment(expected, fragments[0]);
    EXPECT_EQ(color, right.color);
    for (std::size_t r = NINEBIT_FOG; r < kRegisterCount; ++r) {
      EXPECT_TRUE(std::equal(after.code[r], after.code[r] + 4, right.registers.value[r].begin())) << r;
    }
  }
  EXPECT_GT(different_colors, 1000);
}

TEST(Capi, TraceAndGlslAreTheLibrarys) {
  Random random(0xCA92);
  const CombinerState state = random_state(random, profiles::geforce2);
  const RegisterFile registers = random_registers(random, profiles::geforce2);
  const ProgramHandle program = compiled(profiles::geforce2, state);
  const Program expected = *compile(state, profiles::geforce2);
  const ninebit_registers in = registers_of(registers);
  char* text = nullptr;
  ASSERT_EQ(ninebit_trace_json(program.get(), &in, &text, nullptr), NINEBIT_OK);
  RegisterFile read = registers;  // zero and the constants are not read, and so not told
  read[Register::zero] = read[Register::constant0] = read[Register::constant1] = {};
  EXPECT_EQ(take(text), print_json_trace(expected, trace(expected, profiles::geforce2, read)));
  ASSERT_EQ(ninebit_emit_glsl(program.get(), 300, "mine", &text, nullptr), NINEBIT_OK);
  EXPECT_EQ(take(text), *emit_glsl(expected, GlslVersion::es_300, "mine"));
  EXPECT_EQ(ninebit_one(program.get()), 255);
  EXPECT_EQ(ninebit_lowest(program.get()), -255);
}

TEST(Capi, EveryFormThereAndBack) {
  Random random(0xCA93);
  for (const int form :
       {NINEBIT_FORM_GL_CALLS, NINEBIT_FORM_NV10_WORDS, NINEBIT_FORM_NV10_WORDS_JSON, NINEBIT_FORM_JSON}) {
    SCOPED_TRACE(form);
    const CombinerState state = random_state(random, profiles::geforce2);
    const StateHandle first = parsed(profiles::geforce2, NINEBIT_FORM_JSON, print_json_program(state));
    char* text = nullptr;
    ASSERT_EQ(ninebit_state_print(first.get(), form, &text, nullptr), NINEBIT_OK);
    const StateHandle second = parsed(profiles::geforce2, form, take(text));
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(*compile(json_of(second.get()), profiles::geforce2), *compile(state, profiles::geforce2));
  }
}

TEST(Capi, StagesGoThroughStates) {
  const std::string text = "!!TS1.0\ntexture_2d();\ndependent_ar(tex0);\n!!RC1.0\nout.rgb = tex1;\n";
  ninebit_state* state = nullptr;
  char* error = nullptr;
  ASSERT_EQ(ninebit_state_parse("nv2a", NINEBIT_FORM_RC10, text.data(), text.size(), &state, &error), NINEBIT_OK);
  char* json = nullptr;
  ASSERT_EQ(ninebit_state_print(state, NINEBIT_FORM_JSON, &json, &error), NINEBIT_OK);
  EXPECT_NE(std::string(json).find("{\"operation\": \"dependent_ar\"}"), std::string::npos) << json;
  ninebit_free_text(json);
  ninebit_report* report = nullptr;
  ASSERT_EQ(ninebit_validate(state, &report, &error), NINEBIT_OK);
  EXPECT_EQ(ninebit_report_count(report), 0U);
  ninebit_report_free(report);
  ninebit_state_free(state);
  ASSERT_EQ(ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text.data(), text.size(), &state, &error),
            NINEBIT_INVALID_INPUT);
  EXPECT_NE(std::string(error).find("GL_INVALID_ENUM: profile geforce2 has no texture shaders"), std::string::npos);
  ninebit_free_text(error);
}

TEST(Capi, StagesReadTexelsByACallback) {
  const std::string text =
      "!!TS1.0\ntexture_2d();\noffset_2d(tex0, 0.5, 0, 0, 1);\n"
      "cull_fragment(GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO);\n!!RC1.0\nout.rgb = tex1;\n";
  const auto program_of = [](const std::string& source) {
    ninebit_state* made = nullptr;
    EXPECT_EQ(ninebit_state_parse("nv2a", NINEBIT_FORM_RC10, source.data(), source.size(), &made, nullptr), NINEBIT_OK);
    const StateHandle state(made);
    ninebit_program* program = nullptr;
    EXPECT_EQ(ninebit_compile(state.get(), &program, nullptr), NINEBIT_OK);
    return ProgramHandle(program);
  };
  const auto program = program_of(text);
  // Unit 0 has ds = 0.5 and dt = -0.25; unit 1 shows where it is read, in sixteenths.
  const auto read = [](void* data, int unit, const float place[3], std::uint8_t texel[4]) {
    ++*static_cast<int*>(data);
    const std::array<std::uint8_t, 4> offset{0, 224, 64, 9};
    for (std::size_t k = 0; k < 4; ++k) {
      texel[k] = unit == 0 ? offset[k] : k < 2 ? static_cast<std::uint8_t>(16 * place[k]) : std::uint8_t{7};
    }
  };
  std::array<float, 16> at{0, 0, 0, 1, 0.5F, 0.5F, 0, 1, 0, 0, 0, -1, 0, 0, 0, 1};
  ninebit_registers registers{.struct_size = sizeof(registers), .code = {}};
  ninebit_fate fate{.struct_size = sizeof(fate), .culled = 5, .depth_is_set = 5, .depth = 5};
  int calls = 0;
  ASSERT_EQ(ninebit_run_stages(program.get(), at.data(), read, &calls, &registers, &fate, nullptr), NINEBIT_OK);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(registers.code[NINEBIT_TEXTURE0 + 1][0], 12);
  EXPECT_EQ(registers.code[NINEBIT_TEXTURE0 + 1][1], 4);
  EXPECT_EQ(registers.code[NINEBIT_SPARE0][3], registers.code[NINEBIT_TEXTURE0][3]);
  EXPECT_EQ(fate.culled, 1);
  EXPECT_EQ(fate.depth_is_set, 0);
  EXPECT_EQ(fate.depth, 0);
  at[11] = 1;
  ASSERT_EQ(ninebit_run_stages(program.get(), at.data(), read, &calls, &registers, &fate, nullptr), NINEBIT_OK);
  EXPECT_EQ(fate.culled, 0);
  EXPECT_EQ(ninebit_run_stages(program.get(), at.data(), nullptr, &calls, &registers, &fate, nullptr),
            NINEBIT_WRONG_ARGUMENT);
  fate.struct_size = 1;
  EXPECT_EQ(ninebit_run_stages(program.get(), at.data(), read, &calls, &registers, &fate, nullptr),
            NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_run_stages(program_of("!!RC1.0\nout.rgb = tex1;\n").get(), at.data(), read, &calls, &registers,
                               nullptr, nullptr),
            NINEBIT_INVALID_INPUT);
}

TEST(Capi, WordsByName) {
  const std::array<ninebit_word, 2> words{{{"RC_IN_RGB[0]", 0x04200000}, {"RC_OUT_RGB[0]", 0x00000C00}}};
  ninebit_state* made = nullptr;
  ASSERT_EQ(ninebit_state_from_words("nv2a", NINEBIT_CHIP_NV20, words.data(), words.size(), &made, nullptr),
            NINEBIT_OK);
  const StateHandle state(made);
  const auto expected =
      parse_register_words({"RC_IN_RGB[0] = 0x04200000\nRC_OUT_RGB[0] = 0xC00\n", {}}, ChipClass::nv20, profiles::nv2a);
  EXPECT_EQ(json_of(state.get()), *expected);

  const std::array<ninebit_word, 1> wrong{{{"RC_NONE", 0}}};
  char* error = nullptr;
  EXPECT_EQ(ninebit_state_from_words("nv2a", NINEBIT_CHIP_NV20, wrong.data(), 1, &made, &error), NINEBIT_INVALID_INPUT);
  EXPECT_EQ(made, nullptr);
  EXPECT_NE(take(error).find("RC_NONE"), std::string::npos);
}

TEST(Capi, CallsOfGl) {
  using namespace ninebit::gl;
  ninebit_state* made = nullptr;
  ASSERT_EQ(ninebit_state_create("nv2a", &made, nullptr), NINEBIT_OK);
  const StateHandle state(made);
  const std::array<float, 4> color{0.25F, 0.5F, 0.75F, 1};
  EXPECT_EQ(ninebit_gl_combiner_parameteri(made, GL_NUM_GENERAL_COMBINERS_NV, 2), 0U);
  EXPECT_EQ(ninebit_gl_combiner_parameterfv(made, GL_CONSTANT_COLOR0_NV, color.data()), 0U);
  EXPECT_EQ(ninebit_gl_combiner_input(made, GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB,
                                      GL_EXPAND_NORMAL_NV, GL_RGB),
            0U);
  EXPECT_EQ(ninebit_gl_combiner_output(made, GL_COMBINER1_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE1_NV,
                                       GL_SCALE_BY_TWO_NV, GL_NONE, 0, 0, 1),
            0U);
  EXPECT_EQ(ninebit_gl_final_combiner_input(made, GL_VARIABLE_B_NV, GL_SPARE1_NV, GL_UNSIGNED_INVERT_NV, GL_RGB), 0U);
  EXPECT_EQ(ninebit_gl_combiner_stage_parameterfv(made, GL_COMBINER1_NV, GL_CONSTANT_COLOR1_NV, color.data()), 0U);
  EXPECT_EQ(ninebit_gl_enable(made, GL_PER_STAGE_CONSTANTS_NV, 1), 0U);

  CombinerState expected;
  expected.num_general_combiners = 2;
  expected.per_stage_constants = true;
  expected.constant0 = expected.general[1].constant1 = color;
  expected.general[1].rgb.b = {Register::texture0, InputMapping::expand_normal, ComponentUsage::rgb};
  expected.general[1].rgb.out.sum = Register::spare1;
  expected.general[1].rgb.out.scale = Scale::by_two;
  expected.general[1].rgb.out.mux_sum = true;
  expected.final_combiner.b = {Register::spare1, InputMapping::unsigned_invert, ComponentUsage::rgb};
  EXPECT_EQ(json_of(made), expected);

  // A refused call changes nothing, and does not stand in the way of the next.
  EXPECT_EQ(ninebit_gl_combiner_parameteri(made, GL_NUM_GENERAL_COMBINERS_NV, 9), 0x0501U);
  EXPECT_EQ(ninebit_gl_combiner_input(made, GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_SPARE0_NV,
                                      GL_UNSIGNED_IDENTITY_NV, GL_RGB),
            0x0502U);
  EXPECT_EQ(ninebit_gl_combiner_parameterfv(made, GL_CONSTANT_COLOR0_NV, nullptr), 0x0501U);
  EXPECT_EQ(ninebit_gl_enable(nullptr, GL_PER_STAGE_CONSTANTS_NV, 1), 0x0502U);
  EXPECT_EQ(json_of(made), expected);
  EXPECT_EQ(ninebit_gl_enable(made, GL_PER_STAGE_CONSTANTS_NV, 0), 0U);
}

TEST(Capi, DiagnosticsOfAnInvalidState) {
  CombinerState state;
  state.general[0].alpha.out.ab_dot_product = true;
  state.num_general_combiners = 3;
  const StateHandle handle = parsed(profiles::nv2a, NINEBIT_FORM_JSON, print_json_program(CombinerState{}));
  ASSERT_NE(handle, nullptr);
  ninebit_report* made = nullptr;
  ASSERT_EQ(ninebit_validate(handle.get(), &made, nullptr), NINEBIT_OK);
  EXPECT_EQ(ninebit_report_count(made), 0U);
  ninebit_report_free(made);

  // GL's calls cannot make an invalid state, but three general combiners are too many for another chip.
  char* error = nullptr;
  ninebit_state* refused = nullptr;
  const std::string text = print_json_program(state);
  EXPECT_EQ(ninebit_state_parse("geforce2", NINEBIT_FORM_JSON, text.data(), text.size(), &refused, &error),
            NINEBIT_INVALID_INPUT);
  EXPECT_EQ(refused, nullptr);
  EXPECT_NE(take(error).find("GL_INVALID_VALUE"), std::string::npos);
}

TEST(Capi, WhatCannotBeMeant) {
  char* error = nullptr;
  ninebit_state* state = nullptr;
  EXPECT_EQ(ninebit_state_create("voodoo", &state, &error), NINEBIT_WRONG_ARGUMENT);
  EXPECT_NE(take(error).find("geforce2"), std::string::npos);
  EXPECT_EQ(ninebit_state_create("geforce2", nullptr, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_state_parse(nullptr, 7, "", 0, &state, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_state_parse(nullptr, -1, "", 0, &state, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_state_parse(nullptr, NINEBIT_FORM_RC10, nullptr, 5, &state, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_compile(nullptr, nullptr, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_report_count(nullptr), 0U);
  ninebit_state_free(nullptr);
  ninebit_program_free(nullptr);
  ninebit_report_free(nullptr);
  ninebit_free_text(nullptr);

  const ProgramHandle program = compiled(profiles::geforce2, CombinerState{});
  ninebit_registers registers{};
  std::array<std::int16_t, 4> color{};
  EXPECT_EQ(ninebit_evaluate(program.get(), &registers, color.data(), nullptr, nullptr), NINEBIT_WRONG_ARGUMENT)
      << "without struct_size";
  registers.struct_size = sizeof registers;
  registers.code[NINEBIT_SPARE0][3] = 256;
  EXPECT_EQ(ninebit_evaluate(program.get(), &registers, color.data(), nullptr, &error), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(take(error), "code 256 is out of range; expected -255 to 255");
  registers.code[NINEBIT_SPARE0][3] = 0;
  registers.code[NINEBIT_ZERO][0] = 9999;  // not read
  EXPECT_EQ(ninebit_evaluate(program.get(), &registers, color.data(), nullptr, &error), NINEBIT_OK);
  EXPECT_EQ(error, nullptr);

  std::vector<std::int16_t> plane(300, 0), out(300, 77);
  plane[299] = -256;
  ninebit_planes planes{};
  planes.struct_size = sizeof planes;
  planes.count = plane.size();
  planes.input[NINEBIT_PRIMARY][0] = plane.data();
  planes.color[0] = out.data();
  EXPECT_EQ(ninebit_evaluate_planes(program.get(), &planes, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(out, std::vector<std::int16_t>(300, 77)) << "nothing is written";
  planes.count = 0;
  EXPECT_EQ(ninebit_evaluate_planes(program.get(), &planes, nullptr), NINEBIT_OK);
  planes.struct_size = 8;
  EXPECT_EQ(ninebit_evaluate_planes(program.get(), &planes, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_emit_glsl(program.get(), 100, nullptr, &error, nullptr), NINEBIT_WRONG_ARGUMENT);
  EXPECT_EQ(ninebit_emit_glsl(program.get(), 330, "gl_mine", &error, nullptr), NINEBIT_INVALID_INPUT);
}

TEST(Capi, InitialRegistersAreTheProfiles) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    SCOPED_TRACE(profile.name);
    const ProgramHandle program = compiled(profile, CombinerState{});
    ninebit_inputs inputs{};
    inputs.struct_size = sizeof inputs;
    FragmentInputs same;
    for (std::uint8_t c = 0; c < 4; ++c) {
      inputs.primary[c] = same.primary[c] = static_cast<std::uint8_t>(10 + c);
      inputs.secondary[c] = same.secondary[c] = static_cast<std::uint8_t>(250 - c);
    }
    inputs.fog_enabled = 1;
    inputs.fog_factor = 99;
    same.fog_factor = std::uint8_t{99};
    inputs.texture_enabled[1] = 1;
    inputs.texture[1][2] = 200;
    same.texture[1] = Texel{.value = {0, 0, 200, 0}};
    ninebit_registers registers{};
    registers.struct_size = sizeof registers;
    ASSERT_EQ(ninebit_initial_registers(program.get(), &inputs, &registers, nullptr), NINEBIT_OK);
    const RegisterFile expected = initial_registers(profile, same);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      EXPECT_TRUE(std::equal(registers.code[r], registers.code[r] + 4, expected.value[r].begin())) << r;
    }
  }
}

TEST(Capi, ProfilesByNumber) {
  std::size_t count = 0;
  while (const char* const name = ninebit_profile_name(count)) EXPECT_EQ(name, hardware_profiles()[count++].name);
  EXPECT_EQ(count, hardware_profiles().size());
  EXPECT_STREQ(ninebit_version(), NINEBIT_VERSION);
}

}  // namespace
}  // namespace ninebit::test
