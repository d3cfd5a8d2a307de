// Output files in a folder that others may write into, too: links in their way, two programs at once, permissions.
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <regex>
#include <set>
#include <string>
#include <thread>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"
#include "src/system/file_lock.h"

namespace {

using image_test::read_bytes;
using image_test::TempFolder;
using ninebit::Fault;
using ninebit::Image8;
using ninebit::StagedFiles;
using ninebit::Status;

namespace fs = std::filesystem;

const Image8 kSmallPicture{2, 2, 1, {1, 2, 3, 4}};

StagedFiles files_in(const fs::path& folder) {
  auto staged = StagedFiles::open(folder);
  if (!staged) throw std::runtime_error(staged.error().text());
  return std::move(staged).value();
}

std::string put_file(const fs::path& file, std::string_view bytes) {
  image_test::write_bytes(file, bytes);
  return file.string();
}

unsigned mode_of(const fs::path& file) {
  struct stat about = {};
  EXPECT_EQ(::lstat(file.c_str(), &about), 0) << file;
  return about.st_mode & 07777U;
}

TEST(HostileFolder, NamesCannotBeGuessed) {
  const TempFolder folder;
  StagedFiles staged = files_in(folder.path());
  std::set<std::string> numbers;
  for (int i = 0; i < 100; ++i) {
    const std::string name = staged.stage("a" + std::to_string(i) + ".png").filename().string();
    std::smatch found;
    ASSERT_TRUE(std::regex_match(name, found, std::regex(R"(\.a\d+\.ninebit-([0-9a-f]{32})\.png)"))) << name;
    numbers.insert(found[1]);
  }
  EXPECT_EQ(numbers.size(), 100U);
  // No digit is the same in all of them, as the parts of a process's number or of a counter would be.
  for (std::size_t digit = 0; digit < 32; ++digit) {
    std::set<char> found;
    for (const std::string& number : numbers) found.insert(number[digit]);
    EXPECT_GT(found.size(), 4U) << digit;
  }
}

// Whoever knew the name could do no harm with a link, either.
TEST(HostileFolder, NoWriterFollowsALink) {
  const TempFolder folder, elsewhere;
  const std::string victim = put_file(elsewhere.path() / "victim", "precious");
  const std::vector<std::function<Status(const fs::path&)>> writers{
      [](const fs::path& file) { return ninebit::write_png(file, kSmallPicture); },
      [](const fs::path& file) {
        const std::vector<float> row(4);
        const ninebit::PicturePlane plane{row.data(), 2};
        const std::vector<ninebit::ExrPart> parts{{"a", 2, 2, {ninebit::exr_channel("Y", plane)}}};
        return ninebit::write_exr_parts(file, parts);
      }};
  for (const auto& write : writers) {
    for (const bool dangling : {false, true}) {
      StagedFiles staged = files_in(folder.path());
      const fs::path path = staged.stage("a.png");
      const fs::path target = dangling ? elsewhere.path() / "made" : fs::path(victim);
      fs::create_symlink(target, path);
      const Status status = write(path);
      ASSERT_FALSE(status.ok());
      EXPECT_EQ(status.error().fault, Fault::cannot_write);
      EXPECT_FALSE(staged.commit().ok()) << "a link is not what was staged";
    }
  }
  EXPECT_EQ(read_bytes(victim), "precious");
  EXPECT_EQ(elsewhere.names(), std::vector<std::string>{"victim"});
  EXPECT_TRUE(folder.names().empty());
}

// Sees each name as soon as it is there and puts a link to the victim in its place; and guesses at names of the kind
// ".a.ninebit-PROCESS-NUMBER.png" before they are there.
class Attacker {
 public:
  Attacker(fs::path folder, fs::path victim) : folder_(std::move(folder)), victim_(std::move(victim)) {
    events_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    ::inotify_add_watch(events_, folder_.c_str(), IN_CREATE);
    thread_ = std::thread([this] { attack(); });
  }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;
  ~Attacker() {
    end_ = true;
    thread_.join();
    ::close(events_);
  }
  [[nodiscard]] int links() const { return links_; }

 private:
  void link(const fs::path& name) {
    if (::symlink(victim_.c_str(), name.c_str()) == 0) ++links_;
  }

  void attack() {
    for (int guess = 0; !end_; guess = (guess + 1) % 64) {
      alignas(inotify_event) char buffer[4096];
      const ssize_t size = std::max<ssize_t>(::read(events_, buffer, sizeof buffer), 0);
      for (const char* at = buffer; at < buffer + size;) {
        const auto* event = reinterpret_cast<const inotify_event*>(at);
        at += sizeof *event + event->len;
        const std::string name = event->name;
        if (!name.starts_with(".a.ninebit-") || fs::is_symlink(folder_ / name)) continue;
        ::unlink((folder_ / name).c_str());
        link(folder_ / name);
      }
      const fs::path guessed =
          folder_ / (".a.ninebit-" + std::to_string(::getpid()) + "-" + std::to_string(guess) + ".png");
      link(guessed);
      ::unlink(guessed.c_str());
    }
  }

  fs::path folder_, victim_;
  int events_ = -1;
  std::atomic<bool> end_{false};
  std::atomic<int> links_{0};
  std::thread thread_;
};

TEST(HostileFolder, AnAttackerReachesNoOtherFile) {
  const TempFolder folder, elsewhere;
  const std::string victim = put_file(elsewhere.path() / "victim", "precious");
  fs::permissions(victim, fs::perms::owner_read | fs::perms::owner_write);
  const Attacker attacker(folder.path(), victim);
  for (int i = 0; i < 300 || attacker.links() == 0; ++i) {
    StagedFiles staged = files_in(folder.path());
    const Status written = ninebit::write_png(staged.stage("a.png"), kSmallPicture);
    const Status committed = staged.commit();
    EXPECT_TRUE(written.ok() || !committed.ok());
    ASSERT_EQ(read_bytes(victim), "precious") << "try " << i;
    ASSERT_EQ(mode_of(victim), 0600U) << "try " << i;
  }
}

TEST(HostileFolder, PermissionBitsAreKept) {
  const TempFolder folder;
  const mode_t before = ::umask(022);
  for (const unsigned mode : {0600U, 0640U, 0444U, 0666U, 0755U}) {
    const std::string file = put_file(folder.path() / "a.png", "older");
    ::chmod(file.c_str(), mode);
    StagedFiles staged = files_in(folder.path());
    ASSERT_TRUE(ninebit::write_png(staged.stage("a.png"), kSmallPicture).ok());
    ASSERT_TRUE(ninebit::write_png(staged.stage("new.png"), kSmallPicture).ok());
    ASSERT_TRUE(staged.commit().ok());
    EXPECT_NE(read_bytes(file), "older");
    EXPECT_EQ(mode_of(file), mode);
    EXPECT_EQ(mode_of(folder.path() / "new.png"), 0644U);
    fs::remove(file);
    fs::remove(folder.path() / "new.png");
  }
  // Those of a link, or of what it leads to, are not the new file's.
  ::chmod(put_file(folder.path() / "target", "older").c_str(), 0600);
  fs::create_symlink("target", folder.path() / "a.png");
  StagedFiles staged = files_in(folder.path());
  put_file(staged.stage("a.png"), "newer");
  ASSERT_TRUE(staged.commit().ok());
  EXPECT_EQ(mode_of(folder.path() / "a.png"), 0644U);
  ::umask(before);
}

TEST(HostileFolder, OneLockAtATime) {
  using ninebit::posix::FolderLock;
  constexpr std::chrono::milliseconds kShort(20);
  const TempFolder folder;
  std::error_code error;
  {
    const FolderLock first(folder.path(), kShort, error);
    EXPECT_TRUE(first.held());
    EXPECT_FALSE(error);
    const FolderLock second(folder.path(), kShort, error);
    EXPECT_FALSE(second.held());
    EXPECT_EQ(error, std::errc::timed_out);
  }
  error.clear();
  EXPECT_TRUE(FolderLock(folder.path(), kShort, error).held()) << "it ends with its owner";
  EXPECT_FALSE(FolderLock(folder.path() / "missing", kShort, error).held());
  EXPECT_FALSE(error) << "what cannot be locked is written all the same";
  EXPECT_TRUE(folder.names().empty()) << "and no file is left for it";
}

TEST(HostileFolder, ACommitWaitsForTheLock) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a";
  std::thread writer;
  {
    std::error_code error;
    const ninebit::posix::FolderLock lock(folder.path(), std::chrono::milliseconds(0), error);
    ASSERT_TRUE(lock.held());
    writer = std::thread([&] {
      StagedFiles staged = files_in(folder.path());
      put_file(staged.stage("a"), "content");
      EXPECT_TRUE(staged.commit().ok());
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_FALSE(fs::exists(file)) << "it was renamed while another had the lock";
  }
  writer.join();
  EXPECT_EQ(read_bytes(file), "content");
}

// In memory, where there is no disk to wait for, which would keep the two apart.
fs::path fast_folder(const fs::path& other) {
  std::string name = "/dev/shm/ninebit-test-XXXXXX";
  return ::mkdtemp(name.data()) != nullptr ? fs::path(name) : other;
}

// Two processes that commit the same names at the same moment: the folder holds the files of one of them.
TEST(HostileFolder, TwoWritersDoNotMix) {
  constexpr int kTries = 100, kFiles = 60;
  const TempFolder slow;
  const fs::path folder = fast_folder(slow.path());
  void* const shared =
      ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto& ready = *new (shared) std::atomic<int>(0);
  int last_of_a = 0;
  for (int i = 0; i < kTries; ++i) {
    ready = 0;
    pid_t writers[2];
    for (const char who : {'A', 'B'}) {
      pid_t& writer = writers[who - 'A'];
      writer = ::fork();
      ASSERT_GE(writer, 0);
      if (writer != 0) continue;
      StagedFiles staged = files_in(folder);
      for (int f = 0; f < kFiles; ++f) put_file(staged.stage("file-" + std::to_string(f)), {&who, 1});
      for (++ready; ready < 2;) std::this_thread::yield();
      const bool done = staged.commit().ok();
      staged = files_in(folder);  // removes what was not committed; _exit() runs no destructor
      ::_exit(done ? 0 : 1);
    }
    for (const pid_t writer : writers) {
      int status = -1;
      ASSERT_EQ(::waitpid(writer, &status, 0), writer);
      EXPECT_EQ(status, 0) << "both come to their end";
    }
    std::set<std::string> found;
    for (int f = 0; f < kFiles; ++f) found.insert(read_bytes(folder / ("file-" + std::to_string(f))));
    EXPECT_EQ(found.size(), 1U) << "try " << i << " is mixed";
    last_of_a += static_cast<int>(*found.begin() == "A");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), kFiles) << "no temporary file is left";
  if (folder != slow.path()) fs::remove_all(folder);
  ::munmap(shared, sizeof(std::atomic<int>));
  RecordProperty("last_of_a", last_of_a);
}

}  // namespace
