// The tokens of a program's source: C, C++, Java, C# and the like, or Pascal.
#pragma once

#include <cstdint>
#include <string_view>

namespace ninebit::code {

struct Token {
  enum class Kind : std::uint8_t { end, name, number, text, character, punctuation };
  Kind kind = Kind::end;
  bool begins_line = false;  // the first of its line
  bool after_blank = false;  // white space or a comment stands before it
  std::uint32_t offset = 0;  // bytes of the source; of a token from a macro: those of the macro's use
  std::uint32_t end = 0;
  std::string_view text{};  // as written, a literal with its quotes

  [[nodiscard]] bool is(std::string_view spelled) const {
    return text == spelled && (kind == Kind::punctuation || kind == Kind::name);
  }
  [[nodiscard]] bool is_name() const { return kind == Kind::name; }
};

// Pascal has other literals, comments and operators, and its words have no case.
enum class Language : std::uint8_t { c, pascal };

}  // namespace ninebit::code
