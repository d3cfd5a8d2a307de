// Files of another kind or language: one line that names what they are and the verb that reads them.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kRc10Text = "!!RC1.0\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n";

struct Kind {
  std::string bytes, seems;
};

std::vector<Kind> foreign_kinds() {
  return {
      {read_bytes(NINEBIT_SOURCE_DIR "/docs/images/stencil.png"), "a PNG picture"},
      {"\xFF\xD8\xFF\xE0 JFIF", "a JPEG picture"},
      {std::string("\x76\x2F\x31\x01\x02\0\0\0", 8), "an OpenEXR picture"},
      {std::string("DDS \x7C\0\0\0", 8), "a DDS texture"},
      {std::string("PK\x03\x04\0\0", 6), "a ZIP archive"},
      {"\x1F\x8B\x08", "a gzip file"},
      {read_bytes(kProgram).substr(0, 5000), "a program or library (ELF)"},
      {read_bytes(kRoom), "a glTF scene"},
      {std::string("glTF\x02\0\0\0\0\0\0\0", 12), "a binary glTF scene"},
      {"ply\nformat ascii 1.0\n", "a PLY mesh"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "an OBJ mesh"},
      {"#!/bin/sh\nfor i in 1 2; do\n  echo \"$i\";\ndone;\n", "a shell script"},
      {"#!/usr/bin/env python3\nimport sys\n", "a Python script"},
      {"<!DOCTYPE html>\n<p>;</p>\n", "an HTML page"},
      {"<?xml version=\"1.0\"?>\n<x/>\n", "an XML file"},
      {"#version 330\nvoid main() { gl_FragColor = vec4(1.0); }\n", "a GLSL shader"},
      {"!!ARBfp1.0\nMOV result.color, fragment.color;\nEND\n", "a program in !!ARBfp1.0"},
      {read_bytes(NINEBIT_SOURCE_DIR "/src/tools/main.cpp"), "C or C++ source"},
      {read_bytes(NINEBIT_SOURCE_DIR "/README.md"), "a Markdown page"},
      {std::string("a\0b\0c", 5), "a binary file"},
      {"\xFF\xFEg\1l\1", "a text in UTF-16"},
  };
}

std::string being(const std::string& kind) {
  return (kind == "GL calls" ? "these are " : "this is ") + kind;
}

// The text behind the kind: its reader, or the kinds that were expected.
std::string use_of(const std::string& kind, const std::string& expected) {
  const auto is = [&](const char* word) { return kind.find(word) != std::string::npos; };
  if (is("scene") || is("mesh")) return "`ninebit render` draws it";
  if (is("picture") || is("texture")) return "`ninebit draw` reads it as a texture, with --tex0";
  if (is("hardware profile")) return "`ninebit profiles` reads it, with --profile";
  if (is("table")) return "`ninebit eval` reads it, with --inputs";
  if (is("GL calls")) return "`ninebit explain` reads them";
  if (is("RC1.0")) return "`ninebit explain` reads it";
  return "expected " + expected;
}

TEST(OtherKinds, GivenAsAProgram) {
  const TempFolder folder;
  std::vector<Kind> kinds = foreign_kinds();
  kinds.push_back({"tex0.r,out.r\n1,1\n", "a table of comma-separated values"});
  kinds.push_back({"{\"ninebit\": \"profile\", \"version\": 1}", "a hardware profile"});
  kinds.push_back({"{\"name\": \"x\", \"private\": true, \"main\": 1, \"type\": {}}", "JSON of another kind"});
  kinds.push_back({"Dear reader,\nthis is a letter;\nit has\nmany; lines; but; no; calls;\n", "some other text"});
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.seems);
    const std::string file = write_bytes(folder / "file", kind.bytes);
    const bool is_shader =
        kind.seems.find("GLSL") != std::string::npos || kind.seems.find("!!ARB") != std::string::npos;
    const bool is_guess = kind.seems == "some other text" || kind.seems == "JSON of another kind";
    expect_error(ninebit({"validate", file}), 3,
                 {is_shader  ? ", which register combiners cannot run"
                  : is_guess ? "/file: seems to be " + kind.seems + "; expected a combiner program"
                             : "/file: this is " + kind.seems + "; " + use_of(kind.seems, "a combiner program")});
  }
  // All verbs that read programs.
  const std::string file = write_bytes(folder / "file", kinds.front().bytes);
  const std::string table = write_bytes(folder / "t.csv", "tex0.r,out.r\n1,1\n");
  for (const Words& arguments : std::vector<Words>{{"explain", file},
                                                   {"convert", file, "--to", "json"},
                                                   {"trace", file, "--set", "tex0.r=1"},
                                                   {"eval", file, "--inputs", table},
                                                   {"verify", table, "--program", file}}) {
    SCOPED_TRACE(arguments.front());
    expect_error(ninebit(arguments), 3, {"/file: this is a PNG picture; `ninebit draw` reads it as a texture"});
  }
  // Whatever --from says.
  for (const char* form : {"gl", "rc10", "words", "json"}) {
    expect_error(ninebit({"validate", file, "--from", form}), 3, {"this is a PNG picture; `ninebit draw`"});
  }
}

TEST(OtherKinds, AProgramInAnotherLanguage) {
  const TempFolder folder;
  std::map<std::string, std::string> files;
  for (const char* form : {"gl", "rc10", "words", "json"}) {
    files[form] = folder / form;
    ASSERT_EQ(ninebit({"convert", write_bytes(folder / "p", kRc10Text), "--to", form, "-o", files[form]}).code, 0);
  }
  for (const auto& [from, ignored] : files) {
    for (const auto& [form, file] : files) {
      SCOPED_TRACE(form + " given as " + from);
      const Outcome outcome = ninebit({"validate", file, "--from", from});
      if (form == from) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
      } else if (form == "json" && from == "words") {
        EXPECT_EQ(outcome.code, 3) << "words may be JSON, too";
      } else {
        expect_error(outcome, 3, {"as --from " + from + " says; leave out --from, or give --from " + form});
      }
    }
  }
}

TEST(OtherKinds, GivenAsATableOrAProfile) {
  const TempFolder folder;
  const std::string program = write_bytes(folder / "p", kRc10Text);
  std::vector<Kind> kinds = foreign_kinds();
  kinds.push_back({kRc10Text, "an !!RC1.0 program"});
  kinds.push_back({article_calls(), "GL calls"});
  int number = 0;
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.seems);
    const std::string file = write_bytes(folder / "file.json", kind.bytes);
    const std::string is = "/file.json: " + being(kind.seems) + "; ";
    // Each verb with some of the kinds: what a file seems to be is asked of its bytes alone.
    switch (number++ % 3) {
      case 0:
        expect_error(ninebit({"eval", program, "--inputs", file}), 3, {is + use_of(kind.seems, "a table")});
        break;
      case 1:
        expect_error(ninebit({"verify", file, "--program", program}), 3, {is + use_of(kind.seems, "a table")});
        break;
      default:
        expect_error(ninebit({"profiles", "--profile", file}), 3, {is + use_of(kind.seems, "a profile")});
    }
  }
}

TEST(OtherKinds, GivenAsASceneAPictureAnEffectOrAPart) {
  const TempFolder folder;
  const std::string page = NINEBIT_SOURCE_DIR "/README.md", effect = NINEBIT_SOURCE_DIR "/scenes/effects/toon.json",
                    picture = NINEBIT_SOURCE_DIR "/docs/images/stencil.png", out = folder / "out";
  const std::string draws = ": this is a glTF scene; `ninebit render` draws it",
                    explains = ": these are GL calls; `ninebit explain` reads them",
                    textures = ": this is a PNG picture; `ninebit draw` reads it as a texture",
                    effects = ": this is an effect; `ninebit draw` draws it";
  const auto expect = [](const Words& arguments, const std::string& words) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(ninebit(arguments), 3, {words});
  };
  for (const auto& [file, words] :
       std::map<std::string, std::string>{{picture, textures},
                                          {effect, effects},
                                          {kArticle, explains},
                                          {page, ": this is a Markdown page; expected a scene"}}) {
    expect({"render", file, "-o", out}, file + words);
    expect({"compare", file, "-o", out}, file + words);
    expect({"trace", "--scene", file, "--pixel", "1,1"}, file + words);
    expect({"study", "shadows", file}, file + words);
    expect({"bench", "frame", file, "--quick"}, file + words);
  }
  expect({"draw", kArticle, "-o", out + ".png", "--mesh", picture}, picture + textures);
  expect({"draw", kArticle, "-o", out + ".png", "--tex0", kRoom}, kRoom + draws);
  expect({"draw", kRoom, "-o", out + ".png"}, kRoom + draws);
  expect({"draw", page, "-o", out + ".png"}, page +
                                                 ": this is a Markdown page; expected a combiner program: GL calls, an "
                                                 "!!RC1.0 program, a ps.1.x pixel shader, an assembled");
  expect({"render", kRoom, "-o", out, "--technique", "light-cookie", "--cookie", effect}, effect + effects);
  expect({"trace", "--effect", kRoom, "--pixel", "1,1"}, kRoom + draws);
  expect({"study", "merge", kArticle, "-o", out}, kArticle + explains);
  expect({"explain", effect}, effect + effects);
  EXPECT_FALSE(std::filesystem::exists(out));
}

// A first bracket alone does not make a text JSON.
TEST(OtherKinds, AreNamedFromTheWholeText) {
  const TempFolder folder;
  // These are JSON with a fault.
  for (const char* text :
       {"{\"ninebit\": \"program\" ", "{\"a\" 1}", "{ninebit: 1}", "{'a': 1}", "[{\"a\": 1}", "[1, 2"}) {
    const Outcome outcome = ninebit({"explain", write_bytes(folder / "file", text)});
    EXPECT_NE(outcome.err.find("JSON"), std::string::npos) << text << ": " << outcome.err;
  }
}

// Faults of a text that is what it should be are told one by one, with their places.
TEST(OtherKinds, AreNotWhatHasFaults) {
  const TempFolder folder;
  for (const auto& [text, places] : std::vector<std::pair<std::string, Words>>{
           {"glCombinerInputNV(1);\nglEnable(GL_FOO);\nglX();\nglY();\nglZ();\n", {":1:", ":2:", ":3:", ":4:", ":5:"}},
           {"!!RC1.0\nout.rgb = spare2;\nout.a = spare3;\n", {":2:11:", ":3:9:"}},
           {"lCombinerInputNV(GL_COMBINER0_NV);\n", {":1:1:"}},
           {"RC_IN_RGB[0] = 0x1g\nRC_BAD = 1\n", {":1:"}}}) {
    const std::string outcome = err_of(ninebit({"validate", write_bytes(folder / "file", text)}), 3);
    for (const std::string& place : places) expect_parts(outcome, {place});
  }
}

}  // namespace
}  // namespace tools_test
