// Pixel shaders in assembly as a form of programs, for every verb that reads or writes one.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kShader =
    "ps.1.1\ndef c0, 0.25, 0.5, 0.75, 1\ntex t0\nmul_x2 r0.rgb, t0, v0\n+mov r0.a, c0\nadd_sat r0.rgb, r0, -c0\n";
const std::string kSameRc10 =
    "!!RC1.0\nconst0 = (0.25, 0.5, 0.75, 1);\n{ rgb { spare0 = tex0 * col0; scale_by_two(); } alpha { spare0 = const0; "
    "} }\n"
    "{ rgb { discard = spare0; discard = -const0; spare0 = sum(); } }\nout.rgb = spare0;\nout.a = spare0;\n";

class PixelShaderTool : public testing::Test {
 protected:
  std::string file(const std::string& text, const std::string& name = "shader.psh") const {
    return write_bytes(folder_ / name, text);
  }
  const TempFolder folder_;
};

TEST_F(PixelShaderTool, IsReadByItsContentAndByTheFlag) {
  const std::string shader = file(kShader), same = file(kSameRc10, "same.rc1");
  const Outcome rc10 = ninebit({"convert", shader, "--to", "rc10", "--quiet"});
  EXPECT_EQ(rc10.code, 0) << rc10.err;
  EXPECT_EQ(rc10.out, ninebit({"convert", same, "--to", "rc10"}).out);
  EXPECT_EQ(ninebit({"convert", shader, "--from", "ps", "--to", "rc10"}).out, rc10.out);
  EXPECT_EQ(ninebit({"validate", shader}).code, 0);
  expect_parts(ninebit({"explain", shader}).out, {"spare0 = 2·(tex0 × primary)"});
  expect_error(ninebit({"validate", shader, "--from", "rc10"}), 3,
               {"seems to be a ps.1.x pixel shader", "leave out --from, or give --from ps"});
  expect_error(ninebit({"validate", same, "--from", "ps"}), 3,
               {"seems to be an !!RC1.0 program", "leave out --from, or give --from rc10"});
}

TEST_F(PixelShaderTool, SaysWhatTheApplicationSets) {
  const std::string shader = file("xps.1.1\ntex t0\nmul r0, t0, c5\n");
  expect_parts(err_of(ninebit({"explain", shader, "--profile", "nv2a"})), {"shader.psh:3:13: c5 is not defined here"});
  EXPECT_EQ(ninebit({"explain", shader, "--profile", "nv2a", "--quiet"}).err, "");
  const std::string bump = file("ps.1.1\ntex t0\ntexbem t1, t0\nmov r0, t1\n", "bump.psh");
  const Outcome bumped = ninebit({"explain", bump, "--profile", "nv2a"});
  expect_parts(bumped.err, {"bump.psh:3:1: the application sets the bump matrix of texture stage 1"});
  EXPECT_EQ(bumped.out.rfind("texture shader\n  tex0 = texture 0 at (s0, t0) / q0\n", 0), 0U) << bumped.out;
  expect_parts(err_of(ninebit({"explain", bump, "--profile", "geforce2"}), 3),
               {"GL_INVALID_ENUM: profile geforce2 has no texture shaders"});
}

// Every verb that reads programs reads the files that a shader includes, and none outside of its folder unless allowed.
TEST_F(PixelShaderTool, IncludedFilesLieInTheShadersFolder) {
  std::filesystem::create_directory(std::string(folder_ / "inner"));
  const std::string shader = file("ps.1.1\n#include \"../body.h\"\n", "inner/outside.psh");
  (void)file("mov r0, v0\n", "body.h");
  const std::string beside = file("ps.1.1\n#include \"body.h\"\n");
  const std::string table = file("primary.r,out.r\n101,101\n", "rows.csv"), out = folder_ / "out.png";
  for (Words verb : std::vector<Words>{
           {"validate", shader},
           {"explain", shader},
           {"convert", shader, "--to", "rc10"},
           {"trace", shader},
           {"eval", shader, "--inputs", file("primary.r\n1\n", "inputs.csv")},
           {"draw",
            file(R"({"ninebit": "effect", "version": 1, "size": [4, 4], "passes": [{"program": "outside.psh"}]})",
                 "inner/effect.json"),
            "-o", out},
           {"prove", "stable", shader},
           {"prove", "equivalent", shader, beside},
           {"verify", table, "--program", shader}}) {
    SCOPED_TRACE(verb[0] + " " + verb[1]);
    expect_error(ninebit(verb), 3,
                 {"outside.psh:2:", "'\"../body.h\"' was not read; expected a text below the folder"});
    verb.emplace_back("--allow-outside");
    const Outcome outcome = ninebit(verb);
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  }
  EXPECT_EQ(ninebit({"validate", beside}).code, 0);
}

// '\' separates folders, and is followed as far as '/' is; "-" is a file as any other.
TEST_F(PixelShaderTool, IncludedNamesAreNotReadAnotherWay) {
  namespace fs = std::filesystem;
  const fs::path top = folder_.path();
  fs::create_directories(top / "in" / "deep");
  (void)file("mov r0, v0\n", "secret.psh");
  (void)file("mov r0, v0\n", "in/deep/body.psh");
  fs::create_directory_symlink("..", top / "in" / "link");
  const std::string out = file("ps.1.1\n#include \"link\\secret.psh\"\n", "in/out.psh");
  expect_error(ninebit({"validate", out}), 3, {"out.psh:2:", "was not read; expected a text below the folder"});
  EXPECT_EQ(ninebit({"validate", out, "--allow-outside"}).code, 0);
  EXPECT_EQ(ninebit({"validate", file("ps.1.1\n#include \"deep\\body.psh\"\n", "in/below.psh")}).code, 0);
  // The folder's own name may have such a mark.
  fs::create_directory(top / "a\\b");
  (void)file("mov r0, v0\n", "a\\b/body.psh");
  EXPECT_EQ(ninebit({"validate", file("ps.1.1\n#include \"body.psh\"\n", "a\\b/whole.psh")}).code, 0);
  (void)file("mov r0, v0\n", "-");
  (void)file("ps.1.1\n#include \"-\"\n", "dash.psh");
  for (const Words& more : {Words{}, {"--allow-outside"}}) {
    const Words verb = Words{"validate", "dash.psh"} + more;
    const std::string in = file("a wrong text\n", "in.txt");
    const Outcome outcome = ninebit(verb, {.folder = top.string(), .in = in});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
}

// Every verb that reads programs takes the values that a shader's conditions need.
TEST_F(PixelShaderTool, DefinitionsAreTakenByEveryVerb) {
  const std::string body = "mov r0.rgb, v1\n+mov r0.a, v0\n";
  const std::string shader = file("ps.1.1\n#if MODE == 0\nmov r0, v0\n#endif\n#if MODE != 0\n" + body + "#endif\n");
  const std::string secondary = file("ps.1.1\n" + body, "secondary.psh");
  const std::string table = file("secondary.r,out.r\n101,101\n", "rows.csv"), out = folder_ / "out.png";
  const std::string effect = file(
      R"({"ninebit": "effect", "version": 1, "size": [4, 4], "passes": [{"program": "shader.psh"}]})", "effect.json");
  const std::vector<Words> verbs{
      {"validate", shader},
      {"explain", shader},
      {"convert", shader, "--to", "rc10"},
      {"trace", shader},
      {"trace", "--effect", effect, "--pixel", "0,0"},
      {"eval", shader, "--inputs", file("secondary.r\n1\n", "inputs.csv")},
      {"draw", shader, "--size", "4x4", "-o", out},
      {"draw", effect, "-o", out},
      {"prove", "stable", shader},
      {"prove", "equivalent", shader, secondary},
      {"verify", table, "--program", shader},
      {"study", "datapath", "--program", shader, "--over", "secondary.r", "-o", folder_ / "datapath"}};
  for (Words verb : verbs) {
    SCOPED_TRACE(verb[0] + " " + verb[1]);
    expect_error(ninebit(verb), 3, {"'MODE' is not defined, and #if MODE == 0 depends on it", "--define 'MODE=…'"});
    const Outcome outcome = ninebit(verb + Words{"--define", "MODE=1"});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  }
  EXPECT_EQ(ninebit({"verify", table, "--program", shader, "--define", "MODE=0"}).code, 1);
  EXPECT_EQ(ninebit({"prove", "equivalent", shader, secondary, "--define", "MODE=0"}).code, 1);
  EXPECT_EQ(ninebit({"convert", shader, "--to", "rc10", "--define", "MODE=1"}).out,
            ninebit({"convert", secondary, "--to", "rc10"}).out);
  // Programs that have no such values take none, unless the other one of two has.
  const std::string rc10 = file(kSameRc10, "same.rc1");
  expect_error(ninebit({"explain", rc10, "--define", "MODE=1"}), 2, {"--define is for source files and pixel shaders"});
  expect_error(ninebit({"explain", shader, "--function", "f"}), 2, {"--function is for source files"});
  expect_error(ninebit({"prove", "equivalent", rc10, rc10, "--define", "MODE=1"}), 2, {"--define is for source files"});
  expect_parts(ninebit({"draw", rc10, "--size", "4x4", "-o", out, "--define", "MODE=1"}).err, {"--define is ignored"});
  EXPECT_EQ(ninebit({"prove", "equivalent", rc10, shader, "--define", "MODE=1"}).code, 1);
  expect_error(ninebit({"trace", "--define", "MODE=1", "--scene", "x.obj", "--pixel", "0,0"}), 2,
               {"--define requires PROGRAM or --effect"});
}

TEST_F(PixelShaderTool, IsWritten) {
  const std::string shader = file(kShader), same = file(kSameRc10, "same.rc1");
  // The result's saturation has no effect: the final combiner clamps, too.
  const std::string expected =
      "ps.1.1\ndef c0, 0.25, 0.5, 0.75, 1\ntex t0\nmul_x2 r0.rgb, t0, v0\n+mov r0.a, c0\nadd r0.rgb, r0, -c0\n";
  EXPECT_EQ(ninebit({"convert", shader, "--to", "ps11", "--quiet"}).out, expected);
  EXPECT_EQ(ninebit({"convert", same, "--to", "ps11"}).out, expected);
  const std::string written = folder_ / "again.psh";
  EXPECT_EQ(ninebit({"convert", same, "--to", "ps11", "-o", written}).code, 0);
  EXPECT_EQ(ninebit({"convert", written, "--to", "rc10", "--quiet"}).out,
            ninebit({"convert", same, "--to", "rc10"}).out);
  const std::string products = file(
      "!!RC1.0\n{ rgb { discard = tex0 * col0; discard = tex1 * col1; spare0 = sum(); } }\nout.rgb = spare0;\n", "two");
  expect_error(
      ninebit({"convert", products, "--to", "ps11"}), 3,
      {"cannot be written as ps11: ps.1.1 cannot express this: general combiner 0, RGB portion: the sum of two "
       "products"});
}

TEST_F(PixelShaderTool, ExitCodesAreThoseOfTheOtherForms) {
  expect_error(
      ninebit({"validate", file("ps.1.1\nmull r0, t0, v0\nmov r0, v0\n")}), 3,
      {"shader.psh:2:1: 'mull' is not an instruction of ps.1.1; did you mean 'mul'?", "mull r0, t0, v0\n  ^~~~"});
  expect_error(ninebit({"validate", file("ps.2.0\n")}), 3, {"this is a Direct3D pixel shader of version 2"});
  // More instructions than the profile has combiners, and a texture unit that it does not have.
  const std::string three = file("ps.1.1\nmov r0, v0\nmov r1, r0\nmov r0, r1\n");
  expect_parts(out_of(ninebit({"validate", three}), 1), {"GL_INVALID_VALUE: too many general combiners"});
  EXPECT_EQ(ninebit({"validate", three, "--profile", "nv2a"}).code, 0);
  EXPECT_EQ(ninebit({"validate", file("ps.1.1\ntex t3\nmov r0, t3\n")}).code, 1);
}

TEST_F(PixelShaderTool, AreListedInSources) {
  const std::string source = file(
      "const char* glow = \"xps.1.1\\n\" \"mov r0, v0\\n\";\nvoid set() { nvparse(\"!!PS1.0\\nmul r0, t0, v0\\n\"); "
      "}\n",
      "a.c");
  const Outcome listed = ninebit({"validate", source, "--from", "source"});
  expect_parts(listed.out, {"glow", "set"});
  expect_parts(ninebit({"explain", source, "--function", "glow"}).out, {"spare0 = primary"});
}

}  // namespace
}  // namespace tools_test
