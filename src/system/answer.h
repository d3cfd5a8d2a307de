// What an isolated call answers: values in a row, which nobody has to believe.
//
// The writer runs in a child process that may have gone mad; the reader takes nothing for granted. Only types whose
// every bit pattern is a value go through: numbers, and structures and arrays of numbers. An enumerator goes as a
// number that its reader checks.
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

// Throws std::bad_alloc where the answer becomes longer than the call allows.
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

// The values in their order. Each function returns false, and every later one too, where the answer is too short for
// what it says that it holds; no memory is taken for more than the bytes that are there.
class AnswerReader {
 public:
  AnswerReader() = default;
  AnswerReader(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), left_(bytes) {}  // takes the descriptor
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
