// Words of types, for the parser.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "src/language/c_like/c_token.h"

namespace ninebit::code {

[[nodiscard]] inline bool is_one_of(const Token& token, std::initializer_list<std::string_view> words) {
  return token.is_name() && std::find(words.begin(), words.end(), token.text) != words.end();
}

// Words of a number's type, and those that stand for a whole type.
[[nodiscard]] inline bool is_number_word(const Token& token) {
  return is_one_of(token, {"unsigned", "signed", "short", "long", "int", "char", "float", "double", "bool", "_Bool",
                           "void", "auto", "var", "__signed__"});
}
[[nodiscard]] inline bool is_structure_word(const Token& token) {
  return is_one_of(token, {"struct", "class", "union", "enum", "interface"});
}
// Words before a declaration that are not its type.
[[nodiscard]] inline bool is_qualifier(const Token& token) {
  return is_one_of(
      token,
      {"const",     "static",       "extern",       "volatile", "register",      "inline",   "constexpr",  "final",
       "public",    "private",      "protected",    "mutable",  "readonly",      "virtual",  "explicit",   "friend",
       "__inline",  "typedef",      "typename",     "CONST",    "__restrict",    "restrict", "__inline__", "abstract",
       "transient", "synchronized", "thread_local", "__const",  "__extension__", "strictfp", "native"});
}

}  // namespace ninebit::code
