// The program starts with few libraries and no file beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// OpenImageIO alone would bring 250 libraries, and their 160 ms, into every start.
TEST(StartUp, LoadsFewLibraries) {
  const auto [libraries, status] = shell("ldd '" + kProgram + "'");
  if (status != 0) GTEST_SKIP() << "ldd does not answer: " << libraries;
  expect_parts(libraries, {"libOpenEXR"});
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
