// File systems that report only on close() that there is no room: whichever close fails, no temporary file stays.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"

namespace {

std::atomic<int> closes_until_failure{0};  // 1: the next close() fails; 0: none does

}  // namespace

// Stands before that of the C library for the whole test program.
extern "C" int close(int descriptor) {
  const auto result = static_cast<int>(::syscall(SYS_close, descriptor));
  if (result != 0 || closes_until_failure == 0 || --closes_until_failure != 0) return result;
  errno = ENOSPC;
  return -1;
}

namespace {

using image_test::TempFolder;
using ninebit::Image8;
using ninebit::StagedFiles;
using ninebit::Status;

Status write_picture(const std::filesystem::path& folder) {
  auto files = StagedFiles::open(folder);
  if (!files) return files.error();
  for (const char* name : {"a.png", "b.png"}) {
    Status written = ninebit::write_png(files->stage(name), Image8{2, 2, 1, {1, 2, 3, 4}});
    if (!written) return written;
  }
  return files->commit();
}

TEST(FailingClose, LeavesNoTemporaryFile) {
  int failed = 0, succeeded = 0;
  for (int nth = 1; nth <= 12; ++nth) {
    SCOPED_TRACE(nth);
    const TempFolder folder;
    closes_until_failure = nth;
    const Status status = write_picture(folder.path() / "made" / "here");
    closes_until_failure = 0;
    if (status.ok()) {
      ++succeeded;
      std::vector<std::string> names;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "made" / "here")) {
        names.push_back(entry.path().filename().string());
      }
      std::sort(names.begin(), names.end());
      EXPECT_EQ(names, (std::vector<std::string>{"a.png", "b.png"}));
      continue;
    }
    ++failed;
    EXPECT_EQ(status.error().fault, ninebit::Fault::cannot_write);
    EXPECT_NE(status.error().message.find("No space left"), std::string::npos) << status.error().text();
    EXPECT_EQ(folder.names(), std::vector<std::string>()) << status.error().text();
  }
  EXPECT_GE(failed, 3) << "the probe's and both pictures'";
  EXPECT_GE(succeeded, 1) << "there are fewer closes than were let through";
}

}  // namespace
