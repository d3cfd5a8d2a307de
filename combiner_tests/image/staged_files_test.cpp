#include "ninebit/image/staged_files.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"

namespace {

using image_test::read_bytes;
using image_test::TempFolder;
using image_test::write_bytes;
using ninebit::Fault;
using ninebit::StagedFiles;

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

StagedFiles open(const fs::path& folder) {
  auto staged = StagedFiles::open(folder);
  EXPECT_TRUE(staged.ok()) << (staged.ok() ? "" : staged.error().text());
  return std::move(staged).value();
}

TEST(StagedFiles, NothingAppearsBeforeCommit) {
  const TempFolder folder;
  StagedFiles staged = open(folder.path());
  EXPECT_TRUE(folder.names().empty());
  const fs::path first = staged.stage("b.png");
  const fs::path second = staged.stage("a.tar.exr");
  EXPECT_EQ(first.parent_path(), folder.path());
  EXPECT_EQ(first.extension(), ".png");
  EXPECT_EQ(second.extension(), ".exr");
  EXPECT_EQ(first.filename().string().front(), '.');
  EXPECT_NE(first, second);
  EXPECT_EQ(staged.stage("b.png"), first);
  write_bytes(first, "one");
  write_bytes(second, "two");
  EXPECT_FALSE(fs::exists(folder.path() / "b.png"));
  EXPECT_FALSE(fs::exists(folder.path() / "a.tar.exr"));
  EXPECT_EQ(staged.files(), (std::vector<fs::path>{folder.path() / "b.png", folder.path() / "a.tar.exr"}));
  const auto status = staged.commit();
  ASSERT_TRUE(status.ok()) << status.error().text();
  EXPECT_EQ(folder.names(), (Names{"a.tar.exr", "b.png"}));
  EXPECT_EQ(read_bytes(folder.path() / "b.png"), "one");
  EXPECT_EQ(read_bytes(folder.path() / "a.tar.exr"), "two");
  EXPECT_EQ(staged.files().size(), 2U);
  EXPECT_TRUE(staged.commit().ok());
}

TEST(StagedFiles, CommittedFilesSurviveTheSet) {
  const TempFolder folder;
  {
    StagedFiles staged = open(folder.path() / "new" / "er");
    write_bytes(staged.stage("a"), "one");
    ASSERT_TRUE(staged.commit().ok());
    write_bytes(staged.stage("later"), "aborted");
  }
  EXPECT_EQ(read_bytes(folder.path() / "new" / "er" / "a"), "one");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "new" / "er"), {}), 1);
}

TEST(StagedFiles, AnAbortedSetLeavesNothing) {
  const TempFolder folder;
  write_bytes(folder.path() / "a.png", "older");
  {
    StagedFiles staged = open(folder.path());
    write_bytes(staged.stage("a.png"), "newer");
    write_bytes(staged.stage("b.png"), "newer");
    static_cast<void>(staged.stage("never-written.png"));
    EXPECT_EQ(read_bytes(folder.path() / "a.png"), "older");
  }
  EXPECT_EQ(folder.names(), Names{"a.png"});
  EXPECT_EQ(read_bytes(folder.path() / "a.png"), "older");
}

TEST(StagedFiles, ReplacesOlderFiles) {
  const TempFolder folder;
  write_bytes(folder.path() / "a.png", "older and longer");
  StagedFiles staged = open(folder.path());
  write_bytes(staged.stage("a.png"), "newer");
  ASSERT_TRUE(staged.commit().ok());
  EXPECT_EQ(read_bytes(folder.path() / "a.png"), "newer");
  EXPECT_EQ(folder.names(), Names{"a.png"});
}

TEST(StagedFiles, FoldersThatItMadeGoAgain) {
  const TempFolder folder;
  {
    StagedFiles staged = open(folder.path() / "x" / "y" / "z" / "");
    write_bytes(staged.stage("a.png"), "newer");
    EXPECT_TRUE(fs::is_directory(folder.path() / "x" / "y" / "z"));
  }
  EXPECT_TRUE(folder.names().empty());
  fs::create_directory(folder.path() / "mine");
  {
    StagedFiles staged = open(folder.path() / "mine" / "y");
    write_bytes(folder.path() / "mine" / "other", "of somebody else");
  }
  EXPECT_EQ(folder.names(), Names{"mine"});
  EXPECT_FALSE(fs::exists(folder.path() / "mine" / "y"));
  EXPECT_TRUE(fs::exists(folder.path() / "mine" / "other"));
}

void expect_cannot_write(const ninebit::Diagnostic& error, const std::string& path) {
  EXPECT_EQ(error.fault, Fault::cannot_write);
  EXPECT_EQ(error.file, path);
  EXPECT_FALSE(error.message.empty());
}

TEST(StagedFiles, ReportsFoldersThatCannotBe) {
  const TempFolder folder;
  write_bytes(folder.path() / "file", "content");
  fs::create_symlink("nowhere", folder.path() / "link");
  for (const fs::path& bad : {folder.path() / "file", folder.path() / "file" / "x", folder.path() / "link",
                              folder.path() / std::string(300, 'x'), fs::path("/proc"), fs::path("/proc/ninebit/x")}) {
    const auto staged = StagedFiles::open(bad);
    ASSERT_FALSE(staged.ok()) << bad;
    expect_cannot_write(staged.error(), bad.string());
  }
  // Files made on the way to the failure are removed.
  const auto staged = StagedFiles::open(folder.path() / "new" / "er" / std::string(300, 'x'));
  ASSERT_FALSE(staged.ok());
  EXPECT_EQ(folder.names(), (Names{"file", "link"}));
  EXPECT_EQ(read_bytes(folder.path() / "file"), "content");
}

TEST(StagedFiles, ReportsAFileThatWasNotWritten) {
  const TempFolder folder;
  write_bytes(folder.path() / "a.png", "older");
  {
    StagedFiles staged = open(folder.path());
    write_bytes(staged.stage("a.png"), "newer");
    static_cast<void>(staged.stage("b.png"));
    const auto status = staged.commit();
    ASSERT_FALSE(status.ok());
    expect_cannot_write(status.error(), (folder.path() / "b.png").string());
    EXPECT_EQ(read_bytes(folder.path() / "a.png"), "older");
  }
  EXPECT_EQ(folder.names(), Names{"a.png"});
}

TEST(StagedFiles, ReportsANameTakenByAFolder) {
  const TempFolder folder;
  fs::create_directory(folder.path() / "b.png");
  {
    StagedFiles staged = open(folder.path());
    write_bytes(staged.stage("a.png"), "newer");
    write_bytes(staged.stage("b.png"), "newer");
    const auto status = staged.commit();
    ASSERT_FALSE(status.ok());
    expect_cannot_write(status.error(), (folder.path() / "b.png").string());
  }
  EXPECT_EQ(folder.names(), Names{"b.png"});
}

TEST(StagedFiles, ReportsNamesThatAreNotPlain) {
  const TempFolder folder;
  fs::create_directory(folder.path() / "inner");
  for (const std::string& name : {std::string("../a.png"), std::string("inner/a.png"), std::string("/a.png"),
                                  std::string(), std::string("."), std::string(".."), std::string("a\0.png", 6)}) {
    StagedFiles staged = open(folder.path() / "inner");
    const fs::path temporary = staged.stage(name);
    EXPECT_EQ(temporary.parent_path(), folder.path() / "inner") << name;
    write_bytes(temporary, "newer");
    const auto status = staged.commit();
    ASSERT_FALSE(status.ok()) << name;
    EXPECT_EQ(status.error().fault, Fault::cannot_write) << name;
  }
  EXPECT_EQ(folder.names(), Names{"inner"});
  EXPECT_TRUE(fs::is_empty(folder.path() / "inner"));
}

// A name too long for the file system is found out by the rename itself, after others were renamed.
TEST(StagedFiles, TakesBackWhatWasRenamedBeforeAFailure) {
  const TempFolder folder;
  const std::string too_long = std::string(300, 'x') + ".png";
  write_bytes(folder.path() / "old.png", "older");
  write_bytes(folder.path() / "after.png", "older");
  {
    StagedFiles staged = open(folder.path());
    for (const std::string& name :
         {std::string("old.png"), std::string("new.png"), too_long, std::string("after.png")}) {
      write_bytes(staged.stage(name), "newer");
    }
    const auto status = staged.commit();
    ASSERT_FALSE(status.ok());
    expect_cannot_write(status.error(), (folder.path() / too_long).string());
    EXPECT_EQ(read_bytes(folder.path() / "old.png"), "older");
    EXPECT_EQ(read_bytes(folder.path() / "after.png"), "older");
  }
  EXPECT_EQ(folder.names(), (Names{"after.png", "old.png"}));
}

TEST(StagedFiles, ALongNameThatFitsIsCommitted) {
  const TempFolder folder;
  const std::string name = std::string(251, 'x') + ".png";
  StagedFiles staged = open(folder.path());
  write_bytes(staged.stage(name), "newer");
  ASSERT_TRUE(staged.commit().ok());
  EXPECT_EQ(folder.names(), Names{name});
}

TEST(StagedFiles, ReplacesALinkAndNotWhatItPointsTo) {
  const TempFolder folder;
  write_bytes(folder.path() / "target", "older");
  fs::create_symlink("target", folder.path() / "a.png");
  StagedFiles staged = open(folder.path());
  write_bytes(staged.stage("a.png"), "newer");
  ASSERT_TRUE(staged.commit().ok());
  EXPECT_FALSE(fs::is_symlink(folder.path() / "a.png"));
  EXPECT_EQ(read_bytes(folder.path() / "a.png"), "newer");
  EXPECT_EQ(read_bytes(folder.path() / "target"), "older");
  EXPECT_EQ(folder.names(), (Names{"a.png", "target"}));
}

TEST(StagedFiles, MovesItsDuties) {
  const TempFolder folder;
  {
    StagedFiles first = open(folder.path());
    write_bytes(first.stage("a.png"), "first");
    StagedFiles second = std::move(first);
    StagedFiles third = open(folder.path());
    write_bytes(third.stage("b.png"), "third");
    third = std::move(second);
    EXPECT_EQ(folder.names().size(), 1U);  // the temporary file of b.png is gone
    ASSERT_TRUE(third.commit().ok());
  }
  EXPECT_EQ(folder.names(), Names{"a.png"});
}

TEST(StagedFiles, TwoSetsDoNotMeet) {
  const TempFolder folder;
  StagedFiles first = open(folder.path());
  StagedFiles second = open(folder.path());
  const fs::path a = first.stage("a.png");
  const fs::path b = second.stage("a.png");
  EXPECT_NE(a, b);
  write_bytes(a, "first");
  write_bytes(b, "second");
  ASSERT_TRUE(first.commit().ok());
  EXPECT_EQ(read_bytes(folder.path() / "a.png"), "first");
  ASSERT_TRUE(second.commit().ok());
  EXPECT_EQ(read_bytes(folder.path() / "a.png"), "second");
}

// As the program uses it: the disk becomes full in the middle of a set.
TEST(StagedFiles, AFailedWriterLeavesTheOlderPictureWhole) {
  const TempFolder folder;
  const ninebit::Image8 older{2, 2, 1, {1, 2, 3, 4}};
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", older).ok());
  {
    StagedFiles staged = open(folder.path());
    const fs::path temporary = staged.stage("a.png");
    bool written = true;
    {
      const image_test::FileSizeLimit full(30);
      written = ninebit::write_png(temporary, older).ok();
    }
    EXPECT_FALSE(written);
    EXPECT_FALSE(staged.commit().ok());
  }
  const auto image = image_test::read_png(folder.path() / "a.png");
  EXPECT_EQ(image.pixels, older.pixels);
  EXPECT_EQ(folder.names(), Names{"a.png"});
}

}  // namespace
