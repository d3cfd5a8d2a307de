// `ninebit eval` with texture-shader stages: coordinates and texels are columns of the table.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class EvalStagesTable : public testing::Test {
 protected:
  Outcome eval(const std::string& table, std::vector<std::string> more = {}) {
    const std::string program =
        write_bytes(folder_ / "dot.ts",
                    "!!TS1.0\n"
                    "texture_2d();\n"
                    "dot_product_2d_1of2(tex0);\n"
                    "dot_product_2d_2of2(tex0);\n"
                    "cull_fragment(GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO);\n"
                    "!!RC1.0\n"
                    "out.rgb = tex2;\n"
                    "out.a = tex2.a;\n");
    more.insert(more.begin(),
                {"eval", program, "--inputs", write_bytes(folder_ / "in.csv", table), "--profile", "nv2a"});
    return ninebit(more);
  }
  TempFolder folder_;
};

constexpr std::string_view kStageHeader = "texel0.r,texel0.g,at1.s,at2.t,at3.s,texel2.r,texel2.g,texel2.b,texel2.a\n";
constexpr std::string_view kStageResults =
    "out.r,out.g,out.b,out.a,tex0.r,tex0.g,tex0.b,tex0.a,tex1.r,tex1.g,tex1.b,tex1.a,tex2.r,tex2.g,tex2.b,tex2.a,tex3."
    "r,"
    "tex3.g,tex3.b,tex3.a,culled,depth,read0.s,read0.t,read0.r,read1.s,read1.t,read1.r,read2.s,read2.t,read2.r,read3.s,"
    "read3.t,read3.r\n";

TEST_F(EvalStagesTable, RowsRunThroughTheStages) {
  const Outcome outcome = eval(std::string(kStageHeader) + "255,51,0.5,2,0,1,2,3,4\n51,0,1,0,-1,9,8,7,6\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, std::string(kStageResults) +
                             "1,2,3,4,255,51,0,0,0,0,0,0,1,2,3,4,0,0,0,0,0,,0,0,0,,,,0.5,0.4,0,,,\n"
                             "9,8,7,6,51,0,0,0,0,0,0,0,9,8,7,6,0,0,0,0,1,,0,0,0,,,,0.2,0,0,,,\n");
}

TEST_F(EvalStagesTable, JsonHasNullForWhatThereIsNot) {
  const Outcome outcome = eval(std::string(kStageHeader) + "255,51,0.5,2,0,1,2,3,4\n", {"--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_EQ(answer["command"], "eval");
  ASSERT_EQ(answer["rows"].size(), 1U);
  EXPECT_EQ(answer["rows"][0]["out.g"], 2);
  EXPECT_EQ(answer["rows"][0]["read2.s"], 0.5);
  EXPECT_TRUE(answer["rows"][0]["depth"].is_null());
}

TEST_F(EvalStagesTable, BadTablesAreNamed) {
  const auto expect_fault = [&](const std::string& table, const std::string& message) {
    const Outcome outcome = eval(table);
    EXPECT_EQ(outcome.code, 3) << table;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  expect_fault("at1.s,tex0.r\n0,0\n", "in.csv:1:7: unknown column 'tex0.r'; expected atN.s");
  expect_fault("at1.s,at1.s\n0,0\n", "in.csv:1:7: duplicate column at1.s");
  expect_fault("at1.s,texel0.r\n0,256\n", "in.csv:2:3: texel0.r must be a whole number from 0 to 255, not '256'");
  expect_fault("at1.s,texel0.r\nx,1\n", "in.csv:2:1: at1.s must be a number, not 'x'");
  expect_fault("at1.s,texel0.r\n1\n", "in.csv:2:1: the row has 1 field, the header 2");
  const Outcome registers = eval("at1.s\n0\n", {"--registers"});
  EXPECT_EQ(registers.code, 3);
  EXPECT_NE(registers.err.find("--registers is for tables of registers"), std::string::npos) << registers.err;
  const Outcome engine = eval("at1.s\n0\n", {"--engine", "reference"});
  EXPECT_EQ(engine.code, 3);
  EXPECT_NE(engine.err.find("--engine is for tables of registers"), std::string::npos) << engine.err;
}

// A table of registers is as ever, and a note says that the stages do not run.
TEST_F(EvalStagesTable, ATableOfRegistersDoesNotRunThem) {
  const Outcome outcome = eval("tex2.r\n7\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out.r,out.g,out.b,out.a\n7,0,0,255\n");
  EXPECT_NE(outcome.err.find("the texture-shader stages are not run"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace tools_test
