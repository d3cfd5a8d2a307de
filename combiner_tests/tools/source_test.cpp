// Source files from outside: --function, --define, what is listed, noted and asked for.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kLights = NINEBIT_SOURCE_DIR "/docs/programs/lights.c";

Words with_values(Words arguments) {
  for (const char* define : {"light->color=1,0.5,0", "first=1", "r_lists.integer=0"}) {
    arguments.insert(arguments.end(), {"--define", define});
  }
  return arguments;
}

TEST(Source, AFunctionIsAProgramOfEveryVerb) {
  const Outcome rc10 =
      ninebit({"convert", kLights, "--function", "R_LightFragments", "--to", "rc10", "--profile", "nv2a"});
  EXPECT_EQ(rc10.code, 0) << rc10.err;
  expect_parts(rc10.out, {"spare0 = expand(tex0) . expand(tex1);"});
  EXPECT_EQ(ninebit(with_values({"explain", kLights, "--function", "R_DrawLight"})).code, 3)
      << "geforce2 has two textures";
  const Outcome explained =
      ninebit(with_values({"explain", kLights, "--function", "R_DrawLight", "--profile", "nv2a"}));
  EXPECT_EQ(explained.code, 0) << explained.err;
  EXPECT_EQ(ninebit({"trace", kLights, "--function", "R_LightFragments", "--profile", "nv2a", "--set",
                     "tex0=255,128,128,255"})
                .code,
            0);
  EXPECT_EQ(ninebit({"prove", "stable", kLights, "--function", "R_LightFragments", "--profile", "nv2a"})
                .err.find("unknown flag"),
            std::string::npos);
}

TEST(Source, NotesAreQuiet) {
  const Words command{"convert", kLights, "--function", "R_LightFragments", "--to", "gl", "--profile", "nv2a"};
  const Outcome noted = ninebit(command);
  expect_parts(noted.err, {"ninebit: note: " + kLights + ":22:2: assumed that r_lists->integer is false"});
  const Words quiet = command + Words{"--quiet"};
  EXPECT_EQ(ninebit(quiet).err, "");
  EXPECT_EQ(ninebit(quiet).out, noted.out);
}

TEST(Source, FunctionsAreListed) {
  const Json listed = json_of(ninebit({"validate", kLights, "--from", "source", "--json", "--profile", "nv2a"}));
  EXPECT_EQ(keys_of(listed), (Words{"command", "version", "profile", "functions", "rows"}));
  const Json& functions = listed["functions"];
  ASSERT_EQ(functions.size(), 2U);
  EXPECT_EQ(keys_of(functions[0]),
            (Words{"name", "line", "helper", "calls_read", "calls_not_read", "calls_refused", "needs"}));
  EXPECT_EQ(functions[0]["name"], "R_LightFragments");
  EXPECT_EQ(functions[0]["calls_read"], 13);
  EXPECT_EQ(functions[1]["calls_not_read"], 1);
  EXPECT_EQ(functions[1]["needs"], (Json{"first", "light.color", "r_lists.integer"}));
  // A call that GL refuses is a finding, as in every form.
  const Json rows = json_of(ninebit({"validate", kLights, "--json"}), 1)["rows"];
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["gl_error"], "GL_INVALID_ENUM");
  EXPECT_EQ(rows[0]["line"], 36);
  EXPECT_EQ(ninebit({"validate", kLights, "--function", "R_LightFragments"}).code, 1);
}

TEST(Source, ErrorsSayHowToGoOn) {
  expect_error(ninebit({"convert", kLights, "--to", "gl"}), 3,
               {"several functions", "R_LightFragments (line 21)", "R_DrawLight (line 48)"});
  expect_error(ninebit({"explain", kLights, "--function", "R_DrawLight", "--quiet", "--profile", "nv2a"}), 3,
               {"3 values are not known", "'light.color' (line 60, 4 numbers)", "--define 'first=…'"});
  expect_error(ninebit({"explain", kLights, "--function", "R_DrawLihgt", "--profile", "nv2a"}), 3,
               {"did you mean 'R_DrawLight'?"});
  expect_error(ninebit({"explain", kLights, "--function", "R_DrawLight", "--define", "first"}), 2, {"NAME=VALUE"});
  expect_error(ninebit({"explain", kArticle, "--from", "gl", "--define", "a=1"}), 2, {"--define", "GL calls"});
  TempFolder folder;
  const std::string none = write_bytes(folder / "none.c", "#include <GL/gl.h>\nint main(void) { return 0; }\n");
  expect_error(ninebit({"convert", none, "--from", "source", "--to", "gl"}), 3, {"no call of the register combiners"});
}

// A sequence of calls with values from outside is one, too.
TEST(Source, CallsAloneTakeValues) {
  TempFolder folder;
  const std::string calls = write_bytes(folder / "calls.c", "glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, tint);\n");
  expect_error(ninebit({"convert", calls, "--to", "gl"}), 3, {"'tint'"});
  expect_parts(out_of(ninebit({"convert", calls, "--to", "gl", "--define", "tint=1,0,0,1"})),
               {"{1.0f, 0.0f, 0.0f, 1.0f}"});
}

TEST(Source, ForeignLanguagesByTheirNames) {
  TempFolder folder;
  const auto said = [&](const std::string& text, const std::string& name) {
    expect_error(ninebit({"explain", write_bytes(folder / "shader", text)}), 3,
                 {"this is " + name + ", which register combiners cannot run"});
  };
  said("!!ARBfp1.0\nMOV result.color, fragment.color;\nEND\n", "an ARB fragment program");
  said("!!VP1.0\nMOV o[COL0], v[COL0];\nEND\n", "an NV vertex program");
  said("\"!!FP1.0\\n\"\n\"MOV o[COLR], f[COL0];\\n\"\n\"END\\n\"\n", "an NV fragment program");
  said("#version 120\nvoid main() { gl_FragColor = gl_Color; }\n", "a GLSL shader");
  said("uniform sampler2D t;\nvoid main()\n{\n  gl_FragColor = texture2D(t, gl_TexCoord[0].st);\n}\n", "a GLSL shader");
  said(
      "sampler2D s : register(s0);\nfloat4 main(float2 uv : TEXCOORD0) : COLOR0 { return tex2D(s, uv); }\n"
      "technique T { pass P { PixelShader = compile ps_2_0 main(); } }\n",
      "an HLSL shader");
  said("void main(float2 uv : TEXCOORD0, uniform sampler2D s : TEXUNIT0, out float4 c : COLOR) { c = tex2D(s, uv); }\n",
       "a Cg program");
}

}  // namespace
}  // namespace tools_test
