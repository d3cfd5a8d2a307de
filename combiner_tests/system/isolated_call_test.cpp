// Code that does harm on purpose, in an isolated call.
#include "src/system/isolated_call.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/temp_folder.h"
#include "src/system/sandbox.h"

namespace ninebit::posix {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;
using Work = std::function<void(AnswerWriter&)>;

// Enough for anything here, and quick to be reached.
constexpr CallLimits kLimits{.memory_bytes = std::uint64_t{256} << 20U, .seconds = 2};

CallEnd end_of(const Work& work) {
  return call_isolated(kLimits, {}, work).end;
}

// The work's result: errno of a call that must fail, 0 if it succeeded.
int number_from(const std::function<int()>& work, std::span<const fs::path> readable = {}) {
  CallResult result = call_isolated(kLimits, readable, [&](AnswerWriter& answer) { answer.value(work()); });
  int number = -1;
  EXPECT_EQ(result.end, CallEnd::answered);
  EXPECT_TRUE(result.answer.value(number));
  return number;
}

int error_of(int returned) {
  return returned < 0 ? errno : 0;
}

TEST(IsolatedCall, BringsItsAnswer) {
  CallResult result = call_isolated(kLimits, {}, [](AnswerWriter& answer) {
    answer.value(42);
    answer.text("forty-two");
    answer.values(std::span<const float>(std::vector<float>(100'000, 1.5F)));
  });
  ASSERT_EQ(result.end, CallEnd::answered);
  int number = 0;
  std::string text;
  std::vector<float> many;
  EXPECT_TRUE(result.answer.value(number) && result.answer.text(text) && result.answer.values(many));
  EXPECT_EQ(number, 42);
  EXPECT_EQ(text, "forty-two");
  EXPECT_EQ(many, std::vector<float>(100'000, 1.5F));
  EXPECT_EQ(result.answer.bytes_left(), 0U);
}

TEST(IsolatedCall, ChangesNothingHere) {
  int number = 1;
  EXPECT_EQ(end_of([&](AnswerWriter&) { number = 2; }), CallEnd::answered);
  EXPECT_EQ(number, 1);
}

// An answer that says that it holds more than it does gives no memory and no values.
TEST(IsolatedCall, AnswersAreNotBelieved) {
  CallResult result = call_isolated(kLimits, {}, [](AnswerWriter& answer) {
    answer.value(~std::uint64_t{0});
    answer.value(7);
  });
  std::vector<double> many;
  EXPECT_FALSE(result.answer.values(many));
  EXPECT_TRUE(many.empty());
  int number = 0;
  EXPECT_FALSE(result.answer.value(number)) << "what follows a broken value is not read";
}

TEST(IsolatedCall, Crashes) {
  EXPECT_EQ(end_of([](AnswerWriter&) { std::abort(); }), CallEnd::crashed);
  EXPECT_EQ(end_of([](AnswerWriter&) { ::raise(SIGSEGV); }), CallEnd::crashed);
  EXPECT_EQ(end_of([](AnswerWriter&) { throw std::runtime_error("no"); }), CallEnd::crashed);
  EXPECT_EQ(end_of([](AnswerWriter&) { ::_exit(0); }), CallEnd::crashed) << "an end without a report is no answer";
  EXPECT_EQ(end_of([](AnswerWriter&) { std::exit(0); }), CallEnd::crashed);
}

TEST(IsolatedCall, EndsWhatDoesNotEnd) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(end_of([](AnswerWriter&) {
              for (std::atomic<int> i = 0;; ++i) {
              }
            }),
            CallEnd::out_of_time);
  EXPECT_EQ(end_of([](AnswerWriter&) { std::this_thread::sleep_for(std::chrono::hours(1)); }), CallEnd::out_of_time);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(IsolatedCall, LimitsMemory) {
  if (!can_limit_memory()) GTEST_SKIP() << "sanitizers map terabytes, so the address space has no limit";
  EXPECT_EQ(end_of([](AnswerWriter& answer) {
              const std::vector<char> large(std::size_t{1} << 30U, 'x');
              answer.value(large.back());
            }),
            CallEnd::out_of_memory);
  EXPECT_EQ(end_of([](AnswerWriter& answer) {
              const std::vector<char> fits(std::size_t{1} << 26U, 'x');
              answer.value(fits.back());
            }),
            CallEnd::answered);
  EXPECT_EQ(number_from([] { return std::malloc(std::size_t{1} << 40U) == nullptr ? 1 : 0; }), 1);
}

TEST(IsolatedCall, LimitsTheAnswer) {
  EXPECT_EQ(end_of([](AnswerWriter& answer) {
              const std::vector<char> piece(std::size_t{1} << 20U, 'x');
              for (int i = 0; i < 1'000; ++i) answer.values(std::span<const char>(piece));
            }),
            CallEnd::out_of_memory);
}

TEST(IsolatedCall, WritesNoFile) {
  const TempFolder folder;
  const fs::path inside = folder.path() / "new", existing = folder.path() / "old";
  std::ofstream(existing) << "old";
  EXPECT_EQ(number_from([&] { return error_of(::open(inside.c_str(), O_WRONLY | O_CREAT, 0666)); }), EPERM);
  EXPECT_NE(number_from([&] { return error_of(::open(existing.c_str(), O_RDWR)); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::unlink(existing.c_str())); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::truncate(existing.c_str(), 0)); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::rename(existing.c_str(), inside.c_str())); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::mkdir(inside.c_str(), 0777)); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::symlink("/etc/passwd", inside.c_str())); }), 0);
  EXPECT_NE(number_from([&] { return error_of(::chmod(existing.c_str(), 0777)); }), 0);
  EXPECT_FALSE(fs::exists(fs::symlink_status(inside)));
  EXPECT_EQ(fs::file_size(existing), 3U);
}

TEST(IsolatedCall, ReadsTheNamedFileAlone) {
  const TempFolder folder;
  const fs::path named = folder.path() / "named", other = folder.path() / "other";
  std::ofstream(named) << "n";
  std::ofstream(other) << "o";
  const auto open = [](const fs::path& file) { return error_of(::open(file.c_str(), O_RDONLY)); };
  const std::array readable{named};
  EXPECT_EQ(number_from([&] { return open(named); }, readable), 0);
  EXPECT_EQ(number_from([&] { return open(other); }, readable), EACCES) << "without Landlock in the kernel this fails";
  EXPECT_EQ(number_from([&] { return open("/etc/passwd"); }, readable), EACCES);
  EXPECT_EQ(number_from([&] { return open(named); }), EACCES);
}

TEST(IsolatedCall, OpensNoSocketAndStartsNoProcess) {
  EXPECT_EQ(number_from([] { return error_of(::socket(AF_INET, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(number_from([] { return error_of(::socket(AF_UNIX, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(number_from([] { return error_of(::fork()); }), EPERM);
  EXPECT_EQ(number_from([] { return error_of(::execl("/bin/true", "true", nullptr)); }), EPERM);
  EXPECT_EQ(number_from([] { return error_of(::kill(::getppid(), SIGTERM)); }), EPERM);
}

TEST(IsolatedCall, MayUseThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  EXPECT_EQ(number_from([] {
              std::atomic<int> sum = 0;
              std::thread one([&] { sum += 3; }), other([&] { sum += 4; });
              one.join();
              other.join();
              return sum.load();
            }),
            7);
}

TEST(IsolatedCall, StopsWhenItIsTold) {
  int asked = 0;
  const auto begin = std::chrono::steady_clock::now();
  const CallResult result = call_isolated(
      {.seconds = 60}, {}, [](AnswerWriter&) { std::this_thread::sleep_for(std::chrono::hours(1)); },
      [&] { return ++asked < 3; });
  EXPECT_EQ(result.end, CallEnd::stopped);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(IsolatedCall, SaysNothing) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(end_of([](AnswerWriter&) { (void)!::write(STDERR_FILENO, "noise\n", 6); }), CallEnd::answered);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// No descriptor stays open, and no child is left to be waited for.
TEST(IsolatedCall, LeavesNothingBehind) {
  const auto descriptors = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = descriptors();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(end_of([](AnswerWriter& answer) { answer.value(1); }), CallEnd::answered);
    EXPECT_EQ(end_of([](AnswerWriter&) { std::abort(); }), CallEnd::crashed);
  }
  EXPECT_EQ(descriptors(), before);
}

}  // namespace
}  // namespace ninebit::posix
