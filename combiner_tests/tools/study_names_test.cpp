// Names of files that hold markup: every study's report shows them as text.
#include <gtest/gtest.h>

#include <filesystem>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::string kMarkup = "<img src=x onerror=alert(1)>";
const std::string kShown = "&lt;img src=x onerror=alert(1)&gt;";
const std::string kProgram = NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl";

std::string copied(const std::string& file, const TempFolder& folder, const std::string& name) {
  std::filesystem::copy_file(file, folder.path() / name);
  return folder / name;
}

void expect_shown(const TempFolder& folder, Words words) {
  SCOPED_TRACE(words[1]);
  const std::string out = folder / ("out" + words[1] + std::to_string(words.size()));
  const Outcome outcome = ninebit(words + Words{"--quiet", "-o", out});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const auto& [name, text] : files_in(out)) {
    if (!name.ends_with(".html")) continue;
    EXPECT_EQ(text.find("<img src=x"), std::string::npos) << name;
    SCOPED_TRACE(name);
    expect_parts(text, {kShown});
    // The data of plots and maps end their script themselves.
    const std::size_t data = text.find("<script type=\"application/json\" id=\"data\">");
    ASSERT_NE(data, std::string::npos);
    const std::size_t next = text.find('<', data + 1);
    EXPECT_EQ(text.compare(next, 9, "</script>"), 0) << text.substr(next, 80);
  }
  EXPECT_TRUE(std::filesystem::exists(out + "/report.html"));
}

TEST(StudyNames, MarkupInTheNameOfASceneIsShown) {
  const TempFolder folder;
  const std::string scene = copied(kRoom, folder, kMarkup + ".gltf");
  expect_shown(folder, {"study", "shadows", scene, "--size", "40x30", "--map-sizes", "32,64"});
}

TEST(StudyNames, MarkupInTheNameOfAProgramIsShown) {
  const TempFolder folder;
  const std::string program = copied(kProgram, folder, kMarkup + ".gl");
  expect_shown(folder, {"study", "index-steps", "--program", program, "--formats", "channel", "--steps", "1-2"});
  expect_shown(folder, {"study", "datapath", "--program", program, "--over", "primary.r"});
}

TEST(StudyNames, MarkupInTheNameOfInputsIsShown) {
  const TempFolder folder;
  const std::string inputs = copied(NINEBIT_SOURCE_DIR "/docs/programs/inputs.csv", folder, kMarkup + ".csv");
  expect_shown(folder, {"study", "datapath", "--program", kProgram, "--inputs", inputs});
}

// A profile's own name is a word, so that only its file's name can hold markup; a report names the profile.
TEST(StudyNames, MarkupInTheNameOfAProfileIsRefused) {
  const TempFolder folder;
  const std::string file =
      write_bytes(folder / "mine.json", R"({"base": "geforce2", "name": "<img src=x onerror=alert(1)>"})");
  const Outcome outcome = ninebit({"study", "index-steps", "--profile", file, "--formats", "channel", "--steps", "1"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
}

}  // namespace
}  // namespace tools_test
