#include "src/language/xbox/xbox_array.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "src/language/xbox/xbox_dump.h"
#include "src/language/xbox/xbox_expression.h"
#include "src/language/xbox/xbox_numbers.h"

namespace ninebit::xbox {
namespace {

struct TypeWord {
  std::string_view name;  // in lower case, without _t
  std::size_t bytes;      // 0: not a type of integers
};
constexpr std::array kTypeWords{
    TypeWord{"byte", 1},    TypeWord{"char", 1},   TypeWord{"uchar", 1},    TypeWord{"uint8", 1},
    TypeWord{"int8", 1},    TypeWord{"u8", 1},     TypeWord{"glubyte", 1},  TypeWord{"word", 2},
    TypeWord{"short", 2},   TypeWord{"ushort", 2}, TypeWord{"uint16", 2},   TypeWord{"int16", 2},
    TypeWord{"u16", 2},     TypeWord{"dword", 4},  TypeWord{"ulong", 4},    TypeWord{"long", 4},
    TypeWord{"uint", 4},    TypeWord{"int", 4},    TypeWord{"unsigned", 4}, TypeWord{"uint32", 4},
    TypeWord{"int32", 4},   TypeWord{"u32", 4},    TypeWord{"float", 0},    TypeWord{"double", 0},
    TypeWord{"glfloat", 0}, TypeWord{"bool", 0},   TypeWord{"uint64", 0},   TypeWord{"int64", 0}};

std::string lower_type(std::string_view name) {
  std::string lower(name.substr(0, 32));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (lower.ends_with("_t")) lower.resize(lower.size() - 2);
  return lower;
}

// The text before the numbers: "static const unsigned char ps[240] = {", or a brace alone.
struct ArrayHead {
  std::size_t bytes = 0;  // of an element; 0: the type is unknown
  std::size_t names = 0;
  bool integers = true;
  bool of_opengl = false;
  TextPlace place{};  // of the brace

  void add_type(std::string_view name) {
    const std::string lower = lower_type(name);
    of_opengl = of_opengl || name.starts_with("GL");
    if (lower.find("pixelshaderdef") != std::string::npos) integers = false;
    const auto* const found =
        std::find_if(kTypeWords.begin(), kTypeWords.end(), [&](const TypeWord& word) { return word.name == lower; });
    if (found == kTypeWords.end()) return;
    if (found->bytes == 0) integers = false;
    bytes = bytes == 0 ? found->bytes : std::min(bytes, found->bytes);
  }
};

// Skips "(…)" or "[…]", of which the first bracket was taken. False: it is long or does not end.
bool skip_brackets(Lexer& lexer) {
  constexpr int kFewTokens = 16;
  int depth = 1;
  for (int i = 0; i < kFewTokens && depth > 0; ++i) {
    const Token token = lexer.take();
    if (token.kind == TokenKind::end || token.is(";") || token.is("{")) return false;
    if (token.is("(") || token.is("[")) ++depth;
    if (token.is(")") || token.is("]")) --depth;
  }
  return depth == 0;
}

// Takes the tokens up to the brace; empty: this is not an array of integers.
std::optional<ArrayHead> take_head(Lexer& lexer) {
  constexpr int kTokens = 64;
  ArrayHead head;
  std::string_view last;
  bool has_index = false;
  for (int i = 0; i < kTokens; ++i) {
    const Token token = lexer.take();
    if (token.is("#") && head.names == 0) {
      lexer.skip_line();
    } else if (token.kind == TokenKind::name) {
      if (head.names > 0) head.add_type(last);
      last = token.text;
      ++head.names;
    } else if (token.is("[") && head.names > 1 && !has_index) {
      has_index = true;
      if (!skip_brackets(lexer)) return std::nullopt;
    } else if (token.is("(") && head.names > 0) {  // __declspec(align(16))
      if (!skip_brackets(lexer)) return std::nullopt;
    } else if (token.is("{") && head.names == 0) {
      head.place = token.place;
      return head;
    } else if (token.is("=") && has_index && head.integers && lexer.peek().is("{")) {
      head.place = lexer.take().place;
      return head;
    } else if (!token.is(":")) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

// The number of elements that are plain numbers, up to the closing brace; empty: there is something else.
std::optional<std::size_t> count_elements(Lexer lexer) {
  for (std::size_t count = 0; count <= kMostNumbers;) {
    if (lexer.peek().is("}")) return count;
    if (lexer.take().kind != TokenKind::number) return std::nullopt;
    ++count;
    if (lexer.peek().is(",")) {
      (void)lexer.take();
    } else if (!lexer.peek().is("}")) {
      return std::nullopt;
    }
  }
  return kMostNumbers + 1;
}

struct Element {
  std::uint32_t value = 0;
  TextPlace place{};
};

// Up to the closing brace, which is taken.
std::vector<Element> take_elements(Lexer& lexer, TextFaults& faults) {
  Expressions values(lexer, faults);
  std::vector<Element> elements;
  while (!lexer.peek().is("}") && !faults.full() && elements.size() <= kMostNumbers) {
    const TextPlace place = lexer.peek().place;
    const std::optional<std::uint32_t> value = values.read();
    if (!value) return elements;  // with its fault
    elements.push_back({*value, place});
    if (lexer.peek().is(",")) {
      (void)lexer.take();
    } else if (!lexer.peek().is("}")) {
      faults.add(lexer.peek().place, "expected ',' or '}' after a number; found " + shown(lexer.peek()));
      return elements;
    }
  }
  (void)lexer.take();
  return elements;
}

// Text that may follow the array: declarations of single numbers.
void check_rest(Lexer& lexer, const ArrayHead& head, TextFaults& faults) {
  while (lexer.peek().kind != TokenKind::end) {
    const Token first = lexer.take();
    if (first.is(";")) continue;
    if (first.is("#")) {
      lexer.skip_line();
      continue;
    }
    std::size_t names = first.kind == TokenKind::name ? 1 : 0;
    for (; names > 0 && lexer.peek().kind == TokenKind::name; ++names) (void)lexer.take();
    if (names > 1 && lexer.peek().is("=")) {
      (void)lexer.take();
      if (lexer.take().kind == TokenKind::number && lexer.peek().is(";")) continue;
    }
    if (names > 1 && lexer.peek().is("[")) {
      return faults.add(first.place, "a second array; the first is in line " + std::to_string(head.place.line) +
                                         ", and a text has one definition");
    }
    return faults.add(first.place, "expected the end of the text behind the array; found " + shown(first));
  }
}

}  // namespace

bool is_number_array(std::string_view text) {
  Lexer lexer(text);
  const std::optional<ArrayHead> head = take_head(lexer);
  return head && (head->names > 0 || count_elements(lexer) == kXboxDefinitionBytes);
}

bool is_definition_array(std::string_view text) {
  Lexer lexer(text);
  const std::optional<ArrayHead> head = take_head(lexer);
  if (!head || head->of_opengl) return false;
  const std::optional<std::size_t> count = count_elements(lexer);
  if (!count) return false;
  if (head->bytes > 0) return *count * head->bytes == kXboxDefinitionBytes;
  return *count == kXboxDefinitionBytes || (*count == kXboxDefinitionWords && head->names > 0);
}

Definition read_array(std::string_view text, TextFaults& faults) {
  Definition definition;
  Lexer lexer(text);
  const ArrayHead head = take_head(lexer).value_or(ArrayHead{});
  const std::vector<Element> elements = take_elements(lexer, faults);
  if (!faults.empty()) return definition;
  const std::size_t size = head.bytes > 0 ? head.bytes : elements.size() == kXboxDefinitionBytes ? 1 : 4;
  const char* const what = size == 1 ? "bytes" : size == 2 ? "words of 16 bits" : "words of 32 bits";
  const TextPlace last = elements.empty() ? head.place : elements.back().place;
  check_count(elements.size(), what, kXboxDefinitionBytes / size, last, faults);
  if (!faults.empty()) return definition;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::size_t byte = i * size;
    if (size < 4 && elements[i].value >> (8 * size) != 0) {
      faults.add(elements[i].place, "the value does not fit in " + std::to_string(8 * size) + " bits");
    }
    std::optional<TextPlace>& place = definition.places[byte / 4];
    if (!place) place = elements[i].place;
    definition.words[byte / 4] |= elements[i].value << (8 * (byte % 4));
  }
  check_rest(lexer, head, faults);
  return definition;
}

}  // namespace ninebit::xbox
