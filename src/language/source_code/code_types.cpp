// Types.
#include <array>
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
namespace {

struct NamedKinds {
  std::string_view name;
  Kinds kinds;
};
// Types of OpenGL's, Windows' and C's headers. What differs between headers has several kinds.
constexpr std::array kTypes{
    NamedKinds{"GLenum", kUint32},        NamedKinds{"GLbitfield", kUint32},  NamedKinds{"GLuint", kUint32},
    NamedKinds{"GLint", kInt32},          NamedKinds{"GLsizei", kInt32},      NamedKinds{"GLshort", kInt16},
    NamedKinds{"GLushort", kUint16},      NamedKinds{"GLbyte", kInt8},        NamedKinds{"GLubyte", kUint8},
    NamedKinds{"GLboolean", kUint8},      NamedKinds{"GLchar", kInt8},        NamedKinds{"GLfloat", kFloat32},
    NamedKinds{"GLclampf", kFloat32},     NamedKinds{"GLdouble", kFloat64},   NamedKinds{"GLclampd", kFloat64},
    NamedKinds{"int8_t", kInt8},          NamedKinds{"uint8_t", kUint8},      NamedKinds{"int16_t", kInt16},
    NamedKinds{"uint16_t", kUint16},      NamedKinds{"int32_t", kInt32},      NamedKinds{"uint32_t", kUint32},
    NamedKinds{"int64_t", kInt64},        NamedKinds{"uint64_t", kUint64},    NamedKinds{"size_t", kUint32 | kUint64},
    NamedKinds{"BYTE", kUint8},           NamedKinds{"WORD", kUint16},        NamedKinds{"DWORD", kUint32},
    NamedKinds{"BOOL", kInt32},           NamedKinds{"INT", kInt32},          NamedKinds{"UINT", kUint32},
    NamedKinds{"LONG", kInt32},           NamedKinds{"ULONG", kUint32},       NamedKinds{"FLOAT", kFloat32},
    NamedKinds{"D3DCOLOR", kUint32},      NamedKinds{"uint", kUint32},        NamedKinds{"ushort", kUint16},
    NamedKinds{"uchar", kUint8},          NamedKinds{"byte", kInt8 | kUint8}, NamedKinds{"boolean", kBool | kUint8},
    NamedKinds{"qboolean", kEnumeration}, NamedKinds{"__int64", kInt64},      NamedKinds{"float32", kFloat32}};

}  // namespace

std::size_t cells_of(const Type* type) {
  if (type->is(TypeKind::array)) {
    return static_cast<std::size_t>(std::max<std::int64_t>(type->count, 0)) * cells_of(type->of);
  }
  return type->is(TypeKind::structure) ? type->structure->cells : 1;
}

Parser::Parser(const File& file, Outline& outline) : file_(file), outline_(outline), end_(file.tokens.size() - 1) {
  for (const NamedKinds& one : kTypes) symbols_[one.name] = {number_type(one.kinds), {}};
}

const Type* Parser::type(const Type& like) {
  for (const Type& one : outline_.types) {
    const bool same = one.kind == like.kind && one.kinds == like.kinds && one.of == like.of &&
                      one.count == like.count && one.structure == like.structure && one.name == like.name;
    if (same) return &one;
  }
  return &outline_.types.emplace_back(like);
}

// More elements than a source could fill, and elements of unknown size, make it unknown.
const Type* Parser::array_of(const Type* of, std::int64_t count) {
  constexpr std::int64_t kMostElements = 4096;
  const bool is_known = !of->is(TypeKind::unknown) && !of->is(TypeKind::nothing) && count >= Type::kOpen &&
                        count <= kMostElements && !(of->is(TypeKind::array) && of->count == Type::kOpen);
  const bool fits = is_known && (count <= 0 || cells_of(of) * static_cast<std::size_t>(count) <= kMostElements);
  return fits ? type({.kind = TypeKind::array, .of = of, .count = count}) : unknown_type();
}

const Parser::Symbol* Parser::symbol(std::string_view name) const {
  const auto found = symbols_.find(name);
  return found == symbols_.end() ? nullptr : &found->second;
}

const Type* Parser::known_type(std::string_view name) {
  const Symbol* const known = symbol(name);
  return known == nullptr ? nullptr : known->type;
}

void Parser::declare(std::string_view name, Symbol meaning) {
  if (name.empty()) return;
  const auto known = symbols_.find(name);
  if (!saved_.empty()) {
    saved_.back().emplace_back(name, known == symbols_.end() ? std::nullopt : std::optional(known->second));
  }
  symbols_[name] = meaning;
}

void Parser::close_scope() {
  for (auto one = saved_.back().rbegin(); one != saved_.back().rend(); ++one) {
    if (one->second) {
      symbols_[one->first] = *one->second;
    } else {
      symbols_.erase(one->first);
    }
  }
  saved_.pop_back();
}

// Behind <…> of names, numbers and commas; 0: it is something else.
std::size_t Parser::behind_template(std::size_t at) const {
  constexpr std::size_t kLongest = 64;
  int depth = 0;
  for (std::size_t i = at; i < std::min(at + kLongest, end_); ++i) {
    const Token& one = token(i);
    if (one.is("<")) ++depth;
    if (one.is(">")) --depth;
    if (one.is(">>")) depth -= 2;
    if (depth <= 0) return i + 1;
    const bool fits = one.is_name() || one.kind == Token::Kind::number || one.is(",") || one.is("*") || one.is("&") ||
                      one.is("::") || one.is("<");
    if (!fits) return 0;
  }
  return 0;
}

bool Parser::number_words(Specifiers& out) {
  int longs = 0, total = 0;
  bool is_unsigned = false, is_short = false;
  std::string_view main;
  for (; is_number_word(peek()) || is_qualifier(peek()); take()) {
    const Token& word = peek();
    if (word.is("const") || word.is("volatile")) {
      out.is_constant = out.is_constant || word.is("const");
      out.is_volatile = out.is_volatile || word.is("volatile");
      continue;
    }
    if (is_qualifier(word)) break;
    ++total;
    if (word.is("long")) {
      ++longs;
    } else if (word.is("short")) {
      is_short = true;
    } else if (word.is("unsigned")) {
      is_unsigned = true;
    } else if (!word.is("signed") && !word.is("__signed__")) {
      main = word.text;
    }
  }
  if (total == 0) return false;
  Kinds kinds = is_unsigned ? kUint32 : kInt32;
  if (main == "void") {
    out.type = type({.kind = TypeKind::nothing});
    return true;
  }
  if (main == "auto" || main == "var") {
    out.type = type({.name = "auto"});
    return true;
  }
  if (main == "float") kinds = kFloat32;
  if (main == "double") kinds = kFloat64;
  if (main == "bool" || main == "_Bool") kinds = kBool;
  if (main == "char") kinds = is_unsigned ? kUint8 : kInt8;
  if (is_short) kinds = is_unsigned ? kUint16 : kInt16;
  // long has 32 bits on some machines and 64 on others.
  if (longs == 1 && main != "double") kinds = is_unsigned ? kUint32 | kUint64 : kInt32 | kInt64;
  if (longs == 2) kinds = is_unsigned ? kUint64 : kInt64;
  out.type = longs > 0 && main == "double" ? type({.kind = TypeKind::opaque}) : number_type(kinds);
  return true;
}

// The words before a declarator. Without `takes_unknown`, only a type that is known.
bool Parser::specifiers(Specifiers& out, bool takes_unknown) {
  while (true) {
    const Token& word = peek();
    if (word.is("[") && peek(1).is("[")) {  // an attribute
      skip_brackets();
    } else if (is_one_of(word, {"__attribute__", "__declspec", "alignas"}) && peek(1).is("(")) {
      take();
      skip_brackets();
    } else if (is_qualifier(word) && !(word.is("register") && !peek(1).is_name())) {
      out.is_constant = out.is_constant || is_one_of(word, {"const", "constexpr", "CONST", "__const"});
      out.is_static = out.is_static || word.is("static");
      out.is_extern = out.is_extern || word.is("extern");
      out.is_typedef = out.is_typedef || word.is("typedef");
      out.is_volatile = out.is_volatile || word.is("volatile");
      out.is_final = out.is_final || word.is("final");
      take();
    } else if (out.type != nullptr) {
      break;
    } else if (is_number_word(word)) {
      if (!number_words(out)) return false;
    } else if (is_structure_word(word)) {
      out.type = structure(out);
      if (out.type == nullptr) return false;
    } else if (word.is_name() || word.is("::")) {
      takes("::");
      const Token name = take();
      std::string_view last = name.text;
      while ((peek().is("::") && peek(1).is_name()) ||
             (takes_unknown && peek().is(".") && peek(1).is_name() && peek(2).is_name())) {
        take();
        last = take().text;
      }
      out.type = known_type(last);
      bool is_template = false;
      if (peek().is("<")) {
        const std::size_t behind = behind_template(at_);
        if (behind == 0) return false;
        at_ = behind;
        is_template = true;
      }
      if (out.type == nullptr && (!takes_unknown || symbol(last) != nullptr)) return false;
      if (out.type == nullptr || is_template) out.type = type({.name = last});
    } else {
      return false;
    }
  }
  if (out.is_volatile) out.type = type({.kind = TypeKind::opaque});
  // An object of Java's that is final is another one's, too.
  if (out.is_final && out.type->is(TypeKind::number)) out.is_constant = true;
  return true;
}

// struct, class, union or enum, with its body or without.
const Type* Parser::structure(Specifiers& out) {
  const Token keyword = take();
  if (keyword.is("enum")) {
    enumeration(out);
    return out.type;
  }
  std::string_view name;
  // The last name before the body is the class's; those before it are macros.
  while (peek().is_name() && !is_one_of(peek(), {"final", "extends", "implements"})) {
    name = take().text;
    while (takes("::")) name = peek().is_name() ? take().text : name;
    if (!peek().is_name() || !(peek(1).is("{") || peek(1).is(":"))) break;
  }
  const std::size_t at = at_;
  bool has_base = false;
  if (takes("final")) has_base = false;
  if (peek().is(":") || peek().is("extends") || peek().is("implements")) {
    has_base = true;
    while (!at_end() && !peek().is("{") && !peek().is(";") && !peek().is(")")) take();
  }
  if (peek().is("{") && classes_.size() >= std::size_t{kMostNestedStatements}) return nullptr;
  if (!peek().is("{")) {
    at_ = at;
    if (name.empty()) return nullptr;
    const Type* const known = known_type(name);
    if (known != nullptr) return known;
    // It may be defined below.
    Struct& later = outline_.structs.emplace_back();
    later.name = name;
    const Type* const made = type({.structure = &later});
    declare(name, {made, {}});
    return made;
  }
  Struct& body = outline_.structs.emplace_back();
  body.name = name;
  body.is_special = has_base;
  Type& made = outline_.types.emplace_back();
  const Type* const before = known_type(name);
  made.structure = &body;
  if (!name.empty()) declare(name, {&made, {}});
  bool is_read = true;
  classes_.push_back(name);
  take();
  members(body, is_read);
  classes_.pop_back();
  if (!takes("}")) return nullptr;
  body.is_complete = is_read && !has_base;
  made.kind = keyword.is("union") ? TypeKind::opaque : body.is_complete ? TypeKind::structure : TypeKind::unknown;
  // Pointers that were declared to it before lead here.
  const bool forward = before != nullptr && before->is(TypeKind::unknown) && before->structure != nullptr &&
                       before->structure->name == name && !before->structure->is_complete;
  if (forward) {
    for (Type& one : outline_.types) {
      if (&one == before) one = made;
    }
  }
  return &made;
}

void Parser::members(Struct& out, bool& is_read) {
  constexpr std::size_t kMostCells = 4096;
  while (!at_end() && !peek().is("}")) {
    const std::size_t begin = at_;
    if (skip_words()) continue;
    if (peek().is("{") || (peek().is("static") && peek(1).is("{"))) {
      takes("static");
      skip_brackets();
      continue;
    }
    const DeclarationHead head = this->head();
    const bool points = head.parenthesis + 1 < end_ && token(head.parenthesis + 1).is("*");
    if (head.parenthesis != 0 && !head.is_class && !points && function(head, &out)) continue;
    at_ = begin;
    Statement all;
    declaration(all, true);
    if (std::exchange(failed_, false)) {
      is_read = false;
      at_ = begin;
      skip_statement();
      if (at_ == begin) take();
    }
    for (Declared& one : all.declared) {
      one.scope = out.name;
      one.is_constant = one.is_constant && !one.type->is(TypeKind::pointer);
      if (one.is_static) continue;
      const bool fits = !(one.type->is(TypeKind::array) && one.type->count == Type::kOpen);
      is_read = is_read && fits && out.cells < kMostCells;
      out.members.push_back({one.name, one.type, out.cells});
      if (fits) out.cells += cells_of(one.type);
    }
    if (!all.declared.empty()) outline_.globals.push_back(std::move(all));
  }
}

void Parser::enumeration(Specifiers& out) {
  takes("class");
  takes("struct");
  std::string_view name = peek().is_name() ? take().text : std::string_view();
  out.type = number_type(kEnumeration);
  if (!peek().is("{")) {
    if (const Type* const known = known_type(name)) out.type = known;
    return;
  }
  take();
  std::optional<Number> next = int_number(0);
  bool is_negative = false;
  const std::string_view scope = classes_.empty() ? std::string_view() : classes_.back();
  while (peek().is_name()) {
    const Token one = take();
    if (takes("=")) {
      const auto value = tried([&] { return assignment(); });
      next = value ? fold(*value) : std::nullopt;
      if (next) next = convert(*next, kInt64);
      constexpr std::int64_t kBeyond = std::int64_t{1} << 31;
      if (next) next->kinds = next->integer >= kBeyond ? kUint32 : kInt32;
    }
    is_negative = is_negative || (next && next->integer < 0);
    Declared made;
    made.name = one.text;
    made.type = number_type(next ? next->kinds : kInt32);
    made.offset = one.offset;
    made.is_constant = true;
    if (next) {
      Expression& value = made.value.emplace_back();
      value.kind = ExpressionKind::number;
      value.number = *next;
      value.offset = one.offset;
      value.end = one.end;
    }
    declare(one.text, {nullptr, next});
    made.scope = scope;
    out.enumerators.push_back(made);
    made.scope = name;
    if (!name.empty() && name != scope) out.enumerators.push_back(made);
    if (next) next = calculate("+", *next, int_number(1));
    if (peek().is("(")) skip_brackets();  // Java
    if (!takes(",")) break;
  }
  if (!takes("}")) {
    while (!at_end() && !takes("}")) skip_brackets();
  }
  if (is_negative && out.type->kinds == kEnumeration) out.type = number_type(kInt32);
  declare(name, {out.type, {}});
}

}  // namespace ninebit::code
