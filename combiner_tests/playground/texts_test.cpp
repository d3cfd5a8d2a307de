// The engine's answers about texts.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "combiner_tests/playground/support.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/profile_json.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/rc10.h"
#include "ninebit/numerics/fixed9.h"
#include "src/combiner/given_registers.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/rc10/rc10_lexer.h"

namespace ninebit::test {
namespace {

TEST(PlaygroundAbout, ListsProfilesAsProfileFilesHaveThem) {
  const PageJson answer = good({{"do", "about"}});
  ASSERT_EQ(answer["profiles"].size(), hardware_profiles().size());
  int fields = 0;
  for (const PageJson& profile : answer["profiles"]) {
    for (const PageJson& field : profile["fields"]) {
      if (!field["read"]) continue;
      // A file that sets the field to the value that it has, and to each of its choices, is a profile.
      std::vector<PageJson> values{field["value"]};
      for (const PageJson& word : field.value("choices", PageJson::array())) values.push_back(word);
      if (field["name"] == "arithmetic") values.resize(1);
      for (const PageJson& value : values) {
        const PageJson file{{"base", profile["name"]}, {"name", "mine"}, {field["name"].get<std::string>(), value}};
        const auto parsed = parse_json_profile({file.dump(), "test"});
        EXPECT_TRUE(parsed) << file << ": " << (parsed ? "" : parsed.faults()[0].message);
        ++fields;
      }
      if (field.contains("range")) {
        const PageJson beyond = field["range"][1].get<int>() + 1;
        const PageJson file{{"base", profile["name"]}, {"name", "mine"}, {field["name"].get<std::string>(), beyond}};
        EXPECT_FALSE(parse_json_profile({file.dump(), "test"})) << file;
      }
    }
  }
  EXPECT_GT(fields, 200);
}

TEST(PlaygroundVocabulary, HasHelpForEveryNameThatIsRead) {
  const PageJson answer = good({{"do", "vocabulary"}});
  std::set<std::string> words;
  for (const PageJson& word : answer["words"]) {
    words.insert(word["kind"].get<std::string>() + " " + word["word"].get<std::string>());
    EXPECT_GE(word["help"].get<std::string>().size(), 4U) << word;
    EXPECT_LE(word["help"].get<std::string>().size(), 160U) << word;
  }
  EXPECT_EQ(words.size(), answer["words"].size()) << "a word stands there twice";
  const auto expect = [&](const std::string& kind, std::string_view name) {
    EXPECT_EQ(words.count(kind + " " + std::string(name)), 1U) << kind << " " << name;
  };
  for (const std::string_view name : detail::gl_names()) expect("gl-constant", name);
  for (const detail::GlSignature& call : detail::gl_calls()) expect("gl-function", "gl" + std::string(call.name));
  for (const detail::Rc10Name& name : detail::kRc10Names) expect("rc10", name.name);
  for (const detail::ShaderOpRow& op : detail::shader_ops()) expect("ps", op.name);
  for (const HardwareProfile& profile : hardware_profiles()) expect("profile", profile.name);
}

TEST(PlaygroundRead, FindsTheFormAndWhatIsComputed) {
  const PageJson answer = good({{"do", "read"}, {"text", kTexelTimesColor}});
  EXPECT_EQ(answer["form"], "gl");
  EXPECT_TRUE(answer["valid"]);
  EXPECT_EQ(answer["faults"], PageJson::array());
  EXPECT_EQ(answer["textures"], PageJson::array({0}));
  EXPECT_EQ(answer["general_combiners"], 1);
  EXPECT_NE(answer["explanation"].get<std::string>().find("spare0 = tex0 × primary"), std::string::npos) << answer;
}

TEST(PlaygroundRead, MarksEveryFaultAtItsWord) {
  const std::string text =
      "glEnable(GL_REGISTER_COMBINERS_NV);\n"
      "/* \xC3\xA9\xF0\x9F\x8E\xA8 */ glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_VN, 1);\n"
      "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 9);\n";
  const PageJson answer = ask({{"do", "read"}, {"text", text}});
  ASSERT_EQ(answer["faults"].size(), 2U) << answer;
  EXPECT_FALSE(answer["valid"]);
  EXPECT_FALSE(answer.contains("explanation"));
  const PageJson& misspelled = answer["faults"][0];
  EXPECT_EQ(misspelled["line"], 2);
  // Three letters, é, a picture of two units, four letters, then the call's 23; columns begin at 1.
  EXPECT_EQ(misspelled["column"], 3 + 1 + 2 + 4 + 23 + 1) << misspelled;
  EXPECT_EQ(misspelled["length"], 27);
  EXPECT_EQ(misspelled["gl_error"], nullptr);
  EXPECT_EQ(answer["faults"][1]["line"], 3);
  EXPECT_EQ(answer["faults"][1]["gl_error"], "GL_INVALID_VALUE");
}

TEST(PlaygroundRead, ListsTheConstantsOfEachStage) {
  const std::string text = "!!RC1.0\n{ const0 = (1, 0, 0, 1); rgb { spare0 = const0; } }\nout.rgb = spare0;\n";
  const PageJson constants = ask({{"do", "read"}, {"text", text}, {"profile", "nv2a"}})["constants"];
  EXPECT_EQ(constants["stages"].size(), 1U) << constants;
  EXPECT_EQ(constants["stages"][0]["const0"], PageJson::parse("[1.0, 0.0, 0.0, 1.0]")) << constants;
  EXPECT_FALSE(ask({{"do", "read"}, {"text", kTexelTimesColor}})["constants"].contains("stages"));
}

TEST(PlaygroundRead, TakesAProfileOfOnesOwn) {
  const std::string three = R"({"ninebit": "program", "version": 1, "num_general_combiners": 3})";
  EXPECT_FALSE(ask({{"do", "read"}, {"text", three}})["valid"]);
  EXPECT_TRUE(ask({{"do", "read"}, {"text", three}, {"profile", "nv2a"}})["valid"]);
  const PageJson mine{{"base", "geforce2"}, {"name", "mine"}, {"general_combiners", 3}};
  EXPECT_TRUE(ask({{"do", "read"}, {"text", three}, {"profile", mine}})["valid"]);
  EXPECT_TRUE(ask({{"do", "read"}, {"text", three}, {"profile", mine.dump()}})["valid"]);
  const PageJson wrong{{"base", "geforce2"}, {"name", "mine"}, {"general_combiners", 99}};
  const std::string fault = fault_of_answer(ask({{"do", "read"}, {"text", three}, {"profile", wrong}}));
  EXPECT_NE(fault.find("general_combiners must be a whole number from 1 to 8"), std::string::npos) << fault;
}

// Two functions that set combiners, the second from a value that the text does not give; a header gives a register.
constexpr std::string_view kTwoFunctions = R"(#include "lib/source.h"
void by_texel(void) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, SOURCE, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
}
void by_constant(const float *color) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
}
)";
constexpr std::string_view kSourceHeader = "#define SOURCE GL_TEXTURE1_ARB\n";

PageJson read_source(const PageJson& choice, std::string_view text = kTwoFunctions) {
  return ask({{"do", "read"},
              {"text", text},
              {"name", "programs/two.c"},
              {"files", {{"programs/two.c", text}, {"programs/lib/source.h", kSourceHeader}}},
              {"choice", choice}});
}

TEST(PlaygroundRead, ListsTheFunctionsOfASourceAndReadsTheChosenOne) {
  const PageJson all = read_source(PageJson::object());
  ASSERT_EQ(fault_of_answer(all), "");
  EXPECT_EQ(all["form"], "source");
  EXPECT_FALSE(all["valid"]) << all;
  ASSERT_EQ(all["functions"].size(), 2U) << all;
  EXPECT_EQ(all["functions"][0]["name"], "by_texel");
  EXPECT_EQ(all["functions"][0]["needs"], PageJson::array());
  EXPECT_EQ(all["functions"][1]["needs"], PageJson::array({"color"})) << all;
  EXPECT_EQ(all["programs"], 1);
  // What is included gives the texture unit.
  EXPECT_EQ(read_source({{"function", "by_texel"}})["textures"], PageJson::array({1}));
  const PageJson asks = read_source({{"function", "by_constant"}});
  EXPECT_NE(asks["faults"][0]["message"].get<std::string>().find("'color'"), std::string::npos) << asks;
  const PageJson given = read_source({{"function", "by_constant"}, {"defines", {{"color", "1,0.5,0,1"}}}});
  ASSERT_TRUE(given["valid"]) << given;
  EXPECT_EQ(given["constants"]["const0"], PageJson::parse("[1.0, 0.5, 0.0, 1.0]"));
  EXPECT_EQ(given["functions"][1]["needs"], PageJson::array());
  const PageJson outside = ask({{"do", "read"},
                                {"text", "#include \"../lib/source.h\"\n" + std::string(kTwoFunctions)},
                                {"name", "programs/two.c"},
                                {"files", {{"lib/source.h", "#error no\n"}}},
                                {"choice", {{"function", "by_texel"}}}});
  EXPECT_FALSE(outside["valid"]) << "a source reads what is beside it or below";
}

TEST(PlaygroundRead, CountsTheProgramsThatANumberPicks) {
  const std::string text =
      "void f(void) {\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);\n  glDrawArrays(GL_TRIANGLES, 0, 3);\n"
      "  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);\n  glDrawArrays(GL_TRIANGLES, 0, 3);\n}\n";
  const PageJson none = read_source(PageJson::object(), text);
  EXPECT_FALSE(none["valid"]);
  EXPECT_EQ(none["programs"], 2) << none;
  for (const int number : {1, 2}) {
    const PageJson one = read_source({{"program", number}}, text);
    EXPECT_EQ(one["general_combiners"], number) << one;
    EXPECT_EQ(one["programs"], 2) << one;
  }
  EXPECT_FALSE(read_source({{"program", 3}}, text)["valid"]);
  EXPECT_FALSE(read_source({{"program", 1}}, "!!RC1.0\nout.rgb = tex0;\n")["valid"]);
}

TEST(PlaygroundRead, NamesWhatAShadersConditionsNeed) {
  const std::string text = "ps.1.1\n#if BRIGHT\nmov_x2 r0, v0\n#else\nmov r0, v0\n#endif\n";
  EXPECT_EQ(read_source(PageJson::object(), text)["needs"], PageJson::array({"BRIGHT"}));
  const PageJson given = read_source({{"defines", {{"BRIGHT", "1"}}}}, text);
  EXPECT_TRUE(given["valid"]) << given;
  EXPECT_EQ(given["needs"], PageJson::array());
}

TEST(PlaygroundRead, RefusesChoicesOfOtherKinds) {
  for (const PageJson& choice :
       {PageJson(7), PageJson{{"function", 7}}, PageJson{{"function", ""}}, PageJson{{"program", 0}},
        PageJson{{"defines", {{"a", 1}}}}, PageJson{{"defines", {{"a", ""}}}}, PageJson{{"defines", "a=1"}},
        PageJson{{"other", 1}}}) {
    EXPECT_NE(fault_of_answer(read_source(choice)), "") << choice;
  }
}

TEST(PlaygroundRead, SaysThatATextOfAnotherFormHasNoChoice) {
  const std::string text = "!!RC1.0\nout.rgb = tex0;\n";
  const auto fault = [&](const PageJson& choice) {
    return read_source(choice, text)["faults"][0]["message"].get<std::string>();
  };
  EXPECT_NE(fault({{"function", "f"}}).find("is chosen, and this is an !!RC1.0 program"), std::string::npos);
  EXPECT_NE(fault({{"defines", {{"a", "1"}}}}).find("and this is an !!RC1.0 program"), std::string::npos);
  EXPECT_TRUE(read_source(PageJson::object(), text)["valid"]);
}

TEST(PlaygroundConvert, WritesTheChosenFunction) {
  const PageJson answer = good({{"do", "convert"},
                                {"text", kTwoFunctions},
                                {"to", "json"},
                                {"choice", {{"function", "by_constant"}, {"defines", {{"color", "1,0.5,0,1"}}}}}});
  const PageJson constants = ask({{"do", "read"}, {"text", answer["text"]}})["constants"];
  EXPECT_EQ(constants["const0"], PageJson::parse("[1.0, 0.5, 0.0, 1.0]"));
}

TEST(PlaygroundConvert, WritesWhatConvertWrites) {
  const auto program = parse_program({kTexelTimesColor, ""}, ProgramForm::gl, profiles::geforce2);
  ASSERT_TRUE(program);
  for (const std::string& form : written_form_names()) {
    const PageJson answer = ask({{"do", "convert"}, {"text", kTexelTimesColor}, {"to", form}});
    const auto expected = find_form(form)->print(*program, chip_of(profiles::geforce2), profiles::geforce2);
    if (expected) {
      EXPECT_EQ(answer["text"], *expected) << form;
    } else {
      EXPECT_NE(fault_of_answer(answer).find(expected.error().message), std::string::npos) << form;
    }
  }
}

TEST(PlaygroundTrace, StepsThroughTheGivenCodes) {
  const PageJson answer = good({{"do", "trace"},
                                {"text", kTexelTimesColor},
                                {"registers", {{"tex0", {255, 128, 0, 255}}, {"primary", {100, 100, 100, 50}}}}});
  EXPECT_EQ(answer["command"], "trace");
  EXPECT_EQ(answer["program"], nullptr);
  // Texture 0's alpha is spare0's at the start, unless that is given.
  const auto traced = [](const PageJson& registers) {
    return ask({{"do", "trace"}, {"text", "!!RC1.0\nout.rgb = spare0.a;\n"}, {"registers", registers}});
  };
  const PageJson tex0{{"tex0", {0, 0, 0, 77}}};
  EXPECT_EQ(traced(tex0), traced({{"tex0", {0, 0, 0, 77}}, {"spare0", {0, 0, 0, 77}}}));
  EXPECT_NE(traced(tex0), traced({{"tex0", {0, 0, 0, 77}}, {"spare0", {0, 0, 0, 78}}}));
  const PageJson refused = ask(
      {{"do", "trace"}, {"text", kTexelTimesColor}, {"registers", {{"tex0", {256, 0, 0, 0}}, {"tex9", {0, 0, 0, 0}}}}});
  EXPECT_NE(fault_of_answer(refused).find("from -255 to 255"), std::string::npos) << refused;
  EXPECT_EQ(refused["fault"]["others"].size(), 1U) << refused;
}

// Every pixel is what evaluate_fragment() gives for its texels.
TEST(PlaygroundEvaluate, IsTheReferenceTexelByTexel) {
  const std::string text =
      "!!RC1.0\n{ rgb { spare1 = tex0 * tex1; scale_by_two(); } }\nout.rgb = spare1 + const0;\n"
      "out.a = spare0.a;\n";
  for (const HardwareProfile& profile : hardware_profiles()) {
    SCOPED_TRACE(profile.name);
    Engine engine;
    constexpr std::size_t kPixels = 300;
    const auto buffer = engine.buffer(8 * kPixels);
    for (std::size_t i = 0; i < buffer.size(); ++i) buffer[i] = static_cast<std::uint8_t>(i * 37 + i / 256);
    const std::vector<std::uint8_t> given(buffer.begin(), buffer.end());
    const PageJson answer = good(engine, {{"do", "evaluate"},
                                          {"text", text},
                                          {"profile", profile.name},
                                          {"pictures", {"tex1", "tex0"}},
                                          {"registers", {{"const0", {7, 0, 3, 0}}}}});
    ASSERT_EQ(engine.bytes().size(), 4 * kPixels);
    Program program = normalize(parse_rc10({text, ""}, profile).value(), profile);
    const Rgba9 constant{7, 0, 3, 0};
    for (int c = 0; c < 4; ++c)
      replace_constant(program, Register::constant0, c, constant[static_cast<std::size_t>(c)]);
    for (std::size_t i = 0; i < kPixels; ++i) {
      RegisterFile registers = default_registers(profile);
      for (std::size_t c = 0; c < 4; ++c) {
        registers[Register::texture1][c] = from_byte(profile, given[4 * i + c]);
        registers[Register::texture0][c] = from_byte(profile, given[4 * kPixels + 4 * i + c]);
      }
      registers[Register::spare0][kAlpha] = registers[Register::texture0][kAlpha];
      const Rgba9 color = evaluate_fragment(program, registers).color;
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(engine.bytes()[4 * i + c], to_byte(profile, color[c])) << i;
    }
  }
}

TEST(PlaygroundEvaluate, RefusesWhatIsNoPicture) {
  Engine engine;
  const auto fault = [&](const PageJson& pictures) {
    (void)engine.buffer(12);
    return fault_of_answer(ask(engine, {{"do", "evaluate"}, {"text", kTexelTimesColor}, {"pictures", pictures}}));
  };
  EXPECT_EQ(fault({"tex0"}), "");
  EXPECT_NE(fault({"tex0", "primary"}).find("the buffer has 12 bytes; expected 2 pictures"), std::string::npos);
  EXPECT_NE(fault({"tex0", "tex0"}).find("each once"), std::string::npos);
  EXPECT_NE(fault({"const0"}).find("each once"), std::string::npos);
  EXPECT_NE(fault({"tex9"}).find("each once"), std::string::npos);
  EXPECT_NE(fault(PageJson::array()), "");
  EXPECT_NE(fault("tex0"), "");
}

}  // namespace
}  // namespace ninebit::test
