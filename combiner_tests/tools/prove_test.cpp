// `ninebit prove` as people and programs see it; the proofs themselves are tested beside the library.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

// The article's comparison in RC1.0, with the second scale given.
std::string compare_text(const std::string& second_scale) {
  return "!!RC1.0\n{ rgb { discard = unsigned(col0); discard = -tex0; spare0 = sum(); scale_by_four(); } }\n"
         "{ rgb { spare1 = spare0 . spare0; " +
         second_scale + " } }\nout.rgb = zero; out.a = spare1.b;\n";
}

class Prove : public testing::Test {
 protected:
  [[nodiscard]] Outcome equivalent(const std::string& b, const Words& more = {}) const {
    return ninebit(Words{"prove", "equivalent", kArticle, b, "--quiet"} + more);
  }

  TempFolder folder_;
  std::string same_ = write_bytes(folder_ / "same.rc", compare_text("scale_by_four();"));
  std::string other_ = write_bytes(folder_ / "other.rc", compare_text("scale_by_two();"));
};

TEST_F(Prove, TwoFormsOfOneProgram) {
  const Outcome people = equivalent(same_);
  EXPECT_EQ(people.code, 0) << people.err;
  EXPECT_EQ(people.err, "");
  EXPECT_TRUE(people.out.starts_with("proved: ")) << people.out;

  const Json object = json_of(equivalent(same_, {"--json"}));
  EXPECT_EQ(keys_of(object), (Words{"command", "version", "question", "answer", "method", "cases", "profile",
                                    "other_profile", "programs"}));
  EXPECT_EQ(object["question"], "equivalent");
  EXPECT_EQ(object["answer"], "proved");
  EXPECT_EQ(object["programs"], Json({kArticle, same_}));
}

// Texture-shader stages before the combiners.
class ProveStages : public Prove {
 protected:
  // Stage 1 is a line of !!TS1.0; the combiners show `shown`.
  std::string program(const std::string& name, const std::string& stage, const std::string& shown = "tex1") {
    return write_bytes(folder_ / name,
                       "!!TS1.0\ntexture_2d();\n" + stage + ";\n!!RC1.0\nout.rgb = " + shown + ";\nout.a = zero;\n");
  }
  static Outcome prove(const Words& words) { return ninebit(Words{"prove"} + words + Words{"--profile", "nv2a"}); }
};

TEST_F(ProveStages, ALookUpThatBothReadAlikeIsOneOpaqueInput) {
  const std::string a = program("a.rc", "offset_2d(tex0, 0.5, 0, 0, 0.5)");
  const Outcome same = prove({"equivalent", a, a});
  EXPECT_EQ(same.code, 0) << same.err;
  expect_parts(same.err, {"note: tex1 is an opaque input, any four bytes: texture 1 at "});
  const Json object = json_of(prove({"equivalent", a, a, "--json", "--quiet"}));
  EXPECT_EQ(object["opaque"], Json({"tex1"}));
  // Another colour of the same look-up is refuted.
  const std::string half = program("c.rc", "offset_2d(tex0, 0.5, 0, 0, 0.5)", "tex1.a");
  EXPECT_EQ(prove({"equivalent", a, half, "--quiet"}).out.substr(0, 8), "refuted:");
}

TEST_F(ProveStages, OtherStagesMakeTheAnswerUnknown) {
  const std::string a = program("a.rc", "offset_2d(tex0, 0.5, 0, 0, 0.5)");
  for (const char* stage :
       {"offset_2d(tex0, 0.5, 0.25, 0, 0.5)", "dependent_ar(tex0)", "texture_2d()", "pass_through()", "nop()"}) {
    const Outcome outcome = prove({"equivalent", a, program("b.rc", stage), "--quiet"});
    EXPECT_EQ(outcome.code, 1) << stage << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("unknown: tex1 is texture 1 at ")) << stage << outcome.out;
    expect_parts(outcome.out, {": it cannot be one input of both"});
  }
  const std::string keeps = "GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, ";
  const std::string kills = program("k.rc", "cull_fragment(" + keeps + "LESS_THAN_ZERO)", "tex0");
  const Outcome culls = prove({"equivalent", kills, program("s.rc", "nop()", "tex0"), "--quiet"});
  expect_parts(culls.out, {"do not cull the same fragments"});
  // A register that no output depends on makes no difference.
  EXPECT_EQ(prove({"equivalent", program("d.rc", "dependent_ar(tex0)", "tex0"),
                   program("e.rc", "dependent_gb(tex0)", "tex0"), "--quiet"})
                .code,
            0);
}

TEST_F(ProveStages, AStageWithoutATexelHasItsOneValue) {
  // Stage 1 gives (0, 0, 0, 0).
  const std::string dots = program("dots.rc", "dot_product_2d_1of2(tex0);\ndot_product_2d_2of2(tex0)");
  const std::string zero = program("zero.rc", "dot_product_2d_1of2(tex0);\ndot_product_2d_2of2(tex0)", "zero");
  const Outcome outcome = prove({"equivalent", dots, zero, "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

TEST_F(ProveStages, StableSaysThatFieldsOfStagesAreLeftOut) {
  const Outcome outcome = prove({"stable", program("a.rc", "dependent_ar(tex0)")});
  expect_parts(outcome.err,
               {"note: tex1 is an opaque input", "about texture-shader stages are not part of the question"});
}

TEST_F(Prove, ACounterexampleIsWhatEvalComputes) {
  const Outcome outcome = equivalent(other_, {"--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["answer"], "refuted");
  const Json& inputs = object["counterexample"]["inputs"];
  const Json& outputs = object["counterexample"]["outputs"];
  ASSERT_EQ(outputs["component"], "out.a");
  std::string names, values;
  for (const auto& [name, byte] : inputs.items()) {
    names += (names.empty() ? "" : ",") + name;
    values += (values.empty() ? "" : ",") + byte.dump();
  }
  const std::string table = write_bytes(folder_ / "in.csv", names + "\n" + values + "\n");
  for (const auto& [program, side] : {std::pair{kArticle, "a"}, {other_, "b"}}) {
    const Json rows = json_of(ninebit({"eval", program, "--inputs", table, "--json"}))["rows"];
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0]["out.a"], outputs[side]) << program;
  }
  EXPECT_TRUE(equivalent(other_).out.starts_with("refuted: "));
}

// A conversion is the same program: for all inputs, under every profile.
TEST_F(Prove, Conversions) {
  for (const char* profile : {"geforce2", "nv2a"}) {
    for (const char* form : {"gl", "rc10", "words", "json"}) {
      SCOPED_TRACE(std::string(profile) + ' ' + form);
      const std::string file = folder_ / form;
      const Outcome converted = ninebit({"convert", kArticle, "--to", form, "-o", file, "--profile", profile});
      ASSERT_EQ(converted.code, 0) << converted.err;
      const Outcome outcome = equivalent(file, {"--profile", profile});
      EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
      std::filesystem::remove(file);
    }
  }
}

TEST_F(Prove, OtherProfilesAndOutputs) {
  EXPECT_EQ(equivalent(same_, {"--outputs", "out.r,spare0.a"}).code, 0);
  EXPECT_EQ(equivalent(other_, {"--outputs", "out.r,spare0.r"}).code, 0) << "they differ in alpha alone";
  EXPECT_EQ(equivalent(other_, {"--outputs", "spare1.g"}).code, 1);
  EXPECT_EQ(equivalent(same_, {"--other-profile", "nv2a"}).code, 1) << "expand takes another offset there";
  expect_error(equivalent(same_, {"--outputs", "spare2.a"}), 2, {"--outputs", "spare2.a", "expected", "spare0.a"});
}

// Constants that a program does not set are inputs: --set fixes one, --free frees one.
TEST_F(Prove, ConstantsThatAreNotSet) {
  const auto program = [&](const std::string& name, const std::string& body) {
    return write_bytes(folder_ / name, "!!RC1.0\n" + body + "out.a = tex0.a;\n");
  };
  const std::string a = program("a.rc1", "out.rgb = tex0 * const0;\n"), b = program("b.rc1", "out.rgb = const0;\n"),
                    c = program("c.rc1", "const0 = (0, 0, 0, 0);\nout.rgb = tex0 * const0;\n");
  const auto ask = [](const Words& more) { return ninebit(Words{"prove", "equivalent"} + more); };
  const Outcome refuted = ask({a, b, "--json"});
  EXPECT_EQ(refuted.code, 1);
  expect_parts(refuted.err, {"a.rc1: const0 is not set: an input of the question"});
  EXPECT_TRUE(Json::parse(refuted.out)["counterexample"]["inputs"].contains("const0.r")) << refuted.out;
  EXPECT_EQ(ask({a, a, "--quiet"}).code, 0);
  EXPECT_EQ(ask({a, c, "--quiet"}).code, 1);
  EXPECT_EQ(ask({a, c, "--quiet", "--set", "const0=0,0,0,0"}).code, 0);
  EXPECT_EQ(ask({a, b, "--quiet", "--set", "const0=0,0,0,9"}).code, 0);
  EXPECT_EQ(ask({a, b, "--quiet", "--set", "const0.r=0", "--outputs", "out.r"}).code, 0);
  EXPECT_EQ(ask({a, b, "--quiet", "--set", "const0.r=0"}).code, 1);
  EXPECT_EQ(ask({a, c, "--quiet", "--free", "const0"}).code, 0);
  EXPECT_EQ(ask({b, c, "--quiet", "--free", "const0"}).code, 1);
  EXPECT_EQ(ask({b, c, "--quiet", "--free", "const0", "--set", "tex0=255,255,255,0"}).code, 0);
  expect_error(ask({c, c, "--set", "const0=1,2,3,4"}), 2, {"--set", "const0", "--free const0"});
  expect_error(ask({a, b, "--set", "const0.r=256"}), 2, {"--set", "0 to 255"});
  expect_error(ask({a, b, "--set", "const0=1,2"}), 2, {"--set", "R,G,B,A"});
  expect_error(ask({a, b, "--set", "spare0.a=1"}), 2, {"--set", "spare0", "expected"});
  expect_error(ask({a, b, "--set", "const0.r=1", "--set", "const0=1,2,3,4"}), 2, {"const0.r is set twice"});
  expect_error(ask({a, b, "--free", "const1"}), 2, {"--free const1"});
  const std::string final_only =
      write_bytes(folder_ / "d.rc1", "!!RC1.0\nout.rgb = lerp(const0, tex0, tex1);\nout.a = zero;\n");
  EXPECT_EQ(ninebit({"prove", "stable", final_only, "--quiet"}).code, 1) << "final_narrowing matters";
  EXPECT_EQ(ninebit({"prove", "stable", final_only, "--quiet", "--set", "const0=0,0,0,0"}).code, 0);
}

// Verbs that need a colour say which they assume.
TEST_F(Prove, OtherVerbsSayWhatTheyAssume) {
  const std::string program =
      write_bytes(folder_ / "tint.rc1", "!!RC1.0\nout.rgb = tex0 * const0;\nout.a = const1.a;\n");
  const std::string table = write_bytes(folder_ / "in.csv", "tex0.r,const1.a\n255,3\n");
  const Outcome eval = ninebit({"eval", program, "--inputs", table});
  expect_parts(eval.err, {"tint.rc1: const0 is not set; 0 is assumed"});
  EXPECT_EQ(ninebit({"eval", program, "--inputs", table, "--quiet"}).err, "");
  const Outcome trace = ninebit({"trace", program, "--set", "const0=1,1,1,1"});
  expect_parts(trace.err, {"const1 is not set; 0 is assumed"});
  const std::string rows = write_bytes(folder_ / "rows.csv", "tex0.r,out.r\n255,0\n");
  const Outcome verify = ninebit({"verify", rows, "--program", program});
  expect_parts(verify.err, {"const0, const1 are not set; 0 is assumed"});
  const Outcome c = ninebit({"convert", program, "--to", "c"}), gl = ninebit({"convert", program, "--to", "gl"});
  expect_parts(c.err, {"const0, const1 are not set; 0 is assumed"});
  EXPECT_EQ(gl.err, "");
  const Words draw{"draw", program, "--size", "8x8", "--tex0", "checker:8", "--json", "-o", folder_ / "p.png"};
  const std::string warnings = json_of(ninebit(draw))["warnings"].dump();
  expect_parts(warnings, {"const0 is not set; 0 is assumed", "const1 is not set; 0 is assumed"});
  Words given = draw;
  for (const char* word : {"--const0", "1,1,1,1", "--const1", "0,0,0,1"}) given.emplace_back(word);
  EXPECT_EQ(json_of(ninebit(given))["warnings"], Json::array());
  // A study takes them as inputs; a table must have them.
  const std::string shade = write_bytes(folder_ / "shade.rc1", "!!RC1.0\nout.rgb = zero;\nout.a = const1.a;\n");
  const Json study = json_of(ninebit({"study", "datapath", "--program", shade, "--over", "tex0.r", "--json"}));
  EXPECT_EQ(study["rows"][0]["fragments"], 65536);
  const std::string codes = write_bytes(folder_ / "codes.csv", "tex0.r\n255\n");
  expect_error(ninebit({"study", "datapath", "--program", shade, "--inputs", codes}), 3, {"const1.a", "columns"});
}

// Without a solver there are exhaustive proofs, and a sentence where they do not reach.
TEST_F(Prove, WithoutASolver) {
  const char* const before = std::getenv("PATH");
  const std::string path = before == nullptr ? "" : before;
  ASSERT_EQ(::setenv("PATH", folder_.path().c_str(), 1), 0);
  const Outcome compare = equivalent(same_);
  // Six bytes, and no general combiner between which the question could be cut.
  const std::string end = " } }\nout.rgb = spare0;\nout.a = zero;\n";
  const std::string a = write_bytes(folder_ / "a.rc", "!!RC1.0\n{ rgb { spare0 = tex0 . tex1;" + end);
  const std::string b = write_bytes(folder_ / "b.rc", "!!RC1.0\n{ rgb { spare0 = -tex0 . -tex1;" + end);
  const Outcome unknown = ninebit({"prove", "equivalent", a, b, "--quiet"});
  ASSERT_EQ(::setenv("PATH", path.c_str(), 1), 0);
  EXPECT_EQ(compare.code, 0) << compare.out << compare.err;
  EXPECT_EQ(unknown.code, 1) << unknown.err;
  EXPECT_TRUE(unknown.out.starts_with("unknown: ")) << unknown.out;
  expect_parts(unknown.out, {"install the package z3"});
}

TEST_F(Prove, TheFieldsThatTheArticlesProgramRestsOn) {
  const Json object = json_of(ninebit({"prove", "stable", kArticle, "--json"}), 1);
  EXPECT_EQ(object["question"], "stable");
  EXPECT_EQ(object["answer"], "refuted");
  ASSERT_FALSE(object["fields"].empty());
  for (const Json& field : object["fields"]) {
    EXPECT_NE(field["evidence"], "measured") << field;
    EXPECT_NE(field["evidence"], "specified") << field;
    EXPECT_EQ(field["answer"], field["field"] == "expand_offset" ? "refuted" : "proved") << field;
    EXPECT_EQ(field.contains("counterexample"), field["field"] == "expand_offset") << field;
  }
  const std::string people = out_of(ninebit({"prove", "stable", kArticle}), 1);
  EXPECT_TRUE(people.starts_with("refuted: ")) << people;
  expect_parts(people, {"matters", "no effect"});
}

TEST_F(Prove, ProgramsThatCannotBeRead) {
  const std::string broken =
      write_bytes(folder_ / "broken.rc", "!!RC1.0\n{ rgb { spare0 = col0 + ; } }\nout.rgb = spare0;\nout.a = zero;\n");
  for (const Words& words :
       {Words{"equivalent", kArticle, broken}, Words{"equivalent", broken, kArticle}, Words{"stable", broken}}) {
    expect_error(ninebit(Words{"prove"} + words), 3, {"broken.rc:2"});
  }
  // A state that the profile's hardware refuses: three stages where a GeForce 2 has two.
  const std::string three =
      write_bytes(folder_ / "three.rc",
                  "!!RC1.0\n{ rgb { spare0 = col0 * tex0; } }\n{ rgb { spare0 = spare0 * tex0; } }\n"
                  "{ rgb { spare0 = spare0 * tex0; } }\nout.rgb = spare0;\nout.a = zero;\n");
  const Outcome refused = ninebit({"prove", "stable", three});
  EXPECT_EQ(refused.code, 3) << refused.out;
  expect_parts(refused.err, {"three.rc"});
  EXPECT_EQ(refused.out, "");
}

TEST_F(Prove, WhatTellsTwoProfilesApart) {
  expect_parts(out_of(ninebit({"prove", "discriminate", "--field", "half", "--quiet"}), 1),
               {"!!RC1.0", "the fewest possible"});
  const Json object = json_of(ninebit({"prove", "discriminate", "--field", "half", "--json"}), 1);
  EXPECT_EQ(keys_of(object), (Words{"command", "version", "question", "answer", "method", "cases", "profiles", "fields",
                                    "program", "general_combiners", "shortest", "texture_off", "counterexample"}));
  EXPECT_EQ(object["fields"], Json({"half"}));
  // The program gives these bytes in `eval`, too.
  const std::string program = write_bytes(folder_ / "found.rc1", object["program"].get<std::string>());
  const std::string byte = object["counterexample"]["inputs"]["tex0"].dump();
  const std::string table = write_bytes(folder_ / "in.csv", "tex0.r\n" + byte + "\n");
  const std::string rival = write_bytes(folder_ / "rival.json", R"({"base": "geforce2", "name": "r", "half": 127})");
  const Json& outputs = object["counterexample"]["outputs"];
  for (const auto& [profile, side] : {std::pair{std::string("geforce2"), "a"}, {rival, "b"}}) {
    const Json rows = json_of(ninebit({"eval", program, "--inputs", table, "--profile", profile, "--json"}))["rows"];
    EXPECT_EQ(rows[0]["out.r"], outputs[side]) << profile;
  }

  const std::string same = out_of(ninebit({"prove", "discriminate", "nv2a", "nv2a", "--quiet"}));
  EXPECT_TRUE(same.starts_with("proved: no program")) << same;
  expect_error(ninebit({"prove", "discriminate", "--field", "halve"}), 2, {"--field", "halve", "half"});
  expect_error(ninebit({"prove", "discriminate"}), 2, {"two profiles", "--field"});
  expect_error(ninebit({"prove", "discriminate", "geforce2"}), 2, {"profile2"});
}

TEST_F(Prove, TellsWhichQuestionsThereAre) {
  const Outcome outcome = ninebit({"prove"});
  EXPECT_EQ(outcome.code, 2);
  expect_parts(ninebit({"prove", "--help"}).out, {"ninebit prove stable"});
}

TEST_F(Prove, EndsWhenInterrupted) {
  Child child({"prove", "equivalent", kArticle, same_, "--other-profile", "nv2a", "--quiet", "--outputs", "out.a"});
  child.send(SIGINT);
  const Outcome outcome = child.wait();
  // It may have answered before the signal came.
  EXPECT_TRUE(outcome.code == 130 || outcome.code == 1) << outcome.code << outcome.err;
}

}  // namespace
}  // namespace tools_test
