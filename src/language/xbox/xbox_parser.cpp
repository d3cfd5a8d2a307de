#include "src/language/xbox/xbox_parser.h"

#include <algorithm>

#include "src/language/register_words/register_words_layout.h"
#include "src/system/nearest_name.h"

namespace ninebit::xbox {
namespace {

using code::shown;
using code::Token;

constexpr std::string_view kExpected =
    "a D3DPIXELSHADERDEF: an initializer such as D3DPIXELSHADERDEF psd = {…}, or assignments such as "
    "psd.PSRGBInputs[0] = 0x…";

}  // namespace

Definition Parser::parse() {
  if (at_end()) fault_here(std::string(kExpected));
  while (!at_end() && !faults_.full()) statement();
  const bool any = std::any_of(definition_.offsets.begin(), definition_.offsets.end(),
                               [](const auto& offset) { return offset.has_value(); });
  if (faults_.empty() && !any && !first_initializer_) faults_.add(0, "expected " + std::string(kExpected));
  if (const auto comment = tokens_.unterminated()) faults_.add(*comment, "unterminated comment; expected */");
  return definition_;
}

void Parser::statement() {
  const Token token = tokens_.peek();
  if (token.is("{")) return initializer();
  if (tokens_.takes(";")) return;
  if (token.is("#")) {
    faults_.add(token.offset, "lines of the preprocessor are not read; expected " + std::string(kExpected));
    return tokens_.skip_line();
  }
  if (!token.is_name()) fault_here(std::string(kExpected));
  tokens_.take();
  if (!token.is_name()) {
    skip_statement();
  } else if (clears_memory(token.text) && tokens_.peek().is("(")) {
    clear(token);
  } else if (tokens_.peek().is_name()) {
    declaration();
  } else {
    assignment(token);
  }
}

// After the first word of "static const D3DPIXELSHADERDEF psd = {…};".
void Parser::declaration() {
  while (tokens_.peek().is_name()) tokens_.take();
  if (tokens_.peek().is(";")) return;
  if (!expect("=", "after the name of the definition")) return skip_statement();
  if (tokens_.peek().is("{")) return initializer();
  fault_here("'{' and the words of the definition");
  skip_statement();
}

void Parser::assignment(const Token& first) {
  const std::optional<Target> found = target(first);
  if (found && tokens_.peek().is("(")) {
    if (calls_.size() < kMaxTextFaults) calls_.push_back({std::string(found->member.text.substr(0, 60)), first.offset});
    return skip_call();
  }
  const bool adds_bits = tokens_.peek().is("|=");
  if (!found || (!adds_bits && !expect("=", "after " + std::string(found->member.text)))) return skip_statement();
  if (adds_bits) tokens_.take();
  const Field* const field = member(found->member);
  if (field != nullptr) return assign(*field, *found, adds_bits);
  if (!values_.read()) skip_statement();
}

std::optional<Parser::Target> Parser::target(const Token& first) {
  Target found{{}, first, {}};
  while (true) {
    if (tokens_.peek().is("[")) {
      if (found.index) {
        fault_here("'='");
        return std::nullopt;
      }
      found.index = index();
      if (!found.index) return std::nullopt;
    } else if (tokens_.takes(".") || tokens_.takes("->")) {
      found.object += std::string(found.object.empty() ? "" : ".") + std::string(found.member.text);
      if (found.index) found.object += '[' + std::to_string(*found.index) + ']';
      if (!tokens_.peek().is_name()) {
        fault_here("a member of D3DPIXELSHADERDEF");
        return std::nullopt;
      }
      found.member = tokens_.take();
      found.index.reset();
    } else {
      return found;
    }
  }
}

void Parser::assign(const Field& field, const Target& target, bool adds_bits) {
  check_object(target);
  const std::size_t offset = target.member.offset;
  if (tokens_.peek().is("{") && !target.index && field.count > 1) return elements(field);
  const std::optional<std::uint32_t> value = values_.read();
  if (!value) return skip_statement();
  // As Cxbx prints a definition: an array's size, and all its words after each other.
  if (field.count > 1 && target.index == field.count && tokens_.peek().kind == Token::Kind::number) {
    store(field.first, *value, offset);
    for (std::size_t i = 1; i < field.count; ++i) {
      const std::optional<std::uint32_t> next = values_.read();
      if (!next) return skip_statement();
      store(field.first + i, *next, offset);
    }
  } else if (fits(field, target.index, offset)) {
    store(field.first + target.index.value_or(0), *value, offset, adds_bits);
  }
}

const Field* Parser::member(const Token& name) {
  const Field* const field = find_field(name.text);
  if (field != nullptr) return field;
  const words::FoundSlot word = words::find_slot(name.text, ChipClass::nv20);
  const bool is_register = word.slot || word.fault.find("needs an index") != std::string::npos;
  faults_.add(name.offset, shown(name) + " is not a member of D3DPIXELSHADERDEF" +
                               (is_register ? "; register words are another form: --from words"
                                            : did_you_mean(name.text, field_names())));
  return nullptr;
}

std::optional<std::uint32_t> Parser::index() {
  tokens_.take();
  const std::optional<std::uint32_t> value = values_.read();
  return value && expect("]", "after the index") ? value : std::nullopt;
}

bool Parser::fits(const Field& field, std::optional<std::uint32_t> index, std::size_t offset) {
  const std::string fault = index_fault(field, index);
  if (!fault.empty()) faults_.add(offset, fault);
  return fault.empty();
}

void Parser::store(std::size_t word, std::uint32_t value, std::size_t offset, bool adds_bits) {
  std::optional<std::size_t>& given = definition_.offsets[word];
  if (adds_bits) {
    definition_.words[word] |= value;
  } else if (given) {
    faults_.add(offset, word_name(word) + " was given before, in line " + line_of(*given));
  } else {
    definition_.words[word] = value;
  }
  if (!given) given = offset;
}

void Parser::check_object(const Target& target) {
  if (!first_target_) {
    first_target_ = target;
  } else if (first_target_->object != target.object) {
    const auto called = [](const Target& one) {
      return one.object.empty() ? "no object" : "'" + one.object.substr(0, 40) + "'";
    };
    faults_.add(target.member.offset, "a member of " + called(target) + ", but of " + called(*first_target_) +
                                          " in line " + line_of(first_target_->member.offset) +
                                          "; a text has one definition");
  }
}

bool Parser::expect(std::string_view mark, std::string_view where) {
  if (tokens_.takes(mark)) return true;
  fault_here("'" + std::string(mark) + "' " + std::string(where));
  return false;
}

void Parser::fault_here(const std::string& expected) {
  faults_.add(tokens_.peek().offset, "expected " + expected + "; found " + shown(tokens_.peek()));
}

// A call that sets memory to 0; to anything else is a fault.
void Parser::clear(const Token& name) {
  if (name.text == "memset" || name.text == "XMemSet") {
    code::TokenReader ahead = tokens_;
    constexpr int kFewTokens = 16;
    for (int i = 0; i < kFewTokens && !ahead.peek().is(","); ++i) ahead.take();
    ahead.take();
    const Token& value = ahead.peek();
    if (value.kind != Token::Kind::number || values_.number(value) != 0) {
      faults_.add(value.offset, "expected 0, as " + std::string(name.text) +
                                    " is read only to clear a definition; found " + shown(value));
    }
  }
  skip_call();
}

void Parser::skip_call() {
  int depth = 0;
  do {
    if (at_end()) return fault_here("')'");
    const Token token = tokens_.take();
    if (token.is("(")) ++depth;
    if (token.is(")")) --depth;
  } while (depth > 0);
}

// To the next semicolon or to a name in a further line, where a statement may begin.
void Parser::skip_statement() {
  for (bool is_further = false; !at_end();) {
    is_further = is_further || tokens_.peek().begins_line;
    if (is_further && tokens_.peek().is_name()) return;
    if (tokens_.take().is(";")) return;
  }
}

// To the comma or bracket that ends a word in braces.
void Parser::skip_value() {
  for (int depth = 0; !at_end();) {
    const Token token = tokens_.peek();
    if (depth == 0 && (token.is(",") || token.is("}") || token.is(";"))) return;
    if (token.is("(") || token.is("{")) ++depth;
    if ((token.is(")") || token.is("}")) && depth > 0) --depth;
    tokens_.take();
  }
}

// The words of a definition in braces.

void Parser::initializer() {
  const Token open = tokens_.take();
  if (first_initializer_) {
    faults_.add(open.offset,
                "a second definition; the first is in line " + line_of(*first_initializer_) + ", and a text has one");
  } else {
    first_initializer_ = open.offset;
  }
  Positional found{0, open.offset};
  bool designated = false;
  members(found, designated);
  if (!designated) positional_ = found;
}

// Like C: a member in braces, or its words without braces; after a designator the members behind it.
void Parser::members(Positional& found, bool& designated) {
  for (std::size_t at = 0; !tokens_.peek().is("}"); found.words = std::max(found.words, at)) {
    if (faults_.full()) return;
    if (tokens_.peek().is(".")) {
      designated = true;
      const std::optional<std::size_t> word = designator();
      if (!word) skip_value();
      if (!word && tokens_.takes(",")) continue;
      at = word.value_or(at);
    }
    const Token token = tokens_.peek();
    if (at >= kXboxDefinitionWords && !token.is("}")) {
      faults_.add(token.offset, "a D3DPIXELSHADERDEF has " + std::to_string(kXboxDefinitionWords) +
                                    " words; found more: " + shown(token));
      if (!token.is(";")) tokens_.take();
      return skip_statement();
    }
    if (token.is("{")) {
      const Field& field = field_of(at);
      if (at != field.first) {
        faults_.add(token.offset, "'{' within " + std::string(field.name) + "; expected " + word_name(at));
      }
      elements(field);
      at = field.first + field.count;
    } else if (const auto value = token.is("}") ? std::nullopt : values_.read()) {
      store(at++, *value, token.offset);
    } else if (!token.is("}")) {
      skip_value();
      if (at_end()) return;
      ++at;
    }
    if (!tokens_.takes(",") && !tokens_.peek().is("}")) {
      fault_here("',' or '}' after a word");
      if (!tokens_.peek().is(";")) tokens_.take();
      return skip_statement();
    }
  }
  tokens_.take();
}

// ".PSRGBInputs =" and ".PSRGBInputs[1] =".
std::optional<std::size_t> Parser::designator() {
  tokens_.take();
  if (!tokens_.peek().is_name()) {
    fault_here("a member of D3DPIXELSHADERDEF after '.'");
    return std::nullopt;
  }
  const Token name = tokens_.take();
  std::optional<std::uint32_t> element;
  if (tokens_.peek().is("[")) {
    element = index();
    if (!element) return std::nullopt;
  }
  const Field* const field = member(name);
  if (field == nullptr || !expect("=", "after " + std::string(name.text))) return std::nullopt;
  if (element && !fits(*field, element, name.offset)) return std::nullopt;
  return field->first + element.value_or(0);
}

// "{0x…, [3] = 0x…}" of one member.
void Parser::elements(const Field& field) {
  tokens_.take();
  for (std::uint32_t at = 0; !tokens_.peek().is("}") && !faults_.full();) {
    if (tokens_.peek().is("[")) {
      const std::size_t offset = tokens_.peek().offset;
      const std::optional<std::uint32_t> element = index();
      if (!element || !expect("=", "after the index")) return skip_value();
      if (!fits(field, element, offset)) {
        skip_value();
        tokens_.takes(",");
        continue;
      }
      at = *element;
    }
    const Token token = tokens_.peek();
    if (at >= field.count) {
      faults_.add(token.offset, std::string(field.name) + " has " + std::to_string(field.count) +
                                    (field.count == 1 ? " word" : " words") + "; found more: " + shown(token));
      while (!tokens_.peek().is("}") && !at_end()) {
        skip_value();
        if (tokens_.peek().is(",") || tokens_.peek().is(";")) tokens_.take();
      }
      break;
    }
    if (const auto value = values_.read()) {
      store(field.first + at, *value, token.offset);
    } else {
      skip_value();
      if (at_end()) return;
    }
    ++at;
    if (!tokens_.takes(",") && !tokens_.peek().is("}")) {
      return fault_here("',' or '}' after a word of " + std::string(field.name));
    }
  }
  tokens_.take();
}

}  // namespace ninebit::xbox
