// Regular files, read whole or in part; everything else is refused without a wait.
#include "src/system/stream.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "combiner_tests/support/temp_folder.h"

namespace ninebit::posix {
namespace {

std::string read(const std::filesystem::path& file, std::size_t most, std::error_code expected = {}) {
  std::error_code error;
  std::string content = read_file(file, most, error);
  EXPECT_EQ(error, expected) << file << ": " << error.message();
  return content;
}

TEST(ReadFile, GivesAsManyBytesAsThereAreUpToTheMost) {
  const test::TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 300'000; ++i) bytes += static_cast<char>(i * 7 + i / 256);
  for (const std::size_t size : {0U, 1U, 2U, 4095U, 4096U, 4097U, 8192U, 300'000U}) {
    const std::string content = bytes.substr(0, size);
    test::write_bytes(folder / "a", content);
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, size / 2, size - std::min<std::size_t>(size, 1),
                                   size, size + 1, std::size_t{1} << 40}) {
      EXPECT_TRUE(read(folder / "a", most) == content.substr(0, most)) << size << ", " << most;
    }
  }
}

// Files of the kernel have the size 0.
TEST(ReadFile, ReadsOnWhereTheSizeIsUnknown) {
  if (!std::filesystem::exists("/proc/self/smaps")) GTEST_SKIP() << "no /proc here";
  EXPECT_GT(read("/proc/self/smaps", 1 << 20).size(), 4096U);
  EXPECT_EQ(read("/proc/self/smaps", 5000).size(), 5000U);
}

TEST(ReadFile, RefusesAllButRegularFiles) {
  const test::TempFolder folder;
  const std::string fifo = folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::filesystem::create_symlink("fifo", folder / "link");
  for (const std::string& file : {fifo, folder / "link", std::string("/dev/zero"), std::string("/dev/null")}) {
    EXPECT_EQ(read(file, 10, not_a_regular_file()), "");
  }
  read(folder.path(), 10, std::make_error_code(std::errc::is_a_directory));
  read(folder / "none", 10, {ENOENT, std::generic_category()});
  EXPECT_EQ(not_a_regular_file().message(), "not a regular file");
}

}  // namespace
}  // namespace ninebit::posix
