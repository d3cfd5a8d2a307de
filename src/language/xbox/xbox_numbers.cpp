#include "src/language/xbox/xbox_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/xbox/xbox_expression.h"
#include "src/system/find_row.h"

namespace ninebit::xbox {
namespace {

// A D3DPIXELSHADERDEF_FILE of the Xbox's development kit begins with it.
constexpr std::string_view kFileMagic = "PSB0";

std::uint32_t value_of(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

// How the numbers of a list are written.
struct Style {
  explicit Style(const DumpNumbers& dump) {
    const std::vector<DumpNumber>& numbers = dump.numbers;
    prefixed = std::any_of(numbers.begin(), numbers.end(), [](const DumpNumber& number) { return number.prefixed; });
    if (!prefixed && !numbers.empty()) digits = numbers.front().digits.size();
    // As xxd -i writes what it reads from a pipe.
    const bool bytes = numbers.size() == kXboxDefinitionBytes &&
                       std::all_of(numbers.begin(), numbers.end(), [](const DumpNumber& number) {
                         return number.prefixed && number.digits.size() == 2;
                       });
    if (prefixed) {
      unit = bytes ? 1 : 4;
    } else if (digits == 8 || (digits == 4 && dump.little_endian_halves)) {
      unit = digits / 2;
    }
  }

  [[nodiscard]] bool fits(const DumpNumber& number) const {
    const std::size_t found = number.digits.size();
    if (!is_hex_number(number)) return false;
    if (prefixed) return found <= 8 && (number.prefixed || number.digits == "0");
    return digits > 8 ? found % 2 == 0 : found == digits;
  }
  [[nodiscard]] std::string expected() const {
    if (prefixed) return "0x and up to 8 hexadecimal digits";
    return digits > 8 ? "an even number of hexadecimal digits" : std::to_string(digits) + " hexadecimal digits";
  }

  bool prefixed = false;  // with 0x; a 0 may stand alone
  std::size_t digits = 8;
  std::size_t unit = 1;  // the bytes of a number in little endian: 1, 2 or 4; longer ones are bytes in their order
};

// Adds a fault if the count of `what` ("bytes") is not that of a definition.
void check_count(std::size_t found, std::string_view what, std::size_t expected, std::size_t offset,
                 detail::SourceFaults& faults) {
  if (found == expected) return;
  const std::string count = found > kMostNumbers ? "more than " + std::to_string(kMostNumbers) : std::to_string(found);
  faults.add(offset, count + " " + std::string(what) + "; expected the " + std::to_string(expected) +
                         " of a D3DPIXELSHADERDEF");
}

}  // namespace

bool is_binary(std::string_view bytes) {
  return bytes.find('\0') != std::string_view::npos;
}

bool is_definition_file(std::string_view bytes) {
  return bytes.starts_with(kFileMagic);
}

Definition read_bytes(std::string_view bytes, detail::SourceFaults& faults) {
  Definition definition;
  std::size_t begin = 0;
  if (is_definition_file(bytes)) {
    const std::size_t expected = kFileMagic.size() + kXboxDefinitionBytes;
    if (bytes.size() != expected) {
      faults.add(0, "a file 'PSB0' of " + std::to_string(bytes.size()) + " bytes; expected " +
                        std::to_string(expected) + ", the magic and one D3DPIXELSHADERDEF");
      return definition;
    }
    begin = kFileMagic.size();
    bytes.remove_prefix(begin);
  }
  if (bytes.size() != kXboxDefinitionBytes) {
    const bool several = !bytes.empty() && bytes.size() % kXboxDefinitionBytes == 0;
    faults.add(0, std::to_string(bytes.size()) + " bytes" +
                      (several ? ", which are " + std::to_string(bytes.size() / kXboxDefinitionBytes) + " definitions"
                               : std::string()) +
                      "; expected the 240 of one D3DPIXELSHADERDEF");
    return definition;
  }
  for (std::size_t i = 0; i < kXboxDefinitionWords; ++i) {
    definition.offsets[i] = begin + 4 * i;
    for (std::size_t k = 0; k < 4; ++k) {
      definition.words[i] |= std::uint32_t{static_cast<unsigned char>(bytes[4 * i + k])} << (8 * k);
    }
  }
  return definition;
}

Definition read_number_list(std::string_view text, detail::SourceFaults& faults) {
  Definition definition;
  const DumpNumbers dump = read_dump(text, faults);
  const bool complete = faults.empty();
  const Style style(dump);
  std::size_t bytes = 0, last = 0;
  for (const DumpNumber& number : dump.numbers) {
    last = number.offset;
    if (!style.fits(number)) {
      faults.add(number.offset,
                 detail::quoted(number.digits) + " is not a number of this list; expected " + style.expected());
      bytes += style.prefixed ? style.unit : style.digits / 2;
      continue;
    }
    const std::size_t step = style.prefixed ? number.digits.size() : 2 * style.unit;
    for (std::size_t at = 0; at < number.digits.size(); at += step, bytes += style.unit) {
      if (bytes >= kXboxDefinitionBytes) continue;
      std::optional<std::size_t>& offset = definition.offsets[bytes / 4];
      if (!offset) offset = number.offset;
      definition.words[bytes / 4] |= value_of(number.digits.substr(at, step)) << (8 * (bytes % 4));
    }
  }
  if (complete && style.unit == 4) {
    check_count(bytes / 4, "words of 32 bits", kXboxDefinitionWords, last, faults);
  } else if (complete) {
    check_count(bytes, "bytes", kXboxDefinitionBytes, last, faults);
  }
  return definition;
}

namespace {

using code::shown;
using code::Token;
using code::TokenReader;

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
  std::string lower = detail::lower_case(name.substr(0, 32));
  if (lower.ends_with("_t")) lower.resize(lower.size() - 2);
  return lower;
}

// The text before the numbers: "static const unsigned char ps[240] = {", or a brace alone.
struct ArrayHead {
  std::size_t bytes = 0;  // of an element; 0: the type is unknown
  std::size_t names = 0;
  bool integers = true;
  bool of_opengl = false;
  std::size_t brace = 0;  // its offset

  void add_type(std::string_view name) {
    const std::string lower = lower_type(name);
    of_opengl = of_opengl || name.starts_with("GL");
    if (lower.find("pixelshaderdef") != std::string::npos) integers = false;
    const TypeWord* const found = find_row(kTypeWords, &TypeWord::name, lower);
    if (found == nullptr) return;
    if (found->bytes == 0) integers = false;
    bytes = bytes == 0 ? found->bytes : std::min(bytes, found->bytes);
  }
};

// Skips "(…)" or "[…]", of which the first bracket was taken. False: it is long or does not end.
bool skip_brackets(TokenReader& lexer) {
  constexpr int kFewTokens = 16;
  int depth = 1;
  for (int i = 0; i < kFewTokens && depth > 0; ++i) {
    const Token token = lexer.take();
    if (token.kind == Token::Kind::end || token.is(";") || token.is("{")) return false;
    if (token.is("(") || token.is("[")) ++depth;
    if (token.is(")") || token.is("]")) --depth;
  }
  return depth == 0;
}

// Takes the tokens up to the brace; empty: this is not an array of integers.
std::optional<ArrayHead> take_head(TokenReader& lexer) {
  constexpr int kTokens = 64;
  ArrayHead head;
  std::string_view last;
  bool has_index = false;
  for (int i = 0; i < kTokens; ++i) {
    const Token token = lexer.take();
    if (token.is("#") && head.names == 0) {
      lexer.skip_line();
    } else if (token.is_name()) {
      if (head.names > 0) head.add_type(last);
      last = token.text;
      ++head.names;
    } else if (token.is("[") && head.names > 1 && !has_index) {
      has_index = true;
      if (!skip_brackets(lexer)) return std::nullopt;
    } else if (token.is("(") && head.names > 0) {  // __declspec(align(16))
      if (!skip_brackets(lexer)) return std::nullopt;
    } else if (token.is("{") && head.names == 0) {
      head.brace = token.offset;
      return head;
    } else if (token.is("=") && has_index && head.integers && lexer.peek().is("{")) {
      head.brace = lexer.take().offset;
      return head;
    } else if (!token.is("::")) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

// The number of elements that are plain numbers, up to the closing brace; empty: there is something else.
std::optional<std::size_t> count_elements(TokenReader lexer) {
  for (std::size_t count = 0; count <= kMostNumbers;) {
    if (lexer.peek().is("}")) return count;
    if (lexer.take().kind != Token::Kind::number) return std::nullopt;
    ++count;
    if (!lexer.takes(",") && !lexer.peek().is("}")) return std::nullopt;
  }
  return kMostNumbers + 1;
}

struct Element {
  std::uint32_t value = 0;
  std::size_t offset = 0;
};

// Up to the closing brace, which is taken.
std::vector<Element> take_elements(TokenReader& lexer, detail::SourceFaults& faults) {
  Expressions values(lexer, faults);
  std::vector<Element> elements;
  while (!lexer.peek().is("}") && !faults.full() && elements.size() <= kMostNumbers) {
    const std::size_t offset = lexer.peek().offset;
    const std::optional<std::uint32_t> value = values.read();
    if (!value) return elements;  // with its fault
    elements.push_back({*value, offset});
    if (lexer.takes(",") || lexer.peek().is("}")) continue;
    faults.add(lexer.peek().offset, "expected ',' or '}' after a number; found " + shown(lexer.peek()));
    return elements;
  }
  lexer.take();
  return elements;
}

// Text that may follow the array: declarations of single numbers.
void check_rest(TokenReader& lexer, const ArrayHead& head, const SourceText& source, detail::SourceFaults& faults) {
  const std::optional<Token> first = lexer.skip_behind_array();
  if (const auto comment = lexer.unterminated()) return faults.add(*comment, "unterminated comment; expected */");
  if (!first) return;
  if (!first->is_name() || !lexer.peek().is("[")) {
    return faults.add(first->offset, "expected the end of the text behind the array; found " + shown(*first));
  }
  const std::string line = std::to_string(source.place(head.brace).line);
  faults.add(first->offset, "a second array; the first is in line " + line + ", and a text has one definition");
}

}  // namespace

bool is_number_array(std::string_view text) {
  TokenReader lexer(text, true);
  const std::optional<ArrayHead> head = take_head(lexer);
  return head && (head->names > 0 || count_elements(lexer) == kXboxDefinitionBytes);
}

bool is_definition_array(std::string_view text) {
  TokenReader lexer(text, true);
  const std::optional<ArrayHead> head = take_head(lexer);
  if (!head || head->of_opengl) return false;
  const std::optional<std::size_t> count = count_elements(lexer);
  if (!count) return false;
  if (head->bytes > 0) return *count * head->bytes == kXboxDefinitionBytes;
  return *count == kXboxDefinitionBytes || (*count == kXboxDefinitionWords && head->names > 0);
}

Definition read_array(const SourceText& source, detail::SourceFaults& faults) {
  Definition definition;
  TokenReader lexer(source.text, true);
  const ArrayHead head = take_head(lexer).value_or(ArrayHead{});
  const std::vector<Element> elements = take_elements(lexer, faults);
  if (!faults.empty()) return definition;
  const std::size_t size = head.bytes > 0 ? head.bytes : elements.size() == kXboxDefinitionBytes ? 1 : 4;
  const char* const what = size == 1 ? "bytes" : size == 2 ? "words of 16 bits" : "words of 32 bits";
  const std::size_t last = elements.empty() ? head.brace : elements.back().offset;
  check_count(elements.size(), what, kXboxDefinitionBytes / size, last, faults);
  if (!faults.empty()) return definition;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::size_t byte = i * size;
    if (size < 4 && elements[i].value >> (8 * size) != 0) {
      faults.add(elements[i].offset, "the value does not fit in " + std::to_string(8 * size) + " bits");
    }
    std::optional<std::size_t>& offset = definition.offsets[byte / 4];
    if (!offset) offset = elements[i].offset;
    definition.words[byte / 4] |= elements[i].value << (8 * (byte % 4));
  }
  check_rest(lexer, head, source, faults);
  return definition;
}

}  // namespace ninebit::xbox
