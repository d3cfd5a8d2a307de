// Texts of NV_vertex_program: what is read, what is refused and where, and their translation.
#include <gtest/gtest.h>

#include <string>

#include "src/gl_layer/vertex_program/vertex_program.h"

namespace ninebit::gl_layer {
namespace {

std::optional<VertexProgram> parse(const std::string& text, VertexFault& fault) {
  const auto kind = text.starts_with("!!VSP") ? VertexProgramKind::state : VertexProgramKind::vertex;
  return parse_vertex_program(text, kind, true, fault);
}

std::string translated(const std::string& text, const TrackedMatrices& matrices = {}, unsigned arrays = 0) {
  VertexFault fault;
  const auto program = parse(text, fault);
  return program ? translate_vertex_program(*program, matrices, arrays) : "refused: " + fault.message;
}

// The lines behind the declarations and initial values of a translation.
std::string code_of(const std::string& text) {
  const std::string all = translated(text);
  std::size_t begin = 0;
  for (std::size_t at = 0; (at = all.find(", initial", at)) != std::string::npos; ++at) begin = all.find('\n', at) + 1;
  return all.substr(begin);
}

const std::string kPosition = "MOV o[HPOS], v[OPOS];";

TEST(VertexProgramText, Translation) {
  TrackedMatrices matrices{};
  matrices[0] = {.source = MatrixSource::modelview_projection};
  matrices[1] = {.source = MatrixSource::texture, .number = 3, .transform = MatrixTransform::inverse_transpose};
  const std::string text =
      "!!VP1.0 # a comment; END\n"
      "DP4 o[HPOS].x, c[0], v[OPOS];\nDP4 o[HPOS].y, c[1], v[0];\tMUL R1.xw, v[COL0].wzyx, -c[5].y;\n"
      "RSQ R2.z, R1.w; MAD o[TEX1], R1, R2.z, v[TEX2]; MOV o[COL0], v[WGHT];END trailing";
  EXPECT_EQ(translated(text, matrices, 1U << 10),
            "!!ARBvp1.0\n"
            "TEMP R0, R1, R2, R3, R4, R5, R6, R7, R8, R9, R10, R11;\n"
            "PARAM c0 = state.matrix.mvp.row[0];\n"
            "PARAM c1 = state.matrix.mvp.row[1];\n"
            "PARAM c5 = state.matrix.texture[3].invtrans.row[1];\n"
            "ATTRIB v0 = vertex.position;\n"
            "ATTRIB v1 = vertex.attrib[1];\n"
            "ATTRIB v3 = vertex.color;\n"
            "ATTRIB v10 = vertex.attrib[10];\n"
            "PARAM initial = { 0.0, 0.0, 0.0, 1.0 };\n"
            "MOV result.position, initial;\n"
            "MOV result.color.front.secondary, initial;\n"
            "MOV result.color.back.primary, initial;\n"
            "MOV result.color.back.secondary, initial;\n"
            "MOV result.fogcoord, initial;\n"
            "MOV result.texcoord[0], initial;\n"
            "MOV result.texcoord[2], initial;\n"
            "MOV result.texcoord[3], initial;\n"
            "MOV R1, initial.x;\n"
            "DP4 result.position.x, c0, v0;\n"
            "DP4 result.position.y, c1, v0;\n"
            "MUL R1.xw, v3.wzyx, -c5.yyyy;\n"
            "RSQ R2.z, R1.w;\n"
            "MAD result.texcoord[1], R1, R2.zzzz, v10;\n"
            "MOV result.color.front.primary, v1;\n"
            "END\n");
}

TEST(VertexProgramText, RelativeParametersStayInTheirArray) {
  const std::string text = "!!VP1.0 ARL A0.x, v[1].y; MOV R0, c[A0.x - 64]; MOV o[HPOS], c[ A0 . x + 63 ];END";
  EXPECT_EQ(code_of(text),
            "FLR address.x, v1.y;\n"
            "MAX scratch.x, address.x, 63.0;\nMIN scratch.x, scratch.x, 160.0;\n"
            "ADD scratch.x, scratch.x, 1.0;\nARL A0.x, scratch.x;\nMOV R0, all[A0.x - 64];\n"
            "MAX scratch.x, address.x, -64.0;\nMIN scratch.x, scratch.x, 33.0;\n"
            "ADD scratch.x, scratch.x, 1.0;\nARL A0.x, scratch.x;\nMOV result.position, all[A0.x + 63];\n"
            "END\n");
  const std::string all = translated(text);
  EXPECT_NE(all.find("PARAM all[98] = { { 0.0, 0.0, 0.0, 0.0 }, program.env[0], "), std::string::npos) << all;
  EXPECT_NE(all.find(", program.env[95], { 0.0, 0.0, 0.0, 0.0 } };"), std::string::npos) << all;
}

TEST(VertexProgramText, PositionInvariant) {
  const std::string all = translated("!!VP1.1 OPTION NV_position_invariant; SUB o[COL0], v[3], c[4];END");
  EXPECT_TRUE(all.starts_with("!!ARBvp1.0\nOPTION ARB_position_invariant;\n")) << all;
  EXPECT_EQ(all.find("result.position"), std::string::npos) << all;
}

TEST(VertexProgramText, EachOpcodeIsKnown) {
  for (const auto& [text, is_1_1] : {std::pair{"ARL A0.x, v[0].w", false},
                                     {"MOV R0, v[0]", false},
                                     {"MUL R0, v[0], R1", false},
                                     {"ADD R0, v[0], R1", false},
                                     {"MAD R0, v[0], R1, c[3]", false},
                                     {"RCP R0, v[0].x", false},
                                     {"RSQ R0, v[0].x", false},
                                     {"DP3 R0, v[0], R1", false},
                                     {"DP4 R0, v[0], R1", false},
                                     {"DST R0, v[0], R1", false},
                                     {"MIN R0, v[0], R1", false},
                                     {"MAX R0, v[0], R1", false},
                                     {"SLT R0, v[0], R1", false},
                                     {"SGE R0, v[0], R1", false},
                                     {"EXP R0, v[0].x", false},
                                     {"LOG R0, v[0].x", false},
                                     {"LIT R0, v[0]", false},
                                     {"DPH R0, v[0], R1", true},
                                     {"RCC R0, v[0].x", true},
                                     {"SUB R0, v[0], R1", true},
                                     {"ABS R0, v[0]", true}}) {
    VertexFault fault;
    const std::string rest = std::string(text) + ";" + kPosition + "END";
    EXPECT_TRUE(parse("!!VP1.1 " + rest, fault)) << text << ": " << fault.message;
    EXPECT_EQ(parse("!!VP1.0 " + rest, fault).has_value(), !is_1_1) << text;
  }
}

TEST(VertexProgramText, Faults) {
  struct Case {
    std::string text;
    std::string at;  // the position is that of this part; empty: the text's length
    std::string message;
  };
  std::string long_text = "!!VP1.0";
  for (int i = 0; i < 127; ++i) long_text += "MOV R1,R2;";
  const Case cases[]{
      {"!!VP2.0 END", "!!VP2.0", "expected !!VP1.0 or !!VP1.1"},
      {" !!VP1.0 END", " ", "expected !!VP1.0 or !!VP1.1"},
      {"!!VP1.0 END", "", "o[HPOS] is not written"},
      {"!!VP1.0" + kPosition, "", "expected an instruction or END"},
      {"!!VP1.0 mov R0, R1;END", "mov", "expected an instruction or END"},
      {"!!VP1.0 MOV R12, R1;END", "R12", "expected a register R0 to R11 or o[]"},
      {"!!VP1.0 MOV R01, R1;END", "R01", "expected a register R0 to R11 or o[]"},
      {"!!VP1.0 MOV c[3], R1;END", "c[3]", "expected a register R0 to R11 or o[]"},
      {"!!VP1.0 MOV o[TEX8], R1;END", "TEX8", "expected a name of a result"},
      {"!!VP1.0 MOV R0.yx, R1;END", "yx", "expected components of xyzw in their order"},
      {"!!VP1.0 MOV R0., R1;END", ", R1", "expected components of xyzw in their order"},
      {"!!VP1.0 MOV R0, o[HPOS];END", "o[", "expected a register R0 to R11, v[] or c[]"},
      {"!!VP1.0 MOV R0, R1.xy;END", "xy", "expected one component or four"},
      {"!!VP1.0 MOV R0, R1.rgba;END", "rgba", "expected components of xyzw"},
      {"!!VP1.0 RCP R0, R1;END", ";", "expected one component"},
      {"!!VP1.0 RCP R0, R1.xxxx;END", "xxxx", "expected one component"},
      {"!!VP1.0 MOV R0, c[96];END", "96", "expected a number from 0 to 95"},
      {"!!VP1.0 MOV R0, c[99999999999999999999];END", "9999", "expected a number from 0 to 95"},
      {"!!VP1.0 MOV R0, v[16];END", "16", "expected an attribute: 0 to 15 or its name"},
      {"!!VP1.0 MOV R0, v[TEX8];END", "TEX8", "expected an attribute: 0 to 15 or its name"},
      {"!!VP1.0 MOV R0, c[A0.x + 64];END", "64", "expected a number from 0 to 63"},
      {"!!VP1.0 MOV R0, c[A0.x - 65];END", "65", "expected a number from 0 to 64"},
      {"!!VP1.0 MOV R0, c[A0.y];END", "y]", "expected 'x'"},
      {"!!VP1.0 ARL R0.x, R1.x;END", "R0", "expected 'A0'"},
      {"!!VP1.0 ADD R0, c[1], c[2];END", "ADD", "it reads two parameters"},
      {"!!VP1.0 MAD R0, c[A0.x+1], R1, c[A0.x+2];END", "MAD", "it reads two parameters"},
      {"!!VP1.0 MAD R0, c[1], R1, c[A0.x+1];END", "MAD", "it reads two parameters"},
      {"!!VP1.0 ADD R0, v[1], v[2];END", "ADD", "it reads two attributes"},
      {"!!VP1.0 MOV R0, R1 END", "END", "expected ';'"},
      {"!!VP1.0 MOV R0 R1;END", "R1", "expected ','"},
      {"!!VP1.0 SUB R0, R1, R2;END", "SUB", "SUB is of !!VP1.1"},
      {"!!VP1.0 OPTION NV_position_invariant;END", "OPTION", "expected an instruction or END"},
      {"!!VP1.1 OPTION NV_fast;END", "NV_fast", "expected NV_position_invariant"},
      {"!!VP1.1 OPTION NV_position_invariant;" + kPosition + "END", "HPOS",
       "o[HPOS] is not the program's with NV_position_invariant"},
      {"!!VSP1.0 MOV R0, v[0];END", "", "a state program writes a parameter"},
      {"!!VSP1.0 MOV c[1], v[1];END", "1];END", "a state program reads v[0] alone"},
      {"!!VSP1.0 MOV o[HPOS], v[0];END", "o[", "expected a register R0 to R11 or c[]"},
      {"!!VSP1.0 MOV c[A0.x], v[0];END", "A0", "expected a number from 0 to 95"},
      {long_text + kPosition + "RCP R0, R0.x;END", "RCP", "expected at most 128 instructions"},
  };
  for (const Case& one : cases) {
    VertexFault fault;
    EXPECT_FALSE(parse(one.text, fault)) << one.text;
    EXPECT_EQ(fault.message, one.message) << one.text;
    EXPECT_EQ(fault.position, one.at.empty() ? one.text.size() : one.text.find(one.at)) << one.text;
  }
  VertexFault fault;
  EXPECT_TRUE(parse(long_text + kPosition + "END", fault)) << fault.message;
  EXPECT_TRUE(parse("!!VP1.0 ADD R0, c[1].x, -c[1].y; MAD R0, v[2], v[NRML], R0;" + kPosition + "END", fault));
  EXPECT_TRUE(parse(std::string("!!VP1.0") + kPosition + std::string("END\0\1", 5), fault)) << "text behind END";
  EXPECT_FALSE(parse_vertex_program("!!VP1.1" + kPosition + "END", VertexProgramKind::vertex, false, fault));
}

TEST(VertexProgramText, StatePrograms) {
  VertexFault fault;
  const auto program = parse(
      "!!VSP1.0 ARL A0.x, v[0].x; MOV R0, c[A0.x+1]; ADD c[10].xz, R0, -v[0].wzyx; MOV c[11], c[A0.x + 63];"
      "MOV c[12], R5; END",
      fault);
  ASSERT_TRUE(program) << fault.message;
  std::array<VertexVector, kVertexParameters> parameters{};
  parameters[3] = {1, 2, 3, 4};
  parameters[10] = {5, 6, 7, 8};
  parameters[11] = parameters[12] = {9, 9, 9, 9};
  execute_state_program(*program, {2.75F, 0, 20, 100}, parameters);
  EXPECT_EQ(parameters[10], (VertexVector{-99, 6, 3, 8}));
  EXPECT_EQ(parameters[11], (VertexVector{}));
  EXPECT_EQ(parameters[12], (VertexVector{})) << "a temporary begins as 0";
  const auto outside = parse("!!VSP1.0 ARL A0.x, v[0].x; MOV c[0], c[A0.x + 50];END", fault);
  execute_state_program(*outside, {46, 0, 0, 0}, parameters);
  EXPECT_EQ(parameters[0], (VertexVector{})) << "c[96]";
}

}  // namespace
}  // namespace ninebit::gl_layer
