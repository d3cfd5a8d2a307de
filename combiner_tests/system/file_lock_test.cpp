// One process at a time for a file.
#include "src/system/file_lock.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "combiner_tests/support/temp_folder.h"

namespace ninebit::posix {
namespace {

using Outcome = FileLock::Outcome;
using test::TempFolder;

TEST(FileLock, KeepsOutOthersUntilItEnds) {
  const TempFolder folder;
  std::optional<FileLock> first(std::in_place, folder / "a");
  EXPECT_EQ(first->outcome(), Outcome::held);
  EXPECT_EQ(FileLock(folder / "a").outcome(), Outcome::taken);
  EXPECT_EQ(FileLock(folder / "b").outcome(), Outcome::held);
  first.reset();
  EXPECT_EQ(FileLock(folder / "a").outcome(), Outcome::held);
}

TEST(FileLock, LeavesTheContentAlone) {
  const TempFolder folder;
  test::write_bytes(folder / "a", "content");
  EXPECT_EQ(FileLock(folder / "a").outcome(), Outcome::held);
  EXPECT_EQ(test::read_bytes(folder / "a"), "content");
}

TEST(FileLock, EndsWithAProcessThatIsKilled) {
  const TempFolder folder;
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FileLock lock(folder / "a");
    const char answer = lock.outcome() == Outcome::held ? 'y' : 'n';
    if (::write(pipe[1], &answer, 1) == 1) ::pause();
    ::_exit(0);
  }
  char answer = 0;
  ASSERT_EQ(::read(pipe[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  EXPECT_EQ(FileLock(folder / "a").outcome(), Outcome::taken);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(FileLock(folder / "a").outcome(), Outcome::held);
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(FileLock, RefusesWhatIsNotAFile) {
  const TempFolder folder;
  EXPECT_EQ(FileLock(folder.path()).outcome(), Outcome::failed);
  EXPECT_EQ(FileLock(folder / "none/a").error(), std::errc::no_such_file_or_directory);
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(FileLock(folder / "fifo").outcome(), Outcome::failed);
}

}  // namespace
}  // namespace ninebit::posix
