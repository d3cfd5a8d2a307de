// Executes statements.
#include "src/language/source_code/code_machine.h"

#include <algorithm>
#include <utility>

#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

// How many statements a function executes at most, and all functions together, and how often an endless loop goes
// round.
constexpr std::size_t kMostSteps = 200'000, kMostStepsOfFile = 2'000'000, kMostRounds = 500;

bool ends_function(const std::vector<Statement>& statements) {
  if (statements.empty()) return false;
  const Statement& last = statements.back();
  return last.kind == StatementKind::give_back || last.kind == StatementKind::jump ||
         (last.kind == StatementKind::block && ends_function(last.body));
}

}  // namespace

bool Machine::spend(std::size_t steps) {
  if (out_of_steps_) return false;
  steps_ += steps;
  program_.steps += steps;
  out_of_steps_ = steps_ > kMostSteps || program_.steps > kMostStepsOfFile;
  return !out_of_steps_;
}

// What to say where the steps are used up.
std::string Machine::too_many_steps() const {
  return steps_ > kMostSteps ? "the function runs for too long; loops of more than 200,000 steps are not executed"
                             : "the functions run for too long; a source's take at most 2,000,000 steps together";
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
  need_conditions(&function);
  execute(body_of(function));
  frames_.clear();
}

void Machine::run_code() {
  frames_.assign(1, Frame{});
  need_conditions(nullptr);
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
    case StatementKind::each:
      return each(s);
    case StatementKind::choice:
      return choice(s);
    case StatementKind::jump:
      return jump(s);
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
    if (!guard || jumps_to_calls(s.body)) return either(condition, s);
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
    ++guesses_;
    execute(s.body);
    execute(s.otherwise);
    --guesses_;
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

Machine::Flow Machine::each(const Statement& s) {
  const Value range = evaluate(s.value[0]);
  const std::string name = program_.key(s.declared[0].name);
  if (range.kind != Value::Kind::list) {
    if (may_set(s.body)) {
      need(range, s.value[0]);
      frames_.back().values[name] = needed_value(name);
      execute(s.body);
    }
    forget(s.body, range);
    return Flow::normal;
  }
  for (const Value& element : range.list) {
    if (out_of_steps_) return Flow::normal;
    frames_.back().values[name] = element.is_known() || !element.needs.empty() ? element : needed_value(name);
    const Flow flow = execute(s.body);
    if (flow == Flow::leave) return Flow::normal;
    if (flow == Flow::give_back) return flow;
  }
  return Flow::normal;
}

// Whether statements end with a goto behind whose label calls of the combiners stand.
bool Machine::jumps_to_calls(const std::vector<Statement>& statements) const {
  if (statements.empty()) return false;
  const Statement& last = statements.back();
  if (last.kind == StatementKind::block) return jumps_to_calls(last.body);
  return last.kind == StatementKind::jump && leads_to_calls(last);
}

bool Machine::leads_to_calls(const Statement& jump) const {
  const Function* const function = frames_.back().function;
  const std::size_t end = function != nullptr ? function->end : program_.source.text.size();
  const std::string_view behind = program_.source.text.substr(jump.end, end - jump.end);
  for (std::size_t at = behind.find(jump.message); at != std::string_view::npos;
       at = behind.find(jump.message, at + 1)) {
    const std::size_t next = behind.find_first_not_of(" \t\r\n", at + jump.message.size());
    const bool is_word = at == 0 || !detail::is_word(behind[at - 1]);
    const bool is_label = is_word && next != std::string_view::npos && behind[next] == ':';
    if (is_label) return program_.file.calls_between(jump.end + at, end);
  }
  return true;  // it leads back
}

// A goto to where no calls follow is a return.
Machine::Flow Machine::jump(const Statement& s) {
  if (guesses_ == 0 && leads_to_calls(s) && misspelled_.insert(s.offset).second) {
    faults_.add(s.offset, "goto is not followed, and calls of the combiners stand behind its label");
  }
  return Flow::give_back;
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

}  // namespace ninebit::code
