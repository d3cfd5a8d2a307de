#include "combiner_tests/tools/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

namespace tools_test {
namespace {

std::FILE* open_file(const std::string& path) {
  std::FILE* file = path.empty() ? std::tmpfile() : std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot open " + (path.empty() ? "a temporary file" : path));
  return file;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::array<char, 4096> buffer{};
  std::rewind(file);
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file)) text.append(buffer.data(), n);
  return text;
}

// Runs between fork and exec: system calls only.
[[noreturn]] void become_the_program(char* const* arguments, const ChildSettings& settings, int out, int err) {
  bool ready = settings.folder.empty() || ::chdir(settings.folder.c_str()) == 0;
  if (settings.file_size_limit) {
    const rlimit limit{*settings.file_size_limit, *settings.file_size_limit};
    ready = ready && ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
  }
  if (settings.address_space) {
    const rlimit limit{*settings.address_space, *settings.address_space}, no_core{0, 0};
    ready = ready && ::setrlimit(RLIMIT_AS, &limit) == 0 && ::setrlimit(RLIMIT_CORE, &no_core) == 0;
  }
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  for (const int signal : settings.ignored) std::signal(signal, SIG_IGN);
  if (settings.traced) ready = ready && ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0;
  const int in = ::open(settings.in.empty() ? "/dev/null" : settings.in.c_str(), O_RDONLY);
  ready = ready && ::dup2(in, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0;
  if (ready) ::execv(kProgram.c_str(), arguments);
  ::_exit(126);
}

}  // namespace

Child::Child(const Words& arguments, const ChildSettings& settings)
    : out_(open_file(settings.out), &std::fclose), err_(open_file(settings.err), &std::fclose) {
  Words words{kProgram};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("cannot fork");
  if (process_ == 0) become_the_program(pointers.data(), settings, ::fileno(out_.get()), ::fileno(err_.get()));
}

Child::~Child() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool Child::ended() const {
  siginfo_t about{};
  return ::waitid(P_PID, static_cast<id_t>(process_), &about, WEXITED | WNOHANG | WNOWAIT) == 0 && about.si_pid != 0;
}

bool Child::until(const std::function<bool()>& come) const {
  while (!come()) {
    if (ended()) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

void Child::send(int signal) const {
  if (::kill(process_, signal) != 0) throw std::runtime_error("cannot send a signal");
}

Outcome Child::wait() {
  int status = 0;
  rusage used{};
  pid_t ended = -1;
  do {
    ended = ::wait4(process_, &status, 0, &used);
  } while (ended < 0 && errno == EINTR);
  if (ended < 0) throw std::runtime_error("cannot wait for the program");
  process_ = -1;
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.peak_kib = used.ru_maxrss;
  outcome.out = content_of(out_.get());
  outcome.err = content_of(err_.get());
  return outcome;
}

bool Child::run_to(const std::function<bool(std::uint64_t call)>& stops_at) const {
  while (true) {
    siginfo_t about{};
    if (::waitid(P_PID, static_cast<id_t>(process_), &about, WEXITED | WSTOPPED | WNOWAIT) != 0) return false;
    if (about.si_code != CLD_TRAPPED && about.si_code != CLD_STOPPED) return false;
    int status = 0;
    ::waitpid(process_, &status, 0);
    int signal = WSTOPSIG(status);
    if (signal == (SIGTRAP | 0x80)) {
      signal = 0;
      __ptrace_syscall_info info{};
      ::ptrace(PTRACE_GET_SYSCALL_INFO, process_, sizeof info, &info);
      if (info.op == PTRACE_SYSCALL_INFO_ENTRY && stops_at(info.entry.nr)) return true;
    } else if (signal == SIGTRAP) {  // it has become the program
      signal = 0;
      ::ptrace(PTRACE_SETOPTIONS, process_, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
    }
    ::ptrace(PTRACE_SYSCALL, process_, nullptr, signal);
  }
}

void Child::let_go() const {
  ::ptrace(PTRACE_DETACH, process_, nullptr, nullptr);
}

// Held open, so that what was written is not lost when a program ends.
Terminal::Terminal(unsigned short columns) : terminal_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
  if (terminal_ < 0 || ::grantpt(terminal_) != 0 || ::unlockpt(terminal_) != 0) {
    throw std::runtime_error("no terminal");
  }
  held_ = ::open(name().c_str(), O_RDWR | O_NOCTTY);
  const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  if (columns != 0) (void)::ioctl(terminal_, TIOCSWINSZ, &size);
}

Terminal::~Terminal() {
  ::close(held_);
  ::close(terminal_);
}

std::string Terminal::name() const {
  return ::ptsname(terminal_);
}

bool Terminal::read_more(std::string& seen, int milliseconds) const {
  pollfd wait{terminal_, POLLIN, 0};
  if (::poll(&wait, 1, milliseconds) <= 0) return false;
  std::array<char, 4096> piece{};
  const ssize_t count = ::read(terminal_, piece.data(), piece.size());
  if (count > 0) seen.append(piece.data(), static_cast<std::size_t>(count));
  return count > 0;
}

// A terminal hands on piece by piece, and late, what was written to it.
std::string Terminal::seen_until(const std::string& text) const {
  std::string seen;
  while (seen.find(text) == std::string::npos && read_more(seen, 10000)) {
  }
  return seen;
}

std::string Terminal::seen_of(const Child& child) const {
  std::string seen;
  for (bool ended = false; read_more(seen, 100) || !ended;) ended = child.ended();
  return seen;
}

Outcome ninebit(const Words& arguments, const ChildSettings& settings) {
  return Child(arguments, settings).wait();
}

}  // namespace tools_test
