#include "src/language/source_code/code_conditions.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "src/language/source_code/code_file.h"
#include "src/language/source_code/code_lexer.h"
#include "src/language/source_code/code_macros.h"

namespace ninebit::code {
namespace {

constexpr int kMostNestedConditions = 64;

// An expression of #if, by recursive descent. What it cannot read is 0 and not sure.
class ConditionReader {
 public:
  // `used`: the definitions whose values or presence were asked for.
  ConditionReader(const std::vector<Token>& line, const std::vector<Definition>& definitions,
                  const MacroExpander& macros, std::set<std::string, std::less<>>& used)
      : line_(line), definitions_(definitions), macros_(macros), used_(used) {}

  long long any() {
    long long value = all();
    while (takes("||")) {
      const long long right = all();
      value = value != 0 || right != 0 ? 1 : 0;
    }
    return value;
  }
  [[nodiscard]] bool sure() const { return sure_ && at_ == line_.size(); }
  // Whether a name is defined: by a macro, by the caller, or as one of OpenGL's headers.
  bool defined(std::string_view name) {
    if (macros_.is_defined(name) || definition(name) != nullptr || name.starts_with("GL_")) return true;
    sure_ = false;
    return false;
  }

 private:
  long long all() {
    long long value = comparison();
    while (takes("&&")) {
      const long long right = comparison();
      value = value != 0 && right != 0 ? 1 : 0;
    }
    return value;
  }

  long long comparison() {
    const long long left = unary();
    if (takes("==")) return left == unary() ? 1 : 0;
    if (takes("!=")) return left != unary() ? 1 : 0;
    if (takes(">=")) return left >= unary() ? 1 : 0;
    if (takes("<=")) return left <= unary() ? 1 : 0;
    if (takes(">")) return left > unary() ? 1 : 0;
    if (takes("<")) return left < unary() ? 1 : 0;
    return left;
  }

  long long unary() {
    if (at_ >= line_.size() || ++depth_ > kMostNestedConditions) {
      sure_ = false;
      at_ = line_.size();
      return 0;
    }
    if (takes("!")) return unary() == 0 ? 1 : 0;
    if (takes("(")) {
      const long long value = any();
      takes(")");
      return value;
    }
    const Token& token = line_[at_++];
    if (token.is("defined")) {
      const bool parenthesis = takes("(");
      const bool value = at_ < line_.size() && defined(line_[at_++].text);
      if (parenthesis) takes(")");
      return value ? 1 : 0;
    }
    if (token.kind == Token::Kind::number) return number(token.text);
    if (token.is_name()) return named(token.text);
    sure_ = false;
    return 0;
  }

  static long long number(std::string_view text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    long long value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    return value;
  }

  long long named(std::string_view name) {
    if (const Definition* const given = definition(name)) return number(given->value);
    if (const Token* const body = macros_.only_token(name); body != nullptr && body->kind == Token::Kind::number) {
      return number(body->text);
    }
    sure_ = false;
    return 0;
  }

  [[nodiscard]] const Definition* definition(std::string_view name) {
    const auto found =
        std::find_if(definitions_.begin(), definitions_.end(), [&](const Definition& d) { return d.name == name; });
    if (found == definitions_.end()) return nullptr;
    used_.insert(found->name);
    return &*found;
  }

  bool takes(std::string_view what) {
    if (at_ >= line_.size() || !line_[at_].is(what)) return false;
    ++at_;
    return true;
  }

  const std::vector<Token>& line_;
  const std::vector<Definition>& definitions_;
  const MacroExpander& macros_;
  std::set<std::string, std::less<>>& used_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool sure_ = true;
};

bool opens_group(const Token& directive) {
  return directive.is("if") || directive.is("ifdef") || directive.is("ifndef");
}
bool begins_branch(const Token& directive) {
  return directive.is("else") || directive.is("elif");
}

}  // namespace

Conditions::Conditions(File& file, const std::vector<Definition>& definitions, const MacroExpander& macros,
                       detail::SourceFaults& notes)
    : file_(file), definitions_(definitions), macros_(macros), notes_(notes) {
  find_groups();
}

void Conditions::find_groups() {
  std::vector<std::size_t> open;
  Lexer lexer(file_.text, Language::c, 0, file_.text.size());
  for (Token token = lexer.next(); token.kind != Token::Kind::end;) {
    if (!token.is("#") || !token.begins_line) {
      token = lexer.next();
      continue;
    }
    const Token directive = lexer.next();
    if (opens_group(directive)) {
      open.push_back(groups_.size());
      groups_.push_back({{directive.offset}, static_cast<std::uint32_t>(file_.text.size())});
    } else if (begins_branch(directive) && !open.empty()) {
      groups_[open.back()].branches.push_back(directive.offset);
    } else if (directive.is("endif") && !open.empty()) {
      groups_[open.back()].end = directive.offset;
      open.pop_back();
    }
    token = directive.kind == Token::Kind::end ? directive : lexer.next();
  }
}

bool Conditions::has_calls(const Group& group, std::size_t branch) const {
  const std::uint32_t end = branch + 1 < group.branches.size() ? group.branches[branch + 1] : group.end;
  return file_.calls_between(group.branches[branch], end);
}

// Whether no combiners are set outside of a group and of others with the same condition.
bool Conditions::holds_all_calls(const Group& group) const {
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

Conditions::Answer Conditions::answer(const Token& directive, const std::vector<Token>& line) {
  if (directive.is("else")) return {true, true};
  ConditionReader reader(line, definitions_, macros_, file_.used_by_conditions);
  if (directive.is("if") || directive.is("elif")) {
    const bool value = reader.any() != 0;
    return {value, reader.sure()};
  }
  const std::string_view name = line.empty() ? std::string_view() : line[0].text;
  const bool is_known = reader.defined(name);
  return {is_known == directive.is("ifdef"), is_known};
}

// Whether a branch is read, and none before it was.
bool Conditions::chosen(const OpenGroup& open, const Token& directive, const std::vector<Token>& line) {
  const Answer answer = this->answer(directive, line);
  const Group* const group = open.group;
  constexpr std::size_t kMostBranches = 256;
  if (group == nullptr || group->branches.size() > kMostBranches) return answer.value;
  const auto found = std::find(group->branches.begin(), group->branches.end(), directive.offset);
  const auto branch = static_cast<std::size_t>(found - group->branches.begin());
  std::size_t with_calls = 0;
  for (std::size_t i = 0; i < group->branches.size(); ++i) with_calls += has_calls(*group, i) ? std::size_t{1} : 0;
  const bool here = has_calls(*group, branch);
  const std::string condition =
      "#" + std::string(directive.text) +
      (line.empty() ? "" : " " + std::string(file_.text.substr(line[0].offset, line.back().end - line[0].offset)));
  if (!answer.sure && with_calls == 1 && holds_all_calls(*group)) {
    if (here && !answer.value) {
      notes_.add(directive.offset,
                 "read the part of " + condition + " as if it were true: only there are combiners set");
    }
    return here;
  }
  if (here && !answer.value) notes_.add(directive.offset, "skipped calls of combiners: " + condition + " is false");
  return answer.value;
}

bool Conditions::obey(const Token& directive, const std::vector<Token>& line) {
  if (opens_group(directive)) {
    const auto found = std::lower_bound(groups_.begin(), groups_.end(), directive.offset,
                                        [](const Group& g, std::uint32_t at) { return g.branches[0] < at; });
    OpenGroup open{.group = found != groups_.end() && found->branches[0] == directive.offset ? &*found : nullptr,
                   .outer = reads()};
    open.reads = open.outer && chosen(open, directive, line);
    open.taken = open.reads;
    open_.push_back(open);
    return true;
  }
  if (begins_branch(directive)) {
    if (open_.empty()) return true;
    OpenGroup& open = open_.back();
    open.reads = open.outer && !open.taken && chosen(open, directive, line);
    open.taken = open.taken || open.reads;
    return true;
  }
  if (!directive.is("endif")) return false;
  if (!open_.empty()) open_.pop_back();
  return true;
}

}  // namespace ninebit::code
