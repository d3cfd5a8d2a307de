#include "src/system/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>

#include "src/system/isolated_call.h"

extern char** environ;

namespace ninebit::posix {
namespace {

struct Pipe {
  Descriptor read, write;
};

std::optional<Pipe> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  return Pipe{Descriptor(ends[0]), Descriptor(ends[1])};
}

// The started child's number, or 0 and errno's number in `error`.
pid_t start(const std::vector<std::string>& arguments, int standard_input, int standard_output, int& error) {
  std::vector<char*> words;
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, standard_input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, standard_output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  sigset_t defaults;  // this process may ignore them
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  error = posix_spawnp(&child, words[0], &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? child : 0;
}

// Feeds the child and listens to it until it closes its output.
class Conversation {
 public:
  Conversation(Descriptor to, Descriptor from, std::string_view input)
      : to_(std::move(to)), from_(std::move(from)), left_(input) {
    ::fcntl(to_.get(), F_SETFL, O_NONBLOCK);
    if (left_.empty()) to_.close();
  }

  // Waits for a tenth of a second at most. Returns whether the output goes on.
  bool step(std::string& output, bool& failed) {
    std::array<pollfd, 2> ready{{{from_.get(), POLLIN, 0}, {to_.get(), POLLOUT, 0}}};
    if (::poll(ready.data(), to_.get() >= 0 ? 2 : 1, 100) < 0) return errno == EINTR || !(failed = true);
    if (ready[1].revents != 0) feed();
    if (ready[0].revents == 0) return true;
    std::array<char, 4096> part{};
    const ssize_t count = ::read(from_.get(), part.data(), part.size());
    if (count > 0) output.append(part.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) failed = true;
    return count > 0 || (count < 0 && errno == EINTR);
  }

 private:
  void feed() {
    const ssize_t count = ::write(to_.get(), left_.data(), left_.size());
    if (count > 0) left_.remove_prefix(static_cast<std::size_t>(count));
    // A child that reads no further may still answer.
    if (left_.empty() || (count < 0 && errno != EAGAIN && errno != EINTR)) to_.close();
  }

  Descriptor to_, from_;
  std::string_view left_;
};

// A child that closes its input early must not end this process.
class NoBrokenPipe {
 public:
  NoBrokenPipe() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~NoBrokenPipe() { std::signal(SIGPIPE, before_); }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, std::string_view input, double seconds,
                          const std::function<bool()>& go_on) {
  auto to = make_pipe(), from = make_pipe();
  if (!to || !from) return {};
  int error = 0;
  const pid_t child = start(arguments, to->read.get(), from->write.get(), error);
  if (child == 0) return {error == ENOENT ? ProgramEnd::not_found : ProgramEnd::failed, 0, {}};
  to->read.close();
  from->write.close();
  const NoBrokenPipe guard;
  const auto begin = std::chrono::steady_clock::now();
  ProgramResult result{ProgramEnd::ended, 0, {}};
  Conversation conversation(std::move(to->write), std::move(from->read), input);
  bool failed = false;
  while (conversation.step(result.output, failed)) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (passed.count() > seconds) result.end = ProgramEnd::out_of_time;
    if (go_on && !go_on()) result.end = ProgramEnd::stopped;
    if (result.end != ProgramEnd::ended) break;
  }
  if (failed) result.end = ProgramEnd::failed;
  if (result.end != ProgramEnd::ended) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (result.end != ProgramEnd::ended) return result;
  if (WIFSIGNALED(status)) result.end = ProgramEnd::crashed;
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  return result;
}

}  // namespace ninebit::posix
