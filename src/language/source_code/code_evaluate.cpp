// Executes expressions.
#include <algorithm>
#include <utility>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_machine.h"
#include "src/system/nearest_name.h"

namespace ninebit::code {
namespace {

bool is_comparison(std::string_view op) {
  return op == "==" || op == "!=" || op == "<" || op == ">" || op == "<=" || op == ">=";
}

bool is_null(const Value& value) {
  return value.is_number() && !value.number.is_true() && (value.number.kinds & ~kReals) != 0;
}

bool is_address(const Value& value) {
  return value.is(ValueKind::pointer) || value.is(ValueKind::text) || value.is(ValueKind::function) ||
         value.is(ValueKind::entry_point);
}

// The types that a value has or may have; 0: not a number, or any.
Kinds kinds_of(const Value& value) {
  return value.is_number() || !value.is_known() ? value.number.kinds : Kinds{0};
}

}  // namespace

Value Machine::evaluate(const Expression& e) {
  if (++depth_ > kMostChained || !spend()) {
    --depth_;
    return {};
  }
  Value out = evaluate_once(e);
  --depth_;
  if (out.is_known() || definitions_.empty()) return out;
  const std::string path = path_of(e);
  const Value* const given = defined(path);
  return given != nullptr ? definition_for(*given, out.type, path) : out;
}

Value Machine::evaluate_once(const Expression& e) {
  switch (e.kind) {
    case ExpressionKind::number:
      return number_value(e.number);
    case ExpressionKind::text:
      if (e.is_made && e.text.empty()) return {};
      return {.kind = ValueKind::text, .begin = e.offset, .end = e.end, .name = std::string(e.is_made ? e.text : "")};
    case ExpressionKind::name:
      return evaluate_name(e);
    case ExpressionKind::unary:
      return evaluate_unary(e);
    case ExpressionKind::binary:
      return evaluate_binary(e);
    case ExpressionKind::assignment:
      return evaluate_assignment(e);
    case ExpressionKind::conditional:
      return evaluate_conditional(e);
    case ExpressionKind::comma:
      (void)evaluate(e.parts[0]);
      return evaluate(e.parts[1]);
    case ExpressionKind::call:
      return call(e);
    case ExpressionKind::index:
    case ExpressionKind::member: {
      if (auto word = assigned_word(e)) return *std::move(word);
      const ExpressionKind from = e.parts[0].kind;
      if (e.kind == ExpressionKind::member && !e.is_arrow &&
          (from == ExpressionKind::call || from == ExpressionKind::conditional || from == ExpressionKind::make)) {
        const Value object = evaluate(e.parts[0]);
        if (object.is(ValueKind::record)) return part_of(object, e.text);
        return needed_value(path_of(e));
      }
      const Place at = place(e);
      if (at.kind != PlaceKind::cell) {
        if (const auto known = constant(e)) return *known;
      }
      return read(at);
    }
    case ExpressionKind::list:
      return list_value(e);
    case ExpressionKind::cast:
      return cast(evaluate(e.parts[0]), e.type, text_of(e));
    case ExpressionKind::size:
      return evaluate_size(e);
    case ExpressionKind::make:
      return evaluate_make(e);
    default:
      return {};
  }
}

// A member of a struct that no variable holds.
Value Machine::part_of(const Value& record, std::string_view name) {
  for (const Member& one : record.type->structure->members) {
    if (one.name != name) continue;
    if (one.type->is(TypeKind::array)) return needed_value(std::string(name));
    if (!one.type->is(TypeKind::structure)) return (*record.cells)[one.cell];
    return record_value(one.type, std::span(*record.cells).subspan(one.cell, one.type->structure->cells));
  }
  return needed_value(std::string(name));
}

Value Machine::evaluate_name(const Expression& e) {
  if (e.text == "this" && e.qualifier.empty()) return frames_.back().self;
  const Place at = lookup(e);
  if (at.kind == PlaceKind::outside && at.outside[0] != '#' && !cell({-1, 0, at.outside}).is_known()) {
    const auto functions = program_.by_name.find(e.text);
    if (functions != program_.by_name.end() && functions->second.size() == 1) {
      return {.kind = ValueKind::function, .function = functions->second[0]};
    }
    if (const auto known = constant(e)) return *known;
  }
  return read(at);
}

Value Machine::evaluate_unary(const Expression& e) {
  const Expression& operand = e.parts[0];
  if (e.text == "&") {
    const bool names_function = operand.kind == ExpressionKind::name && program_.by_name.count(operand.text) != 0;
    if (names_function) return evaluate(operand);
    // &color.r of a class of another file is all of it.
    const bool is_first = operand.kind == ExpressionKind::member && (operand.text == "r" || operand.text == "x");
    if (is_first) {
      const Place whole = place(operand.parts[0]);
      if (is_vague(whole.type) && whole.kind != PlaceKind::nowhere) {
        const Value value = evaluate(operand.parts[0]);
        if (value.is(ValueKind::pointer) || !value.is_known()) return value;
      }
    }
    const Place at = place(operand);
    Value out = pointer_value(at.object, at.at, at.type);
    if (at.kind == PlaceKind::cell) return out;
    out.kind = ValueKind::unknown;
    if (at.kind == PlaceKind::outside && at.outside[0] != '#') {
      const bool element = at.outside.ends_with("[0]");
      std::string name = at.outside.substr(0, at.outside.size() - (element ? 3 : 0));
      out.needs = needed_value(name).needs;
      const bool is_array = at.type != nullptr && at.type->is(TypeKind::array);
      if (element || is_array) out.name = name;
      if (is_array) out.type = at.type->of;
      if (!out.name.empty()) {
        if (const Value* const given = defined(out.name)) return definition_for(*given, nullptr, out.name);
      }
      return out;
    }
    out.needs = needed_value(at.path).needs;
    return out;
  }
  if (e.text == "*") {
    const Value pointer = evaluate(operand);
    if (pointer.is(ValueKind::function) || pointer.is(ValueKind::entry_point)) return pointer;
    return read(deref(pointer, integer_value(0), path_of(e)));
  }
  const bool steps = e.text == "++" || e.text == "--" || e.text == "post++" || e.text == "post--";
  if (steps) {
    const Place at = place(operand);
    const Value before = read(at);
    const bool up = e.text.ends_with("++");
    const Value after = combine(up ? "+" : "-", before, integer_value(1));
    store(at, after);
    return e.text.starts_with("post") ? before : load(at);
  }
  const Value value = evaluate(operand);
  if (e.text == "!") {
    const auto is_true = truth(value);
    if (!is_true) return unknown_of(value, value, kInt32);
    return with_origins(integer_value(*is_true ? 0 : 1), value);
  }
  if (!value.is_number()) return unknown_of(value, value, promoted_kinds(kinds_of(value)));
  const auto number = calculate(e.text, value.number);
  return number ? with_origins(number_value(*number), value) : needed_value({}, promoted_kinds(value.number.kinds));
}

Value Machine::compare_pointers(std::string_view op, const Value& left, const Value& right) const {
  const bool equality = op == "==" || op == "!=";
  if (equality && (is_null(left) || is_null(right))) return integer_value(op == "!=" ? 1 : 0);
  const bool pointers = left.is(ValueKind::pointer) && right.is(ValueKind::pointer);
  if (pointers && left.object == right.object) {
    return number_value(*calculate(op, int_number(left.at, kInt64), int_number(right.at, kInt64)));
  }
  if (pointers && equality) return integer_value(op == "!=" ? 1 : 0);
  const bool functions = left.is(ValueKind::function) && right.is(ValueKind::function) && equality;
  if (functions) return integer_value((left.function == right.function) == (op == "==") ? 1 : 0);
  return needed_value({}, kInt32);
}

Value Machine::combine(std::string_view op, const Value& left, const Value& right) {
  const Kinds kinds =
      is_comparison(op) ? kInt32
      : op == "<<" || op == ">>"
          ? promoted_kinds(kinds_of(left))
          : (kinds_of(left) != 0 && kinds_of(right) != 0 ? common_kinds(kinds_of(left), kinds_of(right)) : Kinds{0});
  // A name that a definition gives as a value is equal to itself alone.
  for (const auto* const pair : {&left, &right}) {
    const Value& other = pair == &left ? right : left;
    if (!pair->is(ValueKind::symbol) || (op != "==" && op != "!=")) continue;
    const bool is_name = other.is(ValueKind::symbol) || (!other.is_known() && !other.name.empty());
    if (is_name) return integer_value((other.name == pair->name) == (op == "==") ? 1 : 0);
  }
  if (!left.is_known() || !right.is_known()) {
    // A constant of another file is not what is asked for.
    const auto is_foreign = [](const Value& one) {
      return !one.is_known() && !one.name.empty() &&
             std::none_of(one.name.begin(), one.name.end(), [](char c) { return c >= 'a' && c <= 'z'; }) &&
             is_capital(one.name[0]) && one.name.size() > 1;
    };
    Value out = unknown_of(left, right, kinds);
    if (is_comparison(op) && !left.is_known() && is_foreign(right)) out = unknown_of(left, left, kinds);
    if (is_comparison(op) && !right.is_known() && is_foreign(left)) out = unknown_of(right, right, kinds);
    const Value& pointer = left.object >= 0 ? left : right;
    if (pointer.object >= 0 && (op == "+" || op == "-")) {
      out.object = pointer.object;
      out.type = pointer.type;
    }
    return out;
  }
  Value out;
  if (left.is_number() && right.is_number()) {
    const auto number = calculate(op, left.number, right.number);
    out = number ? number_value(*number) : needed_value({}, kinds);
    return with_origins(with_origins(std::move(out), left), right);
  }
  if (is_comparison(op) && (is_address(left) || is_address(right))) return compare_pointers(op, left, right);
  const bool moves = (left.is(ValueKind::pointer) && right.is_number()) ||
                     (op == "+" && right.is(ValueKind::pointer) && left.is_number());
  if ((op == "+" || op == "-") && moves) {
    out = left.is(ValueKind::pointer) ? left : right;
    const auto by = convert((left.is_number() ? left : right).number, kInt64);
    if (by && out.type != nullptr && !out.type->is(TypeKind::nothing)) {
      out.at += (op == "+" ? by->integer : -by->integer) * static_cast<std::int64_t>(cells_of(out.type));
      return out;
    }
    out.kind = ValueKind::unknown;
    return out;
  }
  const bool distance = op == "-" && left.is(ValueKind::pointer) && right.is(ValueKind::pointer);
  if (distance && left.object == right.object && left.type != nullptr && cells_of(left.type) > 0) {
    return number_value(int_number((left.at - right.at) / static_cast<std::int64_t>(cells_of(left.type)), kInt64));
  }
  if (left.is(ValueKind::text) && right.is(ValueKind::text) && op == "+" && left.name.empty() && right.name.empty()) {
    out = left;
    out.begin = std::min(left.begin, right.begin);
    out.end = std::max(left.end, right.end);
    return out;
  }
  // An operator of a class may change what it is given.
  if (!is_address(left) && !is_address(right)) {
    forget_pointed(left);
    forget_pointed(right);
    if (left.is(ValueKind::record) || right.is(ValueKind::record)) forget_all();
  }
  return needed_value({}, kinds);
}

Value Machine::evaluate_binary(const Expression& e) {
  const Value left = evaluate(e.parts[0]);
  if (e.text != "&&" && e.text != "||") {
    const Value right = evaluate(e.parts[1]);
    return combine(e.text, left, right);
  }
  const bool decides = e.text == "||";
  const auto first = truth(left);
  if (first && *first == decides) return with_origins(integer_value(decides ? 1 : 0), left);
  Value right;
  if (first) {
    right = evaluate(e.parts[1]);
  } else {
    (void)fork(left, &e.parts[0],
               {[&] {
                  right = evaluate(e.parts[1]);
                  return Flow::normal;
                },
                [] { return Flow::normal; }});
  }
  const auto second = truth(right);
  if (second && *second == decides) return with_origins(integer_value(decides ? 1 : 0), right);
  if (!first || !second) return unknown_of(left, right, kInt32);
  return with_origins(with_origins(integer_value(decides ? 0 : 1), left), right);
}

Value Machine::evaluate_conditional(const Expression& e) {
  const Value condition = evaluate(e.parts[0]);
  const auto is_true = truth(condition);
  Value yes, no;
  if (is_true) {
    // The operand that is not evaluated still gives the result its type.
    yes = *is_true ? evaluate(e.parts[1]) : quietly([&] { return evaluate(e.parts[1]); });
    no = *is_true ? quietly([&] { return evaluate(e.parts[2]); }) : evaluate(e.parts[2]);
  } else {
    (void)fork(condition, &e.parts[0],
               {[&] {
                  yes = evaluate(e.parts[1]);
                  return Flow::normal;
                },
                [&] {
                  no = evaluate(e.parts[2]);
                  return Flow::normal;
                }});
  }
  const Kinds a = kinds_of(yes), b = kinds_of(no);
  const auto with_type = [&](Value value) {
    if (!value.is_number()) {
      value.number.kinds = a != 0 && b != 0 ? common_kinds(a, b) : Kinds{0};
      return value;
    }
    const bool both_numbers = a != 0 && b != 0;
    if (!both_numbers && yes.is_known() && no.is_known()) return value;
    const auto number = both_numbers ? convert(value.number, common_kinds(a, b)) : loosen(value.number);
    return number ? with_origins(number_value(*number), value) : needed_value({}, a);
  };
  if (is_true) return with_origins(with_type(*is_true ? yes : no), condition);
  yes = with_type(yes);
  no = with_type(no);
  if (yes.is_known() && same(yes, no)) return yes;
  return unknown_of(condition, yes.is_known() ? no : yes, kinds_of(yes));
}

Value Machine::evaluate_assignment(const Expression& e) {
  const NamedWord word = named_word(e.parts[0]);
  if (word.field != nullptr) return assign_word(word, e);
  const std::string meant = word.name.empty() ? "" : did_you_mean(word.name, xbox::field_names());
  if (!meant.empty()) {
    report(e.parts[0].offset, detail::quoted(word.name) + " is not a member of D3DPIXELSHADERDEF" + meant);
  }
  const bool is_list = e.parts[1].kind == ExpressionKind::list;
  Value value = evaluate(e.parts[1]);
  Place at = place(e.parts[0]);
  if (e.text != "=") {
    const Value before = read(at);
    value = combine(e.text.substr(0, e.text.size() - 1), before, value);
  } else if (frames_.size() == 1) {
    if (const Value* const given = defined(at.path)) value = definition_for(*given, at.type, at.path);
  }
  const bool is_struct = at.type != nullptr && at.type->is(TypeKind::structure);
  if (is_struct && is_list && at.kind == PlaceKind::cell) {
    fill(at, e.parts[1]);
    return load(at);
  }
  // A class's own operator may do anything.
  if (is_struct && at.type->structure->is_special) {
    forget_all();
    value = {};
  }
  store(at, std::move(value));
  return load(at);
}

Value Machine::cast(const Value& value, const Type* type, const std::string& path) const {
  return type == nullptr || type->is(TypeKind::nothing) ? value : converted(value, type, path);
}

Value Machine::evaluate_size(const Expression& e) {
  const Type* type = e.type;
  if (type == nullptr) {
    const Place at = quietly([&] { return place(e.parts[0]); });
    type = at.type;
    if (type == nullptr) {
      const Kinds kinds = kinds_of(quietly([&] { return evaluate(e.parts[0]); }));
      if (kinds != 0) type = program_.parser->number_type(kinds);
    }
  }
  const std::int64_t bytes = type == nullptr ? 0 : bytes_of(type);
  if (bytes == 0) return needed_value(path_of(e), kUint32 | kUint64);
  return number_value(int_number(bytes, kUint32 | kUint64));
}

Value Machine::evaluate_make(const Expression& e) {
  const Expression& list = e.parts[0];
  const Type* type = e.type;
  if (e.text == "call" && !type->is(TypeKind::structure)) {
    if (list.parts.size() == 1) return cast(evaluate(list.parts[0]), type, text_of(e));
    if (list.parts.empty() && type->is(TypeKind::number)) return number_value(*convert(int_number(0), type->kinds));
    for (const Expression& one : list.parts) forget_pointed(evaluate(one));
    return needed_value(path_of(e));
  }
  if (type->is(TypeKind::array) && type->count == Type::kOpen) {
    type = program_.parser->array_of(type->of, static_cast<std::int64_t>(list.parts.size()));
  }
  Place at{.kind = PlaceKind::cell, .object = new_object(type, text_of(e)), .type = type, .path = text_of(e)};
  const bool is_plain = type->is(TypeKind::array) || (type->is(TypeKind::structure) && !type->structure->is_special);
  if (is_plain || !e.is_new) {
    if (e.text != "empty") fill(at, list);
  } else {
    for (const Expression& one : list.parts) forget_pointed(evaluate(one));
    if (type->is(TypeKind::structure)) forget_shared();
  }
  if (e.is_new && type->is(TypeKind::unknown)) return needed_value(path_of(e));
  if (!e.is_new) return load(at);
  return pointer_value(at.object, 0, type->is(TypeKind::array) ? type->of : type);
}

}  // namespace ninebit::code
