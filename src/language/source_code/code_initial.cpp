// Variables: what a name means, and first values.
#include <algorithm>
#include <utility>

#include "src/language/source_code/code_machine.h"

namespace ninebit::code {

// The variable that a name means; memory outside if there is none.
Place Machine::lookup(const Expression& e) {
  const std::string name(e.text);
  Frame& frame = frames_.back();
  if (e.qualifier.empty()) {
    for (auto one = frame.variables.rbegin(); one != frame.variables.rend(); ++one) {
      if (one->name != e.text) continue;
      Place out = one->place;
      out.path = name;
      return out;
    }
    const Type* const self = frame.self.type;
    if (frame.self.object >= 0 && self != nullptr && self->is(TypeKind::structure)) {
      Place out = member(deref(frame.self, integer_value(0), ""), e.text);
      out.path = name;
      if (out.kind != PlaceKind::nowhere) return out;
    }
    const std::string_view scope = frame.function != nullptr ? frame.function->scope : std::string_view();
    if (!scope.empty()) {
      if (auto found = global(std::string(scope) + "::" + name)) return *std::move(found);
    }
  } else if (auto found = global(std::string(e.qualifier) + "::" + name)) {
    return *std::move(found);
  }
  if (auto found = global(name)) return *std::move(found);
  return {.kind = PlaceKind::outside, .path = name, .outside = name};
}

// A variable of the file; empty: there is none.
std::optional<Place> Machine::global(const std::string& name) {
  const auto declared = program_.globals.find(name);
  if (declared == program_.globals.end()) return std::nullopt;
  const Declared& one = *declared->second;
  const bool changes = !one.is_constant && program_.assigned.count(one.name) != 0;
  return static_variable(one, changes, changes);
}

// A variable that is there before any function runs.
Place Machine::static_variable(const Declared& one, bool changes, bool is_global) {
  if (statics_.try_emplace(&one, -1).second) {
    const int made = first_value(one, changes);
    object_at(made).is_constant = one.is_constant;
    object_at(made).is_global = is_global;
    statics_[&one] = made;
  }
  const int object = statics_[&one];
  return object < 0 ? Place{.path = std::string(one.name)} : place_of(object);  // in its own value it is not known
}

// The object of such a variable. Its first value is not logged: no way takes it back.
int Machine::first_value(const Declared& one, bool changes) {
  const std::string name(one.name);
  const Place at = place_of(new_object(sized_type(one), name));
  object_at(at.object).is_static = true;
  const Value* const given = defined(name);
  const bool has_value = !one.value.empty() || (one.is_static && one.scope.empty() && !one.is_extern);
  if (given == nullptr && (changes || !has_value)) return at.object;
  const std::size_t mark = log_.size();
  std::vector<Frame> frames = std::exchange(frames_, std::vector<Frame>(1));
  std::vector<Guard> guards = std::exchange(guards_, {});
  std::vector<Exit> exits = std::exchange(exits_, {});
  if (given != nullptr) {
    store(at, definition_for(*given, at.type, name));
  } else {
    initialize(at, one);
  }
  if (!one.is_constant && given == nullptr) {
    Value origin;
    origin.origins = std::make_shared<const Names>(Names{name});
    assumptions_[name] = {one.offset,
                          "took the initial value of " + detail::quoted(name) + ", which is not a constant"};
    for (Value& cell : object_at(at.object).cells) cell = with_origins(cell, origin);
  }
  frames_ = std::move(frames);
  guards_ = std::move(guards);
  exits_ = std::move(exits);
  log_.resize(mark);
  return at.object;
}

// How many elements a list gives an array without a size.
std::int64_t Machine::open_count(const Expression& list) {
  std::int64_t next = 0, most = 0;
  for (const Expression& one : list.parts) {
    if (one.kind == ExpressionKind::designated && one.parts.size() == 2) {
      const auto index = integer_of(evaluate(one.parts[0]));
      if (!index) return -2;
      next = *index;
    }
    most = std::max(most, ++next);
  }
  return most;
}

// The type of a variable, with as many elements as its value has.
const Type* Machine::sized_type(const Declared& d) {
  if (!d.type->is(TypeKind::array) || d.type->count != Type::kOpen) return d.type;
  const bool is_list = !d.value.empty() && d.value[0].kind == ExpressionKind::list && !d.is_constructed;
  const Type* const type = is_list ? program_.parser->array_of(d.type->of, open_count(d.value[0])) : d.type;
  return type->count == Type::kOpen ? program_.parser->unknown_type() : type;
}

// A variable of a function.
void Machine::declare(const Declared& d) {
  if (d.is_extern && d.value.empty()) return;
  const Expression* const value = d.value.empty() ? nullptr : &d.value[0];
  if (d.is_reference && value != nullptr) {
    const bool is_place = value->kind == ExpressionKind::name || value->kind == ExpressionKind::index ||
                          value->kind == ExpressionKind::member ||
                          (value->kind == ExpressionKind::unary && value->text == "*");
    if (is_place) return bind(d.name, place(*value));
  }
  if (d.is_static && !d.type->is(TypeKind::function)) return bind(d.name, static_variable(d, false, !d.is_constant));
  const Type* type = sized_type(d);
  Value first;
  const bool is_auto = type->name == "auto" && value != nullptr && value->kind != ExpressionKind::list;
  if (is_auto) {
    first = evaluate(*value);
    if (first.is_number()) type = program_.parser->number_type(first.number.kinds);
    if (first.is(ValueKind::pointer) && first.type != nullptr) type = program_.parser->pointer_to(first.type);
    if (first.is(ValueKind::record)) type = first.type;
  }
  const std::string name(d.name);
  const Place at = new_variable(type, d.name);
  if (object_at(at.object).cells.empty()) return;
  const Value* const given = frames_.size() == 1 ? defined(name) : nullptr;
  if (given != nullptr) {
    if (value != nullptr) (void)evaluate(*value);
    const Value whole = definition_for(*given, type, name);
    const std::size_t count = type->is(TypeKind::array) && given->cells ? given->cells->size() : 0;
    for (std::size_t i = 0; i < std::min(count, cells_of(type)); ++i) {
      const auto index = static_cast<std::int64_t>(i);
      Place element = at;
      element.type = object_at(at.object).types[0];
      element.at = index;
      store(element, load(deref(whole, integer_value(index), name)));
    }
    if (!type->is(TypeKind::array) || !whole.is(ValueKind::pointer)) store(at, whole);
  } else if (type->structure != nullptr && type->structure->is_special) {
    construct(d);
  } else if (is_auto) {
    store(at, std::move(first));
  } else if (value != nullptr) {
    initialize(at, d);
  }
  object_at(at.object).is_constant = d.is_constant && value != nullptr;
}

// A class with a constructor, which may do anything with what it is given.
void Machine::construct(const Declared& d) {
  if (!d.value.empty()) {
    const Value made = evaluate(d.value[0]);
    forget_pointed(made);
    const std::vector<Value> list = made.object >= 0 ? object_at(made.object).cells : std::vector<Value>{};
    for (const Value& one : list) forget_pointed(one);
  }
  forget_shared();
  const auto constructors = program_.by_name.find(d.type->structure->name);
  if (constructors == program_.by_name.end()) return;
  for (const Function* const one : constructors->second) {
    if (program_.sets(*one)) report(d.offset, "a constructor sets combiners, and is not followed");
  }
}

void Machine::initialize(const Place& at, const Declared& d) {
  if (d.value.empty()) {
    Expression none;
    none.kind = ExpressionKind::list;
    return fill(at, none);
  }
  const Expression& value = d.value[0];
  if (d.is_constructed) {
    const bool one = value.parts.size() == 1 && !names_vector(at.type->name, 1);
    if (one && !at.type->is(TypeKind::unknown)) return store(at, evaluate(value.parts[0]));
    if (at.type->is(TypeKind::unknown) && names_vector(at.type->name, value.parts.size()))
      return store(at, evaluate(value));
    for (const Expression& part : value.parts) forget_pointed(evaluate(part));
    return;
  }
  if (value.kind == ExpressionKind::list) return fill(at, value);
  Value first = evaluate(value);
  if (!at.type->is(TypeKind::array)) store(at, std::move(first));  // else a text, or what another language gives
}

// Fills a variable from { … }: what the list does not name is 0.
void Machine::fill(const Place& at, const Expression& list) {
  if (at.type == nullptr || at.kind != PlaceKind::cell) return store(at, Value{});
  if (at.type->is(TypeKind::unknown)) return store(at, evaluate(list));
  // Several values are an array of another language. The variable is no array here, so that it is asked for.
  if (!is_whole(at.type) && list.parts.size() > 1) return store(at, Value{});
  if (!is_whole(at.type)) return store(at, list.parts.empty() ? integer_value(0) : evaluate(list.parts[0]));
  std::vector<const Type*> types;
  add_cell_types(at.type, types);
  for (std::size_t i = 0; i < types.size(); ++i) {
    Place one = at;
    one.type = types[i];
    one.at += static_cast<std::int64_t>(i);
    const bool is_opaque = types[i]->is(TypeKind::opaque) || types[i]->is(TypeKind::unknown);
    if (is_inside(one)) store(one, is_opaque ? needed_value(at.path) : integer_value(0));
  }
  (void)spend(types.size() / 8);
  std::size_t next = 0;
  fill_part(at, list.parts, next, true);
}

// The number of the element or the member that [INDEX] = … or .NAME = … means; empty: there is none.
std::optional<std::size_t> Machine::designated(const Expression& part, const Type& type) {
  const bool has_index = part.parts.size() == 2;
  if (type.is(TypeKind::array) != has_index) return std::nullopt;
  if (has_index) {
    const auto index = integer_of(evaluate(part.parts[0]));
    return index && *index >= 0 ? std::optional(static_cast<std::size_t>(*index)) : std::nullopt;
  }
  const auto& members = type.structure->members;
  const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.name == part.text; });
  return static_cast<std::size_t>(found - members.begin());
}

// One array or struct from the parts of a list; without braces of its own it takes as many as it has.
void Machine::fill_part(const Place& at, const std::vector<Expression>& parts, std::size_t& next, bool has_braces) {
  const Type& type = *at.type;
  const bool is_array = type.is(TypeKind::array);
  const std::size_t count =
      is_array ? static_cast<std::size_t>(std::max<std::int64_t>(type.count, 0)) : type.structure->members.size();
  for (std::size_t i = 0; next < parts.size(); ++i) {
    const bool designates = parts[next].kind == ExpressionKind::designated;
    if (designates) {
      if (!has_braces) return;
      i = designated(parts[next], type).value_or(count);
      if (i >= count) return forget_object(at.object);
    }
    if (i >= count) return has_braces ? forget_object(at.object) : void();
    const Expression& part = designates ? parts[next].parts.back() : parts[next];
    Place element = at;
    element.type = is_array ? type.of : type.structure->members[i].type;
    element.at += static_cast<std::int64_t>(is_array ? i * cells_of(type.of) : type.structure->members[i].cell);
    const bool is_struct = element.type->is(TypeKind::structure);
    const Value value =
        is_struct && part.kind != ExpressionKind::list ? quietly([&] { return evaluate(part); }) : integer_value(0);
    const std::size_t before = next++;
    if (part.kind == ExpressionKind::list) {
      fill(element, part);
    } else if (!is_whole(element.type) || value.is(ValueKind::record) || !value.is_known()) {
      store(element, evaluate(part));
    } else if (part.kind == ExpressionKind::text || designates) {
      forget_object(at.object);
      if (designates) return;
    } else {
      next = before;
      fill_part(element, parts, next, false);
      if (next == before) ++next;
    }
  }
}

// { … } without a type: its numbers, one after the other.
Value Machine::list_value(const Expression& e) {
  const Type* const type = program_.parser->unknown_type();
  const int made = new_array(type, e.parts.size(), text_of(e));
  for (std::size_t i = 0; i < e.parts.size(); ++i) {
    const bool designates = e.parts[i].kind == ExpressionKind::designated;
    const Expression& part = designates ? e.parts[i].parts.back() : e.parts[i];
    Value value = converted(evaluate(part), type, text_of(part));
    set_cell({made, static_cast<std::int64_t>(i), {}}, designates ? Value{} : std::move(value));
  }
  return pointer_value(made, 0, type);
}

// An object of elements that are not known.
int Machine::new_array(const Type* element, std::size_t count, const std::string& name) {
  const int made = new_object(element, name);
  object_at(made).types.assign(count, element);
  object_at(made).cells.assign(count, Value{});
  return made;
}

}  // namespace ninebit::code
