// The words of a definition in braces.
#include <algorithm>

#include "src/language/xbox/xbox_parser.h"

namespace ninebit::xbox {

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
      if (lexer_.peek().kind == TokenKind::end) return;
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
  if (lexer_.peek().kind != TokenKind::name) {
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
      while (!lexer_.peek().is("}") && lexer_.peek().kind != TokenKind::end) {
        skip_value();
        if (lexer_.peek().is(",") || lexer_.peek().is(";")) (void)lexer_.take();
      }
      break;
    }
    if (const auto value = values_.read()) {
      store(field.first + at, *value, token.place);
    } else {
      skip_value();
      if (lexer_.peek().kind == TokenKind::end) return;
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
