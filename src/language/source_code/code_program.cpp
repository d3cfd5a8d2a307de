// A source parsed for execution; which of its parts set combiners.
#include <algorithm>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {
namespace {

// The names that functions may change: assigned to, alone or a part of them; or given away by address, as arrays are.
void find_assigned(Program& program) {
  const std::vector<Token>& tokens = program.file.tokens;
  const auto is_step = [](const Token& token) { return token.is("++") || token.is("--"); };
  for (const Function& function : program.outline.functions) {
    std::vector<std::size_t> calls;  // the tokens before the parentheses that are open
    for (std::size_t i = function.first; i < function.last; ++i) {
      if (tokens[i].is("(")) calls.push_back(i - 1);
      if (tokens[i].is(")") && !calls.empty()) calls.pop_back();
      if (!tokens[i].is_name()) continue;
      const Token &before = tokens[i - 1], &operand = tokens[i - 2];
      std::size_t next = i + 1;
      while (next < function.last && (tokens[next].is("[") || tokens[next].is(".") || tokens[next].is("->"))) {
        next = tokens[next].is("[") ? program.file.closing[next] + std::size_t{1} : next + 2;
      }
      const bool changed =
          is_step(before) || (next < function.last && (is_step(tokens[next]) || is_assignment(tokens[next])));
      const bool address = before.is("&") && !operand.is_name() && operand.kind != Token::Kind::number &&
                           !operand.is(")") && !operand.is("]");
      const auto global = program.globals.find(std::string(tokens[i].text));
      const bool is_array = global != program.globals.end() && !global->second->type->is(TypeKind::number) &&
                            !global->second->type->is(TypeKind::pointer);
      const bool to_gl =
          !calls.empty() && tokens[calls.back()].is_name() && names_gl_function(tokens[calls.back()].text);
      const bool given = (address || (is_array && next == i + 1)) && !to_gl;
      if (changed || given) program.assigned.insert(tokens[i].text);
    }
  }
}

// Whether an argument of glEnable is one of the combiners' capabilities.
bool names_capability(const Expression& e) {
  for (const std::string_view part : {"REGISTER_COMBINERS", "PER_STAGE_CONSTANTS", "register_combiners",
                                      "RegisterCombiners", "PerStageConstants", "TEXTURE_SHADER_NV"}) {
    if (e.text.find(part) != std::string_view::npos) return true;
  }
  if (e.kind == ExpressionKind::cast || e.kind == ExpressionKind::member) {
    return std::any_of(e.parts.begin(), e.parts.end(), names_capability);
  }
  return e.kind == ExpressionKind::number;
}

}  // namespace

Program::Program(const SourceText& text, const SourceSelection& selection, detail::SourceFaults& faults,
                 detail::SourceFaults& notes)
    : source(text) {
  file.reads_stages = names_stages(text.text);
  read_file(file, text, selection, faults, notes);
  parser = std::make_unique<Parser>(file, outline);
  parser->read_outline();
  for (const Function& function : outline.functions) by_name[function.own_name].push_back(&function);
  for (const Function& function : outline.prototypes) prototypes[function.own_name].push_back(&function);
  for (const Statement& statement : outline.globals) {
    for (const Declared& one : statement.declared) {
      const std::string name = (one.scope.empty() ? "" : std::string(one.scope) + "::") + std::string(one.name);
      const auto [known, is_new] = globals.try_emplace(name, &one);
      if (!is_new && known->second->value.empty()) known->second = &one;
    }
  }
  find_assigned(*this);
}

const std::vector<Statement>& Program::body_of(const Function& function) {
  const auto known = bodies.find(&function);
  if (known != bodies.end()) return known->second;
  return bodies.emplace(&function, parser->body(function)).first->second;
}

bool Program::sets(const Function& function) {
  if (file.calls_between(function.begin, function.end)) return true;
  const auto known = may_set.find(&function);
  if (known != may_set.end()) return known->second;
  may_set[&function] = false;  // while it is looked at
  return may_set[&function] = sets(body_of(function));
}

bool Program::sets(const std::vector<Statement>& statements) {
  if (statements.empty()) return false;
  if (const auto known = may_set.find(&statements); known != may_set.end()) return known->second;
  bool found = false;
  const auto look = [&](const std::vector<Expression>& all) {
    for (const Expression& e : all) found = found || sets(e);
  };
  for (const Statement& s : statements) {
    if (found) break;
    look(s.value);
    look(s.step);
    for (const Declared& one : s.declared) look(one.value);
    found = found || (s.kind == StatementKind::unreadable && file.calls_between(s.offset, s.end)) || sets(s.first) ||
            sets(s.body) || sets(s.otherwise);
  }
  may_set.emplace(&statements, found);
  return found;
}

// Whether a call is one of the combiners' own, of texture shaders, or of nvparse; or an assignment to a definition of
// the Xbox.
bool Program::is_setter(const Expression& e) const {
  if (e.kind != ExpressionKind::call) return assigns_word(e);
  const std::string_view name = called_operand(e.parts[0]).text;
  if (name == "nvparse") return true;
  if (file.reads_stages && detail::find_stage_call(name) != nullptr) return file.calls_between(e.offset, e.end);
  const auto* const signature = signature_of(e.parts[0]);
  return signature != nullptr && signature->parameters != "e";
}

bool Program::sets(const Expression& e) {
  if (is_setter(e)) return true;
  if (e.kind == ExpressionKind::call) {
    if (e.parts.size() == 2 && signature_of(e.parts[0]) != nullptr && names_capability(e.parts[1])) return true;
    const Function* const function = function_of(e.parts[0], e.parts.size() - 1, nullptr);
    if (function != nullptr && sets(*function)) return true;
  }
  // A function that is given away may be called.
  if (e.kind == ExpressionKind::name) {
    const auto named = by_name.find(e.text);
    if (named != by_name.end() && named->second.size() == 1 && globals.count(std::string(e.text)) == 0 &&
        file.calls_between(named->second[0]->begin, named->second[0]->end)) {
      return true;
    }
  }
  return std::any_of(e.parts.begin(), e.parts.end(), [&](const Expression& part) { return sets(part); });
}

// That with as many parameters, of the same class; or the only one.
const Function* Program::function_of(const Expression& callee, std::size_t arguments, const Function* inside) const {
  const Expression& named = called_operand(callee);
  if (named.kind != ExpressionKind::name && named.kind != ExpressionKind::member) return nullptr;
  const auto found = by_name.find(named.text);
  if (found == by_name.end()) return nullptr;
  const bool is_member = named.kind == ExpressionKind::member;
  const bool is_self = is_member && named.parts[0].kind == ExpressionKind::name && named.parts[0].text == "this";
  const std::string_view scope = inside != nullptr ? inside->scope : std::string_view();
  const bool is_gls = detail::find_gl_call(named.text) != nullptr;
  std::vector<const Function*> fitting;
  for (const Function* const one : found->second) {
    // A wrapper that has the name of what it calls.
    if (one == inside && (callee.kind != ExpressionKind::name || is_gls)) continue;
    if (!named.qualifier.empty() && !one->scope.empty() && one->scope != named.qualifier) continue;
    if (is_member && one->scope.empty()) continue;
    const std::size_t count = one->parameters.size();
    const bool defaults = count > arguments && !one->parameters[arguments].value.empty();
    if (count == arguments || defaults || one->is_variadic || found->second.size() == 1) fitting.push_back(one);
  }
  const auto of_class = [&](std::string_view wanted) {
    std::vector<const Function*> own;
    std::copy_if(fitting.begin(), fitting.end(), std::back_inserter(own),
                 [&](const Function* one) { return one->scope == wanted; });
    return own;
  };
  if (!is_member || is_self) {
    if (const auto own = of_class(scope); own.size() == 1) return own[0];
    if (const auto free = of_class({}); free.size() == 1 && !is_self) return free[0];
  }
  return fitting.size() == 1 ? fitting[0] : nullptr;
}

}  // namespace ninebit::code
