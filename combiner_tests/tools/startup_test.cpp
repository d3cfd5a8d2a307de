// The program starts with few libraries and no file beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// A shell command's stdout; empty if it fails.
std::string output_of(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 4096> piece{};
  for (std::size_t size = 0; (size = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) {
    text.append(piece.data(), size);
  }
  return pclose(pipe) == 0 ? text : std::string();
}

// OpenImageIO alone would bring 250 libraries, and their 160 ms, into every start.
TEST(StartUp, LoadsFewLibraries) {
  const std::string libraries = output_of("ldd '" + kProgram + "' 2>/dev/null");
  if (libraries.empty()) GTEST_SKIP() << "there is no ldd to ask";
  EXPECT_NE(libraries.find("libOpenEXR"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("libOpenImageIO"), std::string::npos)
      << "ninebit_image is linked; ninebit_image_output suffices to write pictures\n"
      << libraries;
  EXPECT_LE(std::count(libraries.begin(), libraries.end(), '\n'), 40) << libraries;
}

TEST(StartUp, ACopyRendersAlone) {
  const TempFolder folder;
  const std::string copy = folder / "copy";
  std::filesystem::copy_file(kProgram, copy);
  std::string command = "cd '" + folder.path().string() + "' && ./copy";
  for (const std::string& argument : small_render(kRoom, "out")) command += " '" + argument + "'";
  ASSERT_EQ(std::system((command + " >messages 2>&1").c_str()), 0) << read_bytes(folder / "messages");
  ASSERT_EQ(ninebit(small_render(kRoom, folder / "expected")).code, 0);
  const Files files = files_in(folder / "out");
  EXPECT_FALSE(files.empty());
  EXPECT_EQ(files, files_in(folder / "expected"));
}

}  // namespace
}  // namespace tools_test
