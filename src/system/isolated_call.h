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

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ninebit::posix {

// The answer of an isolated call: a sequence of values that the reader does not trust.
//
// The writer runs in a child process that may be corrupted, so the reader checks every length. Only types for which
// every bit pattern is a valid value are allowed: numbers, and structures and arrays of numbers. An enumerator is sent
// as a number, which the reader checks.

template <class T>
concept Plain =
    std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, bool> && !std::is_enum_v<T>;

// Throws std::bad_alloc if the answer exceeds the call's limit.
class AnswerWriter {
 public:
  explicit AnswerWriter(int descriptor) : descriptor_(descriptor) {}

  template <Plain T>
  void value(const T& one) {
    put(&one, sizeof one);
  }

  template <Plain T>
  void values(std::span<const T> many) {
    value(std::uint64_t{many.size()});
    put(many.data(), many.size_bytes());
  }

  void text(std::string_view one) { values(std::span(one.data(), one.size())); }

 private:
  void put(const void* bytes, std::size_t size);

  int descriptor_;
};

// Reads the values in the order in which they were written. If the answer is shorter than the lengths in it state, the
// call and every later one return false. No more memory is allocated than the answer has bytes.
class AnswerReader {
 public:
  AnswerReader() = default;
  AnswerReader(int descriptor, std::uint64_t bytes)
      : descriptor_(descriptor), left_(bytes) {}  // takes ownership of the descriptor
  AnswerReader(AnswerReader&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), left_(std::exchange(other.left_, 0)) {}
  AnswerReader& operator=(AnswerReader&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(left_, other.left_);
    return *this;
  }
  AnswerReader(const AnswerReader&) = delete;
  AnswerReader& operator=(const AnswerReader&) = delete;
  ~AnswerReader();

  template <Plain T>
  [[nodiscard]] bool value(T& one) {
    return get(&one, sizeof one);
  }

  template <Plain T, class Allocator>
  [[nodiscard]] bool values(std::vector<T, Allocator>& many) {
    std::uint64_t count = 0;
    if (!value(count) || count > left_ / sizeof(T)) return fail();
    many.resize(static_cast<std::size_t>(count));
    return get(many.data(), many.size() * sizeof(T));
  }

  [[nodiscard]] bool text(std::string& one);

  [[nodiscard]] std::uint64_t bytes_left() const { return left_; }

 private:
  bool get(void* bytes, std::size_t size);
  bool fail() {
    left_ = 0;
    return false;
  }

  int descriptor_ = -1;
  std::uint64_t left_ = 0;
};

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
