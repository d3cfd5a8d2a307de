// A source parsed for execution; which of its parts set combiners.
#include <algorithm>

#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
namespace {

bool changes(const Token& token) {
  for (const std::string_view op : {"=", ":=", "+=", "-=", "*=", "/=", "|=", "&=", "^=", "%=", "++", "--"}) {
    if (token.is(op)) return true;
  }
  return false;
}

// The names that functions assign to, alone or with an index.
void find_assigned(Program& program) {
  const std::vector<Token>& tokens = program.file.tokens;
  for (const Function& function : program.outline.functions) {
    for (std::size_t i = function.first; i < function.last; ++i) {
      if (!tokens[i].is_name()) continue;
      std::size_t next = i + 1;
      while (next < function.last && tokens[next].is("[")) next = program.file.closing[next] + std::size_t{1};
      const bool before = i > 0 && (tokens[i - 1].is("++") || tokens[i - 1].is("--"));
      if (before || (next < function.last && changes(tokens[next])))
        program.assigned.insert(program.key(tokens[i].text));
    }
  }
}

// Whether an argument of glEnable is one of the combiners' capabilities.
bool names_capability(const Expression& e) {
  for (const std::string_view part :
       {"REGISTER_COMBINERS", "PER_STAGE_CONSTANTS", "register_combiners", "RegisterCombiners"}) {
    if (e.text.find(part) != std::string_view::npos) return true;
  }
  return e.kind == ExpressionKind::number;
}

}  // namespace

Program read_program(const SourceText& source, const std::vector<Definition>& definitions, detail::SourceFaults& faults,
                     detail::SourceFaults& notes) {
  Program program{.source = source, .file = read_file(source, definitions, faults, notes), .outline = {}};
  program.outline =
      program.file.language == Language::pascal ? read_pascal_outline(program.file) : read_outline(program.file);
  return program;
}

void index_program(Program& program) {
  for (const Function& function : program.outline.functions) {
    program.by_name[program.key(function.own_name)].push_back(&function);
  }
  for (const Statement& statement : program.outline.globals) {
    for (const Declared& one : statement.declared) {
      if (!one.value.empty() || one.is_array) program.globals.emplace(program.key(one.name), &one);
    }
  }
  find_assigned(program);
}

const std::vector<Statement>& Machine::body_of(const Function& function) {
  const auto known = program_.bodies.find(&function);
  if (known != program_.bodies.end()) return known->second;
  std::vector<Statement> body;
  if (program_.file.language == Language::pascal) {
    body = read_pascal_body(program_.file, function, program_.outline);
  } else {
    TokenCursor in(program_.file, function.first, function.last);
    StatementParser parser(in, program_.outline);
    while (!in.at_end()) {
      body = parser.statements();
      if (!in.at_end()) in.take();  // a stray brace
    }
  }
  return program_.bodies.emplace(&function, std::move(body)).first->second;
}

bool Machine::may_set(const Function& function) {
  if (program_.file.calls_between(function.begin, function.end)) return true;
  const auto known = program_.sets_combiners.find(&function);
  if (known != program_.sets_combiners.end()) return known->second;
  program_.sets_combiners[&function] = false;  // while it is looked at
  const bool sets = frames_.size() < 24 && may_set(body_of(function));
  program_.sets_combiners[&function] = sets;
  return sets;
}

bool Machine::may_set(const std::vector<Statement>& statements) {
  if (statements.empty()) return false;
  if (const auto known = may_set_.find(&statements); known != may_set_.end()) return known->second;
  const bool sets = std::any_of(statements.begin(), statements.end(), [&](const Statement& s) {
    const auto any = [&](const std::vector<Expression>& all) {
      return std::any_of(all.begin(), all.end(), [&](const Expression& e) { return may_set(e); });
    };
    const bool declares =
        std::any_of(s.declared.begin(), s.declared.end(), [&](const Declared& d) { return any(d.value); });
    const bool unreadable = s.kind == Statement::Kind::unreadable && program_.file.calls_between(s.offset, s.end);
    return any(s.value) || any(s.step) || declares || unreadable || may_set(s.first) || may_set(s.body) ||
           may_set(s.otherwise);
  });
  may_set_.emplace(&statements, sets);
  return sets;
}

bool Machine::may_set(const Expression& e) {
  if (assigns_word(e)) return true;
  if (e.kind == ExpressionKind::call) {
    const auto* const signature = signature_of(e.parts[0], program_.file.language);
    if (signature != nullptr) {
      const bool switches = signature->parameters == "e";
      if (!switches || (e.parts.size() == 2 && names_capability(e.parts[1]))) return true;
    }
    if (called_operand(e.parts[0]).text == "nvparse") return true;
    const Function* const function = function_of(e.parts[0], e.parts.size() - 1);
    if (function != nullptr && may_set(*function)) return true;
  }
  return std::any_of(e.parts.begin(), e.parts.end(), [&](const Expression& part) { return may_set(part); });
}

}  // namespace ninebit::code
