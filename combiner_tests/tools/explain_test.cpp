// `ninebit explain` as people and programs see it; explain's own tests hold what it says against what programs compute.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

TEST(ExplainVerb, TheArticle) {
  const TempFolder folder;
  const Outcome outcome = ninebit({"explain", kArticle});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::size_t from = 0;
  for (const char* equation :
       {"spare0 = 4·(primary − tex0)\n", "spare1 = 4·dot(spare0, spare0)\n", "rgb = 0\n", "alpha = spare1.blue\n"}) {
    from = outcome.out.find(equation, from);
    ASSERT_NE(from, std::string::npos) << equation << outcome.out;
  }
}

TEST(ExplainVerb, Json) {
  const TempFolder folder;
  const Json object = json_of(ninebit({"explain", write_program(folder, "a.json", article_state()), "--json"}));
  for (const char* key : {"command", "version", "profile", "rows", "dead", "constants", "notes", "legend"}) {
    EXPECT_TRUE(object.contains(key)) << key;
  }
  ASSERT_EQ(object["rows"].size(), 4U);
  EXPECT_EQ(object["rows"][0], Json({{"stage", 0},
                                     {"portion", "rgb"},
                                     {"output", "sum"},
                                     {"target", "spare0"},
                                     {"expression", "4·(primary − tex0)"},
                                     {"used", true},
                                     {"clamps", true}}));
  EXPECT_EQ(object["rows"][3]["stage"], "final");
  EXPECT_EQ(object["rows"][3]["expression"], "spare1.blue");
  EXPECT_EQ(object["dead"].size(), 2U);
}

TEST(ExplainVerb, WhatCannotRunIsNotExplained) {
  const TempFolder folder;
  const std::string file = write_bytes(folder / "bad.txt", "glEnable(GL_REGISTER_COMBINERS_NV);\nglCombiner();\n");
  expect_error(ninebit({"explain", file}), 3, {file + ":2:1: "});
  expect_error(ninebit({"explain", folder / "none"}), 3, {"none", "No such file"});
  expect_error(ninebit({"explain", ""}), 2, {"empty"});
  expect_error(ninebit({"explain", write_bytes(folder / "empty", " \n")}), 3, {"is empty"});
}

}  // namespace
}  // namespace tools_test
