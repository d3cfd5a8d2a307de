#include <gtest/gtest.h>
#include <ninebit/image/staged_files.h>

#include <filesystem>
#include <fstream>

TEST(Examples, StagedFiles) {
  using namespace ninebit;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "ninebit_staged";
  {
    Result<StagedFiles> files = StagedFiles::open(folder);
    ASSERT_TRUE(files.ok());
    std::ofstream(files->stage("a.txt")) << "a";
    std::ofstream(files->stage("b.txt")) << "b";
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));  // not yet
    ASSERT_TRUE(files->commit().ok());                        // both, or none
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "b.txt"));
  std::filesystem::remove_all(folder);
}
