// Outputs that cannot be written: exit code 4, one line that says where and why, older files whole, nothing left over.
#include <gtest/gtest.h>

#include "combiner_tests/tools/small_disk.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// A folder with an older rendering, made under another light.
class WriteError : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(ninebit(small_render(kRoom, out_, {"--layers", "--light", "1,2,1"})).code, 0);
    write_bytes(out_ + "/notes.txt", "the user's own");
    older_ = files_in(out_);
    ASSERT_EQ(older_.size(), 7U);
  }
  [[nodiscard]] Outcome render(const ChildSettings& settings = {}) const {
    return ninebit(small_render(kRoom, out_, {"--layers"}), settings);
  }

  TempFolder folder_;
  std::string out_ = folder_ / "out";
  Files older_;
};

TEST_F(WriteError, NoFolderThere) {
  const std::string file = write_bytes(folder_.path() / "file", "a file");
  for (const std::string& out :
       {file, file + "/sub", std::string("/proc/ninebit"), std::string("/dev/full"), std::string("/dev/null/x")}) {
    SCOPED_TRACE(out);
    expect_error(ninebit(small_render(kRoom, out)), 4, {out});
  }
  EXPECT_EQ(read_bytes(file), "a file");
}

TEST_F(WriteError, AFolderInTheWay) {
  for (const char* name : {"color.png", "layers.exr"}) {
    SCOPED_TRACE(name);
    std::filesystem::remove(out_ + '/' + name);
    std::filesystem::create_directory(out_ + '/' + name);
    const Files before = files_in(out_);
    expect_error(render(), 4, {out_ + '/' + name, "folder"});
    EXPECT_EQ(files_in(out_), before);
    std::filesystem::remove(out_ + '/' + name);
  }
}

// Each file in turn is the one that finds no room.
TEST_F(WriteError, FilesMayNotGrow) {
  Files newer;
  {
    const TempFolder other;
    ASSERT_EQ(ninebit(small_render(kRoom, other / "out", {"--layers"})).code, 0);
    newer = files_in(other / "out");
  }
  ASSERT_EQ(newer.size(), 6U);
  std::vector<std::uint64_t> limits{0, 1, 100};
  for (const auto& [name, bytes] : newer) limits.push_back(bytes.size() - 1);
  for (const std::uint64_t limit : limits) {
    SCOPED_TRACE(limit);
    // Messages would fall under the limit as well, unless they go to no file.
    EXPECT_EQ(render({.file_size_limit = limit, .err = "/dev/null"}).code, 4);
    EXPECT_EQ(files_in(out_), older_);
  }
  expect_error(render({.file_size_limit = 1000}), 4, {out_, "File too large"});
  EXPECT_EQ(files_in(out_), older_);
  EXPECT_EQ(ninebit(small_render(kRoom, folder_ / "never"), {.file_size_limit = 1000}).code, 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "never"));

  EXPECT_EQ(render().code, 0);
  newer["notes.txt"] = older_["notes.txt"];
  EXPECT_EQ(files_in(out_), newer);
}

TEST_F(WriteError, FullDisk) {
  const std::string disk = folder_ / "disk";
  const SmallDisk small(disk);
  if (!small.mounted()) GTEST_SKIP() << "mounting is not allowed here: " << small.error();
  for (const auto& [name, bytes] : older_) write_bytes(disk + '/' + name, bytes);
  // Nothing at all, and only a little, can be written.
  const std::string ballast = disk + "/ballast";
  small.fill("ballast");
  Files before = files_in(disk);
  expect_error(ninebit(small_render(kRoom, disk, {"--layers"})), 4, {disk, "No space left on device"});
  EXPECT_EQ(files_in(disk), before);
  std::filesystem::resize_file(ballast, before["ballast"].size() - 20000);
  before = files_in(disk);
  expect_error(ninebit(small_render(kRoom, disk, {"--layers", "--size", "640x480"})), 4,
               {disk, "No space left on device"});
  EXPECT_EQ(files_in(disk), before);
  std::filesystem::remove(ballast);
  EXPECT_EQ(ninebit(small_render(kRoom, disk)).code, 0);
}

}  // namespace
}  // namespace tools_test
