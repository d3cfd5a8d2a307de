#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "ninebit/language/gl_calls.h"
#include "src/language/gl_calls/gl_calls_arguments.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/foreign_language.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

using code::Token;
using detail::element_type;
using detail::GlArgument;
using detail::GlArgumentReader;
using detail::GlLexer;
using detail::GlSignature;
using detail::quoted;

// Lines of dumps of GL calls, as apitrace and GLIntercept write them: "1235 glCombinerParameteriNV(pname = …)".

struct GlDumpLine {
  std::size_t call = 0;     // where the name of the call begins
  std::string_view name{};  // of the call
  bool sets_combiners = false;
  std::size_t end = 0;  // behind the line; text in quotes may make it longer
};

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

// The first byte from `at` on that is not one of these.
template <class Is>
std::size_t behind(std::string_view text, std::size_t at, const Is& is) {
  while (at < text.size() && is(text[at])) ++at;
  return at;
}

bool begins_line(std::string_view text, std::size_t at) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
    at -= kByteOrderMark.size();
  }
  while (at > 0 && is_space(text[at - 1])) --at;
  return at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
}

// The end of a line. Text in quotes, such as that of a shader, may go on in the next lines.
std::size_t end_of_line(std::string_view text, std::size_t at) {
  for (bool quoted = false; at < text.size() && (quoted || text[at] != '\n'); ++at) {
    if (quoted && text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      quoted = !quoted;
    }
  }
  return std::min(at, text.size());
}

// Whether the arguments of glEnable or glDisable name a capability of the combiners.
bool names_capability(std::string_view arguments) {
  const auto has = [&](std::string_view part) { return arguments.find(part) != std::string_view::npos; };
  return has("REGISTER_COMBINERS") || has("PER_STAGE_CONSTANTS") || has("0x8522") || has("0x8535");
}

// The line of a dump that begins with the call number at this byte; empty: the number does not begin such a line.
std::optional<GlDumpLine> gl_dump_line(std::string_view text, std::size_t number) {
  if (!begins_line(text, number)) return std::nullopt;
  std::size_t at = behind(text, number, detail::is_digit);
  const bool has_colon = at < text.size() && text[at] == ':';
  if (has_colon) ++at;
  const std::size_t blank = at;
  at = behind(text, at, is_space);
  if (at < text.size() && text[at] == '@')
    at = behind(text, behind(text, at + 1, detail::is_digit), is_space);  // a thread
  if (at == blank && !has_colon) return std::nullopt;
  GlDumpLine line{.call = at};
  const std::size_t name_end = behind(text, at, detail::is_word);
  line.name = text.substr(at, name_end - at);
  const std::size_t open = behind(text, name_end, is_space);
  if (line.name.empty() || detail::is_digit(line.name.front()) || text.substr(open, 1) != "(") return std::nullopt;
  line.end = end_of_line(text, open);
  const GlSignature* const call = detail::find_gl_call(line.name);
  const bool switches = call != nullptr && call->parameters == "e";
  line.sets_combiners = call != nullptr && (!switches || names_capability(text.substr(open, line.end - open)));
  return line;
}

// Reads statements and executes each as soon as it is read. A faulty statement is skipped up to its semicolon or the
// next name of a call.
class GlParser {
 public:
  // With `reads_stages`, calls of texture shaders are read, too.
  GlParser(const SourceText& source, const HardwareProfile& profile, bool reads_stages)
      : text_(source.text),
        faults_(source),
        notes_(source),
        lexer_(source.text),
        values_(source, lexer_, faults_),
        context_(profile),
        has_semicolons_(source.text.find(';') != std::string_view::npos),
        reads_stages_(reads_stages) {
    values_.read_stage_names(reads_stages);
  }

  Parsed<CombinerState> parse() {
    while (!lexer_.at_end() && !faults_.full()) {
      dump_end_ = 0;
      if (!statement()) recover();
    }
    if (const auto comment = lexer_.unterminated()) faults_.add(*comment, "unterminated comment; expected */");
    note_skipped();
    if (!faults_.empty()) return {faults_.take(), notes_.take()};
    CombinerState state = context_.state();
    mark_unset_constants(state, context_.constants_set());
    if (!reads_stages_ && context_.texture_shader().enabled) {
      notes_.add(0, "GL_TEXTURE_SHADER_NV is enabled; texture shaders are not for combiners");
    }
    if (reads_stages_ && !context_.texture_shader().enabled && context_.texture_shader() != TextureShaderState{}) {
      notes_.add(0, "texture shaders are set and not enabled by GL_TEXTURE_SHADER_NV: they have no effect");
    }
    return {state, notes_.take()};
  }

  [[nodiscard]] const TextureShaderState& texture_shader() const { return context_.texture_shader(); }

 private:
  // Returns false if the rest of the statement must be skipped.
  bool statement() {
    if (lexer_.takes(";")) return true;
    const Token& token = lexer_.peek();
    if (token.text.starts_with('#')) {
      faults_.add(token.offset, "preprocessor lines are not supported; expected a GL call");
      lexer_.skip_line();
      return true;
    }
    if (token.kind == Token::Kind::number) {
      if (const auto line = gl_dump_line(text_, token.offset)) return dump_line(*line);
    }
    const bool pointer = lexer_.begins_pointer_call();  // (*glEnable)(…)
    if (pointer) {
      lexer_.take();
      lexer_.take();
    }
    if (!token.is_name() && token.text != "::") return values_.expected("a GL call");
    const bool qualified = values_.qualifier();
    if (const GlSignature* const call = called(qualified)) return call_statement(*call, pointer, false);
    if (qualified) return unknown_call(lexer_.take());
    if (lexer_.next_is_call() && lexer_.wraps_call()) return wrapped_call();
    if (token.is("static") || token.is("const") || element_type(token.text)) return declaration();
    return unknown_call(lexer_.take());
  }

  // A call of a dump, which has a number before it. Those that set no combiners are skipped.
  bool dump_line(const GlDumpLine& line) {
    const GlSignature* stage_call = reads_stages_ ? stage_call_of(line) : nullptr;
    if (stage_call != nullptr && stage_call->command == detail::GlCommand::active_texture) {
      beyond_units_ = selects_unit_beyond(stage_call, line);
      if (beyond_units_) stage_call = nullptr;
    } else if (stage_call != nullptr && beyond_units_ && stage_call->command >= detail::GlCommand::tex_env_i) {
      faults_.add(line.call,
                  "the active texture unit is beyond those of profile " + std::string(context_.profile().name));
      lexer_.move_to(line.end);
      return true;
    }
    if (line.sets_combiners || stage_call != nullptr) {
      lexer_.move_to(line.call);
      dump_end_ = line.end;
      return call_statement(stage_call != nullptr ? *stage_call : *detail::find_gl_call(line.name), false, false);
    }
    constexpr std::size_t kMostNames = 6;
    const bool is_new = std::find(skipped_names_.begin(), skipped_names_.end(), line.name) == skipped_names_.end();
    if (skipped_++ == 0) first_skipped_ = line.call;
    if (is_new && skipped_names_.size() <= kMostNames) skipped_names_.push_back(line.name);
    if (skipped_names_.size() > kMostNames) skipped_names_.back() = "…";
    lexer_.move_to(line.end);
    return true;
  }

  // The call of a line of a dump that sets texture shaders; nullptr: it does not. Units are followed where there may be
  // stages; elsewhere enabling them is refused, and the other calls have no effect.
  [[nodiscard]] const GlSignature* stage_call_of(const GlDumpLine& line) const {
    const GlSignature* const call = named_call(line.name);
    const std::string_view text = text_.substr(line.call, line.end - line.call);
    const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
    const bool names_stages = has("TEXTURE_SHADER_NV") || has("0x86de") || has("0x86DE");
    const bool is_unit = call != nullptr && call->command == detail::GlCommand::active_texture;
    if (!context_.profile().texture_shaders) {
      const bool enables = call != nullptr && call->command == detail::GlCommand::enable;
      return enables && names_stages ? call : nullptr;
    }
    return is_unit || names_stages ? call : nullptr;
  }

  // Whether glActiveTexture of a dump selects a unit that the profile does not have, where there can be no stages.
  [[nodiscard]] bool selects_unit_beyond(const GlSignature* call, const GlDumpLine& line) const {
    if (call == nullptr || call->command != detail::GlCommand::active_texture) return false;
    const std::string_view text = text_.substr(line.call, line.end - line.call);
    const int units = std::min(context_.profile().texture_units.value, kTextureStages);
    for (const auto& [word, first, base] : {std::tuple{std::string_view("GL_TEXTURE"), 0, 10}, {"0x", 0x84C0, 16}}) {
      const std::size_t at = text.find(word);
      if (at == std::string_view::npos) continue;
      int unit = 0;
      const char* const begin = text.data() + at + word.size();
      const auto [end, error] = std::from_chars(begin, text.data() + text.size(), unit, base);
      return end != begin && (error != std::errc{} || unit < first || unit >= first + units);
    }
    return false;
  }

  void note_skipped() {
    if (skipped_ == 0) return;
    if (!called_ && faults_.empty()) {
      faults_.add(first_skipped_, "no call of the register combiners was found in this dump");
    }
    std::string names;
    for (const std::string_view name : skipped_names_) names += (names.empty() ? "" : ", ") + std::string(name);
    notes_.add(first_skipped_, "skipped " + std::to_string(skipped_) +
                                   (skipped_ == 1 ? " call that sets" : " calls that set") + " no combiners: " + names);
  }

  // The call that the next name means. With an object before them, enable and disable are GL's.
  const GlSignature* called(bool qualified) {
    const std::string_view name = lexer_.peek().text;
    if (const GlSignature* const call = named_call(name)) return call;
    return qualified ? detail::find_gl_method(name) : nullptr;
  }

  [[nodiscard]] const GlSignature* named_call(std::string_view name) const {
    if (const GlSignature* const call = detail::find_gl_call(name)) return call;
    return reads_stages_ ? detail::find_stage_call(name) : nullptr;
  }

  bool unknown_call(const Token& name) {
    const std::string meant = detail::meant_call(name.text);
    faults_.add(name.offset, (lexer_.peek().is("(") ? quoted(name.text) + " is not a call of the register combiners"
                                                    : "expected a GL call, found " + quoted(name.text)) +
                                 meant);
    return false;
  }

  // CHECK(glEnable(…)), with or without further arguments, or CALL(glEnable)(…).
  bool wrapped_call() {
    lexer_.take();
    lexer_.take();
    const bool qualified = values_.qualifier();
    const GlSignature* const call = called(qualified);
    if (call == nullptr) return values_.expected("a GL call");
    return call_statement(*call, !lexer_.next_is_call(), lexer_.next_is_call());
  }

  // `closes_name`: a parenthesis closes behind the name; `closes_call`: another one behind the arguments.
  bool call_statement(const GlSignature& call, bool closes_name, bool closes_call) {
    const std::size_t offset = lexer_.take().offset;
    called_ = true;
    std::vector<GlArgument> arguments;
    bool good = true;
    if (closes_name && !values_.expect(")")) return false;
    if (!values_.expect("(")) return false;
    while (!lexer_.peek().is(")")) {
      if (!arguments.empty() && !values_.expect(",")) return false;
      GlArgument argument;
      const GlArgumentReader::Read read = values_.argument(argument);
      if (read == GlArgumentReader::Read::broken) return false;
      good = good && read == GlArgumentReader::Read::done;
      // The longest call has ten arguments; the limit only bounds the memory.
      if (arguments.size() < detail::kMostGlValues) arguments.push_back(std::move(argument));
    }
    lexer_.take();
    if (good) detail::execute_gl_call(call, arguments, offset, context_, faults_);
    if (closes_call) {
      while (!lexer_.at_end() && !lexer_.peek().is(")") && !lexer_.peek().is(";")) {
        lexer_.take();
      }
      if (!values_.expect(")")) return false;
    }
    return end_of_statement();
  }

  // [static] [const] TYPE [const] NAME [ [N] ] = { … } {, NAME …};
  bool declaration() {
    while (lexer_.takes("static") || lexer_.takes("const")) {
    }
    const auto element = element_type(lexer_.peek().text);
    if (!element) return values_.expected("GLfloat or GLint");
    lexer_.take();
    while (lexer_.peek().is("const")) lexer_.take();
    while (true) {
      if (!lexer_.peek().is_name()) return values_.expected("the name of an array");
      const Token name = lexer_.take();
      GlArgument array;
      array.element = *element;
      std::optional<std::size_t> size;
      if (!values_.bounds(size) || !values_.expect("=") || !values_.braces(array, size)) return false;
      if (!values_.declare(name.text, std::move(array))) {
        faults_.add(name.offset, quoted(name.text) + " is already declared");
      }
      if (!lexer_.takes(",")) return end_of_statement();
    }
  }

  // If only the semicolon is missing, nothing is skipped. A text without any is of a language without them.
  bool end_of_statement() {
    if (lexer_.takes("=")) {  // what a dump says that the call returned
      lexer_.takes("-");
      lexer_.take();
    }
    if (dump_end_ != 0) return true;
    if (!has_semicolons_ && !lexer_.unterminated()) return true;
    if (!values_.expect(";")) return named_call(lexer_.peek().text) != nullptr;
    return true;
  }

  void recover() {
    if (dump_end_ != 0) return lexer_.move_to(dump_end_);
    while (!lexer_.at_end()) {
      if (lexer_.peek().is_name() && named_call(lexer_.peek().text) != nullptr) return;
      if (lexer_.take().is(";")) return;
    }
  }

  std::string_view text_;
  detail::SourceFaults faults_, notes_;
  GlLexer lexer_;
  GlArgumentReader values_;
  gl::Context context_;
  bool has_semicolons_, reads_stages_;
  bool beyond_units_ = false;  // a dump has selected a unit that the profile does not have
  bool called_ = false;        // a call of the combiners was found
  std::size_t dump_end_ = 0;   // of the line of a dump that is read; else 0
  std::size_t skipped_ = 0, first_skipped_ = 0;
  std::vector<std::string_view> skipped_names_;
};

}  // namespace

Parsed<CombinerState> parse_gl_calls(const SourceText& source, const HardwareProfile& profile,
                                     TextureShaderState* texture_shader) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return faults.take();
  GlParser parser(source, profile, texture_shader != nullptr);
  Parsed<CombinerState> parsed = parser.parse();
  if (parsed) {
    if (texture_shader != nullptr && parser.texture_shader().enabled) *texture_shader = parser.texture_shader();
    return parsed;
  }
  std::string_view language = foreign_language(source.text);
  const auto names = [&](std::string_view part) { return source.text.find(part) != std::string_view::npos; };
  const bool names_combiners =
      names("ombiner") || (texture_shader != nullptr && (names("TEXTURE_SHADER_NV") || names("SHADER_OPERATION_NV")));
  if (language.empty() && !names_combiners) language = foreign_calls(source.text);
  if (language.empty()) return parsed;
  faults.add(0, cannot_run(language));
  return faults.take();
}

}  // namespace ninebit
