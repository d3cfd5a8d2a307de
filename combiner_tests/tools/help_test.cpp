// `ninebit help`, the version, the groups of a long help, flags that a verb does not have, and the grammar of lists.
#include <gtest/gtest.h>

#include <regex>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

TEST(Help, OfAVerbIsThatOfItsFlag) {
  for (const Words& verb : std::vector<Words>{
           {}, {"render"}, {"study"}, {"study", "shadows"}, {"prove", "kit"}, {"gl-run"}, {"help"}, {"generate"}}) {
    SCOPED_TRACE(testing::PrintToString(verb));
    Words asked{"help"}, flagged = verb;
    asked.insert(asked.end(), verb.begin(), verb.end());
    flagged.emplace_back("--help");
    const Outcome help = ninebit(asked), flag = ninebit(flagged);
    EXPECT_EQ(help.code, 0) << help.err;
    EXPECT_EQ(help.err, "");
    EXPECT_EQ(help.out, flag.out);
    expect_parts(help.out, {"Usage: ninebit"});
  }
}

TEST(Help, OfNothing) {
  expect_error(ninebit({"help", "rendr"}), 2, {"unknown command 'rendr'; expected one of render, ", "'render'?"});
  expect_error(ninebit({"help", "study", "shadow"}), 2, {"unknown command 'shadow'", "'shadows'?"});
  expect_error(ninebit({"help", "render", "more"}), 2, {"`ninebit render` has no commands of its own"});
}

// The flags of each technique stand together, and every flag of render that takes a value names its default, or is one
// that must be given.
TEST(Help, OfRenderIsGroupedWithDefaults) {
  const std::string help = ninebit({"render", "--help"}).out;
  std::size_t at = 0;
  for (const char* heading :
       {"\nOptions:\n", "\nScene, camera and light:\n", "\nPicture:\n", "\nMap of the light (index-cube, ",
        "\nIndices (index-cube, light-cookie):\n", "\nDepth cube map (depth-cube):\n",
        "\nShadow map (shadow-map, reflective):\n", "\nShadow volumes (shadow-volume):\n",
        "\nReflected light (reflective):\n", "\nLight cookie (light-cookie):\n"}) {
    const std::size_t found = help.find(heading);
    ASSERT_NE(found, std::string::npos) << heading;
    EXPECT_GT(found, at) << heading;
    at = found;
  }
  EXPECT_LT(help.find("--index-step"), help.find("\nDepth cube map"));
  EXPECT_LT(help.find("\nLight cookie"), help.find("--cookie-shadows"));
  static const std::regex flag("\n  (?:-[a-z],)?(--[a-z-]+)((?:[^\n]|\n +[^ -])*)");
  std::size_t flags = 0;
  for (std::sregex_iterator found(help.begin(), help.end(), flag), end; found != end; ++found, ++flags) {
    const std::string text = (*found)[2];
    const std::string name = (*found)[1];
    if (name == "--help" || name == "--json" || name == "--quiet" || name == "--allow-outside") continue;
    const bool has_default = text.find('=') != std::string::npos || text.find("default:") != std::string::npos;
    EXPECT_TRUE(has_default || text.find("REQUIRED") != std::string::npos || name == "--cookie") << name << text;
  }
  EXPECT_GT(flags, 40U);
}

// Flags whose value would not matter.
TEST(Help, RefusedFlags) {
  const TempFolder folder;
  const std::string table = write_bytes(folder / "t.csv", "primary.r\n1\n");
  for (const Words& arguments : std::vector<Words>{{"explain", kArticle},
                                                   {"validate", kArticle},
                                                   {"convert", kArticle, "--to", "json"},
                                                   {"eval", kArticle, "--inputs", table},
                                                   {"profiles"},
                                                   {"trace", kArticle}}) {
    SCOPED_TRACE(arguments[0]);
    expect_error(ninebit(arguments + Words{"--threads", "2"}), 2, {"--threads", "one thread"});
    EXPECT_EQ(ninebit(arguments).code, 0);
  }
  expect_error(ninebit({"study", "depth-packing", "--profile", "nv2a"}), 2, {"--profile", "does not depend"});
  expect_error(ninebit({"trace", kArticle, "--up", "z"}), 2, {"--up requires --scene"});
  expect_error(ninebit({"trace", "--scene", kRoom, "--pixel", "1,1", "--from", "gl"}), 2, {"--from requires program"});
  expect_error(ninebit({"explain", kArticle, "--chip", "nv20"}), 2, {"--chip is for register words"});
  EXPECT_EQ(ninebit({"convert", kArticle, "--to", "words", "--chip", "nv20", "--profile", "nv2a"}).code, 0);
}

TEST(Help, OneProfile) {
  const Json rows = json_of(ninebit({"profiles", "--profile", "nv2a", "--json"}))["rows"];
  EXPECT_GT(rows.size(), 20U);
  for (const Json& row : rows) EXPECT_EQ(row["profile"], "nv2a");
  EXPECT_EQ(json_of(ninebit({"profiles", "--json"}))["rows"].size(), rows.size() * 6);
  const Json nv2a = json_of(ninebit({"info", "--json", "--profile", "nv2a", "--threads", "3"}))["rows"][0];
  EXPECT_EQ(nv2a["general_combiners"], 8);
  EXPECT_EQ(nv2a["threads"], 3);
}

TEST(Help, Lists) {
  const auto steps = [](const std::string& list) {
    return ninebit(
        {"study", "index-steps", "--formats", "channel", "--profile", "geforce2", "--json", "--steps", list});
  };
  EXPECT_EQ(json_of(steps("1-3")), json_of(steps("1,2,3")));
  EXPECT_EQ(json_of(steps("1-3")), json_of(steps("1,2-3")));
  for (const char* list : {"3-1", "1,3", "1,,2", "", "1-", "-1", "1-300", "a"}) {
    SCOPED_TRACE(list);
    if (*list == '\0') continue;
    expect_parts(err_of(steps(list), 2), {std::string("invalid list '") + list + "'; expected a list of"});
  }
}

}  // namespace
}  // namespace tools_test
