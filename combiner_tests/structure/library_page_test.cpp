// The example of the page on the library is the one that is compiled and run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace {

std::string content(const std::string& file) {
  std::ifstream in(std::string(NINEBIT_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(LibraryPage, ExampleIsTheConsumersProgram) {
  const std::string page = content("docs/library.md");
  const std::string example = content("combiner_tests/consumer/example.cpp");
  const std::size_t begin = page.find("```cpp\n");
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = page.find("```", begin + 7);
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(example.substr(example.find('\n') + 1), page.substr(begin + 7, end - begin - 7));
}

// "ninebit/…" of the lines that include a public header.
std::vector<std::string> headers_in(const std::string& text) {
  std::vector<std::string> headers;
  const std::string begin = "#include \"ninebit/";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t first = at + std::string("#include \"").size();
    headers.push_back(text.substr(first, text.find('"', first) - first));
  }
  return headers;
}

// ninebit.h includes every public header but those that its comment names.
TEST(LibraryPage, NinebitHIncludesWhatItSays) {
  const std::string all = content("include/ninebit/ninebit.h");
  const std::string comment = all.substr(0, all.find("*/"));
  std::set<std::string> seen;
  std::vector<std::string> left{"ninebit/ninebit.h"};
  while (!left.empty()) {
    const std::string header = left.back();
    left.pop_back();
    if (!seen.insert(header).second) continue;
    for (std::string& more : headers_in(content("include/" + header))) left.push_back(std::move(more));
  }
  const std::filesystem::path include = std::string(NINEBIT_SOURCE_DIR) + "/include/ninebit";
  for (const auto& file : std::filesystem::recursive_directory_iterator(include)) {
    if (file.path().extension() != ".h") continue;
    const std::string name = file.path().lexically_relative(include).string();
    const bool named = comment.find(name) != std::string::npos || (name.starts_with("study/") && name.find('/') == 5);
    EXPECT_NE(seen.contains("ninebit/" + name), named && name != "capi/combiner.h") << name;
  }
}

}  // namespace
