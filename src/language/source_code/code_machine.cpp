// Executes statements.
#include "src/language/source_code/code_machine.h"

#include <algorithm>
#include <utility>

#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

// How many statements are executed at most, and how often an endless loop goes round.
constexpr std::size_t kMostSteps = 200'000, kMostRounds = 500;
// The most elements that declarations without values make.
constexpr std::size_t kMostMadeElements = std::size_t{1} << 18;

// Elements that are not known yet are known if `name` is defined.
void name_unknowns(Value& value, const std::string& name) {
  if (!value.is_known() && value.needs.empty()) value.needs.push_back(name);
  for (Value& element : value.list) name_unknowns(element, name);
}

bool ends_function(const std::vector<Statement>& statements) {
  if (statements.empty()) return false;
  const Statement& last = statements.back();
  return last.kind == StatementKind::give_back || (last.kind == StatementKind::block && ends_function(last.body));
}

}  // namespace

bool Machine::spend() {
  if (++steps_ <= kMostSteps) return true;
  out_of_steps_ = true;
  return false;
}

void Machine::run(const Function& function) {
  Frame frame{.function = &function};
  for (const Parameter& parameter : function.parameters) {
    if (parameter.name.empty()) continue;
    Value value = needed_value(program_.key(parameter.name));
    if (!parameter.value.empty()) {
      Value given = evaluate(parameter.value[0]);
      if (given.is_known()) {
        value = std::move(given);
        notes_.add(parameter.value[0].offset, "took the default of parameter " + detail::quoted(parameter.name));
      }
    }
    frame.values.emplace(program_.key(parameter.name), std::move(value));
  }
  frames_.assign(1, std::move(frame));
  execute(body_of(function));
  frames_.clear();
}

void Machine::run_code() {
  frames_.assign(1, Frame{});
  execute(program_.outline.code);
  frames_.clear();
}

Machine::Flow Machine::execute(const std::vector<Statement>& statements) {
  for (const Statement& one : statements) {
    if (const Flow flow = execute(one); flow != Flow::normal) return flow;
  }
  return Flow::normal;
}

Machine::Flow Machine::execute(const Statement& s) {
  if (!spend()) return Flow::give_back;
  switch (s.kind) {
    case StatementKind::nothing:
    case StatementKind::label:
      return Flow::normal;
    case StatementKind::expression:
      evaluate(s.value[0]);
      return Flow::normal;
    case StatementKind::declaration:
      for (const Declared& one : s.declared) declare(one);
      return Flow::normal;
    case StatementKind::block:
      return execute(s.body);
    case StatementKind::branch:
      return branch(s);
    case StatementKind::loop:
      return loop(s);
    case StatementKind::choice:
      return choice(s);
    case StatementKind::leave:
      return Flow::leave;
    case StatementKind::next:
      return Flow::next;
    case StatementKind::give_back:
      if (!s.value.empty()) {
        frames_.back().result = evaluate(s.value[0]);
        frames_.back().has_result = true;
      }
      return Flow::give_back;
    case StatementKind::unreadable:
      if (program_.file.calls_between(s.offset, s.end)) {
        faults_.add(s.offset, "a call of the combiners cannot be read here: " + s.message);
      }
      return Flow::normal;
  }
  return Flow::normal;
}

Machine::Flow Machine::branch(const Statement& s) {
  const Value condition = evaluate(s.value[0]);
  const bool yes = may_set(s.body), no = may_set(s.otherwise);
  if (yes || no) use(condition);
  if (condition.is_known()) return execute(is_true(condition) ? s.body : s.otherwise);
  const std::uint32_t end = frames_.back().function != nullptr
                                ? frames_.back().function->end
                                : static_cast<std::uint32_t>(program_.source.text.size());
  const bool more_follow = program_.file.calls_between(s.end, end);
  const std::string text = text_of(s.value[0]);
  if (const auto before = assumed_.find(text); before != assumed_.end()) {
    return execute(before->second ? s.body : s.otherwise);
  }
  if (!yes && !no) {
    const bool guard = ends_function(s.body) && s.otherwise.empty();
    if (!guard) return either(condition, s);
    if (!more_follow) return Flow::normal;
    if (calls_made_ > 0) return either(condition, s);
    assumed_[text] = false;
    notes_.add(s.offset, "assumed that " + text + " is false: else no combiners are set");
    return Flow::normal;
  }
  // Which way it goes decides whether there is a program at all.
  if (yes != no && calls_made_ == 0 && !more_follow && frames_.size() == 1) {
    assumed_[text] = yes;
    notes_.add(s.offset, "assumed that " + text + (yes ? " is true" : " is false") + ": only then are combiners set");
    return execute(yes ? s.body : s.otherwise);
  }
  return either(condition, s);
}

// Nobody knows which way it goes: if that matters, the condition is needed, and both ways are looked through for what
// else is needed.
Machine::Flow Machine::either(const Value& condition, const Statement& s) {
  const bool guard = ends_function(s.body) && s.otherwise.empty();
  if (may_set(s.body) || may_set(s.otherwise) || guard) {
    need(condition, s.value[0]);
    execute(s.body);
    execute(s.otherwise);
  }
  forget(s.body, condition);
  forget(s.otherwise, condition);
  return Flow::normal;
}

Machine::Flow Machine::loop(const Statement& s) {
  execute(s.first);
  const bool sets = may_set(s.body);
  const bool endless = s.value.empty() || s.value[0].kind == Expression::Kind::number;
  for (std::size_t round = 0;; ++round) {
    if (out_of_steps_ || (endless && round == kMostRounds)) return Flow::normal;
    if (!s.value.empty() && (!s.tests_last || round > 0)) {
      const Value goes_on = evaluate(s.value[0]);
      if (!goes_on.is_known()) {
        if (sets) {
          need(goes_on, s.value[0]);
          execute(s.body);
        }
        forget(s.body, goes_on);
        return Flow::normal;
      }
      if (is_true(goes_on) == s.is_repeated_until) return Flow::normal;
    }
    const Flow flow = execute(s.body);
    if (flow == Flow::leave) return Flow::normal;
    if (flow == Flow::give_back) return flow;
    if (!s.step.empty()) evaluate(s.step[0]);
  }
}

Machine::Flow Machine::choice(const Statement& s) {
  const Value chosen = evaluate(s.value[0]);
  std::size_t start = s.body.size();
  bool sure = chosen.is_known();
  for (std::size_t i = 0; i < s.body.size() && sure; ++i) {
    const Statement& label = s.body[i];
    if (label.kind != StatementKind::label) continue;
    if (label.value.empty()) {
      if (start == s.body.size()) start = i;
      continue;
    }
    const Value same = apply_binary("==", chosen, evaluate(label.value[0]));
    if (!same.is_known()) {
      if (may_set(s.body)) need(same, label.value[0]);
      sure = false;
    } else if (is_true(same)) {
      start = i;
      break;
    }
  }
  if (!sure) {
    if (may_set(s.body)) {
      if (!chosen.is_known()) need(chosen, s.value[0]);
      for (const Statement& one : s.body) execute(one);
    }
    forget(s.body, chosen);
    return Flow::normal;
  }
  for (std::size_t i = start; i < s.body.size(); ++i) {
    const Flow flow = execute(s.body[i]);
    if (flow == Flow::leave) return Flow::normal;
    if (flow != Flow::normal) return flow;
  }
  return Flow::normal;
}

void Machine::declare(const Declared& declared) {
  Value value = initial(declared);
  if (!declared.value.empty()) add_alias(declared.name, declared.value[0], frames_.back());
  frames_.back().values[program_.key(declared.name)] = std::move(value);
}

// The value that a declaration gives to its name.
Value Machine::initial(const Declared& declared) {
  const auto members = program_.outline.structs.find(declared.type);
  const bool is_struct = members != program_.outline.structs.end();
  if (declared.value.empty()) {
    if (!declared.is_array && !is_struct) return needed_value(program_.key(declared.name));
    Value empty;
    empty.kind = Value::Kind::list;
    if (!declared.is_array) {
      empty.type = declared.type;
      empty.list.resize(members->second.size());
    }
    Value out = declared.is_array ? shaped(declared, std::move(empty), 0) : std::move(empty);
    name_unknowns(out, program_.key(declared.name));
    return out;
  }
  Value value = evaluate(declared.value[0]);
  if (value.kind == Value::Kind::list && (declared.is_array || is_struct)) return shaped(declared, std::move(value), 0);
  // TYPE name(x), name{x} or name = {x} of a number.
  const bool alone =
      value.kind == Value::Kind::list && value.list.size() == 1 && type_kind(declared.type) != TypeKind::other;
  return converted(alone ? Value(value.list[0]) : value, declared.is_array ? std::string_view() : declared.type);
}

// Gives a list the bounds of its declaration, with zeros for what is left out, and the members' order to its structs.
Value Machine::shaped(const Declared& declared, Value value, std::size_t level) {
  if (value.kind != Value::Kind::list) return converted(value, declared.type);
  const auto members = program_.outline.structs.find(declared.type);
  if (level >= declared.bounds.size()) {
    if (members != program_.outline.structs.end()) {
      value.type = declared.type;
      const bool filled = !value.list.empty();
      while (filled && value.list.size() < members->second.size()) value.list.push_back(integer_value(0));
    }
    return value;
  }
  if (level < declared.low.size()) {
    const Value low = evaluate(declared.low[level]);
    value.low =
        low.kind == Value::Kind::integer ? static_cast<int>(std::clamp<std::int64_t>(low.integer, -4096, 4096)) : 0;
  }
  const bool bounded = declared.bounds[level].kind != Expression::Kind::unreadable;
  const Value bound = bounded ? evaluate(declared.bounds[level]) : Value{};
  const bool filled = !value.list.empty();
  if (bound.kind == Value::Kind::integer && bound.integer >= 0 &&
      bound.integer <= static_cast<std::int64_t>(kMostElements)) {
    const auto size = static_cast<std::size_t>(bound.integer);
    const bool inner = level + 1 < declared.bounds.size() || members != program_.outline.structs.end();
    while (value.list.size() < size && ++elements_ <= kMostMadeElements) {
      value.list.push_back(filled && !inner ? integer_value(0) : Value{});
    }
  }
  for (Value& element : value.list) {
    if (element.kind == Value::Kind::unknown && element.needs.empty() && level + 1 < declared.bounds.size()) {
      element.kind = Value::Kind::list;
    }
    element = shaped(declared, std::move(element), level + 1);
  }
  return value;
}

}  // namespace ninebit::code
