#include "src/system/isolated_call.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <new>
#include <optional>

#include "src/system/process.h"
#include "src/system/sandbox.h"

namespace ninebit::posix {
namespace {

// The child's descriptors besides its standard streams.
constexpr int kAnswerDescriptor = 3, kReportDescriptor = 4;

// The child reports the end of its work by one byte. A child that crashes reports nothing.
enum Report : char { kDone = 'd', kNoMemory = 'm' };

[[noreturn]] void report_and_end(Report what) {
  (void)!::write(kReportDescriptor, &what, 1);
  ::_exit(0);
}

// Closes all descriptors that the child does not need, and redirects its standard streams to /dev/null.
void settle_descriptors(int answer, int report) {
  // Duplicated above their final numbers first, so that neither dup2() overwrites the other.
  const int far_answer = ::fcntl(answer, F_DUPFD, kReportDescriptor + 1);
  const int far_report = ::fcntl(report, F_DUPFD, kReportDescriptor + 1);
  ::dup2(far_answer, kAnswerDescriptor);
  ::dup2(far_report, kReportDescriptor);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  if (::syscall(SYS_close_range, kReportDescriptor + 1, ~0U, 0) == 0) return;
  for (int other = kReportDescriptor + 1; other < static_cast<int>(::sysconf(_SC_OPEN_MAX)); ++other) ::close(other);
}

// This process's handlers must not run in the child. Signals that end the process group are ignored: the parent handles
// them and ends the child.
void settle_signals(const sigset_t& mask) {
  for (int number = 1; number < 32; ++number) {  // real-time signals have no handlers
    const bool ends_group = number == SIGINT || number == SIGTERM || number == SIGHUP || number == SIGQUIT;
    const bool is_checked = number == SIGXFSZ || number == SIGPIPE;  // the write fails, and its result is checked
    std::signal(number, ends_group || is_checked ? SIG_IGN : SIG_DFL);
  }
  ::pthread_sigmask(SIG_SETMASK, &mask, nullptr);
}

[[noreturn]] void run_child(const CallLimits& limits, std::span<const std::filesystem::path> readable,
                            const std::function<void(AnswerWriter&)>& work) {
  limit_resources(limits.memory_bytes, limits.seconds, limits.memory_bytes);
  // A failed allocation is reported at once: foreign code handles it worst.
  std::set_new_handler([] { report_and_end(kNoMemory); });
  allow_only_reading(readable);
  forbid_system_calls();
  try {
    AnswerWriter answer(kAnswerDescriptor);
    work(answer);
  } catch (const std::bad_alloc&) {
    report_and_end(kNoMemory);
  } catch (...) {
    ::_exit(1);
  }
  report_and_end(kDone);
}

// Detects that the child has used no processor time for `seconds`: it waits for something that never happens.
class IdleWatch {
 public:
  IdleWatch(pid_t child, int seconds) : limit_(seconds) { known_ = ::clock_getcpuclockid(child, &clock_) == 0; }

  [[nodiscard]] bool is_over() {
    timespec now{};
    if (known_ && ::clock_gettime(clock_, &now) == 0 && (now.tv_sec != last_.tv_sec || now.tv_nsec != last_.tv_nsec)) {
      last_ = now;
      since_ = std::chrono::steady_clock::now();
    }
    return std::chrono::steady_clock::now() - since_ > limit_;
  }

 private:
  std::chrono::seconds limit_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  clockid_t clock_{};
  timespec last_{};
  bool known_ = false;
};

// Waits until the child reports or ends; kills it when a limit is reached or go_on returns false.
CallEnd wait_for(pid_t child, int report, const CallLimits& limits, const std::function<bool()>& go_on) {
  constexpr int kMilliseconds = 50;
  std::optional<CallEnd> cut_short;
  char what = 0;
  IdleWatch idle(child, limits.seconds);
  while (!cut_short) {
    pollfd one{report, POLLIN, 0};
    const int ready = ::poll(&one, 1, kMilliseconds);
    if (ready > 0) {
      if (::read(report, &what, 1) != 1) what = 0;
      break;
    }
    if (go_on && !go_on()) cut_short = CallEnd::stopped;
    if (idle.is_over()) cut_short = CallEnd::out_of_time;
  }
  // A child that has reported is done. It is killed too, so that a false report cannot make this process wait.
  if (cut_short || what != 0) ::kill(child, SIGKILL);
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  if (cut_short) return *cut_short;
  if (what == kDone) return CallEnd::answered;
  if (what == kNoMemory) return CallEnd::out_of_memory;
  const bool by_time = ended == child && WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU);
  return by_time ? CallEnd::out_of_time : CallEnd::crashed;
}

CallResult not_started() {
  if (errno == ENOMEM) throw std::bad_alloc();
  return {};
}

}  // namespace

CallResult call_isolated(const CallLimits& limits, std::span<const std::filesystem::path> readable,
                         const std::function<void(AnswerWriter&)>& work, const std::function<bool()>& go_on) {
  Descriptor answer(::memfd_create("ninebit", MFD_CLOEXEC));
  std::array<int, 2> ends{-1, -1};
  if (answer.get() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) return not_started();
  Descriptor report(ends[0]);
  Descriptor reporting(ends[1]);
  const pid_t parent = ::getpid();
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);  // the parent ended before that took effect
    settle_descriptors(answer.get(), reporting.get());
    settle_signals(before);
    run_child(limits, readable, work);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) return not_started();
  reporting.close();
  const CallEnd end = wait_for(child, report.get(), limits, go_on);
  if (end == CallEnd::out_of_memory && is_address_space_limited()) throw std::bad_alloc();
  struct stat about = {};
  if (::fstat(answer.get(), &about) != 0 || ::lseek(answer.get(), 0, SEEK_SET) != 0) return not_started();
  return {end, AnswerReader(answer.release(), static_cast<std::uint64_t>(about.st_size))};
}

std::string describe(CallEnd end, const CallLimits& limits, const std::string& who) {
  switch (end) {
    case CallEnd::out_of_time:
      return who + " took more than " + std::to_string(limits.seconds) + " s";
    case CallEnd::out_of_memory:
      return who + " needed more than " + std::to_string(limits.memory_bytes >> 20U) + " MiB";
    case CallEnd::stopped:
      return "interrupted";
    case CallEnd::not_started:
      return "cannot start a process for " + who;
    default:
      return who + " crashed";
  }
}

void AnswerWriter::put(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t done = ::write(descriptor_, from, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw std::bad_alloc();  // the answer is a file in memory with a size limit
    from += done;
    size -= static_cast<std::size_t>(done);
  }
}

AnswerReader::~AnswerReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool AnswerReader::text(std::string& one) {
  std::uint64_t count = 0;
  if (!value(count) || count > left_) return fail();
  one.resize(static_cast<std::size_t>(count));
  return get(one.data(), one.size());
}

bool AnswerReader::get(void* bytes, std::size_t size) {
  if (size > left_) return fail();
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t done = ::read(descriptor_, to, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return fail();
    to += done;
    size -= static_cast<std::size_t>(done);
    left_ -= static_cast<std::uint64_t>(done);
  }
  return true;
}

}  // namespace ninebit::posix
