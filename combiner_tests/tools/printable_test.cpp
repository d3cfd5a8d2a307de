// Names and texts of strangers never reach a terminal as they are: control characters, bytes that are not UTF-8.
#include "src/tools/input/printable.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

using ninebit::tools::printable;
using ninebit::tools::printable_briefly;
using ninebit::tools::printable_lines;

TEST(Printable, WhatIsEscaped) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"plain.gltf", "plain.gltf"},
      {"", ""},
      {"Küche – 台所 🙂 a\\b", "Küche – 台所 🙂 a\\b"},
      {"a\nb\tc\rd", "a\\nb\\tc\\x0dd"},
      {"\x1b[31mred", "\\x1b[31mred"},
      {std::string("\0\x7f", 2), "\\x00\\x7f"},
      {"\xC2\x9B"
       "31m",
       "\\xc2\\x9b31m"},  // the same escape sequence, of one character
      {"a\xE2\x80\xAE"
       "gpj.exe",
       "a\\xe2\\x80\\xaegpj.exe"},          // from right to left
      {"\xE2\x80\xA8", "\\xe2\\x80\\xa8"},  // a line's end
      {"\xFF\xC3", "\\xff\\xc3"},           // no UTF-8, and a character cut short
      {"\xC0\xAF\xED\xA0\x80\xF5\x80\x80\x80", "\\xc0\\xaf\\xed\\xa0\\x80\\xf5\\x80\\x80\\x80"},
      {"\xE4\xB8", "\\xe4\\xb8"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(printable(text), expected);
  EXPECT_EQ(printable_lines("a\n\tb\x1b\xFF\n"), "a\n\tb\\x1b\\xff\n");
}

// The file at the beginning and the reason at the end stay; no character is cut in two.
TEST(Printable, LongMessagesLoseTheirMiddle) {
  const std::string message(2'000, 'x');
  EXPECT_EQ(printable_briefly(message), message);
  for (const char* unit : {"x", "ü", "台", "🙂"}) {
    std::string text = "a.gl:1: ";
    while (text.size() < 100'000) text += unit;
    text += " was given before";
    const std::string brief = printable_briefly(text);
    EXPECT_LE(brief.size(), 2'010U);
    EXPECT_TRUE(brief.starts_with("a.gl:1: ")) << brief;
    EXPECT_TRUE(brief.ends_with(" was given before")) << brief;
    expect_parts(brief, {" … "});
    EXPECT_EQ(printable(brief), brief) << "it is still UTF-8";
  }
}

// Bytes that a terminal would not show as they are, but for the end of a line.
bool is_clean(const std::string& text) {
  return printable_lines(text) == text && text.find('\t') == std::string::npos;
}

const std::string kName = "a\nninebit: error: \x1b[2J\x7f\xC2\x9B\xFF";

TEST(Printable, NamesOfFilesInEveryMessage) {
  const TempFolder folder;
  const std::string program = folder / (kName + ".gl"), table = write_bytes(folder / "t.csv", "tex0.r\n1\n");
  std::filesystem::copy_file(kArticle, program);
  const std::string missing = folder / (kName + ".missing"),
                    png = write_bytes(folder / (kName + ".png"), "\x89PNG\r\n\x1A\n");
  const std::string rows = write_bytes(folder / (kName + ".csv"), "program,name,out.r\n" + kName.substr(2) + ",x,1\n");
  const std::string bad_profile =
      write_bytes(folder / (kName + ".json"),
                  R"({"ninebit": "profile", "version": 1, "base": "geforce2", "name": "x", "\u001b": 1})");
  struct Case {
    Words arguments;
    int code;
  };
  const std::vector<Case> errors{
      {{"validate", missing}, 3},
      {{"validate", png}, 3},
      {{"explain", folder.path().string()}, 3},
      {{"eval", program, "--inputs", missing}, 3},
      {{"eval", program, "--inputs", program}, 3},
      {{"eval", program, "--inputs", table, "-o", program + "/none"}, 4},
      {{"verify", rows}, 3},
      {{"trace", program, "--set", kName}, 2},
      {{"trace", program, "--set", "tex0.r=" + kName}, 2},
      {{"render", missing, "-o", folder / "out"}, 3},
      {{"render", missing + ".gltf", "-o", folder / "out"}, 3},
      {{"render", kRoom, "-o", folder / "out", "--technique", kName}, 2},
      {{"render", kRoom, "-o", folder / "out", "--size", kName}, 2},
      {{"profiles", "--profile", kName}, 2},
      {{"profiles", "--profile", bad_profile}, 3},
      {{"study", "merge", missing, "-o", folder / "out"}, 3},
      {{kName}, 2},
      {{"--" + kName}, 2},
  };
  for (const Case& c : errors) {
    SCOPED_TRACE(printable(testing::PrintToString(c.arguments)));
    const Outcome outcome = ninebit(c.arguments);
    expect_error(outcome, c.code, {});
    EXPECT_TRUE(is_clean(outcome.err)) << printable(outcome.err);
  }
}

TEST(Printable, NamesInAnswersForPeople) {
  const TempFolder folder;
  const std::string program = folder / (kName + ".gl"), out = folder / (kName + ".csv");
  std::filesystem::copy_file(kArticle, program);
  const std::string table = write_bytes(folder / "t.csv", "tex0.r\n1\n");
  for (const Words& arguments : std::vector<Words>{{"validate", program},
                                                   {"trace", program, "--set", "tex0.r=1"},
                                                   {"eval", program, "--inputs", table, "-o", out},
                                                   {"convert", program, "--to", "rc10", "-o", out},
                                                   small_render(kRoom, folder / kName)}) {
    SCOPED_TRACE(printable(testing::PrintToString(arguments)));
    const Outcome outcome = ninebit(arguments);
    EXPECT_EQ(outcome.code, 0) << printable(outcome.err);
    EXPECT_TRUE(is_clean(outcome.out)) << printable(outcome.out);
    EXPECT_TRUE(is_clean(outcome.err)) << printable(outcome.err);
    expect_parts((outcome.out + outcome.err), {"ninebit: error: \\x1b[2J\\x7f\\xc2\\x9b\\xff"});
    EXPECT_EQ(outcome.err.find("\nninebit: error"), std::string::npos) << "a name must not look like a message";
  }
}

// JSON escapes as JSON does, and stays JSON where a name is not UTF-8.
TEST(Printable, NamesInJson) {
  const TempFolder folder;
  const std::string program = folder / (kName + ".gl");
  std::filesystem::copy_file(kArticle, program);
  const Json traced = json_of(ninebit({"trace", program, "--set", "tex0.r=1", "--json"}));
  EXPECT_TRUE(traced["program"].get<std::string>().ends_with("a\nninebit: error: \x1b[2J\x7f\xC2\x9B\xEF\xBF\xBD.gl"));
  const Json drawn = json_of(ninebit(small_render(kRoom, folder / kName, {"--json", "--quiet"})));
  EXPECT_EQ(drawn["files"].size(), 4U);
}

TEST(Printable, PermissionsOfAnOlderTableAreKept) {
  const TempFolder folder;
  const std::string table = write_bytes(folder / "t.csv", "tex0.r\n1\n"),
                    out = write_bytes(folder / "out.csv", "older");
  for (const mode_t mode : {0600U, 0640U, 0664U, 0400U}) {
    ::chmod(out.c_str(), mode);
    ASSERT_EQ(ninebit({"eval", kArticle, "--inputs", table, "-o", out, "--quiet"}).code, 0);
    struct stat about = {};
    ASSERT_EQ(::stat(out.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 07777U, mode);
  }
}

}  // namespace
}  // namespace tools_test
