// Which files a file may name.
#include "src/system/inside_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "combiner_tests/support/temp_folder.h"

namespace ninebit::posix {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;
using test::write_bytes;

// The folder "in" with a file, and a file beside it.
class InsideFolder : public testing::Test {
 protected:
  InsideFolder() {
    fs::create_directories(in_ / "deep");
    write_bytes(in_ / "a.bin", "a");
    write_bytes(in_ / "deep" / "b.bin", "b");
    write_bytes(top_ / "secret", "s");
  }

  [[nodiscard]] std::string why(std::string_view name) const { return why_outside(in_, name).value_or(""); }

  TempFolder top_;
  fs::path in_ = top_.path() / "in";
};

TEST_F(InsideFolder, AcceptsRegularFilesBelow) {
  for (const char* name : {"a.bin", "deep/b.bin", "./a.bin", "deep//b.bin", "not there", "deep/none", "a b:c", ":a",
                           "...", "..a", "a..", "deep/..b"}) {
    EXPECT_EQ(why(name), "") << name;
  }
}

TEST_F(InsideFolder, RefusesNamesThatLeaveIt) {
  for (const char* name : {"../secret", "deep/../../secret", "..", "deep/..", "deep/../a.bin", R"(..\secret)",
                           R"(deep\..\a.bin)", R"(deep/..\..\secret)"}) {
    EXPECT_EQ(why(name), "'" + std::string(name) +
                             "' leaves the folder of the file that names it; expected a regular file below the folder "
                             "of the file that names it, or --allow-outside");
  }
}

TEST_F(InsideFolder, RefusesAbsolutePathsAndAddresses) {
  EXPECT_TRUE(why("/etc/passwd").starts_with("'/etc/passwd' is an absolute path; expected"));
  EXPECT_TRUE(why((in_ / "a.bin").string()).find("is an absolute path") != std::string::npos);
  EXPECT_TRUE(why(R"(\\server\share)").find("is an absolute path") != std::string::npos);
  for (const char* name : {"http://host/a", "file:///etc/passwd", "FILE:a.bin", "C:\\a", "data:,"}) {
    EXPECT_NE(why(name).find("is an address"), std::string::npos) << name;
  }
}

TEST_F(InsideFolder, RefusesLinksOutOfIt) {
  fs::create_symlink(top_.path() / "secret", in_ / "link");
  fs::create_symlink("../secret", in_ / "relative");
  fs::create_directory_symlink("..", in_ / "up");
  fs::create_symlink("../not there", in_ / "dangling");
  for (const char* name : {"link", "relative", "up/secret", "up/none", "up"}) {
    EXPECT_NE(why(name).find("is a link out of the folder"), std::string::npos) << name << ": " << why(name);
  }
  // A folder whose name begins alike is another one.
  fs::create_directory(top_.path() / "in2");
  write_bytes(top_.path() / "in2" / "a.bin", "s");
  fs::create_symlink("../in2/a.bin", in_ / "beside");
  EXPECT_NE(why("beside").find("is a link out of the folder"), std::string::npos);
  // Nothing stands there, and still it would lead out as soon as something does.
  EXPECT_NE(why("dangling"), "");
  fs::create_symlink("a.bin", in_ / "alias");
  fs::create_directory_symlink("deep", in_ / "shallow");
  EXPECT_EQ(why("alias"), "");
  EXPECT_EQ(why("shallow/b.bin"), "");
  fs::create_symlink("loop", in_ / "loop");
  EXPECT_NE(why("loop"), "");
}

TEST_F(InsideFolder, RefusesWhatIsNotARegularFile) {
  ASSERT_EQ(::mkfifo((in_ / "fifo").c_str(), 0600), 0);
  for (const char* name : {"fifo", "deep", "deep/"}) {
    EXPECT_NE(why(name).find("is not a regular file"), std::string::npos) << name << ": " << why(name);
  }
  EXPECT_NE(why(".").find("expected a regular file"), std::string::npos);
}

// LOG#N: the set-up N of a log.
TEST_F(InsideFolder, ChecksTheFileOfASetup) {
  fs::create_symlink("../secret", in_ / "link");
  fs::create_symlink("../secret", in_ / "own#2");
  EXPECT_EQ(why("a.bin#1"), "");
  EXPECT_EQ(why("none#1"), "");
  for (const char* name : {"link#1", "deep#1", "own#2"}) EXPECT_NE(why(name), "") << name;
  EXPECT_EQ(why("link#x"), "") << "that is the name of a file";
  EXPECT_EQ(without_setup("a#12"), "a");
  for (const char* name : {"a#", "#1", "a#1x", "a#-1", "a#1234567890", "a"}) EXPECT_EQ(without_setup(name), name);
}

TEST_F(InsideFolder, RefusesWhatIsNoName) {
  EXPECT_NE(why(""), "");
  EXPECT_NE(why(std::string_view("a.bin\0/../../secret", 19)), "");
  EXPECT_EQ(why("/\n\x1b").find_first_of("\n\x1b"), std::string::npos) << "control characters reach the message";
  EXPECT_LT(why("/" + std::string(100'000, 'x')).size(), 500U);
  EXPECT_NE(why(std::string(100'000, 'x')), "") << "longer than a name can be";
}

TEST_F(InsideFolder, AnEmptyFolderIsTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(in_);
  const auto inside = why_outside("", "a.bin"), outside = why_outside("", "../secret");
  fs::current_path(before);
  EXPECT_FALSE(inside);
  EXPECT_TRUE(outside);
  // A folder that is a link itself is the folder that it leads to.
  fs::create_directory_symlink(in_, top_.path() / "alias");
  EXPECT_FALSE(why_outside(top_.path() / "alias", "deep/b.bin"));
  EXPECT_TRUE(why_outside(top_.path() / "none", "a.bin")) << "a folder that is not there";
}

}  // namespace
}  // namespace ninebit::posix
