// Executes statements.
#include "src/language/source_code/code_machine.h"

#include <algorithm>
#include <utility>

namespace ninebit::code {
namespace {

// How many statements and expressions a function executes at most, and all functions together; how often a loop that
// sets no combiners goes round before what it changes is no longer followed.
constexpr std::size_t kMostSteps = 200'000, kMostStepsOfFile = 2'000'000, kMostRounds = 4096;

// The place of a goto's label; nullptr: it is not there.
const Statement* find_mark(const std::vector<Statement>& statements, std::string_view label) {
  for (const Statement& one : statements) {
    if (one.kind == StatementKind::mark && one.message == label) return &one;
    for (const std::vector<Statement>* const inner : {&one.body, &one.otherwise}) {
      if (const Statement* const found = find_mark(*inner, label)) return found;
    }
  }
  return nullptr;
}

}  // namespace

bool names_vector(std::string_view word, std::size_t numbers) {
  return (numbers == 3 || numbers == 4) &&
         contains_any(detail::lower_case(word),
                      {"vec", "color", "colour", "rgba", "float4", "float3", "quat", "plane", "tuple"});
}

bool Machine::spend(std::size_t steps) {
  if (out_of_steps_) return false;
  steps_ += steps;
  program_.steps += steps;
  out_of_steps_ = steps_ > kMostSteps || program_.steps > kMostStepsOfFile;
  return !out_of_steps_;
}

// The fault where the steps are used up.
std::string Machine::too_many_steps() const {
  return steps_ > kMostSteps ? "the function runs for too long; loops of more than 200,000 steps are not executed"
                             : "the functions run for too long; a source's take at most 2,000,000 steps together";
}

void Machine::run(const Function* function) {
  frames_.assign(1, Frame{.function = function});
  frames_[0].mark = log_.size();
  exits_.clear();
  static const std::vector<Declared> kNone;
  for (const Declared& parameter : function == nullptr ? kNone : function->parameters) {
    if (parameter.name.empty()) continue;
    const std::string name(parameter.name);
    const Place at = new_variable(parameter.type, parameter.name);
    if (is_whole(at.type) || at.type->is(TypeKind::opaque)) continue;
    Value value = needed_value(name, parameter.type->kinds);
    if (const Value* const given = defined(name)) {
      value = definition_for(*given, parameter.type, name);
    } else if (!parameter.value.empty()) {
      Value usual = evaluate(parameter.value[0]);
      if (usual.is_known()) {
        value = std::move(usual);
        notes_.add(parameter.value[0].offset, "took the default of parameter " + detail::quoted(parameter.name));
      }
    }
    store(at, std::move(value));
  }
  frames_[0].result = place_of(new_object(program_.parser->unknown_type(), "the result"));
  need_conditions(function);
  (void)execute_body(function != nullptr ? program_.body_of(*function) : program_.outline.code, true);
  frames_.clear();
}

Machine::Flow Machine::execute(const std::vector<Statement>& statements, std::size_t from) {
  const std::size_t variables = frames_.back().variables.size();
  Flow flow = Flow::normal;
  for (std::size_t i = from; i < statements.size() && flow == Flow::normal; ++i) {
    flow = execute(statements[i]);
    if (is_thrown_) flow = Flow::give_back;
    if (flow != Flow::jump) continue;
    for (std::size_t to = 0; to < statements.size() && spend(); ++to) {
      if (statements[to].kind != StatementKind::mark || statements[to].message != jump_label_) continue;
      flow = Flow::normal;
      i = to;
      resolve(Flow::jump, frames_.back().mark, jump_label_);
      break;
    }
  }
  for (std::size_t i = frames_.back().variables.size(); i > variables; --i) {
    const Type* const type = frames_.back().variables[i - 1].place.type;
    if (type != nullptr && type->structure != nullptr && type->structure->is_destroyed) forget_all();
  }
  frames_.back().variables.resize(variables);
  return flow;
}

Machine::Flow Machine::execute(const Statement& s) {
  if (!spend()) return Flow::give_back;
  switch (s.kind) {
    case StatementKind::nothing:
    case StatementKind::label:
      return Flow::normal;
    case StatementKind::mark:
      resolve(Flow::jump, frames_.back().mark, s.message);
      return Flow::normal;
    case StatementKind::expression:
      (void)evaluate(s.value[0]);
      return Flow::normal;
    case StatementKind::declaration:
      for (const Declared& one : s.declared) declare(one);
      return Flow::normal;
    case StatementKind::block: {
      tries_ += s.message == "try" ? 1 : 0;
      const Flow flow = execute(s.body);
      tries_ -= s.message == "try" ? 1 : 0;
      if (s.message != "try" || !is_thrown_) return flow;
      // The handler that catches it is not executed.
      is_thrown_ = false;
      forget_all();
      add_exit(Flow::give_back, {}, {}, nullptr);
      return Flow::normal;
    }
    case StatementKind::branch:
      return branch(s);
    case StatementKind::loop:
      return loop(s);
    case StatementKind::each:
      return each(s);
    case StatementKind::choice:
      return choice(s);
    case StatementKind::jump:
      jump_label_ = s.message;
      return Flow::jump;
    case StatementKind::leave:
      return Flow::leave;
    case StatementKind::next:
      return Flow::next;
    case StatementKind::give_back:
      if (!s.value.empty() && s.value[0].kind == ExpressionKind::list) {
        fill(frames_.back().result, s.value[0]);
      } else if (!s.value.empty()) {
        Value value = evaluate(s.value[0]);
        if (frames_.back().result.type != nullptr && s.message.empty()) store(frames_.back().result, std::move(value));
      }
      is_thrown_ = is_thrown_ || (s.message == "throw" && (frames_.size() > 1 || tries_ > 0));
      return Flow::give_back;
    case StatementKind::unreadable:
      if (program_.file.calls_between(s.offset, s.end)) {
        report(s.offset, "a call of the combiners cannot be read here: " + s.message);
      }
      forget_all();
      if (s.may_jump) add_exit(Flow::give_back, {}, {}, nullptr);
      return Flow::normal;
  }
  return Flow::normal;
}

Machine::Flow Machine::branch(const Statement& s) {
  const Value condition = evaluate(s.value[0]);
  const bool yes = program_.sets(s.body), no = program_.sets(s.otherwise);
  if (yes || no) use(condition);
  if (const auto is_true = truth(condition)) {
    // All that a condition leads to shares the condition's assumptions.
    if (condition.origins) used_origins_.insert(condition.origins->begin(), condition.origins->end());
    return execute(*is_true ? s.body : s.otherwise);
  }
  const auto either = [&] {
    return fork(condition, &s.value[0], {[&] { return execute(s.body); }, [&] { return execute(s.otherwise); }});
  };
  const Function* const inside = frames_.back().function;
  const bool more_follow =
      program_.file.calls_between(s.end, inside != nullptr ? inside->end : program_.source.text.size());
  const std::string text = text_of(s.value[0]);
  if (const auto before = assumed_.find(text); before != assumed_.end()) {
    return execute(before->second ? s.body : s.otherwise);
  }
  if (!yes && !no) {
    const bool guard = s.otherwise.empty() && more_follow && calls_made_ == 0 && !is_conditional();
    if (!guard || !leaves(s.body)) return either();
    assumed_[text] = false;
    notes_.add(s.offset, "assumed that " + text + " is false: else no combiners are set");
    return Flow::normal;
  }
  // Which way it goes decides whether there is a program at all.
  if (yes != no && calls_made_ == 0 && !more_follow && frames_.size() == 1 && !is_conditional()) {
    assumed_[text] = yes;
    notes_.add(s.offset, "assumed that " + text + (yes ? " is true" : " is false") + ": only then are combiners set");
    return execute(yes ? s.body : s.otherwise);
  }
  return either();
}

Machine::Flow Machine::loop(const Statement& s) {
  const std::size_t variables = frames_.back().variables.size();
  for (const Statement& one : s.first) (void)execute(one);
  frames_.back().loops.push_back({.mark = log_.size()});
  return end_loop(rounds(s), variables);
}

// Behind a loop or a choice.
Machine::Flow Machine::end_loop(Flow flow, std::size_t variables) {
  resolve(Flow::leave, frames_.back().loops.back().mark);
  frames_.back().loops.pop_back();
  frames_.back().variables.resize(variables);
  return flow == Flow::leave ? Flow::normal : flow;
}

Machine::Flow Machine::rounds(const Statement& s) {
  const bool sets = program_.sets(s.body) || (!s.value.empty() && program_.sets(s.value[0]));
  for (std::size_t round = 0;; ++round) {
    if (out_of_steps_) return Flow::normal;
    Value goes_on = integer_value(1);
    if (!s.value.empty() && (!s.tests_last || round > 0)) {
      goes_on = evaluate(s.value[0]);
      if (sets) use(goes_on);
      if (truth(goes_on) == false) return Flow::normal;
    }
    if (!truth(goes_on) || (!sets && (round >= kMostRounds || steps_ > kMostSteps / 2))) {
      widen(s, goes_on);
      return Flow::normal;
    }
    const Flow flow = execute(s.body);
    if (flow == Flow::leave) return Flow::normal;
    if (flow == Flow::give_back || flow == Flow::jump) return flow;
    resolve(Flow::next, frames_.back().loops.back().mark);
    if (!s.step.empty()) (void)evaluate(s.step[0]);
  }
}

// How often it goes round is not known: what the rounds leave different is not known, until a further round changes
// nothing.
void Machine::widen(const Statement& s, const Value& why) {
  constexpr int kMostTries = 60;
  const Expression* const condition = s.value.empty() ? nullptr : &s.value[0];
  for (int i = 0; i < kMostTries && !out_of_steps_; ++i) {
    const std::size_t base = log_.size(), objects = objects_.size();
    guards_.push_back({why, condition});
    const std::size_t variables = frames_.back().variables.size();
    const Flow flow = execute(s.body);
    frames_.back().variables.resize(variables);
    const bool goes_on = flow == Flow::normal || flow == Flow::next;
    resolve(Flow::next, frames_.back().loops.back().mark);
    if (goes_on) {
      if (!s.step.empty()) (void)evaluate(s.step[0]);
      if (condition != nullptr) (void)evaluate(*condition);
    }
    guards_.pop_back();
    const Changes changes = changes_since(base);
    const std::string label = flow == Flow::jump ? jump_label_ : "";
    roll_back(base);
    if (!goes_on) {
      add_exit(flow, changes, why, condition);
      exits_.back().label = label;
      return;
    }
    bool changed = false;
    for (const auto& [key, value] : changes) {
      // A variable of a round is another one in the next.
      const int object = std::get<0>(key);
      if (object >= static_cast<int>(objects) && !object_at(object).is_static) continue;
      const Value& now = cell(key);
      if (same(now, value) || (!now.is_known() && now.name.empty() && now.object < 0 && !value.is_known())) continue;
      changed = true;
      set_cell(key, unknown_of(why, now.is_known() ? value : now, now.number.kinds));
    }
    if (!changed) return;
  }
  forget_all();
}

Machine::Flow Machine::each(const Statement& s) {
  const Value range = evaluate(s.value[0]);
  const bool known = range.is(ValueKind::pointer) && range.at == 0 && range.type != nullptr;
  const std::size_t step = known ? std::max<std::size_t>(cells_of(range.type), 1) : 1;
  const std::size_t size = known ? object_at(range.object).cells.size() / step : 0;
  const Declared& one = s.declared[0];
  const Type* const type = known && one.type->is(TypeKind::unknown) ? range.type : one.type;
  const std::size_t variables = frames_.back().variables.size();
  frames_.back().loops.push_back({.mark = log_.size()});
  const auto take = [&](const Place& from) {
    if (one.is_reference) return bind(one.name, from);
    const Place at = new_variable(type, one.name);
    if (known) store(at, load(from));
  };
  Flow flow = Flow::normal;
  for (std::size_t i = 0; i < size && flow == Flow::normal && spend(); ++i) {
    take(deref(range, integer_value(static_cast<std::int64_t>(i)), std::string(one.name)));
    flow = execute(s.body);
    frames_.back().variables.resize(variables);
    if (flow == Flow::next) flow = Flow::normal;
    resolve(Flow::next, frames_.back().loops.back().mark);
  }
  if (!known) {
    if (program_.sets(s.body)) need(range, s.value[0]);
    take({.path = std::string(one.name)});
    widen(s, unknown_of(range, range));
  }
  return end_loop(flow, variables);
}

// Whether a way that ends like this leaves the function, or goes to where no calls of the combiners follow.
bool Machine::leaves(const std::vector<Statement>& statements) {
  if (statements.empty()) return false;
  const Statement& last = statements.back();
  if (last.kind == StatementKind::block) return leaves(last.body);
  const Function* const function = frames_.back().function;
  if (last.kind != StatementKind::jump || function == nullptr) return last.kind == StatementKind::give_back;
  const Statement* const mark = find_mark(program_.body_of(*function), last.message);
  return mark != nullptr && mark->offset > last.offset && !program_.file.calls_between(mark->offset, function->end);
}

// Executes the body of the innermost frame's function. Ways to a label that is not passed, because it stands before
// them or in a block, are not followed; whether there were some.
bool Machine::execute_body(const std::vector<Statement>& body, bool sets) {
  const bool jumps = execute(body) == Flow::jump;
  if (jumps && sets && !out_of_steps_)
    report(body.back().offset, "goto " + jump_label_ + " leads into a block, and is not followed");
  resolve(Flow::give_back, frames_.back().mark);
  const auto is_lost = [&](const Exit& one) { return one.frame == frames_.size(); };
  const bool loses = std::any_of(exits_.begin(), exits_.end(), is_lost);
  for (const Exit& one : exits_) {
    if (sets && is_lost(one) && one.condition != nullptr) need(one.why, *one.condition);
  }
  exits_.erase(std::remove_if(exits_.begin(), exits_.end(), is_lost), exits_.end());
  if (jumps || loses) forget_all();
  return jumps || loses;
}

Machine::Flow Machine::choice(const Statement& s) {
  const Value chosen = evaluate(s.value[0]);
  const bool sets = program_.sets(s.body);
  if (sets) use(chosen);
  std::optional<std::size_t> usual, start;
  std::vector<std::size_t> labels;
  Value why = chosen;
  const Expression* unknown = chosen.is_known() ? nullptr : &s.value[0];
  for (std::size_t i = 0; i < s.body.size() && !start; ++i) {
    const Statement& label = s.body[i];
    if (label.kind != StatementKind::label) continue;
    labels.push_back(i);
    if (label.value.empty()) {
      usual = i;
      continue;
    }
    const Value same_value = combine("==", chosen, evaluate(label.value[0]));
    const auto is_same = truth(same_value);
    if (is_same == true && unknown == nullptr) start = i;
    if (!is_same && unknown == nullptr) {
      unknown = &label.value[0];
      why = same_value;
    }
  }
  frames_.back().loops.push_back({.mark = log_.size(), .is_choice = true});
  Flow flow = Flow::normal;
  if (unknown == nullptr) {
    if (!start) start = usual;
    if (start) flow = execute(s.body, *start);
  } else {
    std::vector<std::function<Flow()>> ways;
    for (const std::size_t label : labels) ways.emplace_back([&, label] { return execute(s.body, label); });
    if (!usual) ways.emplace_back([] { return Flow::normal; });
    flow = fork(why, unknown, ways);
  }
  return end_loop(flow, frames_.back().variables.size());
}

// Conditions that are not known: all ways are executed from the same state, and what they leave different is not known.

Changes Machine::changes_since(std::size_t mark) const {
  Changes out;
  for (std::size_t i = mark; i < log_.size(); ++i) out.try_emplace(log_[i].key, Value{});
  for (auto& [key, value] : out) value = cell(key);
  return out;
}

void Machine::roll_back(std::size_t mark) {
  while (log_.size() > mark) {
    Logged last = std::move(log_.back());
    log_.pop_back();
    const auto& [object, at, name] = last.key;
    (object < 0 ? outside_[name] : object_at(object).cells[static_cast<std::size_t>(at)]) = std::move(last.before);
  }
}

// The current state and another one, both of which come from that at a mark. `changes` are those of the other.
void Machine::join(const Changes& changes, std::size_t mark, const Value& why) {
  Changes begin;
  for (std::size_t i = mark; i < log_.size(); ++i) begin.try_emplace(log_[i].key, log_[i].before);
  Changes other = changes;
  for (const auto& [key, before] : begin) other.try_emplace(key, before);
  for (const auto& [key, value] : other) {
    const Value& now = cell(key);
    if (!same(now, value)) set_cell(key, unknown_of(why, now.is_known() ? value : now, now.number.kinds));
  }
}

// Executes all ways from here; goes on with those that go on, and keeps the others for where they lead to.
Machine::Flow Machine::fork(const Value& why, const Expression* condition,
                            const std::vector<std::function<Flow()>>& ways) {
  struct Way {
    Flow flow;
    std::string label;
    Changes changes;
  };
  const std::size_t base = log_.size();
  std::vector<Way> all;
  bool throws = false;
  guards_.push_back({why, condition});
  for (const auto& way : ways) {
    const std::size_t variables = frames_.back().variables.size();
    const Flow flow = way();
    throws = std::exchange(is_thrown_, false) || throws;
    frames_.back().variables.resize(variables);
    all.push_back({flow, flow == Flow::jump ? jump_label_ : std::string(), changes_since(base)});
    (void)spend((log_.size() - base) / 16);
    roll_back(base);
  }
  guards_.pop_back();
  const Way* first = &all[0];
  for (const Way& one : all) {
    if (one.flow < first->flow) first = &one;
  }
  const auto goes_on = [&](const Way& one) { return one.flow == first->flow && one.label == first->label; };
  for (const Way& one : all) {
    if (goes_on(one)) continue;
    add_exit(one.flow, one.changes, why, condition);
    exits_.back().label = one.label;
  }
  for (const auto& [key, value] : first->changes) set_cell(key, value);
  for (const Way& one : all) {
    if (&one != first && goes_on(one)) join(one.changes, base, why);
  }
  jump_label_ = first->label;
  if (throws) {  // where it is caught is not known, nor what is still executed
    forget_all();
    exits_.push_back({.flow = Flow::give_back, .frame = 1, .why = why, .condition = condition});
  }
  return first->flow;
}

void Machine::add_exit(Flow flow, const Changes& last, const Value& why, const Expression* condition) {
  const Frame& frame = frames_.back();
  const bool of_loop = flow == Flow::next || flow == Flow::leave;
  // continue leads to the loop around a choice.
  std::size_t loop = frame.loops.size();
  while (flow == Flow::next && loop > 0 && frame.loops[loop - 1].is_choice) --loop;
  Exit out{.flow = flow, .frame = frames_.size(), .loop = loop, .why = why, .condition = condition};
  const std::size_t mark = of_loop && loop > 0 ? frame.loops[loop - 1].mark : frame.mark;
  (void)spend((log_.size() - mark) / 16);
  out.changes = changes_since(mark);
  for (const auto& [key, value] : last) out.changes[key] = value;
  exits_.push_back(std::move(out));
}

// Joins the ways that lead here.
void Machine::resolve(Flow flow, std::size_t mark, std::string_view label) {
  for (std::size_t i = exits_.size(); i > 0; --i) {
    const Exit& one = exits_[i - 1];
    const bool of_loop = flow == Flow::next || flow == Flow::leave;
    const bool here = one.flow == flow && one.frame == frames_.size() && one.label == label &&
                      (!of_loop || one.loop == frames_.back().loops.size());
    if (!here) continue;
    (void)spend((log_.size() - mark) / 16);
    const Exit way = one;
    exits_.erase(exits_.begin() + static_cast<std::ptrdiff_t>(i) - 1);
    join(way.changes, mark, way.why);
  }
}

}  // namespace ninebit::code
