// What people expect of a program: suggestions for misspelled names, colours where they can be seen, a manual page and
// completions that tell of every verb and flag.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

TEST(Habits, DidYouMean) {
  struct Case {
    Words arguments;
    std::string meant;
  };
  const std::vector<Case> cases{
      {{"rendr", "x"}, "render"},
      {{"Verify"}, "verify"},
      {{"sutdy"}, "study"},
      {{"study", "index-step"}, "index-steps"},
      {{"render", kRoom, "-o", "out", "--techniqe", "shadow-map"}, "--technique"},
      {{"render", kRoom, "-o", "out", "--map-sise=64"}, "--map-size"},
      {{"info", "--jsn"}, "--json"},
      {{"render", kRoom, "-o", "out", "--technique", "shadow-mop"}, "shadow-map"},
      {{"profiles", "--profile", "geforce"}, "geforce2"},
      {{"convert", "x.gl", "--to", "glls"}, "glsl"},
      {{"eval", "x.gl", "--profle", "nv2a"}, "--profile"},  // although --inputs is missing, too
      {{"study", "index-steps", "--formats", "rgb,chanel"}, "channel"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    expect_error(ninebit(c.arguments), 2, {"; did you mean '" + c.meant + "'?"});
  }
  // Nothing that was meant is made up.
  for (const Words& arguments :
       std::vector<Words>{{"xyzzy"}, {"info", "--bogus"}, {"profiles", "--profile", "voodoo"}, {"generat"}}) {
    EXPECT_EQ(ninebit(arguments).err.find("did you mean"), std::string::npos) << testing::PrintToString(arguments);
  }
}

TEST(Habits, VersionWithTheBuildsFacts) {
  const Outcome version = ninebit({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.err, "");
  const std::string& text = version.out;
  EXPECT_EQ(ninebit({"-V"}).out, text);
  EXPECT_TRUE(std::regex_search(text, std::regex("^ninebit [0-9]+\\.[0-9]+\\.[0-9]+\ncompiler: (GCC|Clang) [0-9]")))
      << text;
  expect_parts(text, {"\nbuild: ", "\nprocessor: ", "\nSIMD target: "});
  const Json info = json_of(ninebit({"info", "--json"}))["rows"][0];
  expect_parts(text, {"\nSIMD target: " + info["simd_target"].get<std::string>() + "\n",
                      "\nbuild: " + info["build"].get<std::string>() + "\n"});
}

// The program's stderr on a terminal, up to the end of its first line.
std::string seen_on_a_terminal(const Words& arguments) {
  const Terminal terminal;
  (void)ninebit(arguments, {.err = terminal.name()});
  return terminal.seen_until("\n");
}

TEST(Habits, ColoursOnTerminalsAlone) {
  const std::string red = "\x1b[1;31mninebit: error:\x1b[0m ";
  ::unsetenv("NO_COLOR");
  ::setenv("TERM", "xterm", 1);
  EXPECT_TRUE(seen_on_a_terminal({"xyzzy"}).starts_with(red)) << seen_on_a_terminal({"xyzzy"});
  EXPECT_TRUE(ninebit({"xyzzy"}).err.starts_with("ninebit: error: ")) << "into a file";
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_TRUE(seen_on_a_terminal({"xyzzy"}).starts_with("ninebit: error: "));
  ::unsetenv("NO_COLOR");
  ::setenv("TERM", "dumb", 1);
  EXPECT_TRUE(seen_on_a_terminal({"xyzzy"}).starts_with("ninebit: error: "));
  ::setenv("TERM", "xterm", 1);
}

TEST(Habits, ADumbTerminalGetsNoEscapes) {
  const TempFolder folder;
  const Words drawing = small_render(kRoom, folder / "out");
  ::unsetenv("NO_COLOR");
  ::setenv("TERM", "xterm", 1);
  EXPECT_NE(seen_on_a_terminal(drawing).find("\r\x1b[K["), std::string::npos) << "the progress bar";
  ::setenv("TERM", "dumb", 1);
  const std::string seen = seen_on_a_terminal(drawing);
  EXPECT_TRUE(seen.starts_with("wrote ")) << seen;
  EXPECT_EQ(seen.find('\x1b'), std::string::npos);
  ::setenv("TERM", "xterm", 1);
}

TEST(Habits, EveryVerbHasAnExampleAndTheCommonFlags) {
  EXPECT_GE(help_of_all_verbs().size(), 14U);
  for (const auto& [verb, help] : help_of_all_verbs()) {
    SCOPED_TRACE(verb);
    const std::size_t example = help.find("Example");
    ASSERT_NE(example, std::string::npos);
    EXPECT_NE(help.find("ninebit " + (verb.empty() ? "render" : verb), example), std::string::npos);
    const bool is_group = help.find("Subcommands:") != std::string::npos;
    if (!is_group && verb != "help" && verb != "gl-run") expect_parts(help, {"--json", "--quiet"});
  }
}

TEST(Habits, ManualAndCompletionsTellOfEveryVerb) {
  for (const char* form : {"man", "bash", "zsh", "fish"}) {
    SCOPED_TRACE(form);
    const std::string outcome = out_of(ninebit({"generate", form}));
    for (const auto& [verb, help] : help_of_all_verbs()) {
      const std::string name = verb.substr(verb.rfind(' ') + 1);
      const std::string written = std::string(form) == "man" ? std::regex_replace(name, std::regex("-"), "\\-") : name;
      expect_parts(outcome, {written});
    }
    for (const char* flag : {"technique", "shadow-volume", "threads", "nv2a"}) {
      const std::string written =
          std::string(form) == "man" ? std::regex_replace(std::string(flag), std::regex("-"), "\\-") : flag;
      expect_parts(outcome, {written});
    }
  }
  EXPECT_EQ(ninebit({"--help"}).out.find("generate"), std::string::npos) << "it is for the build";
}

}  // namespace
}  // namespace tools_test
