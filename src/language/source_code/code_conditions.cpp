#include "src/language/source_code/code_conditions.h"

#include <algorithm>
#include <optional>
#include <string>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/condition.h"
#include "src/language/source_code/code_file.h"
#include "src/language/source_code/code_lexer.h"
#include "src/language/source_code/code_macros.h"

namespace ninebit::code {
namespace {

// The tokens' text, a blank between two.
std::string text_of(const std::vector<Token>& tokens) {
  std::string out;
  for (const Token& token : tokens) out += (out.empty() ? "" : " ") + std::string(token.text);
  return out;
}

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

// A definition of the caller, which is then in use; nullptr: there is none of this name.
const Definition* Conditions::definition(std::string_view name) {
  const auto found =
      std::find_if(definitions_.rbegin(), definitions_.rend(), [&](const Definition& d) { return d.name == name; });
  if (found == definitions_.rend()) return nullptr;
  file_.used_by_conditions.insert(found->name);
  return &*found;
}

// By a macro, by the caller, or as one of OpenGL's headers.
bool Conditions::is_defined(std::string_view name) {
  return macros_.is_defined(name) || definition(name) != nullptr || name.starts_with("GL_");
}

Conditions::Answer Conditions::answer(const Token& directive, const std::vector<Token>& line) {
  if (directive.is("else")) return {true, true};
  if (directive.is("ifdef") || directive.is("ifndef")) {
    const bool known = !line.empty() && is_defined(line[0].text);
    return {known == directive.is("ifdef"), known};
  }
  bool sure = true;
  const auto value = detail::condition_value(
      text_of(line), {.is_defined =
                          [&](std::string_view name) {
                            const bool known = is_defined(name);
                            sure = sure && known;
                            return known;
                          },
                      .body_of = [&](std::string_view name) -> std::optional<std::string> {
                        if (const Definition* const given = definition(name)) return given->value;
                        if (const Macro* const macro = macros_.find(name); macro != nullptr) {
                          return macro->has_parameters ? std::nullopt : std::optional(text_of(macro->body));
                        }
                        // OpenGL's headers define the names of versions and extensions as 1.
                        if (name.starts_with("GL_")) return std::to_string(detail::value_of_name(name).value_or(1));
                        return std::nullopt;
                      }});
  return {value.holds, sure && value.unknown.empty() && value.fault.empty(), value.unknown};
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
  if (!answer.unknown.empty() && with_calls > 0) {
    file_.open_conditions.push_back({group->branches[0], group->end, directive.offset, answer.unknown});
  } else if (here && !answer.value) {
    notes_.add(directive.offset, "skipped calls of combiners: " + condition + " is false");
  }
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
