// `ninebit convert`: every form leads to every other, and what a form lacks is told.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

const Words kForms{"gl", "rc10", "words", "words-json", "json"};

// The equations of a program stay the same whatever its form is: rows of explain that matter.
Json meaning_of(const std::string& file, const Words& more = {}) {
  const Words arguments = Words{"explain", file, "--json"} + more;
  Json used = Json::array();
  const Json object = json_of(ninebit(arguments));
  for (const Json& row : object.at("rows")) {
    if (row.at("used") == true) used.push_back(row);
  }
  return used;
}

TEST(Convert, EveryFormToEveryOther) {
  const TempFolder folder;
  const std::string& calls = kArticle;
  const Json meaning = meaning_of(calls);
  ASSERT_EQ(meaning.size(), 4U);
  std::size_t number = 0;
  for (const std::string& form : kForms) {
    const std::string file = folder / form;
    const Outcome first = ninebit({"convert", calls, "--to", form, "-o", file});
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(first.err, "wrote " + file + "\n");
    EXPECT_EQ(first.out, "");
    EXPECT_EQ(ninebit({"convert", calls, "--to", form}).out, read_bytes(file));
    EXPECT_EQ(meaning_of(file), meaning) << form << " is told by its content";
    // To the next form and to itself: a form is read and written without regard to the other.
    for (const std::string& other : {form, kForms[(number++ + 1) % kForms.size()]}) {
      SCOPED_TRACE(form + " to " + other);
      const Outcome second = ninebit({"convert", file, "--to", other});
      ASSERT_EQ(second.code, 0) << second.err;
      EXPECT_EQ(meaning_of(write_bytes(folder / "second", second.out)), meaning);
    }
  }
}

TEST(Convert, Chips) {
  const TempFolder folder;
  CombinerState state = article_state();
  const std::string program = write_program(folder, "a.json", state);
  const std::string nv10 = ninebit({"convert", program, "--to", "words"}).out;
  const std::string nv20 = ninebit({"convert", program, "--to", "words", "--chip", "nv20"}).out;
  EXPECT_NE(nv10, nv20);
  EXPECT_EQ(ninebit({"convert", program, "--to", "words", "--chip", "nv10"}).out, nv10);
  EXPECT_EQ(ninebit({"convert", program, "--to", "words", "--profile", "nv2a"}).out, nv20);
}

TEST(Convert, CodeOut) {
  const TempFolder folder;
  const std::string program = write_program(folder, "a.json", article_state());
  EXPECT_TRUE(ninebit({"convert", program, "--to", "glsl"}).out.starts_with("#version 330"));
  EXPECT_TRUE(ninebit({"convert", program, "--to", "glsl-es"}).out.starts_with("#version 300 es"));
  expect_parts(ninebit({"convert", program, "--to", "c"}).out, {"void ninebit_combine("});
}

TEST(Convert, WhatAFormLacksIsTold) {
  const TempFolder folder;
  CombinerState state;
  state.num_general_combiners = 3;
  const std::string program = write_program(folder, "three.json", state);
  expect_error(ninebit({"convert", program, "--to", "words", "--chip", "nv10", "--profile", "nv2a"}), 3,
               {"three.json", "words"});
  expect_error(ninebit({"convert", program, "--to", "glsl", "--profile", "ideal"}), 3, {"three.json", "glsl"});
  expect_error(ninebit({"convert", program, "--to", "rc10"}), 3, {"GL_INVALID_VALUE"});
  expect_error(ninebit({"convert", program}), 2, {"--to"});
  expect_error(ninebit({"convert", program, "--to", "pascal"}), 2, {"--to"});
}

// All that the NV2A's registers have and OpenGL has not, in one program.
TEST(Convert, WhatOpenGlLacksComesOnlyThroughWordsJsonAndCode) {
  const TempFolder folder;
  const std::string words =
      write_bytes(folder / "x.words", "RC_OUT_RGB[0] = 0x000c4c4d\nRC_FINAL1 = 0x00001ce0\nRC_ENABLE = 0x00000001\n");
  const std::string lacks =
      "mux by the lowest bit of spare0's alpha (general combiner 0); blue-to-alpha output (general combiner 0); 1 - "
      "spare0 in the colour sum; 1 - secondary in the colour sum";
  expect_error(ninebit({"convert", words, "--to", "gl", "--profile", "nv2a"}), 3,
               {"x.words", "cannot be written as gl: OpenGL has no " + lacks});
  expect_error(ninebit({"convert", words, "--to", "rc10", "--profile", "nv2a"}), 3,
               {"cannot be written as rc10: !!RC1.0 cannot express this: " + lacks});
  const std::string file =
      write_bytes(folder / "x.json", out_of(ninebit({"convert", words, "--to", "json", "--profile", "nv2a"})));
  const Outcome back = ninebit({"convert", file, "--to", "words", "--profile", "nv2a"});
  expect_parts(back.out, {"RC_OUT_RGB[0] = 0x000c4c4d\n", "RC_FINAL1 = 0x00001ce0\n", "RC_ENABLE = 0x00000001\n"});
  for (const char* form : {"glsl", "glsl-es", "c"}) {
    EXPECT_EQ(ninebit({"convert", words, "--to", form, "--profile", "nv2a"}).code, 0) << form;
  }
  // A GeForce 2's profile says of each that it has no such thing, at its word.
  const std::string refused = out_of(ninebit({"validate", words, "--chip", "nv20"}), 1);
  const std::string place = words + ':';
  EXPECT_EQ(refused,
            place +
                "1:1: GL_INVALID_ENUM: general combiner 0, RGB portion: profile geforce2 has no blue-to-alpha "
                "outputs (NV2A)\n" +
                place + "2:1: GL_INVALID_ENUM: profile geforce2 has no 1 - x in the colour sum (NV2A)\n" + place +
                "3:1: GL_INVALID_ENUM: profile geforce2 has no mux by the lowest bit of spare0's alpha (NV2A)\n");
}

TEST(Convert, JsonAndOutputs) {
  const TempFolder folder;
  const std::string program = write_program(folder, "a.json", article_state());
  const Json object = json_of(ninebit({"convert", program, "--to", "rc10", "--json"}));
  EXPECT_EQ(keys_of(object), (Words{"command", "version", "profile", "rows"}));
  EXPECT_EQ(object["rows"][0]["form"], "rc10");
  EXPECT_EQ(object["rows"][0]["text"], ninebit({"convert", program, "--to", "rc10"}).out);
  const std::string older = write_bytes(folder / "out", "older");
  expect_error(ninebit({"convert", program, "--to", "gl", "-o", older}, {.file_size_limit = 500}), 4,
               {"File too large"});
  EXPECT_EQ(read_bytes(older), "older");
  expect_error(ninebit({"convert", program, "--to", "gl", "-o", "/dev/full"}), 4, {"No space left"});
  // Through a link to the file that it names.
  std::filesystem::create_symlink("out", folder / "link");
  EXPECT_EQ(ninebit({"convert", program, "--to", "gl", "-o", folder / "link"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_bytes(older), ninebit({"convert", program, "--to", "gl"}).out);
}

}  // namespace
}  // namespace tools_test
