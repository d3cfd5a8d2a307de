#include "src/language/pixel_shader/shader_macros.h"

#include <algorithm>
#include <utility>

#include "src/language/c_like/c_lexer.h"
#include "src/language/c_like/c_preprocessor.h"
#include "src/system/lines.h"

namespace ninebit::detail {
namespace {

bool begins_with(std::string_view text, std::string_view lower_word) {
  return text.size() >= lower_word.size() &&
         std::equal(lower_word.begin(), lower_word.end(), text.begin(), [](char a, char b) { return a == lower(b); });
}

// The text as C has it, byte for byte: without comments, with the preprocessor's words in lower case, and with lines
// joined that a backslash and blanks end.
class PlainShader {
 public:
  PlainShader(std::string_view text, SourceFaults& faults) : out_(text), faults_(faults) {
    bool is_directive = false, line_begins = true;
    for (at_ = mark_size(text); at_ < out_.size();) {
      const char c = out_[at_];
      if (c == '\n') {
        line_begins = true;
        is_directive = false;
        ++at_;
      } else if (c == '\0') {
        out_[at_++] = ' ';
      } else if (is_blank(c)) {
        ++at_;
      } else if (!comment() && !continuation()) {
        is_directive = is_directive || (line_begins && c == '#');
        line_begins = false;
        word(is_directive);
      }
    }
  }

  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  void clear_to(std::size_t end) {
    for (; at_ < end; ++at_) {
      if (out_[at_] != '\n') out_[at_] = ' ';
    }
  }

  bool comment() {
    const std::string_view rest = std::string_view(out_).substr(at_);
    if (rest.front() == ';' || rest.starts_with("//")) {
      clear_to(std::min(out_.find('\n', at_), out_.size()));
    } else if (rest.starts_with("/*")) {
      const std::size_t end = out_.find("*/", at_ + 2);
      if (end == std::string::npos) faults_.add(at_, "unterminated comment; expected */");
      for (std::size_t i = at_; i < std::min(end, out_.size()); ++i) {
        if (out_[i] == '\n') out_[i] = ' ';  // a comment does not end a line
      }
      clear_to(end == std::string::npos ? out_.size() : end + 2);
    } else {
      return false;
    }
    return true;
  }

  // A backslash, if nothing but blanks stands between it and the end of its line.
  bool continuation() {
    if (out_[at_] != '\\') return false;
    std::size_t end = at_ + 1;
    while (end < out_.size() && out_[end] != '\n' && is_blank(out_[end])) ++end;
    if (end == out_.size() || out_[end] != '\n') return false;
    clear_to(end);
    out_[at_++] = ' ';
    return true;
  }

  void word(bool is_directive) {
    std::size_t end = at_;
    while (end < out_.size() && is_word(out_[end])) ++end;
    const auto begin = out_.begin() + static_cast<std::ptrdiff_t>(at_);
    const std::size_t before = at_ > 0 ? out_.find_last_not_of(" \t", at_ - 1) : std::string::npos;
    const bool follows_hash = is_directive && before != std::string::npos && out_[before] == '#';
    const bool is_operator = is_directive && lower_case(std::string_view(out_).substr(at_, end - at_)) == "defined";
    if (follows_hash || is_operator) {
      std::transform(begin, begin + static_cast<std::ptrdiff_t>(end - at_), begin, lower);
    }
    at_ = std::max(end, at_ + 1);
  }

  std::string out_;
  SourceFaults& faults_;
  std::size_t at_ = 0;
};

class ShaderReader {
 public:
  ShaderReader(std::string_view text, const std::vector<Definition>& definitions, const SourceInclude& include,
               SourceFaults& faults, SourceFaults& notes)
      : include_(include), faults_(faults), notes_(notes), macros_(std::make_shared<code::Macros>()) {
    auto plain = std::make_shared<std::string>(PlainShader(text, faults).take());
    text_ = *plain;
    out_.written = std::move(plain);
    out_.macros = macros_;
    for (const Definition& one : definitions) {
      SourceFaults wrong({one.value, {}});
      code::Lexer lexer(macros_->kept.emplace_back(PlainShader(one.value, wrong).take()));
      for (const TextFault& fault : wrong.take()) {
        faults_.add(0, "the definition of " + quoted(one.name) + ": " + fault.message);
      }
      code::Macro macro{.is_given = true};
      for (auto token = lexer.next(); token.kind != code::Token::Kind::end; token = lexer.next()) {
        macro.body.push_back(token);
      }
      macros_->all.insert_or_assign(one.name, std::move(macro));
    }
  }

  ShaderTokens run() {
    code::Preprocessor preprocessor(text_, *macros_, options());
    std::size_t end = 0;  // of the text that was read
    auto token = preprocessor.take();
    for (; token.kind != code::Token::Kind::end && !faults_.full(); token = preprocessor.take()) {
      if (!token.is_made && token.offset < end) continue;  // a part of a version
      const std::size_t line_end =
          token.offset > end ? text_.substr(end, token.offset - end).find('\n') : std::string_view::npos;
      if (line_end != std::string_view::npos) {
        out_.tokens.push_back({ShaderToken::Kind::end_of_line, end + line_end, {}});
      } else if (token.is_made && token.begins_line) {  // of an included file
        out_.tokens.push_back({ShaderToken::Kind::end_of_line, token.offset, {}});
      }
      add(token);
      end = std::max<std::size_t>(end, token.is_made ? token.end : token.offset + length_);
      if (out_.tokens.size() > kMostShaderTokens) break;
    }
    if (preprocessor.too_many() || out_.tokens.size() > kMostShaderTokens) {
      faults_.add(token.offset, "the text is longer than " + std::to_string(kMostShaderTokens) + " words");
    }
    preprocessor.finish();
    const std::size_t last = text_.size();
    out_.tokens.push_back({ShaderToken::Kind::end_of_line, last, {}});
    out_.tokens.push_back({ShaderToken::Kind::end, last, {}});
    for (const auto& [name, macro] : macros_->all) {
      if (macro.is_given && macro.is_used) out_.used.emplace(name);
    }
    return std::move(out_);
  }

 private:
  code::PreprocessorOptions options() {
    code::PreprocessorOptions options;
    options.fault = options.endless = [this](const code::Token& at, const std::string& message) {
      faults_.add(at.offset, message);
    };
    options.reads = [this](const code::Token& directive, const std::vector<code::Token>& line,
                           const code::Answer& answer) { return reads(directive, line, answer); };
    if (include_) options.include = [this](std::string_view name) { return included(name); };
    options.skipped = [this](const code::Token& directive, const std::string& name) {
      const std::string file = name.empty() ? "a file" : quoted(name);
      out_.includes = true;
      if (include_ && name.starts_with('"')) {
        faults_.add(hash_of(directive),
                    file + " was not read; expected a text below the folder of this file, or --allow-outside");
      } else {
        notes_.add(hash_of(directive), "skipped " + file + "; its names are not known");
      }
    };
    return options;
  }

  // The text of an included file as C has it; null: it is not there.
  const std::string* included(std::string_view name) {
    const auto text = include_(name);
    if (!text) return nullptr;
    SourceFaults wrong({.text = *text, .file = name});
    const std::string& plain = macros_->kept.emplace_back(PlainShader(*text, wrong).take());
    for (TextFault& fault : wrong.take()) faults_.add(std::move(fault));
    return &plain;
  }

  // The text of a line's tokens.
  [[nodiscard]] std::string_view between(const std::vector<code::Token>& line) const {
    return line.empty() ? std::string_view() : text_.substr(line.front().offset, line.back().end - line.front().offset);
  }
  [[nodiscard]] std::size_t hash_of(const code::Token& directive) const { return text_.rfind('#', directive.offset); }

  // A name without a value on which a condition depends is a fault, once.
  bool reads(const code::Token& directive, const std::vector<code::Token>& line, const code::Answer& answer) {
    if (!answer.unknown.empty() && asked_.insert(answer.unknown).second) {
      out_.is_whole = false;
      const std::string condition = quoted(between(line));
      // src/playground/read.cpp reads the name from "give it as in --define '".
      faults_.add(hash_of(directive), quoted(answer.unknown) + " is not defined, and #" + std::string(directive.text) +
                                          " " + condition.substr(1, condition.size() - 2) +
                                          " depends on it; give it as in --define '" + answer.unknown +
                                          "=…', or by #define");
    }
    return answer.value;
  }

  void add(const code::Token& token) {
    using From = code::Token::Kind;
    ShaderToken out{ShaderToken::Kind::punctuation, token.offset, token.text};
    const std::size_t version = shader_version_length(token.is_made ? token.text : text_.substr(token.offset));
    if (version > 0) {
      out.kind = ShaderToken::Kind::version;
      if (!token.is_made) out.text = text_.substr(token.offset, version);
    } else if (token.kind == From::name || token.kind == From::number) {
      out.kind = token.kind == From::name ? ShaderToken::Kind::word : ShaderToken::Kind::number;
    } else if (token.kind == From::punctuation && static_cast<unsigned char>(token.text[0]) < 0x80) {
      for (std::size_t i = 0; i + 1 < token.text.size(); ++i) {  // "--" is two signs
        out_.tokens.push_back({out.kind, token.is_made ? token.offset : token.offset + i, token.text.substr(i, 1)});
      }
      if (!token.is_made) out.offset += token.text.size() - 1;
      out.text.remove_prefix(token.text.size() - 1);
      out_.tokens.push_back(out);
      length_ = token.text.size();
      return;
    }
    length_ = out.text.size();
    out_.tokens.push_back(out);
  }

  std::string_view text_;
  const SourceInclude& include_;
  SourceFaults& faults_;
  SourceFaults& notes_;
  std::shared_ptr<code::Macros> macros_;
  ShaderTokens out_;
  std::size_t length_ = 0;       // of the token that was added last
  std::set<std::string> asked_;  // names without a value that were reported
};

}  // namespace

std::size_t shader_version_length(std::string_view text) {
  if (begins_with(text, "!!ps1.")) {
    const std::size_t length = std::string_view("!!PS1.").size();
    return text.size() > length && is_digit(text[length]) ? length + 1 : 0;
  }
  const std::size_t name = begins_with(text, "xps") ? 3 : begins_with(text, "ps") ? 2 : 0;
  if (name == 0 || text.size() < name + 4) return 0;
  const char separator = text[name];
  const bool separated = (separator == '.' || separator == '_') && text[name + 2] == separator;
  if (!separated || !is_digit(text[name + 1]) || !is_word(text[name + 3])) return 0;
  std::size_t length = name + 4;
  while (length < text.size() && is_word(text[length])) ++length;
  return length;
}

ShaderTokens preprocess_shader(std::string_view text, const std::vector<Definition>& definitions,
                               const SourceInclude& include, SourceFaults& faults, SourceFaults& notes) {
  return ShaderReader(text, definitions, include, faults, notes).run();
}

}  // namespace ninebit::detail
