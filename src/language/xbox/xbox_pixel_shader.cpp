#include "ninebit/language/xbox_pixel_shader.h"

#include <algorithm>

#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_dump.h"
#include "src/language/xbox/xbox_fields.h"
#include "src/language/xbox/xbox_lexer.h"
#include "src/language/xbox/xbox_numbers.h"
#include "src/language/xbox/xbox_parser.h"

namespace ninebit {
namespace xbox {
namespace {

bool names_the_struct(std::string_view name) {
  std::string upper(name.substr(0, 64));
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return upper.find("PIXELSHADERDEF") != std::string::npos;
}

// Whether a text in C begins with a definition: with a struct of this name, a member of it, or a brace that is not
// JSON's.
bool begins_with_definition(std::string_view text) {
  constexpr int kTokens = 64;
  Lexer lexer(text);
  bool begins = true;  // a statement, or a member of an object
  for (int i = 0; i < kTokens; ++i) {
    const Token token = lexer.take();
    if (token.kind == Token::Kind::end) return false;
    if (token.is("#")) {
      lexer.skip_line();
    } else if (i == 0 && token.is("{")) {
      const Token& next = lexer.peek();
      return next.kind == Token::Kind::number || next.is(".") || next.is("{") || next.is("(") ||
             (next.kind == Token::Kind::name && next.text.starts_with("PS_"));
    } else if (token.is_name() && names_the_struct(token.text)) {
      return true;
    } else if (begins && token.text.starts_with("PS") && !token.text.starts_with("PS_")) {
      // A member, or one that is misspelled.
      return lexer.peek().is("=") || lexer.peek().is("[") || lexer.peek().is("|=");
    }
    begins = token.is(".") || token.is("->") || token.is(";") || token.is("}");
  }
  return false;
}

Definition read(const SourceText& source, TextFaults& faults, std::vector<TextFault>& notes) {
  if (is_binary(source.text)) return read_bytes(source.text, faults);
  if (is_number_list(source.text)) return read_number_list(source.text, faults);
  if (is_number_array(source.text)) return read_array(source.text, faults);
  Parser parser(source.text, faults);
  Definition definition = parser.parse();
  for (const auto& [function, place] : parser.calls()) {
    notes.push_back({std::string(source.file), place.line, place.column, "the call of " + function + " is skipped"});
  }
  const auto& positional = parser.positional();
  if (positional && positional->words > 1 && positional->words < kXboxDefinitionWords) {
    notes.push_back({std::string(source.file), positional->place.line, positional->place.column,
                     "the first " + std::to_string(positional->words) + " of " + std::to_string(kXboxDefinitionWords) +
                         " words are given; the others are 0"});
  }
  return definition;
}

}  // namespace
}  // namespace xbox

bool is_xbox_pixel_shader(std::string_view text) {
  if (xbox::is_binary(text)) return xbox::is_definition_file(text) || text.size() == kXboxDefinitionBytes;
  return xbox::is_number_list(text) || xbox::begins_with_definition(text) || xbox::is_definition_array(text);
}

Parsed<CombinerState> parse_xbox_pixel_shader(const SourceText& source, const HardwareProfile& profile,
                                              std::vector<RegisterWord>* other_words) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  std::vector<TextFault> notes;
  const xbox::Definition definition = xbox::read(source, faults, notes);
  if (!faults.empty()) return {faults.take(), std::move(notes)};
  Parsed<CombinerState> program = xbox::program_of_definition(definition, source.file, profile, other_words);
  program.notes.insert(program.notes.begin(), notes.begin(), notes.end());
  return program;
}

}  // namespace ninebit
