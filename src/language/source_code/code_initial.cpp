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
  const std::string own(one.name);
  const auto at_object = [&](int object) {
    Place out = place_of(object);
    out.path = own;
    return out;
  };
  if (const auto known = globals_.find(name); known != globals_.end()) {
    return known->second < 0 ? Place{.path = own} : at_object(known->second);
  }
  globals_[name] = -1;  // in its own value
  const bool changes = !one.is_constant && program_.assigned.count(one.name) != 0;
  const int object = first_value(one, changes);
  object_at(object).is_constant = one.is_constant;
  object_at(object).is_global = changes;
  globals_[name] = object;
  return at_object(object);
}

// A variable that is there before any function runs. Its first value is not logged: no way takes it back.
int Machine::first_value(const Declared& one, bool changes) {
  const std::string name(one.name);
  const Type* const type = sized_type(one);
  const int object = new_object(type, name);
  object_at(object).is_static = true;
  const Value* const given = defined(name);
  const bool has_value = !one.value.empty() || (one.is_static && one.scope.empty() && !one.is_extern);
  if (given == nullptr && (changes || !has_value)) return object;
  const std::size_t mark = log_.size();
  std::vector<Frame> frames = std::exchange(frames_, std::vector<Frame>(1));
  std::vector<Guard> guards = std::exchange(guards_, {});
  std::vector<Exit> exits = std::exchange(exits_, {});
  const Place at = place_of(object);
  if (given != nullptr) {
    store(at, definition_for(*given, type, name));
  } else {
    initialize(at, one);
  }
  if (!one.is_constant && given == nullptr) {
    Value origin;
    origin.origins = std::make_shared<const Names>(Names{name});
    assumptions_[name] = {one.offset,
                          "took the initial value of " + detail::quoted(name) + ", which is not a constant"};
    for (Value& cell : object_at(object).cells) cell = with_origins(cell, origin);
  }
  frames_ = std::move(frames);
  guards_ = std::move(guards);
  exits_ = std::move(exits);
  log_.resize(mark);
  return object;
}

// How many elements a list gives an array without a size.
std::int64_t Machine::open_count(const Expression& list) {
  std::int64_t next = 0, most = 0;
  for (const Expression& one : list.parts) {
    if (one.kind == ExpressionKind::designated && one.parts.size() == 2) {
      const Value index = evaluate(one.parts[0]);
      if (!index.is_number() || index.number.may_be_real()) return -2;
      next = index.number.integer;
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
  const std::string name(d.name);
  const Expression* const value = d.value.empty() ? nullptr : &d.value[0];
  if (d.is_reference && value != nullptr) {
    const bool is_place = value->kind == ExpressionKind::name || value->kind == ExpressionKind::index ||
                          value->kind == ExpressionKind::member ||
                          (value->kind == ExpressionKind::unary && value->text == "*");
    if (is_place) {
      const Place at = place(*value);
      frames_.back().variables.push_back({d.name, at});
      return;
    }
  }
  if (d.is_static && !d.type->is(TypeKind::function)) {
    const auto known = statics_.find(&d);
    const int object = known != statics_.end() ? known->second : first_value(d, false);
    statics_[&d] = object;
    object_at(object).is_constant = d.is_constant;
    object_at(object).is_global = !d.is_constant;
    frames_.back().variables.push_back({d.name, place_of(object)});
    return;
  }
  const Type* type = sized_type(d);
  Value first;
  const bool is_auto = type->name == "auto" && value != nullptr && value->kind != ExpressionKind::list;
  if (is_auto) {
    first = evaluate(*value);
    if (first.is_number()) type = program_.parser->number_type(first.number.kinds);
    if (first.is(ValueKind::pointer) && first.type != nullptr) type = program_.parser->pointer_to(first.type);
    if (first.is(ValueKind::record)) type = first.type;
  }
  const Place at = new_variable(type, d.name);
  if (object_at(at.object).cells.empty()) return;
  const bool is_special = type->structure != nullptr && type->structure->is_special;
  const Value* const given = frames_.size() == 1 ? defined(name) : nullptr;
  if (given != nullptr) {
    if (value != nullptr) (void)evaluate(*value);
    const Value whole = definition_for(*given, type, name);
    if (type->is(TypeKind::array) && whole.is(ValueKind::pointer)) {
      for (std::int64_t i = 0; i < static_cast<std::int64_t>(given->cells ? given->cells->size() : 0); ++i) {
        Place element = at;
        element.type = object_at(at.object).types[0];
        element.at = i;
        if (i < static_cast<std::int64_t>(cells_of(type))) store(element, load(deref(whole, integer_value(i), name)));
      }
    } else {
      store(at, whole);
    }
  } else if (is_special) {
    // A constructor may do anything with what it is given.
    if (value != nullptr) {
      const Value made = evaluate(*value);
      forget_pointed(made);
      const Object* const list = made.object >= 0 ? &object_at(made.object) : nullptr;
      for (const Value& one : list != nullptr ? list->cells : std::vector<Value>{}) forget_pointed(one);
    }
    forget_shared();
    const auto constructors = program_.by_name.find(type->structure->name);
    for (const Function* const one :
         constructors == program_.by_name.end() ? std::vector<const Function*>{} : constructors->second) {
      if (program_.sets(*one)) report(d.offset, "a constructor sets combiners, and is not followed");
    }
  } else if (is_auto) {
    store(at, std::move(first));
  } else if (value != nullptr) {
    initialize(at, d);
  }
  object_at(at.object).is_constant = d.is_constant && value != nullptr;
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
  if (at.type->is(TypeKind::array)) {
    // A text, or what another language gives.
    (void)evaluate(value);
    return;
  }
  store(at, evaluate(value));
}

// Fills a variable from { … }: what the list does not name is 0.
void Machine::fill(const Place& at, const Expression& list) {
  if (at.type == nullptr || at.kind != PlaceKind::cell) return store(at, Value{});
  if (at.type->is(TypeKind::unknown)) return store(at, evaluate(list));
  const bool is_whole = at.type->is(TypeKind::array) || at.type->is(TypeKind::structure);
  // int[] all = {1, 2}, of Java
  if (at.type->is(TypeKind::pointer) && at.type->of->is(TypeKind::number) && list.parts.size() > 1) {
    const Type* const array = program_.parser->array_of(at.type->of, static_cast<std::int64_t>(list.parts.size()));
    const Place made{.kind = PlaceKind::cell, .object = new_object(array, at.path), .type = array, .path = at.path};
    fill(made, list);
    return store(at, load(made));
  }
  if (!is_whole) {
    Value value = list.parts.empty() ? integer_value(0) : evaluate(list.parts[0]);
    return store(at, std::move(value));
  }
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

// One array or struct from the parts of a list; without braces of its own it takes as many as it has.
void Machine::fill_part(const Place& at, const std::vector<Expression>& parts, std::size_t& next, bool has_braces) {
  const Type& type = *at.type;
  const bool is_array = type.is(TypeKind::array);
  const std::size_t count =
      is_array ? static_cast<std::size_t>(std::max<std::int64_t>(type.count, 0)) : type.structure->members.size();
  for (std::size_t i = 0; next < parts.size(); ++i) {
    const Expression* part = &parts[next];
    if (part->kind == ExpressionKind::designated) {
      if (!has_braces) return;
      if (is_array != (part->parts.size() == 2)) return forget_object(at.object);
      if (is_array) {
        const Value index = evaluate(part->parts[0]);
        const bool good = index.is_number() && !index.number.may_be_real() && index.number.integer >= 0;
        if (!good) return forget_object(at.object);
        i = static_cast<std::size_t>(index.number.integer);
      } else {
        const auto& members = type.structure->members;
        const auto found =
            std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.name == part->text; });
        i = static_cast<std::size_t>(found - members.begin());
      }
      part = &part->parts.back();
      if (i >= count) return forget_object(at.object);
    }
    if (i >= count) {
      if (has_braces) forget_object(at.object);
      return;
    }
    Place element = at;
    element.type = is_array ? type.of : type.structure->members[i].type;
    element.at += static_cast<std::int64_t>(is_array ? i * cells_of(type.of) : type.structure->members[i].cell);
    const bool is_whole = element.type->is(TypeKind::array) || element.type->is(TypeKind::structure);
    if (part->kind == ExpressionKind::list) {
      ++next;
      fill(element, *part);
      continue;
    }
    if (is_whole) {
      const bool is_struct = element.type->is(TypeKind::structure);
      const Value value = is_struct ? quietly([&] { return evaluate(*part); }) : Value{};
      if (is_struct && (value.is(ValueKind::record) || !value.is_known())) {
        ++next;
        Value whole = evaluate(*part);
        store(element, std::move(whole));
      } else if (part->kind == ExpressionKind::text) {
        ++next;
        forget_object(at.object);
      } else {
        if (parts[next].kind == ExpressionKind::designated) return forget_object(at.object);
        const std::size_t before = next;
        fill_part(element, parts, next, false);
        if (next == before) ++next;
      }
      continue;
    }
    ++next;
    store(element, evaluate(*part));
    if (!has_braces && i + 1 == count) return;
  }
}

// { … } without a type: its numbers, one after the other.
Value Machine::converted_list(const Expression& e, const Type* type) {
  const int object = new_object(type, text_of(e));
  {
    Object& made = object_at(object);
    made.types.assign(e.parts.size(), type);
    made.cells.assign(e.parts.size(), Value{});
  }
  for (std::size_t i = 0; i < e.parts.size(); ++i) {
    const Expression& part = e.parts[i].kind == ExpressionKind::designated ? e.parts[i].parts.back() : e.parts[i];
    Value value = evaluate(part);
    if (e.parts[i].kind == ExpressionKind::designated) value = Value{};
    store({.kind = PlaceKind::cell,
           .object = object,
           .at = static_cast<std::int64_t>(i),
           .type = type,
           .path = text_of(part)},
          std::move(value));
  }
  return pointer_value(object, 0, type);
}

}  // namespace ninebit::code
