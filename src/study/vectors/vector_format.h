// The texts of packs and results: what printer and readers share.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/result.h"
#include "ninebit/study/vectors.h"
#include "src/system/lines.h"

namespace ninebit::vectors {

inline constexpr std::string_view kPackTitle = "ninebit-vectors 1", kStagePackTitle = "ninebit-stage-vectors 1",
                                  kResultsTitle = "ninebit-results 1";
inline constexpr std::size_t kIdDigits = 16;
inline constexpr int kTraceOffset = 256;  // added to the codes of a trace, so that none is negative

// Eight hexadecimal digits: red, green, blue, alpha.
[[nodiscard]] std::string color_text(const Bytes4& color);

// Appends a code in two digits to the base of 36, with kTraceOffset added.
void append_code(std::string& text, int code);

// The line of a group, without its programs.
[[nodiscard]] std::string group_line(const VectorGroup& group);

// The id of a pack whose text, without its first line, is `body`.
[[nodiscard]] std::string id_of(std::string_view body);

// The lines of a text, and the words of each.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  // Goes to the next line; false at the end.
  bool next() {
    if (rest_.empty()) {
      words_ = {};
      ++line_;
      return false;
    }
    words_ = take_line(rest_);
    ++line_;
    return true;
  }

  [[nodiscard]] int line() const { return line_; }
  // The text after the current line.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  // The rest of the line.
  [[nodiscard]] std::string_view words() const { return words_; }
  [[nodiscard]] bool at_end() const { return words_.find_first_not_of(' ') == std::string_view::npos; }

  // The next word of the line; empty: there is none.
  std::string_view word() {
    const std::size_t begin = words_.find_first_not_of(' ');
    if (begin == std::string_view::npos) return words_ = {};
    const std::size_t end = words_.find(' ', begin);
    const std::string_view found = words_.substr(begin, end == std::string_view::npos ? end : end - begin);
    words_ = end == std::string_view::npos ? std::string_view() : words_.substr(end + 1);
    return found;
  }

  // The next word as a number in [low, high].
  template <class T>
  std::optional<T> number(T low, T high, int base = 10) {
    return number_of(word(), low, high, base);
  }
  template <class T>
  static std::optional<T> number_of(std::string_view word, T low, T high, int base = 10) {
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value < low || value > high ? std::nullopt : std::optional(value);
  }

  // The next word as a colour.
  std::optional<Bytes4> color() {
    const std::string_view digits = word();
    const auto value = number_of<std::uint32_t>(digits, 0, 0xFFFFFFFF, 16);
    if (digits.size() != 8 || !value) return std::nullopt;
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(*value >> shift & 255U); };
    return Bytes4{byte(24), byte(16), byte(8), byte(0)};
  }

  [[nodiscard]] Diagnostic fault(std::string message) const { return {std::move(message), file_, line_}; }

 private:
  std::string_view rest_, words_;
  std::string file_;
  int line_ = 0;
};

}  // namespace ninebit::vectors
