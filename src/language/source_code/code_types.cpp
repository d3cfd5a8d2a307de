#include "src/language/source_code/code_types.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace ninebit::code {
namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

TypeKind type_kind(std::string_view word) {
  const std::string lower = lower_case(word);
  if (is_one_of(lower, {"float", "double", "glfloat", "gldouble", "glclampf", "glclampd", "single", "real", "extended",
                        "float32", "float64", "real32", "tglfloat", "pglfloat", "gl_float"})) {
    return TypeKind::real;
  }
  if (is_one_of(lower, {"bool", "boolean", "glboolean", "_bool", "bytebool", "tglboolean"})) return TypeKind::boolean;
  if (is_one_of(lower, {"char",     "short",   "int",      "long",     "unsigned",   "signed",   "byte",
                        "word",     "dword",   "uint",     "ulong",    "ushort",     "uchar",    "size_t",
                        "glenum",   "glint",   "gluint",   "glshort",  "glbyte",     "glubyte",  "glushort",
                        "glsizei",  "int32",   "uint32",   "int64",    "uint64",     "int16",    "uint16",
                        "int8",     "uint8",   "integer",  "cardinal", "longint",    "longword", "smallint",
                        "shortint", "tglenum", "tglint",   "tgluint",  "glbitfield", "gl_enum",  "int32_t",
                        "uint32_t", "int64_t", "uint64_t", "int16_t",  "uint16_t",   "int8_t",   "uint8_t"})) {
    return TypeKind::integer;
  }
  return TypeKind::other;
}

bool is_type_word(std::string_view word) {
  if (type_kind(word) != TypeKind::other) return true;
  return is_one_of(word, {"void", "const", "struct", "enum", "class", "auto", "var", "GLvoid", "GLchar", "string"}) ||
         word.ends_with("_t");
}

bool is_qualifier(std::string_view word) {
  return is_one_of(word, {"const",  "static",  "extern",   "volatile",  "register", "inline",    "constexpr",
                          "final",  "public",  "private",  "protected", "internal", "mutable",   "readonly",
                          "unsafe", "virtual", "explicit", "friend",    "__inline", "constinit", "thread_local"});
}

bool is_vector_type(std::string_view word) {
  const std::string lower = lower_case(word);
  for (const std::string_view part : {"vec", "color", "colour", "rgba", "float4", "float3", "quat", "plane", "tuple"}) {
    if (lower.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace ninebit::code
