// `ninebit study index-steps` from outside: its keys and counts, a program of one's own, and what it refuses.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

Outcome index_steps(Words arguments) {
  return ninebit(Words{"study", "index-steps"} + arguments);
}

TEST(StudyIndexSteps, RowsAndQuestion) {
  const Json object = json_of(index_steps(
      {"--profile", "geforce2", "--formats", "channel,rgb", "--variants", "both-x4", "--steps", "1-2", "--json"}));
  EXPECT_EQ(object["command"], "study index-steps");
  EXPECT_EQ(object["profile"], "geforce2");
  EXPECT_EQ(object["question"],
            "ninebit study index-steps --steps 1-2 --formats channel,rgb --variants both-x4 --profile geforce2");
  const Json& rows = object["rows"];
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(keys_of(rows[0]), (Words{"profile", "format", "variant", "step", "codes", "pairs", "false_matches"}));
  EXPECT_EQ(rows[0]["false_matches"], 510);
  EXPECT_EQ(rows[1]["false_matches"], 0);
  EXPECT_EQ(rows[2]["codes"], 1 << 24);
  EXPECT_EQ(json_of(index_steps({"--formats", "l", "--steps", "2", "--json"}))["profile"], "all");
}

TEST(StudyIndexSteps, ThreadsChangeNothing) {
  const Words asked{"--formats", "la", "--steps", "1-3", "--profile", "geforce2", "--json"};
  EXPECT_EQ(index_steps(asked).out, index_steps(asked + Words{"--threads", "1"}).out);
}

TEST(StudyIndexSteps, AProgramFile) {
  expect_parts(out_of(index_steps({"--program", kArticle, "--formats", "rgb"})),
               {"nv2a, ideal, float-shader with program: step 2 is the smallest safe one"});
}

TEST(StudyIndexSteps, WhatItRefuses) {
  expect_error(index_steps({"--profile", "voodoo"}), 2, {"voodoo"});
  expect_error(index_steps({"--formats", "rgb,xyz"}), 2, {"xyz"});
  expect_error(index_steps({"--formats", ""}), 2, {"--formats"});
  expect_error(index_steps({"--variants", "thrice"}), 2, {"thrice"});
  expect_error(index_steps({"--steps", "0-4"}), 2, {"0-4"});
  expect_error(index_steps({"--steps", "4-3"}), 2, {"4-3"});
  expect_error(index_steps({"--program", "-"}), 2, {"file"});
  expect_error(index_steps({"--program", kArticle, "--variants", "both-x4"}), 2, {"--program"});
  expect_error(index_steps({"--program", "/nonexistent.gl"}), 3, {"/nonexistent.gl"});
  expect_error(index_steps({"--formats", "l", "--variants", "no-scale-separate"}), 2, {"several channels"});
  const TempFolder folder;
  const std::string broken = write_bytes(folder.path() / "broken.gl", "glCombinerInputNV(1);\nglNonsense();\n");
  expect_error(index_steps({"--program", broken}), 3, {broken, "1:"});
  const std::string three =
      write_bytes(folder.path() / "three.gl", "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);\n");
  expect_error(index_steps({"--program", three}), 3, {three, "GL_INVALID_VALUE"});
}

}  // namespace
}  // namespace tools_test
