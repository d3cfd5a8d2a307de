// Outputs that cannot be written: exit code 4, one line that says where and why, older files whole, nothing left over.
#include <gtest/gtest.h>

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

// A file that may not grow, or a full disk, leaves the older files: over_older_test.cpp. A new folder is not left over.
TEST_F(WriteError, AFolderThatWasMadeIsRemoved) {
  expect_error(render({.file_size_limit = 1000}), 4, {out_, "File too large"});
  EXPECT_EQ(files_in(out_), older_);
  EXPECT_EQ(ninebit(small_render(kRoom, folder_ / "never"), {.file_size_limit = 1000}).code, 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "never"));
}

}  // namespace
}  // namespace tools_test
