// The names of types, as far as casts and declarations need them.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::code {

// A word with the letters A to Z as a to z.
[[nodiscard]] std::string lower_case(std::string_view word);

enum class TypeKind { integer, real, boolean, other };

// What a type's last word says about numbers: GLenum, int, DWORD; GLfloat, double, Single; bool.
[[nodiscard]] TypeKind type_kind(std::string_view word);

// Whether a word is surely a type's, or belongs to one (const, unsigned, struct).
[[nodiscard]] bool is_type_word(std::string_view word);

// Whether a word stands before a declaration without being its type (static, const, final, …).
[[nodiscard]] bool is_qualifier(std::string_view word);

// Whether a class seems to hold a few numbers, so that TYPE(1, 0, 0, 1) is an array of them: Vec4, Color, GLfloat4, …
[[nodiscard]] bool is_vector_type(std::string_view word);

}  // namespace ninebit::code
