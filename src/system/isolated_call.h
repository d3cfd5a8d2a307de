// Calls into code that may crash, hang, take all memory or do what its input tells it to: in a child process that can
// do no harm.
//
// The child is this process, forked: it has what this one has in memory, and the thread that called. So the work may
// use malloc and what it brings along itself, but no lock that another thread of this process may hold, and no thread
// pool. What it may do:
// - It reads the files that were named, and no other, where the kernel has Landlock (Linux 5.13); elsewhere any file
//   that the user may read.
// - It writes no file, opens no socket, starts no process and signals none (seccomp; x86-64 and arm64).
// - It has the memory and the processor time of the limits. Its standard streams are /dev/null.
// - It dies with its parent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "src/system/answer.h"

namespace ninebit::posix {

struct CallLimits {
  std::uint64_t memory_bytes = std::uint64_t{1} << 30U;  // beyond what this process has mapped; of the answer, too
  int seconds = 20;                                      // of processor time, or without any
};

enum class CallEnd : std::uint8_t {
  answered,       // the work came to its end
  crashed,        // a signal, an exception, or an exit
  out_of_time,    // the limit of seconds
  out_of_memory,  // the limit of bytes
  stopped,        // the caller's wish
  not_started     // the system allows no further process
};

struct CallResult {
  CallEnd end = CallEnd::not_started;
  AnswerReader answer;  // what was written until the end
};

// Runs `work` in a child and waits for it; what it writes is the answer. `readable` are the files that it may open.
// `go_on`, if it is there, is called a few times a second; where it returns false the child is killed. Throws
// std::bad_alloc where the machine has no memory for a child, or where a limit that this process was started with is
// what leaves too little.
[[nodiscard]] CallResult call_isolated(const CallLimits& limits, std::span<const std::filesystem::path> readable,
                                       const std::function<void(AnswerWriter&)>& work,
                                       const std::function<bool()>& go_on = {});

// What happened to `who`, in words: "Assimp's 3DS reader crashed". Of any end but CallEnd::answered.
[[nodiscard]] std::string describe(CallEnd end, const CallLimits& limits, const std::string& who);

}  // namespace ninebit::posix
