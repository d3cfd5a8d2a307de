// What is no longer known after a part that is not executed.
#include <utility>

#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {

// Variables that the statements assign to are no longer known.
void Machine::forget(const std::vector<Statement>& statements, const Value& why) {
  for (const Statement& s : statements) {
    for (const Expression& e : s.value) forget(e, why);
    for (const Expression& e : s.step) forget(e, why);
    for (const Declared& one : s.declared) {
      for (const Expression& e : one.value) forget(e, why);
    }
    forget(s.first, why);
    forget(s.body, why);
    forget(s.otherwise, why);
  }
}

void Machine::forget(const Expression& e, const Value& why) {
  if (!spend()) return;
  const bool steps = e.kind == ExpressionKind::unary && (e.text.ends_with("++") || e.text.ends_with("--"));
  if (e.kind == ExpressionKind::assignment || steps) {
    const std::string path = path_of(e.parts[0]);
    Value lost = unknown_of(why, why);
    if (lost.needs.empty()) lost = needed_value(path);
    if (Value* const known = place(e.parts[0])) {
      *known = std::move(lost);
    } else if (!frames_.empty() && defined(path) == nullptr) {
      frames_.back().values[path] = std::move(lost);
    }
  }
  if (e.kind == ExpressionKind::call) forget_arguments(e);
  for (const Expression& part : e.parts) forget(part, why);
}

// A function that is not in the file may change what it is given by address: arrays, and what has & before it. Those of
// OpenGL do not, unless they get something.
void Machine::forget_arguments(const Expression& call) {
  const Expression& callee = call.parts[0];
  const bool is_gls = callee.text.find("gl") != std::string_view::npos &&
                      callee.text.find("Get") == std::string_view::npos &&
                      callee.text.find("Gen") == std::string_view::npos;
  const bool prints = lower_case(callee.text).find("print") != std::string::npos;
  if (is_gls || prints || function_of(callee, call.parts.size() - 1) != nullptr) return;
  for (std::size_t i = 1; i < call.parts.size(); ++i) {
    const Expression& argument = call.parts[i];
    const bool address = argument.kind == ExpressionKind::unary && argument.text == "&";
    const Expression& target = address ? argument.parts[0] : argument;
    if (target.kind != ExpressionKind::name && target.kind != ExpressionKind::index &&
        target.kind != ExpressionKind::member) {
      continue;
    }
    // &array[0] is the array.
    const bool element = address && target.kind == ExpressionKind::index;
    const Expression& whole = element ? target.parts[0] : target;
    Value* const known = place(whole);
    if (known == nullptr || (!address && known->kind != Value::Kind::list)) continue;
    const auto global = program_.globals.find(path_of(whole));
    if (global != program_.globals.end() && global->second->is_constant) continue;
    *known = needed_value(path_of(whole));
  }
}

}  // namespace ninebit::code
