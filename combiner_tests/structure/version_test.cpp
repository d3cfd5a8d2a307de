// The version stands in the build's file; those of the packagers must say the same.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(NINEBIT_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string found(const std::string& file, const char* pattern) {
  const std::string text = text_of(file);
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
}

TEST(Version, IsTheSameEverywhere) {
  const std::string version = found("CMakeLists.txt", "project\\(ninebit VERSION ([0-9.]+)");
  ASSERT_NE(version, "");
  EXPECT_EQ(found("pyproject.toml", "\nversion = \"([^\"]*)\""), version);
  EXPECT_EQ(found("src/playground/npm/package.json", "\"version\": \"([^\"]*)\""), version);
  EXPECT_EQ(found("CITATION.cff", "\nversion: (\\S*)"), version);
}

}  // namespace
