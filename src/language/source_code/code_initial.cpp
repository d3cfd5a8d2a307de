// The values that declarations give to their names.
#include <algorithm>
#include <utility>

#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

// The most elements that declarations without values make.
constexpr std::size_t kMostMadeElements = std::size_t{1} << 18;

// Elements that are not known yet are known if `name` is defined.
void name_unknowns(Value& value, const std::string& name) {
  if (!value.is_known() && value.needs.empty()) value.needs.push_back(name);
  for (Value& element : value.list) name_unknowns(element, name);
}

}  // namespace

void Machine::declare(const Declared& declared) {
  Value value = initial(declared);
  if (!declared.value.empty()) add_alias(declared.name, declared.value[0], frames_.back());
  frames_.back().values[program_.key(declared.name)] = std::move(value);
}

// The value that a declaration gives to its name.
Value Machine::initial(const Declared& declared) {
  const auto members = program_.outline.structs.find(declared.type);
  const bool is_struct = members != program_.outline.structs.end();
  if (program_.outline.unions.count(declared.type) != 0) return needed_value(program_.key(declared.name));
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
    // The elements of an array of structs: a pointer to the first.
    const bool points = !value.list.empty() && value.list[0].kind == Value::Kind::list &&
                        value.list[0].type == declared.type && value.type.empty();
    if (members != program_.outline.structs.end() && !points) {
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

// The only struct that has all the members that a list names; end: there is none, or several in other orders.
std::map<std::string_view, Members>::const_iterator Machine::designated_struct(const Expression& e) const {
  const auto& structs = program_.outline.structs;
  const auto has_all = [&](const Members& members) {
    return std::all_of(e.parts.begin(), e.parts.end(), [&](const Expression& part) {
      const bool names = part.kind == ExpressionKind::assignment && part.text != kDesignatedElement;
      return !names || std::find(members.begin(), members.end(), part.parts[0].text) != members.end();
    });
  };
  auto found = structs.end();
  for (auto one = structs.begin(); one != structs.end(); ++one) {
    if (!has_all(one->second)) continue;
    if (found != structs.end() && found->second != one->second) return structs.end();
    found = one;
  }
  return found;
}

Value Machine::evaluate_list(const Expression& e) {
  Value out;
  out.kind = Value::Kind::list;
  if (e.parts.size() > kMostElements) return {};
  const bool is_designated = std::any_of(
      e.parts.begin(), e.parts.end(), [](const Expression& part) { return part.kind == ExpressionKind::assignment; });
  const auto type = is_designated ? designated_struct(e) : program_.outline.structs.end();
  std::size_t at = 0;
  for (const Expression& part : e.parts) {
    const bool designates = part.kind == ExpressionKind::assignment;
    if (designates && part.text == kDesignatedElement) {
      const Value index = evaluate(part.parts[0]);
      const bool fits = index.kind == Value::Kind::integer && index.integer >= 0 &&
                        index.integer < static_cast<std::int64_t>(kMostElements);
      if (!fits) return {};
      at = static_cast<std::size_t>(index.integer);
    } else if (designates) {
      if (type == program_.outline.structs.end()) return {};
      const Members& members = type->second;
      at = static_cast<std::size_t>(std::find(members.begin(), members.end(), part.parts[0].text) - members.begin());
    }
    while (out.list.size() <= at) out.list.push_back(integer_value(0));
    out.list[at++] = evaluate(designates ? part.parts[1] : part);
  }
  return out;
}

}  // namespace ninebit::code
