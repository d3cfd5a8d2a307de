// With --json, a command that fails answers with its errors: one object on stdout, the same exit code, and the lines
// for people on stderr.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

// Each line of stderr that is an error ends with the message of the object.
void expect_same_lines(const Outcome& outcome, const Json& faults) {
  Words errors;
  for (const std::string& line : lines_of(outcome.err)) {
    if (line.starts_with("ninebit: error: ")) errors.push_back(line);
  }
  ASSERT_EQ(errors.size(), faults["errors"].size()) << outcome.err;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_TRUE(errors[i].ends_with(faults["errors"][i]["message"].get<std::string>())) << errors[i];
  }
}

TEST(JsonFaults, WrongUsage) {
  for (const Words& arguments : std::vector<Words>{{"render", kRoom, "-o", "out", "--json", "--size", "none"},
                                                   {"render", "--json"},
                                                   {"trace", "--json"},
                                                   {"rendr", "--json"},
                                                   {"study", "index-steps", "--steps", "0", "--json"},
                                                   {"vectors", "-o", "out", "--programs", "1", "--json"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Outcome outcome = ninebit(arguments);
    const Json faults = faults_of(outcome, 2);
    EXPECT_EQ(keys_of(faults), (Words{"command", "version", "exit_code", "error", "errors"}));
    EXPECT_EQ(faults["command"], arguments[0]);
    EXPECT_EQ(faults["errors"].size(), 1U);
    expect_parts(faults["error"]["message"].get<std::string>(), {"--help)"});
    expect_same_lines(outcome, faults);
  }
}

TEST(JsonFaults, FileAndPlace) {
  const TempFolder folder;
  const std::string program = write_bytes(folder / "two.rc1", "!!RC1.0\nout.rgb = tex7;\nout.a = 1;\n");
  const Outcome outcome = ninebit({"explain", program, "--json"});
  const Json faults = faults_of(outcome, 3);
  ASSERT_GE(faults["errors"].size(), 2U);
  EXPECT_EQ(faults["error"]["file"], program);
  EXPECT_EQ(faults["error"]["line"], 2);
  EXPECT_EQ(faults["error"]["column"], 11);
  EXPECT_EQ(faults["errors"][1]["line"], 3);
  expect_same_lines(outcome, faults);

  const Json missing = faults_of(ninebit({"render", folder / "none.obj", "-o", folder / "out", "--json"}), 3);
  EXPECT_EQ(missing["error"]["file"], folder / "none.obj");
  EXPECT_FALSE(missing["error"].contains("line"));

  const std::string profile = write_bytes(folder / "p.json", "{\n\"ninebit\": \"profile\",\n\"version\": 99\n}");
  const Json invalid = faults_of(ninebit({"info", "--json", "--profile", profile}), 3);
  EXPECT_EQ(invalid["error"]["file"], profile);
  EXPECT_GE(invalid["error"]["line"], 1);
}

TEST(JsonFaults, CannotWrite) {
  const TempFolder folder;
  const std::string file = write_bytes(folder / "file", "");
  const Json faults = faults_of(ninebit({"explain", kArticle, "--json", "-o", file + "/page.html"}), 4);
  EXPECT_NE(faults["error"]["message"], "");
}

// The answer is all that stdout has.
TEST(JsonFaults, AnAnswerIsTheOnlyObject) {
  const TempFolder folder;
  const std::string table = write_bytes(folder / "t.csv", "primary.r,tex0.r,out.a\n102,100,0\n9,1,0\n");
  EXPECT_FALSE(json_of(ninebit({"verify", table, "--program", kArticle, "--json"}), 1).contains("error"));
  const std::string invalid = write_bytes(folder / "p.rc1", "!!RC1.0\nout.rgb = tex7;\n");
  const Outcome refused = ninebit({"validate", invalid, "--json"});
  EXPECT_NE(refused.code, 0);
  EXPECT_TRUE(Json::accept(refused.out)) << refused.out;
}

TEST(JsonFaults, NoneWithoutTheFlag) {
  EXPECT_EQ(ninebit({"rendr"}).out, "");
  EXPECT_EQ(ninebit({"gl-run", "--", "/nowhere/program", "--json"}).out, "");
}

}  // namespace
}  // namespace tools_test
