// Wrong usage: exit code 2, one line that says what is wrong and what was expected, and nothing is written.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

struct WrongUsage {
  Words arguments;
  Words words;  // of the message
};

TEST(UsageError, VerbsAndArguments) {
  const TempFolder folder;
  const std::vector<WrongUsage> cases{
      {{}, {"a command is required", "render, draw, compare, profiles, info", "ninebit --help"}},
      {{"rendr", "x"}, {"unknown command 'rendr'", "render, draw, compare, profiles, info"}},
      {{"--bogus"}, {"unknown flag '--bogus'"}},
      {{"render"}, {"scene is required", "ninebit render --help"}},
      {{"render", kRoom}, {"--output is required"}},
      {{"render", "", "-o", "out"}, {"scene", "the file name is empty"}},
      {{"render", kRoom, "another", "-o", "out"}, {"not expected", "another"}},
      {{"render", kRoom, "-o", "out", "--bogus"}, {"not expected", "--bogus"}},
      {{"render", kRoom, "-o"}, {"--output requires a value"}},
      {{"render", kRoom, "-o", "out", "--size"}, {"--size requires a value"}},
      {{"render", kRoom, "-o", "out", "--quiet=perhaps"}, {"--quiet"}},
      {{"profiles", "extra"}, {"not expected", "extra", "ninebit profiles --help"}},
      {{"profiles", "--profile", "voodoo"}, {"--profile", "voodoo", "geforce2"}},
      {{"info", "--bogus"}, {"not expected", "--bogus", "ninebit info --help"}},
  };
  for (const WrongUsage& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    expect_error(ninebit(c.arguments, {.folder = folder.path()}), 2, c.words);
  }
  EXPECT_TRUE(files_in(folder.path()).empty());
}

// What no flag takes, as "nan", is asked of all flags in flags_test.cpp.
TEST(UsageError, ValuesOfRender) {
  const TempFolder folder;
  const std::string size = "WIDTHxHEIGHT, each a whole number from 1 to 16384";
  const std::string map_size = "power of two from 1 to 16384";
  const std::string degrees = "degrees from 0.01 to 170";
  struct Flag {
    std::string name;
    Words wrong;
    std::string expected;
  };
  const std::vector<Flag> flags{
      {"--size", {"0x0", "-5x5", "16385x1", "1x16385", "1024", "abc", "1x2x3", "1x", "2.5x3", "9999999999x1"}, size},
      {"--map-size", {"3", "500", "32768", "2.0", "64,64", ""}, map_size},
      {"--index-step", {"17", "1.5"}, "1 to 16"},
      {"--index-format", {"bgr"}, "rgb"},
      {"--index-scope", {"pixel"}, "polygon,object,section"},
      {"--index-order", {"neighbor", "patch"}, "file,neighbour"},
      {"--index-scales", {"both", "x4"}, "both-x4,first-x4,second-x4,no-scale"},
      {"--patch-angle", {"90.1", "20,20"}, "degrees from 0 to 90"},
      {"--section-size", {"3", "513", "64.5"}, "4 to 512"},
      {"--pick", {"-1,0", "0,-1", "5", "1,2,3", "1.5,2"}, "X,Y, each a whole number, counted from the top left"},
      {"--technique", {"magic"}, "index-cube"},
      {"--threads", {"1025", "many"}, "0 to 1024"},
      {"--fov", {"0.009", "170.1", "50,50"}, degrees},
      {"--camera", {"nan,0,0", "1,2", "1,2,3,4", "1;2;3", "1,2,3,", "1e99,0,0"}, "X,Y,Z"},
      {"--look-at", {"0,0,nan", ""}, "X,Y,Z"},
      {"--light", {"0,-inf,0", "light"}, "X,Y,Z"},
      {"--floor", {"low", "1,2"}, "auto, none or a height"},
      {"--cull", {"both"}, "none,back,front"},
  };
  for (const Flag& flag : flags) {
    for (const std::string& value : flag.wrong) {
      SCOPED_TRACE(flag.name + "=" + value);
      expect_error(
          ninebit({"render", kRoom, "-o", folder / "out", flag.name + "=" + value}), 2,
          {flag.name, value, value.empty() ? "requires a value" : flag.expected, "(see: ninebit render --help)"});
    }
  }
  EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(UsageError, PickedPixel) {
  const TempFolder folder;
  for (const char* pixel : {"60,0", "0,45", "99999,1"}) {
    expect_error(ninebit({"render", kRoom, "-o", folder / "out", "--size", "60x45", "--pick", pixel}), 2,
                 {"--pick", pixel, "X from 0 to 59 and Y from 0 to 44", "(see: ninebit render --help)"});
  }
  EXPECT_TRUE(files_in(folder.path()).empty());
}

// The other side of the same limits, and points that begin with a minus sign.
TEST(UsageError, LimitsThemselvesAreFine) {
  const TempFolder folder;
  const std::vector<Words> fine{
      {"--size", "1x1", "--map-size", "1", "--index-step", "1", "--threads", "1024", "--floor", "none"},
      {"--size", "16384x1", "--index-step", "16", "--floor", "-1.5", "--fov", "170"},
      {"--size", "8x6", "--pick", "7,5", "--index-scope", "section", "--section-size", "4"},
      {"--size", "8x6", "--pick", "0,0", "--index-scope", "section", "--section-size", "512"},
      {"--index-order", "neighbour", "--patch-angle", "0", "--index-scales", "no-scale", "--check-order"},
      {"--index-order", "neighbour", "--patch-angle", "90", "--index-scales", "first-x4", "--check-order"},
      {"--camera", "-1,-2,-3.5", "--look-at", "-1,0.5,-2", "--light", "-1,1e-1,-2", "--threads", "0"},
  };
  for (const Words& flags : fine) {
    SCOPED_TRACE(testing::PrintToString(flags));
    const Outcome outcome = ninebit(small_render(kRoom, folder / "out", flags));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
}

}  // namespace
}  // namespace tools_test
