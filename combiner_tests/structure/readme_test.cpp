// The README's example is the one that is compiled and run.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string content(const std::string& file) {
  std::ifstream in(std::string(NINEBIT_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Readme, ExampleIsTheConsumersProgram) {
  const std::string readme = content("README.md");
  const std::string example = content("combiner_tests/consumer/example.cpp");
  const std::size_t begin = readme.find("```cpp\n");
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = readme.find("```", begin + 7);
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(example.substr(example.find('\n') + 1), readme.substr(begin + 7, end - begin - 7));
}

}  // namespace
