// `ninebit eval` with texture-shader stages: coordinates and texels are columns of the table.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class EvalStagesTable : public testing::Test {
 protected:
  Outcome eval(const std::string& table, Words more = {}) {
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
  EXPECT_EQ(out_of(eval(std::string(kStageHeader) + "255,51,0.5,2,0,1,2,3,4\n51,0,1,0,-1,9,8,7,6\n")),
            std::string(kStageResults) +
                "1,2,3,4,255,51,0,0,0,0,0,0,1,2,3,4,0,0,0,0,0,,0,0,0,,,,0.5,0.4,0,,,\n"
                "9,8,7,6,51,0,0,0,0,0,0,0,9,8,7,6,0,0,0,0,1,,0,0,0,,,,0.2,0,0,,,\n");
}

TEST_F(EvalStagesTable, JsonHasNullForWhatThereIsNot) {
  const Json answer = json_of(eval(std::string(kStageHeader) + "255,51,0.5,2,0,1,2,3,4\n", {"--json"}));
  EXPECT_EQ(answer["command"], "eval");
  ASSERT_EQ(answer["rows"].size(), 1U);
  EXPECT_EQ(answer["rows"][0]["out.g"], 2);
  EXPECT_EQ(answer["rows"][0]["read2.s"], 0.5);
  EXPECT_TRUE(answer["rows"][0]["depth"].is_null());
}

// `trace` runs the stages on what --set gives, and has their values in all its forms.
TEST_F(EvalStagesTable, TraceRunsThem) {
  (void)eval("at1.s\n0\n");  // writes the program
  const auto trace = [&](Words more) {
    return ninebit(Words{"trace", folder_ / "dot.ts", "--profile", "nv2a"} + more);
  };
  const Words set{"--set", "texel0=255,51,0,0", "--set", "at1.s=0.5", "--set", "at2=0,2", "--set", "texel2=1,2,3,4"};
  const auto with = [&](Words more) {
    more.insert(more.end(), set.begin(), set.end());
    return trace(more);
  };
  const Outcome text = with({});
  ASSERT_EQ(text.code, 0) << text.err;
  expect_parts(text.out, {"  texture stage 1: dot_product by stage 0, s, t, r, q = (0.5, 0, 0, 1), dot\n      product "
                          "0.5 with (1, 0.2, 0)",
                          "texture read at (0.5, 0.4, 0)"});
  EXPECT_EQ(text.out.find("culled"), std::string::npos);
  EXPECT_EQ(text.err.find("not run"), std::string::npos) << text.err;
  const Json json = Json::parse(with({"--json"}).out);
  EXPECT_EQ(json["out"]["codes"], Json({1, 2, 3, 4}));
  ASSERT_EQ(json["texture_shader"]["stages"].size(), 4U);
  EXPECT_EQ(json["texture_shader"]["stages"][2]["codes"], Json({1, 2, 3, 4}));
  EXPECT_EQ(json["texture_shader"]["stages"][1]["dot"], 0.5);
  EXPECT_EQ(json["texture_shader"]["culled"], false);
  EXPECT_TRUE(json["texture_shader"]["depth"].is_null());
  ASSERT_EQ(with({"-o", folder_ / "t.html"}).code, 0);
  expect_parts(read_bytes(folder_ / "t.html"), {"texture stage 2: "});
  ASSERT_EQ(with({"-o", folder_ / "t.svg"}).code, 0);
  expect_parts(read_bytes(folder_ / "t.svg"), {"texture stage 2: "});
  // Without --set all is 0; a culled fragment; registers of textures in the stages' place, with a note.
  expect_parts(trace({}).out, {"texture stage 3: "});
  expect_parts(trace({"--set", "at3.q=-1"}).out, {"the fragment is culled"});
  const Outcome registers = trace({"--set", "tex2.r=9", "--json"});
  EXPECT_FALSE(Json::parse(registers.out).contains("texture_shader"));
  expect_parts(registers.err, {"the texture-shader stages are not run, as --set tex2.r gives"});
  const auto expect_wrong = [&](Words more, const std::string& message) {
    expect_parts(err_of(trace(std::move(more)), 2), {message});
  };
  expect_wrong({"--set", "at1.s=0", "--set", "tex0.r=1"}, "--set tex0.r: the texture-shader stages give it");
  expect_wrong({"--set", "at1.s=x"}, "--set: at1.s takes a number, not 'x'");
  expect_wrong({"--set", "at1=1"}, "--set: at1 takes two to four numbers S,T,R,Q, not '1'");
  expect_wrong({"--set", "texel0=1,2,3"}, "--set: texel0 takes four whole numbers R,G,B,A, each from 0 to 255");
  expect_wrong({"--set", "texel0.g=256"}, "--set: texel0.g takes a whole number from 0 to 255, not '256'");
  expect_wrong({"--set", "at1.s=1", "--set", "at1=2,3"}, "--set: at1.s is set twice");
  const std::string plain = write_bytes(folder_ / "plain.rc", "!!RC1.0\nout.rgb = tex0;\n");
  expect_error(ninebit({"trace", plain, "--set", "at1.s=1"}), 2,
               {"--set at1.s: the program has no texture-shader stages"});
}

TEST_F(EvalStagesTable, BadTablesAreNamed) {
  const auto expect_fault = [&](const std::string& table, const std::string& message) {
    const Outcome outcome = eval(table);
    EXPECT_EQ(outcome.code, 3) << table;
    expect_parts(outcome.err, {message});
  };
  expect_fault("at1.s,tex0.r\n0,0\n", "in.csv:1:7: unknown column 'tex0.r'; expected atN.s");
  expect_fault("at1.s,at1.s\n0,0\n", "in.csv:1:7: duplicate column at1.s");
  expect_fault("at1.s,texel0.r\n0,256\n", "in.csv:2:3: texel0.r must be a whole number from 0 to 255, not '256'");
  expect_fault("at1.s,texel0.r\nx,1\n", "in.csv:2:1: at1.s must be a number, not 'x'");
  expect_fault("at1.s,texel0.r\n1\n", "in.csv:2:1: the row has 1 field, the header 2");
  const Outcome registers = eval("at1.s\n0\n", {"--registers"});
  EXPECT_EQ(registers.code, 3);
  expect_parts(registers.err, {"--registers is for tables of registers"});
  const Outcome engine = eval("at1.s\n0\n", {"--engine", "reference"});
  EXPECT_EQ(engine.code, 3);
  expect_parts(engine.err, {"--engine is for tables of registers"});
}

// A table of registers is as ever, and a note says that the stages do not run.
TEST_F(EvalStagesTable, ATableOfRegistersDoesNotRunThem) {
  const Outcome outcome = eval("tex2.r\n7\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out.r,out.g,out.b,out.a\n7,0,0,255\n");
  expect_parts(outcome.err, {"the texture-shader stages are not run"});
}

}  // namespace
}  // namespace tools_test
