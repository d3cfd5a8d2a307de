// The answer of an isolated call: a sequence of values that the reader does not trust.
//
// The writer runs in a child process that may be corrupted, so the reader checks every length. Only types for which
// every bit pattern is a valid value are allowed: numbers, and structures and arrays of numbers. An enumerator is sent
// as a number, which the reader checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ninebit::posix {

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

}  // namespace ninebit::posix
