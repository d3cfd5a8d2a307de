// The text of `ninebit trace` and `ninebit explain` fits the terminal that it is read on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

const std::string kEffects = NINEBIT_SOURCE_DIR "/scenes/effects";

class TerminalText : public testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("COLUMNS");
    ::unsetenv("NO_COLOR");
    ::setenv("TERM", "xterm", 1);
  }
  void TearDown() override { SetUp(); }
  TempFolder folder_;
};

std::size_t code_points(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

bool fits(const std::string& line, std::size_t columns) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  return code_points(line) <= columns || line.find(' ', begin) == std::string::npos;  // one word stays whole
}

// The number of lines; each has at most `columns` code points, or is one word.
std::size_t expect_fit(const Outcome& outcome, std::size_t columns) {
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Words lines = lines_of(outcome.out);
  for (const std::string& line : lines) {
    EXPECT_TRUE(fits(line, columns)) << line;
  }
  return lines.size();
}

// The program's stdout on a terminal of this width, or its stderr.
std::string shown_on(unsigned short columns, const Words& arguments, bool errors = false) {
  const Terminal terminal(columns);
  const Child child(arguments, {.out = errors ? "" : terminal.name(), .err = errors ? terminal.name() : ""});
  std::string seen = terminal.seen_of(child);
  std::erase(seen, '\r');
  return seen;
}

TEST_F(TerminalText, TracesOfTheGalleryFitEightyColumns) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  std::size_t lines = 0, effects = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kEffects)) {
    if (entry.path().extension() != ".json" || entry.path().stem() == "expected_hashes") continue;
    SCOPED_TRACE(entry.path().filename());
    lines += expect_fit(ninebit({"trace", "--effect", entry.path().string(), "--pixel", "128,80"}), 80);
    ++effects;
  }
  EXPECT_GT(effects, 15U);
  EXPECT_GT(lines, 1000U);
}

// Help and the list of profiles are broken for who reads them; a pipe gets them whole, and so are commands to copy.
TEST_F(TerminalText, HelpAndProfilesFit) {
  const auto words = [](std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
  };
  for (const Words& asked : {Words{"help", "render"}, {"profiles"}, {"--help"}}) {
    SCOPED_TRACE(asked[0]);
    const std::string whole = ninebit(asked).out, broken = shown_on(90, asked);
    EXPECT_NE(broken, whole);
    EXPECT_EQ(words(broken), words(whole));
    for (const std::string& line : lines_of(broken)) {
      EXPECT_TRUE(line.starts_with("  ninebit ") || fits(line, 90)) << line;
    }
  }
}

TEST_F(TerminalText, ExplanationsOfTheGalleryFitEightyColumns) {
  std::size_t lines = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kEffects + "/programs")) {
    SCOPED_TRACE(entry.path().filename());
    lines += expect_fit(ninebit({"explain", entry.path().string(), "--profile", "nv2a"}), 80);
  }
  EXPECT_GT(lines, 200U);
}

// Random programs have every kind of row and the longest equations.
TEST_F(TerminalText, RandomProgramsFit) {
  using ninebit::HardwareProfile;
  const std::span<const HardwareProfile> all = ninebit::hardware_profiles();
  for (std::uint64_t index = 0; index < 12; ++index) {
    SCOPED_TRACE(index);
    ninebit::test::Random random(0x80C015, index);
    const HardwareProfile& profile = all[index % all.size()];
    const std::string program = write_program(folder_, "p.json", ninebit::test::random_state(random, profile));
    const Words more{program, "--profile", std::string(profile.name)};
    for (const char* verb : {"trace", "explain"}) {
      EXPECT_GT(expect_fit(ninebit(Words{verb} + more), 80), 8U);
    }
  }
}

TEST_F(TerminalText, ColumnsDecides) {
  const Words trace{"trace", kArticle, "--set", "primary=10,20,30,40"};
  const auto has_side_by_side = [](const std::string& text) {
    return text.find("red    green     blue        red") != std::string::npos;
  };
  const std::string usual = ninebit(trace).out;
  EXPECT_FALSE(has_side_by_side(usual));
  ::setenv("COLUMNS", "134", 1);
  const Outcome wide = ninebit(trace);
  EXPECT_TRUE(has_side_by_side(wide.out));
  expect_fit(wide, 134);
  for (const char* columns : {"133", "80", "20", "", "0", "-140", "140x", "10001", "99999999999999999999"}) {
    ::setenv("COLUMNS", columns, 1);
    EXPECT_EQ(has_side_by_side(ninebit(trace).out), false) << columns;
  }
  EXPECT_EQ(ninebit(trace).out, usual);
  ::setenv("COLUMNS", "50", 1);
  const std::string program = kEffects + "/programs/dot3_specular.rc1";
  expect_fit(ninebit({"explain", program, "--profile", "nv2a"}), 50);
}

// A message that comes while there is a progress line has a line of its own.
TEST_F(TerminalText, MessagesDoNotRunIntoTheProgressLine) {
  std::string room = read_bytes(NINEBIT_SOURCE_DIR "/scenes/index_room.gltf");
  const std::string begin = "\"extensionsUsed\": [";
  ASSERT_NE(room.find(begin), std::string::npos);
  room.insert(room.find(begin) + begin.size(), "\"EXT_unknown\", ");
  const std::string file = folder_ / "room.gltf";
  write_bytes(file, room);
  const std::string seen =
      shown_on(80, {"render", file, "-o", folder_ / "out", "--size", "64x48", "--map-size", "32"}, true);
  const std::size_t warning = seen.find("ninebit: warning: ");
  ASSERT_NE(warning, std::string::npos) << seen;
  expect_parts(seen, {"] loading"});  // there was a line
  EXPECT_TRUE(warning == 0 || seen[warning - 1] == '\n' || seen.substr(0, warning).ends_with("\x1b[K")) << seen;
}

TEST_F(TerminalText, ATerminalsWidthAndColours) {
  const Words trace{"trace", kArticle, "--set", "primary.r=200", "--set", "tex0.r=100"};
  const std::string narrow = shown_on(90, trace), wide = shown_on(150, trace);
  expect_parts(narrow, {"\x1b[31m    cut by the clamp"});
  EXPECT_EQ(narrow.find("green     blue"), std::string::npos) << narrow;
  expect_parts(wide, {"red    green     blue        red"});
  ::setenv("TERM", "dumb", 1);
  const std::string plain = shown_on(80, trace);
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
  EXPECT_EQ(plain, ninebit(trace).out);
  ::setenv("TERM", "xterm", 1);
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(shown_on(80, trace), plain);
}

}  // namespace
}  // namespace tools_test
