// A source file as tokens, its macros expanded and its conditional parts chosen.
#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>

#include "src/language/c_like/c_preprocessor.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_parser.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::code {
namespace {

// A brace also closes what was left open inside of it; a stray bracket closes nothing. What is never closed ends with
// the file.
std::vector<std::uint32_t> closing_brackets(const std::vector<Token>& tokens) {
  std::vector<std::uint32_t> closing(tokens.size()), open;
  const auto last = static_cast<std::uint32_t>(tokens.size() - 1);
  for (std::uint32_t i = 0; i < tokens.size(); ++i) {
    closing[i] = i;
    if (tokens[i].kind != Token::Kind::punctuation || tokens[i].text.size() != 1) continue;
    const char c = tokens[i].text[0];
    if (c == '(' || c == '[' || c == '{') {
      open.push_back(i);
      closing[i] = last;
    } else if (c == ')' || c == ']' || c == '}') {
      const char opener = c == ')' ? '(' : c == ']' ? '[' : '{';
      while (c == '}' && !open.empty() && tokens[open.back()].text[0] != '{') {
        closing[open.back()] = i == 0 ? 0 : i - 1;
        open.pop_back();
      }
      if (open.empty() || tokens[open.back()].text[0] != opener) continue;
      closing[open.back()] = i;
      open.pop_back();
    }
  }
  return closing;
}

bool opens_group(const Token& directive) {
  return directive.is("if") || directive.is("ifdef") || directive.is("ifndef");
}

// A whole #if … #endif: where it begins, each further branch begins, and it ends.
struct Group {
  std::vector<std::uint32_t> branches{};
  std::uint32_t end = 0;
};

// Which parts of a file are read, where C's answer would leave no combiners.
class Conditions {
 public:
  Conditions(File& file, detail::SourceFaults& notes) : file_(file), notes_(notes) { find_groups(); }

  // Whether a branch is read, and none before it was.
  bool reads(const Token& directive, const std::vector<Token>& line, Answer answer) const {
    const auto of_branch = groups_of_.find(directive.offset);
    if (of_branch == groups_of_.end()) return answer.value;
    const Group* const group = &groups_[of_branch->second];
    constexpr std::size_t kMost = 256;
    if (group->branches.size() > kMost) return answer.value;
    const auto found = std::lower_bound(group->branches.begin(), group->branches.end(), directive.offset);
    std::size_t with_calls = 0;
    for (std::size_t i = 0; i < group->branches.size(); ++i) with_calls += has_calls(*group, i) ? std::size_t{1} : 0;
    const bool here = has_calls(*group, static_cast<std::size_t>(found - group->branches.begin()));
    const std::string condition =
        "#" + std::string(directive.text) +
        (line.empty() ? "" : " " + std::string(file_.text.substr(line[0].offset, line.back().end - line[0].offset)));
    if (!answer.is_sure && with_calls == 1 && holds_all_calls(*group)) {
      if (here && !answer.value) {
        notes_.add(directive.offset,
                   "read the part of " + condition + " as if it were true: only there are combiners set");
      }
      return here;
    }
    if (!answer.unknown.empty() && with_calls > 0) {
      file_.open_conditions.push_back({group->branches[0], group->end, directive.offset, answer.unknown});
    } else if (here && !answer.value) {
      notes_.add(directive.offset, "skipped calls of combiners: " + condition + " is false");
    }
    return answer.value;
  }

 private:
  void find_groups() {
    std::vector<std::size_t> open;
    const std::vector<Token> tokens = tokens_of(file_.text);
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
      if (!tokens[i].is("#") || !tokens[i].begins_line) continue;
      const Token& directive = tokens[i + 1];
      if (opens_group(directive)) {
        groups_of_[directive.offset] = groups_.size();
        open.push_back(groups_.size());
        groups_.push_back({{directive.offset}, static_cast<std::uint32_t>(file_.text.size())});
      } else if ((directive.is("else") || directive.is("elif")) && !open.empty()) {
        groups_of_[directive.offset] = open.back();
        groups_[open.back()].branches.push_back(directive.offset);
      } else if (directive.is("endif") && !open.empty()) {
        groups_[open.back()].end = directive.offset;
        open.pop_back();
      }
    }
  }

  bool has_calls(const Group& group, std::size_t branch) const {
    const std::uint32_t end = branch + 1 < group.branches.size() ? group.branches[branch + 1] : group.end;
    return file_.calls_between(group.branches[branch], end);
  }

  // Whether no combiners are set outside of a group and of others with the same condition.
  bool holds_all_calls(const Group& group) const {
    constexpr std::size_t kMostCalls = 4096;
    if (file_.calls.size() > kMostCalls || groups_.size() > kMostCalls) return false;
    const auto line_of = [&](const Group& one) {
      const std::string_view rest = file_.text.substr(one.branches[0]);
      return rest.substr(0, rest.find('\n'));
    };
    std::size_t inside = 0;
    std::uint32_t end = 0;  // of the group before, as groups inside of groups count once
    for (const Group& one : groups_) {
      if (one.branches[0] < end || line_of(one) != line_of(group)) continue;
      end = one.end;
      const auto first = std::lower_bound(file_.calls.begin(), file_.calls.end(), one.branches[0]);
      inside += static_cast<std::size_t>(std::lower_bound(first, file_.calls.end(), end) - first);
    }
    return inside == file_.calls.size();
  }

  File& file_;
  detail::SourceFaults& notes_;
  std::vector<Group> groups_;                                 // in the order of their first lines
  std::unordered_map<std::uint32_t, std::size_t> groups_of_;  // by the places of their branches
};

// Headers of the time define the names of calls as function pointers; such a macro says nothing.
bool is_pointer_of_call(std::string_view name, const Macro& macro) {
  if (macro.has_parameters || detail::find_gl_call(name) == nullptr) return false;
  return macro.body.size() != 1 || detail::find_gl_call(macro.body[0].text) != nullptr;
}

}  // namespace

bool names_stages(std::string_view text) {
  return text.find("TEXTURE_SHADER") != std::string_view::npos || text.find("0x86DE") != std::string_view::npos ||
         text.find("0x86de") != std::string_view::npos;
}

std::vector<std::uint32_t> calls_of(std::string_view text, bool reads_stages) {
  const std::vector<Token> tokens = tokens_of(text);
  const auto is = [&](std::size_t i, std::initializer_list<std::string_view> words) {
    return i < tokens.size() && std::any_of(words.begin(), words.end(), [&](auto one) { return tokens[i].is(one); });
  };
  const auto is_call = [&](std::size_t i) {
    std::size_t open = i + 1;
    if (is(open, {")"})) ++open;  // (*f)(…)
    if (!is(open, {"("})) return false;
    const std::string_view name = tokens[i].text;
    if (name.find("ombiner") != std::string_view::npos && detail::find_gl_call(name) != nullptr) return true;
    const bool may_set_stage = reads_stages && name.find("TexEnv") != std::string_view::npos;
    if (!may_set_stage || detail::find_stage_call(name) == nullptr) return name == "nvparse";
    // Another target of glTexEnv is an enumerant of its own.
    std::size_t comma = open;
    while (comma + 1 < tokens.size() && !is(comma, {","})) ++comma;
    const std::string_view target = text.substr(tokens[open].end, tokens[comma].offset - tokens[open].end);
    return names_stages(target) || target.find("GL_") == std::string_view::npos;
  };
  const auto is_word = [&](std::size_t i) {
    const bool is_member = i > 1 && is(i - 1, {".", "->"}) && (tokens[i - 2].is_name() || is(i - 2, {")", "]"}));
    if (!is_member || xbox::find_field(tokens[i].text) == nullptr) return false;
    std::size_t next = i + 1;
    if (is(next, {"["})) {
      while (next < tokens.size() && !is(next, {"]"})) ++next;
      ++next;
    }
    return is(next, {"=", "|=", "+="});
  };
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is_name() && (is_call(i) || is_word(i))) found.push_back(tokens[i].offset);
  }
  return found;
}

void read_file(File& file, const SourceText& source, const SourceSelection& selection, detail::SourceFaults& faults,
               detail::SourceFaults& notes) {
  file.text = source.text;
  file.calls = calls_of(source.text, file.reads_stages);
  const Conditions conditions(file, notes);
  file.macros.is_reserved = is_pointer_of_call;
  PreprocessorOptions options;
  options.value_of = [&](std::string_view name) -> std::optional<std::string_view> {
    const auto& all = selection.definitions;
    const auto found = std::find_if(all.rbegin(), all.rend(), [&](const Definition& one) { return one.name == name; });
    // OpenGL's headers define the names of versions and extensions as 1.
    if (found == all.rend()) {
      if (!name.starts_with("GL_")) return std::nullopt;
      const auto known = detail::value_of_name(name);
      return known ? file.macros.kept.emplace_back(std::to_string(*known)) : std::string_view("1");
    }
    file.used_by_conditions.insert(found->name);
    return found->value;
  };
  options.reads = [&](const Token& directive, const std::vector<Token>& line, Answer answer) {
    return conditions.reads(directive, line, answer);
  };
  options.include = [&](std::string_view name) -> const std::string* {
    auto text = selection.include ? selection.include(name) : std::nullopt;
    return text && text->size() <= kMaxSourceBytes ? &file.included.emplace_back(*std::move(text)) : nullptr;
  };
  options.endless = [&](const Token& at, const std::string& message) { faults.add(at.offset, message); };
  Preprocessor preprocessor(source.text, file.macros, std::move(options));
  while (true) {
    Token token = preprocessor.take();
    if (preprocessor.too_many() || file.tokens.size() >= kMostTokens) {
      faults.add(token.offset, "more than " + std::to_string(kMostTokens) + " tokens, macros expanded");
      token = {};
    }
    file.tokens.push_back(token);
    if (token.kind == Token::Kind::end) break;
  }
  file.closing = closing_brackets(file.tokens);
}

bool File::calls_between(std::size_t begin, std::size_t end) const {
  const auto first = std::lower_bound(calls.begin(), calls.end(), begin);
  return first != calls.end() && *first < end;
}

}  // namespace ninebit::code
