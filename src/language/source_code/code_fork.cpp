// Conditions that are not known: all ways are executed from the same state, and what they leave different is not known.
#include <utility>

#include "src/language/source_code/code_machine.h"

namespace ninebit::code {

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
