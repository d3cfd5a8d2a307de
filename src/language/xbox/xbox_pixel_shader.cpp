#include "ninebit/language/xbox_pixel_shader.h"

#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_fields.h"
#include "src/language/xbox/xbox_numbers.h"
#include "src/language/xbox/xbox_parser.h"

namespace ninebit {
namespace xbox {
namespace {

using code::Token;

bool names_the_struct(std::string_view name) {
  return detail::lower_case(name.substr(0, 64)).find("pixelshaderdef") != std::string::npos;
}

// Whether a text in C begins with a definition: with a struct of this name, a member of it, or a brace that is not
// JSON's.
bool begins_with_definition(std::string_view text) {
  constexpr int kTokens = 64;
  code::TokenReader lexer(text, true);
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

Definition read(const SourceText& source, detail::SourceFaults& faults, detail::SourceFaults& notes) {
  if (is_binary(source.text)) return read_bytes(source.text, faults);
  if (is_number_list(source.text)) return read_number_list(source.text, faults);
  if (is_number_array(source.text)) return read_array(source, faults);
  Parser parser(source, faults);
  Definition definition = parser.parse();
  const auto& positional = parser.positional();
  if (positional && positional->words > 1 && positional->words < kXboxDefinitionWords) {
    notes.add(positional->offset, "the first " + std::to_string(positional->words) + " of " +
                                      std::to_string(kXboxDefinitionWords) + " words are given; the others are 0");
  }
  for (const auto& [function, offset] : parser.calls()) {
    notes.add(offset, "the call of " + function + " is skipped");
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
  detail::SourceFaults faults(source), notes(source);
  if (detail::too_long(source, faults)) return faults.take();
  const xbox::Definition definition = xbox::read(source, faults, notes);
  if (!faults.empty()) return {faults.take(), notes.take()};
  Parsed<CombinerState> program = xbox::program_of_definition(definition, source, profile, other_words);
  const std::vector<TextFault> said = notes.take();
  program.notes.insert(program.notes.begin(), said.begin(), said.end());
  return program;
}

}  // namespace ninebit
