// Sources in the manner of each family of programs of the time: what is read of them is what they would have done.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

std::string family_source(const std::string& name) {
  const std::string folder = name == "lights.c" ? "/docs/programs/" : "/combiner_tests/language/sources/";
  return test::read_bytes(NINEBIT_SOURCE_DIR + folder + name);
}

CombinerState read(const std::string& file, const std::vector<std::string>& functions,
                   const std::vector<Definition>& definitions = {}) {
  const std::string text = family_source(file);
  const auto parsed = parse_source_code({text, file}, {functions, definitions}, profiles::nv2a);
  EXPECT_TRUE(parsed) << test::all_faults(parsed);
  return parsed ? *parsed : CombinerState{};
}

// The state after calls in a shorter spelling: "in 0 RGB A TEXTURE0 EXPAND_NORMAL RGB", one a line.
CombinerState after(const std::string& lines) {
  std::string calls;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    std::vector<std::string> w;
    if (!(words >> kind)) continue;
    for (std::string word; words >> word;) w.push_back(word);
    const auto reg = [](const std::string& name) {
      const bool core = name.starts_with("TEXTURE") || name == "ZERO" || name == "FOG";
      return "GL_" + name + (core ? "" : "_NV");
    };
    const auto none = [](const std::string& name) { return name == "NONE" ? "GL_NONE" : "GL_" + name + "_NV"; };
    if (kind == "in") {
      calls += "glCombinerInputNV(GL_COMBINER" + w[0] + "_NV, GL_" + w[1] + ", GL_VARIABLE_" + w[2] + "_NV, " +
               reg(w[3]) + ", GL_" + w[4] + "_NV, GL_" + w[5] + ");\n";
    } else if (kind == "out") {
      calls += "glCombinerOutputNV(GL_COMBINER" + w[0] + "_NV, GL_" + w[1] + ", " + reg(w[2]) + ", " + reg(w[3]) +
               ", " + reg(w[4]) + ", " + none(w[5]) + ", GL_NONE, " + w[6] + ", 0, 0);\n";
    } else if (kind == "final") {
      calls += "glFinalCombinerInputNV(GL_VARIABLE_" + w[0] + "_NV, " + reg(w[1]) + ", GL_" + w[2] + "_NV, GL_" + w[3] +
               ");\n";
    } else if (kind == "count") {
      calls += "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, " + w[0] + ");\n";
    } else if (kind == "color") {
      calls += "glCombinerParameterfvNV(GL_CONSTANT_COLOR" + w[0] + "_NV, (GLfloat[]){" + w[1] + "});\n";
    } else if (kind == "stage_color") {
      calls += "glCombinerStageParameterfvNV(GL_COMBINER" + w[0] + "_NV, GL_CONSTANT_COLOR" + w[1] +
               "_NV, (GLfloat[]){" + w[2] + "});\n";
    } else {
      calls += line + "\n";
    }
  }
  const auto parsed = parse_gl_calls({calls, "expected"}, profiles::nv2a);
  EXPECT_TRUE(parsed) << test::all_faults(parsed) << calls;
  return parsed ? *parsed : CombinerState{};
}

const char* const kLightFragments = R"(
count 2
color 0 0.5f,0.5f,0.5f,1
in 0 RGB A TEXTURE0 EXPAND_NORMAL RGB
in 0 RGB B TEXTURE1 EXPAND_NORMAL RGB
out 0 RGB SPARE0 DISCARD DISCARD NONE 1
in 1 RGB A SPARE0 UNSIGNED_IDENTITY RGB
in 1 RGB B TEXTURE2 UNSIGNED_IDENTITY RGB
out 1 RGB SPARE0 DISCARD DISCARD SCALE_BY_TWO 0
final A ZERO UNSIGNED_IDENTITY RGB
final B ZERO UNSIGNED_IDENTITY RGB
final C ZERO UNSIGNED_IDENTITY RGB
final D SPARE0 UNSIGNED_IDENTITY RGB
final G ZERO UNSIGNED_INVERT ALPHA
)";

TEST(SourceFamilies, ShootersWithFunctionPointersAndMacros) {
  EXPECT_TRUE(read("lights.c", {"R_LightFragments"}) == after(kLightFragments));
  // The light's colour comes from outside, and the other function is called.
  EXPECT_TRUE(read("lights.c", {"R_DrawLight"},
                   {{"light->color", "1, 0.25, 0.5"}, {"first", "1"}, {"r_lists->integer", "0"}}) ==
              after(std::string("color 1 1,0.25f,0.5f,1\n") + kLightFragments));
  EXPECT_TRUE(read("lights.c", {"R_DrawLight"},
                   {{"color", "{0, 0, 0, 1}"}, {"r_lists.integer", "0"}, {"first", "0"}, {"light.color", "0,0,0"}}) ==
              after(std::string("color 1 0,0,0,1\n") + kLightFragments));
}

TEST(SourceFamilies, SceneGraphsWithAnObjectOfTheContext) {
  const std::string begin = R"(
count 1
in 0 RGB A TEXTURE3 UNSIGNED_INVERT RGB
in 0 RGB B PRIMARY_COLOR SIGNED_IDENTITY ALPHA
out 0 RGB SPARE0 DISCARD DISCARD NONE 0
)";
  EXPECT_TRUE(read("scene_graph.cpp", {"prepare"}) == after(begin));
  EXPECT_TRUE(read("scene_graph.cpp", {"LayerBlend::apply"}, {{"order", "FRONT_TO_BACK"}}) ==
              after(begin + "final D SPARE0 UNSIGNED_IDENTITY RGB\n"));
  EXPECT_TRUE(
      read("scene_graph.cpp", {"apply"}, {{"order", "BACK_TO_FRONT"}, {"unit", "GL_TEXTURE1"}, {"invert", "true"}}) ==
      after(begin + "final D TEXTURE1 UNSIGNED_INVERT RGB\n"));
}

TEST(SourceFamilies, EntryPointsInANamespace) {
  EXPECT_TRUE(read("volume_mapper.cxx", {}, {{"ambient", "0.1"}}) == after(R"(
count 2
stage_color 0 0 0.25f,0.5f,0.75f,0
in 0 RGB A TEXTURE0 EXPAND_NORMAL RGB
in 0 RGB B CONSTANT_COLOR0 UNSIGNED_IDENTITY RGB
out 0 RGB SPARE0 DISCARD DISCARD NONE 1
stage_color 1 0 0.75f,0.5f,0.25f,1
in 1 RGB A SPARE0 SIGNED_IDENTITY RGB
in 1 RGB B CONSTANT_COLOR0 UNSIGNED_IDENTITY RGB
out 1 RGB SPARE0 DISCARD DISCARD NONE 0
glEnable(GL_PER_STAGE_CONSTANTS_NV);
final D SPARE0 UNSIGNED_IDENTITY RGB
)"));
}

TEST(SourceFamilies, Java) {
  EXPECT_TRUE(read("ripples.java", {}) == after(R"(
count 3
color 1 0.25f,0.5f,1,0
in 0 RGB A TEXTURE0 SIGNED_IDENTITY RGB
in 0 RGB B ZERO UNSIGNED_INVERT RGB
in 0 RGB C TEXTURE1 SIGNED_IDENTITY RGB
in 0 RGB D ZERO UNSIGNED_INVERT RGB
out 0 RGB DISCARD DISCARD SPARE0 SCALE_BY_ONE_HALF 0
in 1 RGB A SPARE0 SIGNED_IDENTITY RGB
in 1 RGB B ZERO UNSIGNED_INVERT RGB
in 1 RGB C TEXTURE2 SIGNED_IDENTITY RGB
in 1 RGB D ZERO UNSIGNED_INVERT RGB
out 1 RGB DISCARD DISCARD SPARE1 NONE 0
stage_color 2 0 0.5f,0.5f,0.5f,0.5f
glEnable(GL_PER_STAGE_CONSTANTS_NV);
in 2 RGB A SPARE1 SIGNED_IDENTITY RGB
in 2 RGB B ZERO UNSIGNED_INVERT RGB
in 2 RGB C CONSTANT_COLOR0 SIGNED_IDENTITY RGB
in 2 RGB D ZERO UNSIGNED_INVERT RGB
out 2 RGB DISCARD DISCARD SPARE0 NONE 0
)"));
}

TEST(SourceFamilies, TranslatorsWithTablesAndCheckingMacros) {
  const auto stage = [](const char* op) {
    return read("translator.c", {"set_stage"}, {{"stage", "1"}, {"is_alpha", "0"}, {"op", op}});
  };
  EXPECT_TRUE(stage("OP_MODULATE2X") == after(R"(
in 1 RGB A TEXTURE1 UNSIGNED_IDENTITY RGB
in 1 RGB B SPARE0 UNSIGNED_IDENTITY RGB
out 1 RGB SPARE0 DISCARD DISCARD SCALE_BY_TWO 0
)"));
  EXPECT_TRUE(stage("OP_DOT3") == after(R"(
in 1 RGB A TEXTURE1 EXPAND_NORMAL RGB
in 1 RGB B SPARE0 EXPAND_NORMAL RGB
out 1 RGB SPARE0 DISCARD DISCARD NONE 1
)"));
  EXPECT_TRUE(stage("OP_ADD") == after(R"(
in 1 RGB A TEXTURE1 UNSIGNED_IDENTITY RGB
in 1 RGB B ZERO UNSIGNED_INVERT RGB
in 1 RGB C SPARE0 UNSIGNED_IDENTITY RGB
in 1 RGB D ZERO UNSIGNED_INVERT RGB
out 1 RGB DISCARD DISCARD SPARE0 NONE 0
)"));
  EXPECT_TRUE(read("translator.c", {"set_stage"}, {{"stage", "0"}, {"is_alpha", "1"}, {"op", "OP_MODULATE"}}) ==
              after(R"(
in 0 ALPHA A TEXTURE0 UNSIGNED_IDENTITY ALPHA
in 0 ALPHA B PRIMARY_COLOR UNSIGNED_IDENTITY ALPHA
out 0 ALPHA SPARE0 DISCARD DISCARD NONE 0
)"));
}

TEST(SourceFamilies, ProgramsOfNvparseInStrings) {
  const auto rc10 = [](const std::string& text) { return *parse_rc10({"!!RC1.0 " + text, "e"}, profiles::nv2a); };
  EXPECT_TRUE(
      read("nvparse_demo.cpp", {}) ==
      rc10("{rgb{spare0 = expand(tex0) . expand(col0);}} out.rgb = spare0 * tex1; out.a = unsigned_invert(zero);"));
  EXPECT_TRUE(read("nvparse_demo.cpp", {"unused"}) == rc10("out.rgb = tex0;"));
}

TEST(SourceFamilies, DisplayListsAreFilledUnderOneCondition) {
  // The assumption about the first function's condition holds for the second, too.
  EXPECT_TRUE(read("display_lists.cpp", {"InitCombiners"}) == after(R"(
count 2
in 0 RGB A TEXTURE0 UNSIGNED_IDENTITY RGB
in 1 RGB A TEXTURE1 EXPAND_NORMAL RGB
)"));
}

TEST(SourceFamilies, AreListedWithWhatTheyNeed) {
  const auto listed = [](const std::string& file) {
    std::string out;
    const std::string text = family_source(file);
    for (const SourceFunction& f : find_source_functions({text, file}, {}, profiles::nv2a)) {
      out += f.name + ":" + std::to_string(f.line) + " " + std::to_string(f.calls_read) + "/" +
             std::to_string(f.calls_not_read) + (f.is_helper ? " helper" : "");
      for (const std::string& need : f.needs) out += " " + need;
      out += "\n";
    }
    return out;
  };
  EXPECT_EQ(listed("lights.c"),
            "R_LightFragments:21 13/0\n"
            "R_DrawLight:48 0/1 first light.color r_lists.integer\n");
  EXPECT_EQ(listed("scene_graph.cpp"),
            "LayerBlend::prepare:16 4/0\n"
            "LayerBlend::apply:35 1/1 order unit\n");
  EXPECT_EQ(listed("ripples.java"),
            "Ripples::init:11 7/0\n"
            "Ripples::initCombiners:19 3/0\n"
            "Ripples::input:42 0/2 helper register stage variable\n"
            "Ripples::output:48 0/1 helper register scale stage\n");
  EXPECT_EQ(listed("translator.c"), "set_stage:28 0/6 is_alpha op stage\n");
  EXPECT_EQ(listed("nvparse_demo.cpp"),
            "init_programs:21 2/0\n"
            "unused:15 1/0\n");
}

}  // namespace
}  // namespace ninebit
