#include "src/language/xbox/xbox_parser.h"

#include <algorithm>

#include "src/language/register_words/register_words_layout.h"
#include "src/system/nearest_name.h"

namespace ninebit::xbox {
namespace {

constexpr std::string_view kExpected =
    "a D3DPIXELSHADERDEF: an initializer such as D3DPIXELSHADERDEF psd = {…}, or assignments such as "
    "psd.PSRGBInputs[0] = 0x…";

}  // namespace

Definition Parser::parse() {
  if (lexer_.peek().kind == Token::Kind::end) fault_here(std::string(kExpected));
  while (lexer_.peek().kind != Token::Kind::end && !faults_.full()) statement();
  const bool any = std::any_of(definition_.places.begin(), definition_.places.end(),
                               [](const std::optional<TextPlace>& place) { return place.has_value(); });
  if (faults_.empty() && !any && !first_initializer_) faults_.add({}, "expected " + std::string(kExpected));
  if (const auto place = lexer_.unterminated()) faults_.add(*place, "unterminated comment; expected */");
  return definition_;
}

void Parser::statement() {
  const Token token = lexer_.peek();
  if (token.is(";")) {
    (void)lexer_.take();
  } else if (token.is("{")) {
    initializer();
  } else if (token.is("#")) {
    faults_.add(token.place, "lines of the preprocessor are not read; expected " + std::string(kExpected));
    lexer_.skip_line();
  } else if (!token.is_name()) {
    fault_here(std::string(kExpected));
    (void)lexer_.take();
    skip_statement(token.place.line);
  } else {
    (void)lexer_.take();
    if (clears_memory(token.text) && lexer_.peek().is("(")) {
      clear(token);
    } else if (lexer_.peek().is_name()) {
      declaration();
    } else {
      assignment(token);
    }
  }
}

// After the first word of "static const D3DPIXELSHADERDEF psd = {…};".
void Parser::declaration() {
  const int line = lexer_.peek().place.line;
  while (lexer_.peek().is_name()) (void)lexer_.take();
  if (lexer_.peek().is(";")) return;
  if (!expect("=", "after the name of the definition")) return skip_statement(line);
  if (!lexer_.peek().is("{")) {
    fault_here("'{' and the words of the definition");
    return skip_statement(line);
  }
  initializer();
}

void Parser::assignment(const Token& first) {
  const std::optional<Target> found = target(first);
  if (found && lexer_.peek().is("(")) {
    if (calls_.size() < kMaxTextFaults) calls_.push_back({std::string(found->member.text.substr(0, 60)), first.place});
    return skip_call();
  }
  const bool adds_bits = lexer_.peek().is("|=");
  if (!found || (!adds_bits && !expect("=", "after " + std::string(found->member.text)))) {
    return skip_statement(first.place.line);
  }
  if (adds_bits) (void)lexer_.take();
  const Field* const field = member(found->member);
  if (field != nullptr) return assign(*field, *found, adds_bits);
  if (!values_.read()) skip_statement(first.place.line);
}

std::optional<Parser::Target> Parser::target(const Token& first) {
  Target found{{}, first, {}};
  while (true) {
    if (lexer_.peek().is("[")) {
      if (found.index) {
        fault_here("'='");
        return std::nullopt;
      }
      found.index = index();
      if (!found.index) return std::nullopt;
    } else if (lexer_.peek().is(".") || lexer_.peek().is("->")) {
      found.object += std::string(found.object.empty() ? "" : ".") + std::string(found.member.text);
      if (found.index) found.object += '[' + std::to_string(*found.index) + ']';
      (void)lexer_.take();
      if (!lexer_.peek().is_name()) {
        fault_here("a member of D3DPIXELSHADERDEF");
        return std::nullopt;
      }
      found.member = lexer_.take();
      found.index.reset();
    } else {
      return found;
    }
  }
}

void Parser::assign(const Field& field, const Target& target, bool adds_bits) {
  check_object(target);
  const TextPlace place = target.member.place;
  if (lexer_.peek().is("{") && !target.index && field.count > 1) return elements(field);
  const std::optional<std::uint32_t> value = values_.read();
  if (!value) return skip_statement(place.line);
  if (field.count > 1 && target.index == field.count && lexer_.peek().kind == Token::Kind::number) {
    return all_elements(field, *value, place);
  }
  if (const std::string fault = index_fault(field, target.index); !fault.empty()) {
    faults_.add(place, fault);
  } else {
    store(field.first + target.index.value_or(0), *value, place, adds_bits);
  }
}

// As Cxbx prints a definition: an array's size, and all its words after each other.
void Parser::all_elements(const Field& field, std::uint32_t first, TextPlace place) {
  store(field.first, first, place);
  for (std::size_t i = 1; i < field.count; ++i) {
    const std::optional<std::uint32_t> value = values_.read();
    if (!value) return skip_statement(place.line);
    store(field.first + i, *value, place);
  }
}

const Field* Parser::member(const Token& name) {
  const Field* const field = find_field(name.text);
  if (field != nullptr) return field;
  const words::FoundSlot word = words::find_slot(name.text, ChipClass::nv20);
  const bool is_register = word.slot || word.fault.find("needs an index") != std::string::npos;
  faults_.add(name.place, shown(name) + " is not a member of D3DPIXELSHADERDEF" +
                              (is_register ? "; register words are another form: --from words"
                                           : did_you_mean(name.text, field_names())));
  return nullptr;
}

std::optional<std::uint32_t> Parser::index() {
  (void)lexer_.take();
  const std::optional<std::uint32_t> value = values_.read();
  if (!value || !expect("]", "after the index")) return std::nullopt;
  return value;
}

bool Parser::fits(const Field& field, std::uint32_t index, TextPlace place) {
  const std::string fault = index_fault(field, index);
  if (!fault.empty()) faults_.add(place, fault);
  return fault.empty();
}

void Parser::store(std::size_t word, std::uint32_t value, TextPlace place, bool adds_bits) {
  std::optional<TextPlace>& given = definition_.places[word];
  if (adds_bits) {
    definition_.words[word] |= value;
  } else if (given) {
    faults_.add(place, word_name(word) + " was given before, in line " + std::to_string(given->line));
  } else {
    definition_.words[word] = value;
  }
  if (!given) given = place;
}

void Parser::check_object(const Target& target) {
  if (!first_target_) {
    first_target_ = target;
  } else if (first_target_->object != target.object) {
    const auto called = [](const Target& one) {
      return one.object.empty() ? "no object" : "'" + one.object.substr(0, 40) + "'";
    };
    faults_.add(target.member.place, "a member of " + called(target) + ", but of " + called(*first_target_) +
                                         " in line " + std::to_string(first_target_->member.place.line) +
                                         "; a text has one definition");
  }
}

bool Parser::expect(std::string_view mark, std::string_view where) {
  if (lexer_.peek().is(mark)) {
    (void)lexer_.take();
    return true;
  }
  fault_here("'" + std::string(mark) + "' " + std::string(where));
  return false;
}

void Parser::fault_here(const std::string& expected) {
  faults_.add(lexer_.peek().place, "expected " + expected + "; found " + shown(lexer_.peek()));
}

// A call that sets memory to 0; to anything else is a fault.
void Parser::clear(const Token& name) {
  if (name.text == "memset" || name.text == "XMemSet") {
    Lexer ahead = lexer_;
    constexpr int kFewTokens = 16;
    for (int i = 0; i < kFewTokens && !ahead.peek().is(","); ++i) (void)ahead.take();
    (void)ahead.take();
    const Token& value = ahead.peek();
    if (value.kind != Token::Kind::number || values_.number(value) != 0) {
      faults_.add(value.place, "expected 0, as " + std::string(name.text) +
                                   " is read only to clear a definition; found " + shown(value));
    }
  }
  skip_call();
}

void Parser::skip_call() {
  int depth = 0;
  do {
    const Token token = lexer_.peek();
    if (token.kind == Token::Kind::end) return fault_here("')'");
    if (token.is("(")) ++depth;
    if (token.is(")")) --depth;
    (void)lexer_.take();
  } while (depth > 0);
}

// To the next semicolon or to a name at a later line, where a statement may begin.
void Parser::skip_statement(int line) {
  while (lexer_.peek().kind != Token::Kind::end) {
    const Token token = lexer_.peek();
    if (token.is_name() && token.place.line > line) return;
    (void)lexer_.take();
    if (token.is(";")) return;
  }
}

// To the comma or bracket that ends a word in braces.
void Parser::skip_value() {
  int depth = 0;
  while (lexer_.peek().kind != Token::Kind::end) {
    const Token token = lexer_.peek();
    if (depth == 0 && (token.is(",") || token.is("}") || token.is(";"))) return;
    if (token.is("(") || token.is("{")) ++depth;
    if ((token.is(")") || token.is("}")) && depth > 0) --depth;
    (void)lexer_.take();
  }
}

// The words of a definition in braces.

void Parser::initializer() {
  const Token open = lexer_.take();
  if (first_initializer_) {
    faults_.add(open.place, "a second definition; the first is in line " + std::to_string(first_initializer_->line) +
                                ", and a text has one");
  } else {
    first_initializer_ = open.place;
  }
  Positional found{0, open.place};
  bool designated = false;
  members(found, designated);
  if (!designated) positional_ = found;
}

// Like C: a member in braces, or its words without braces; after a designator the members behind it.
void Parser::members(Positional& found, bool& designated) {
  for (std::size_t at = 0; !lexer_.peek().is("}"); found.words = std::max(found.words, at)) {
    if (faults_.full()) return;
    if (lexer_.peek().is(".")) {
      designated = true;
      const std::optional<std::size_t> word = designator();
      if (!word) {
        skip_value();
      } else {
        at = *word;
      }
      if (!word && lexer_.peek().is(",")) {
        (void)lexer_.take();
        continue;
      }
    }
    const Token token = lexer_.peek();
    if (at >= kXboxDefinitionWords && !token.is("}")) {
      faults_.add(token.place, "a D3DPIXELSHADERDEF has " + std::to_string(kXboxDefinitionWords) +
                                   " words; found more: " + shown(token));
      skip_statement(token.place.line);
      return;
    }
    if (token.is("{")) {
      const Field& field = field_of(at);
      if (at != field.first) {
        faults_.add(token.place, "'{' within " + std::string(field.name) + "; expected " + word_name(at));
      }
      elements(field);
      at = field.first + field.count;
    } else if (const auto value = token.is("}") ? std::nullopt : values_.read()) {
      store(at++, *value, token.place);
    } else if (!token.is("}")) {
      skip_value();
      if (lexer_.peek().kind == Token::Kind::end) return;
      ++at;
    }
    if (lexer_.peek().is(",")) {
      (void)lexer_.take();
    } else if (!lexer_.peek().is("}")) {
      fault_here("',' or '}' after a word");
      return skip_statement(lexer_.peek().place.line);
    }
  }
  (void)lexer_.take();
}

// ".PSRGBInputs =" and ".PSRGBInputs[1] =".
std::optional<std::size_t> Parser::designator() {
  (void)lexer_.take();
  if (!lexer_.peek().is_name()) {
    fault_here("a member of D3DPIXELSHADERDEF after '.'");
    return std::nullopt;
  }
  const Token name = lexer_.take();
  std::optional<std::uint32_t> element;
  if (lexer_.peek().is("[")) {
    element = index();
    if (!element) return std::nullopt;
  }
  const Field* const field = member(name);
  if (field == nullptr || !expect("=", "after " + std::string(name.text))) return std::nullopt;
  if (element && !fits(*field, *element, name.place)) return std::nullopt;
  return field->first + element.value_or(0);
}

// "{0x…, [3] = 0x…}" of one member.
void Parser::elements(const Field& field) {
  (void)lexer_.take();
  for (std::uint32_t at = 0; !lexer_.peek().is("}") && !faults_.full();) {
    if (lexer_.peek().is("[")) {
      const TextPlace place = lexer_.peek().place;
      const std::optional<std::uint32_t> element = index();
      if (!element || !expect("=", "after the index")) return skip_value();
      if (!fits(field, *element, place)) {
        skip_value();
        if (lexer_.peek().is(",")) (void)lexer_.take();
        continue;
      }
      at = *element;
    }
    const Token token = lexer_.peek();
    if (at >= field.count) {
      faults_.add(token.place, std::string(field.name) + " has " + std::to_string(field.count) +
                                   (field.count == 1 ? " word" : " words") + "; found more: " + shown(token));
      while (!lexer_.peek().is("}") && lexer_.peek().kind != Token::Kind::end) {
        skip_value();
        if (lexer_.peek().is(",") || lexer_.peek().is(";")) (void)lexer_.take();
      }
      break;
    }
    if (const auto value = values_.read()) {
      store(field.first + at, *value, token.place);
    } else {
      skip_value();
      if (lexer_.peek().kind == Token::Kind::end) return;
    }
    ++at;
    if (lexer_.peek().is(",")) {
      (void)lexer_.take();
    } else if (!lexer_.peek().is("}")) {
      return fault_here("',' or '}' after a word of " + std::string(field.name));
    }
  }
  (void)lexer_.take();
}

}  // namespace ninebit::xbox
