// The example of the page on the library is the one that is compiled and run.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

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

}  // namespace
