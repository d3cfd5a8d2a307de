// Runs code that may crash, hang, exhaust memory or be controlled by its input in a sandboxed child process.
//
// The child is forked from this process: it has a copy of the memory, and only the calling thread. The work may use
// malloc and its own objects, but no lock that another thread of this process may hold, and no thread pool. The child's
// restrictions:
// - It can read only the named files if the kernel has Landlock (Linux 5.13); otherwise any file that the user may
//   read.
// - It cannot write files, open sockets, or start or signal processes (seccomp; x86-64 and arm64).
// - CallLimits bounds its memory and processor time. Its standard streams are /dev/null.
// - It dies with its parent.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "src/system/answer.h"

namespace ninebit::posix {

struct CallLimits {
  std::uint64_t memory_bytes = std::uint64_t{1}
                               << 30U;  // beyond what this process has mapped; also the limit of the answer
  int seconds = 20;                     // of processor time, or of waiting without using any
};

enum class CallEnd : std::uint8_t {
  answered,       // the work finished
  crashed,        // a signal, an exception, or an exit
  out_of_time,    // CallLimits::seconds
  out_of_memory,  // CallLimits::memory_bytes
  stopped,        // go_on returned false
  not_started     // no process could be started
};

struct CallResult {
  CallEnd end = CallEnd::not_started;
  AnswerReader answer;  // what was written before the end
};

// Runs `work` in a child and waits for it; the values that it writes are the answer. `readable` lists the files that it
// may open. `go_on`, if given, is called a few times a second; if it returns false, the child is killed. Throws
// std::bad_alloc if the machine has no memory for a child, or if the child runs out of memory while this process itself
// was started with a memory limit.
[[nodiscard]] CallResult call_isolated(const CallLimits& limits, std::span<const std::filesystem::path> readable,
                                       const std::function<void(AnswerWriter&)>& work,
                                       const std::function<bool()>& go_on = {});

// The message for any end but CallEnd::answered, such as "Assimp's 3DS reader crashed"; `who` is its subject.
[[nodiscard]] std::string describe(CallEnd end, const CallLimits& limits, const std::string& who);

// A file descriptor that closes itself.

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

}  // namespace ninebit::posix
