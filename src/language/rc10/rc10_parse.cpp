#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/language/rc10.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/rc10/rc10_lexer.h"
#include "src/language/rc10/rc10_parser.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/source_faults.h"
#include "src/language/source/string_literals.h"
#include "src/system/lines.h"

namespace ninebit::detail {
namespace {

// The offsets of "!!" and a letter outside of comments.
std::vector<std::size_t> headers_in(std::string_view text) {
  std::vector<std::size_t> found;
  SourceFaults unterminated({text, {}});  // the parser reports that, too
  std::size_t at = 0;
  while (skip_blanks(text, at, {.hash_comments = true, .heading = {}}, unterminated) && at < text.size()) {
    const bool is_header = text.substr(at).starts_with("!!") && at + 2 < text.size() && is_word(text[at + 2]);
    if (is_header) found.push_back(at);
    at += is_header ? 2 : 1;
  }
  return found;
}

std::string_view header_at(std::string_view text) {
  constexpr std::size_t kLongest = 24;
  text = text.substr(0, kLongest);
  const auto is_header = [](char c) { return is_word(c) || c == '.' || c == '!'; };
  return text.substr(0, static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_header) - text.begin()));
}

}  // namespace

std::optional<Rc10Parts> rc10_parts(std::string_view text, bool skips_stages, SourceFaults& faults,
                                    SourceFaults& notes) {
  const std::vector<std::size_t> headers = headers_in(text);
  const auto is_rc10 = [&](std::size_t at) { return text.substr(at).starts_with(kRc10Header); };
  if (headers.empty() || std::all_of(headers.begin(), headers.end(), is_rc10)) return std::nullopt;
  Rc10Parts parts{.rc10 = std::string(text), .ts10 = std::string(text)};
  const auto blank = [](std::string& out, std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t offset) { return out.begin() + static_cast<std::ptrdiff_t>(offset); };
    std::replace_if(
        at(begin), at(end), [](char c) { return c != '\n'; }, ' ');
  };
  blank(parts.ts10, 0, headers[0]);
  for (std::size_t i = 0; i < headers.size() && !faults.full(); ++i) {
    const std::size_t at = headers[i], end = i + 1 < headers.size() ? headers[i + 1] : text.size();
    const bool is_ts10 = !skips_stages && text.substr(at).starts_with(kTs10Header);
    parts.has_rc10 = parts.has_rc10 || is_rc10(at);
    if (!is_rc10(at)) blank(parts.rc10, at, end);
    if (!is_ts10) blank(parts.ts10, at, end);
    if (is_rc10(at)) continue;
    const std::string_view header = header_at(text.substr(at));
    const std::string_view language = language_of_header(header);
    if (is_ts10) {
      if (parts.ts10_at) faults.add(at, "there is a part !!TS1.0 already; expected one");
      parts.ts10_at = at;
    } else if (language.empty()) {
      faults.add(at, "unknown part " + quoted(header) + "; expected !!RC1.0 or !!TS1.0");
    } else {
      notes.add(at, "skipped " + std::string(language) + " (" + std::string(header) + "): it is not for combiners");
    }
  }
  return parts;
}

}  // namespace ninebit::detail

namespace ninebit {
namespace {

using detail::quoted;
using detail::Rc10Constants;
using detail::Rc10Final;
using detail::Rc10Reader;
using detail::Rc10Token;

class Parser {
 public:
  Parser(const SourceText& source, const HardwareProfile& profile)
      : profile_(profile), faults_(source), in_(source.text, profile, faults_) {}

  Parsed<CombinerState> parse() {
    while (in_.lexer.peek().kind != Rc10Token::Kind::end && !faults_.full()) {
      if (!part()) recover();
    }
    final_.finish(in_, state_);
    finish();
    if (faults_.empty()) return state_;
    return faults_.take();
  }

 private:
  enum class Phase { constants, stages, last };

  // Reads one constant, general combiner or statement of the final combiner; false if the rest of it must be skipped.
  bool part() {
    const Rc10Token token = in_.lexer.peek();
    if (token.is("const0") || token.is("const1")) {
      // The Xbox's tools: constants after the general combiners are those of the final combiner.
      if (phase_ == Phase::stages && profile_.per_stage_constants)
        return detail::read_rc10_constant(in_, finals_, "final");
      enter(Phase::constants, token, "constants must come before the general combiners");
      return detail::read_rc10_constant(in_, globals_, "global");
    }
    if (token.is('{')) {
      enter(Phase::stages, token, "general combiners must come before the final combiner");
      stage(token);
      return true;
    }
    if (Rc10Final::begins(token)) {
      enter(Phase::last, token, "");
      return final_.read_statement(in_);
    }
    return in_.expected(phase_ == Phase::last ? "a statement of the final combiner"
                                              : "a constant, a general combiner in braces, or out.rgb or out.a");
  }

  void enter(Phase phase, const Rc10Token& token, const char* fault) {
    if (phase < phase_) {
      faults_.add(token.offset, fault);
    } else {
      phase_ = phase;
    }
  }

  void stage(const Rc10Token& token) {
    if (stages_ == profile_.general_combiners) {
      if (!too_many_) {
        faults_.add(
            token.offset,
            "too many general combiners; profile " + std::string(profile_.name) + " has " + std::to_string(stages_),
            GlError::invalid_value);
      }
      too_many_ = true;
      in_.skip_block();
      return;
    }
    const auto i = static_cast<std::size_t>(stages_++);
    detail::read_rc10_stage(in_, state_.general[i], locals_[i]);
  }

  // A stray closing brace and the braces after it are one fault.
  void recover() {
    if (in_.lexer.peek().is('}')) {
      while (in_.lexer.peek().is('}')) in_.lexer.take();
      return;
    }
    while (in_.lexer.peek().kind != Rc10Token::Kind::end && !in_.lexer.peek().is('{') && !in_.lexer.peek().is('}')) {
      if (in_.lexer.take().is(';')) return;
    }
  }

  void finish() {
    const auto set = [](ColorF& to, const std::optional<ColorF>& color) {
      if (color) to = *color;
    };
    const auto has_any = [](const Rc10Constants& constants) { return constants.color[0] || constants.color[1]; };
    set(state_.constant0, finals_.color[0] ? finals_.color[0] : globals_.color[0]);
    set(state_.constant1, finals_.color[1] ? finals_.color[1] : globals_.color[1]);
    state_.per_stage_constants = has_any(finals_) || std::any_of(locals_.begin(), locals_.end(), has_any);
    for (std::size_t i = 0; state_.per_stage_constants && i < static_cast<std::size_t>(stages_); ++i) {
      GeneralCombiner& stage = state_.general[i];
      set(stage.constant0, locals_[i].color[0] ? locals_[i].color[0] : globals_.color[0]);
      set(stage.constant1, locals_[i].color[1] ? locals_[i].color[1] : globals_.color[1]);
    }
    state_.num_general_combiners = std::max(stages_, 1);
    if (stages_ == 0) detail::clear_rc10_stage(state_.general[0]);
    ByConstant<bool> given{};
    for (std::size_t which = 0; which < 2; ++which) {
      for (std::size_t i = 0; i < locals_.size(); ++i) {
        given[i][which] = locals_[i].color[which].has_value() || globals_.color[which].has_value();
      }
      given[kFinalConstants][which] = finals_.color[which].has_value() || globals_.color[which].has_value();
    }
    mark_unset_constants(state_, given);
  }

  const HardwareProfile& profile_;
  detail::SourceFaults faults_;
  Rc10Reader in_;
  CombinerState state_;
  Rc10Constants globals_, finals_;
  std::array<Rc10Constants, kMaxGeneralCombiners> locals_;
  Rc10Final final_;
  Phase phase_ = Phase::constants;
  int stages_ = 0;
  bool too_many_ = false;
};

bool has_part(std::string_view text, std::string_view header) {
  return text.find(header) != std::string_view::npos;
}

// The text behind blanks and comments.
std::string_view without_blanks(std::string_view text) {
  std::size_t at = mark_size(text);
  detail::SourceFaults none({text, {}});
  return detail::skip_blanks(text, at, {.hash_comments = true, .heading = {}}, none) ? text.substr(at) : text;
}

// The specification requires the header at the very beginning, but real files have comments before it. A missing header
// is a fault.
bool begins_with_header(std::string_view text, detail::SourceFaults& faults) {
  std::size_t at = mark_size(text);
  if (!detail::skip_blanks(text, at, {.hash_comments = true, .heading = {}}, faults)) return false;
  if (text.substr(at).starts_with(detail::kRc10Header)) return true;
  faults.add(at, "expected !!RC1.0 at the beginning; only blanks and comments may come before it");
  return false;
}

}  // namespace

Parsed<CombinerState> parse_rc10(const SourceText& source, const HardwareProfile& profile,
                                 TextureShaderState* texture_shader) {
  detail::SourceFaults faults(source), notes(source);
  if (detail::too_long(source, faults)) return faults.take();
  // As it stands in a source: in string literals.
  const std::size_t quote = find_literal(source.text, "!!");
  const std::size_t header = source.text.find("!!");
  if (quote != std::string_view::npos && quote < header) {
    const LiteralText program(source, quote, end_of_literals(source.text, quote));
    return parse_rc10(program.source(), profile, texture_shader);
  }
  const bool may_be_stages = texture_shader != nullptr && has_part(source.text, detail::kTs10Header);
  if (const std::string_view language = foreign_language(source.text);
      !language.empty() && !may_be_stages && !has_part(source.text, detail::kRc10Header)) {
    faults.add(0, cannot_run(language));
    return faults.take();
  }
  SourceText program = source;
  const auto parts = detail::rc10_parts(source.text, texture_shader == nullptr, faults, notes);
  if (parts) {
    program.text = parts->rc10;
    if (program.written.empty()) program.written = source.text;
  }
  if (!faults.empty()) return {faults.take(), notes.take()};
  TextureShaderState stages;
  if (parts && parts->ts10_at) stages = detail::read_ts10(*parts, profile, faults);
  const bool is_alone = stages.enabled && !parts->has_rc10 && without_blanks(program.text).empty();
  if (is_alone) {
    notes.add(*parts->ts10_at, std::string(detail::kNoRegisterCombiners));
  } else if (!begins_with_header(program.text, faults)) {
    return {faults.take(), notes.take()};
  }
  Parsed<CombinerState> parsed = is_alone ? CombinerState{} : Parser(program, profile).parse();
  if (!parsed) {
    for (const TextFault& fault : parsed.faults()) faults.add(fault);
  }
  if (!faults.empty()) return {faults.take(), notes.take()};
  if (texture_shader != nullptr) *texture_shader = stages;
  parsed.notes = notes.take();
  return parsed;
}

}  // namespace ninebit
