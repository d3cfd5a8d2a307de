// Variables and what is stored in them.
#include <utility>

#include "src/language/source_code/code_machine.h"
#include "src/system/find_row.h"

namespace ninebit::code {
namespace {

// "a.b[1]" is the memory ".b[1]" of a; empty: a variable alone.
std::string_view behind_root(std::string_view name) {
  const std::size_t at = name.find_first_of(".[", 1);
  return at == std::string_view::npos ? std::string_view() : name.substr(at);
}

bool begins_with_name(std::string_view text, std::string_view prefix) {
  return text.starts_with(prefix) &&
         (text.size() == prefix.size() || text[prefix.size()] == '.' || text[prefix.size()] == '[');
}

std::string name_in(int object, std::int64_t at) {
  return "#" + std::to_string(object) + ":" + std::to_string(at);
}

bool same_size(const Type* a, const Type* b) {
  const bool integers = (a->kinds & kReals) == 0 && (b->kinds & kReals) == 0;
  return integers && size_of(a->kinds) != 0 && size_of(a->kinds) == size_of(b->kinds);
}

// Whether a cell of one type keeps its meaning where it is read or written as another.
bool agree(const Type* own, const Type* as) {
  if (own == as || own->is(TypeKind::unknown) || as->is(TypeKind::unknown)) return true;
  if (own->kind != as->kind) return false;
  return own->is(TypeKind::pointer) || (own->is(TypeKind::number) && (own->kinds == as->kinds || same_size(own, as)));
}

}  // namespace

int Machine::new_object(const Type* type, const std::string& name) {
  Object out;
  add_cell_types(type, out.types);
  out.type = type;
  out.name = name;
  out.cells.resize(out.types.size());
  for (std::size_t i = 0; i < out.cells.size(); ++i) out.cells[i].number.kinds = out.types[i]->kinds;
  (void)spend(out.cells.size() / 8);
  objects_.push_back(std::move(out));
  return static_cast<int>(objects_.size()) - 1;
}

Place Machine::place_of(int object) const {
  const Object& one = object_at(object);
  return {.kind = PlaceKind::cell, .object = object, .type = one.type, .path = one.name};
}

// A variable of the function that is executed.
Place Machine::new_variable(const Type* type, std::string_view name) {
  bind(name, place_of(new_object(type, std::string(name))));
  return frames_.back().variables.back().place;
}

const Value& Machine::cell(const CellKey& key) const {
  static const Value kNothing;
  const auto& [object, at, name] = key;
  if (object >= 0) return object_at(object).cells[static_cast<std::size_t>(at)];
  const auto found = outside_.find(name);
  return found == outside_.end() ? kNothing : found->second;
}

void Machine::set_cell(const CellKey& key, Value value) {
  const auto& [object, at, name] = key;
  Value& now = object >= 0 ? object_at(object).cells[static_cast<std::size_t>(at)] : outside_[name];
  log_.push_back({key, std::exchange(now, std::move(value))});
}

bool Machine::is_inside(const Place& place) const {
  const auto size = static_cast<std::int64_t>(object_at(place.object).cells.size());
  return place.at >= 0 && place.at + static_cast<std::int64_t>(cells_of(place.type)) <= size;
}

// A value as a variable of a type has it.
Value Machine::converted(Value value, const Type* type, const std::string& path) const {
  switch (type->kind) {
    case TypeKind::number: {
      if (value.is_number()) {
        const auto number = convert(value.number, type->kinds);
        return number ? with_origins(number_value(*number), value) : needed_value({}, type->kinds);
      }
      if (value.is(ValueKind::symbol)) return value;
      if (type->kinds == kBool) {
        if (const auto is_true = truth(value)) return number_value(int_number(*is_true ? 1 : 0, kBool));
      }
      if (value.is_known()) return needed_value({}, type->kinds);
      value.number.kinds = type->kinds;
      return value;
    }
    case TypeKind::pointer: {
      const bool is_null = value.is_number() && !value.number.may_be_real() && value.number.integer == 0;
      if ((value.is_number() && !is_null) || value.is(ValueKind::record)) return needed_value({});
      const bool says = !type->of->is(TypeKind::nothing) && !type->of->is(TypeKind::unknown);
      if (says && (value.is(ValueKind::pointer) || !value.is_known())) value.type = type->of;
      return value;
    }
    case TypeKind::structure:
      if (value.is(ValueKind::record) && value.type->structure == type->structure) return value;
      return unknown_of(value, value);
    case TypeKind::unknown:
      if (value.is_number()) {
        const auto number = loosen(value.number);
        return number ? with_origins(number_value(*number), value) : needed_value(path);
      }
      return value;
    default:
      return needed_value({});
  }
}

Value Machine::load_cell(const Place& place) {
  const Object& object = object_at(place.object);
  const Type* const own = object.types[static_cast<std::size_t>(place.at)];
  const Value& value = object.cells[static_cast<std::size_t>(place.at)];
  const Type* const as = place.type;
  if (as == own || as->is(TypeKind::unknown)) return value;
  return agree(own, as) ? converted(value, as, place.path) : needed_value({}, as->kinds);
}

Value Machine::load(const Place& place) {
  Value out;
  if (place.type != nullptr) out.number.kinds = place.type->kinds;
  const bool is_array = place.type != nullptr && place.type->is(TypeKind::array);
  if (place.kind == PlaceKind::cell && is_array) {
    return pointer_value(place.object, place.at, place.type->of);
  }
  if (place.kind == PlaceKind::cell && is_inside(place)) {
    if (place.type->is(TypeKind::structure)) {
      (void)spend(cells_of(place.type) / 8);
      return record_value(
          place.type,
          std::span(object_at(place.object).cells).subspan(static_cast<std::size_t>(place.at), cells_of(place.type)));
    }
    out = load_cell(place);
  } else if (place.kind == PlaceKind::outside) {
    out = cell({-1, 0, place.outside});
    if (!out.is_known() && !out.needs && out.name.empty() && place.outside[0] != '#') out.name = place.outside;
    if (place.type != nullptr && !is_array && !place.type->is(TypeKind::structure)) {
      out = converted(out, place.type, place.path);
    }
    if (is_array) out.type = place.type->of;
  }
  if (!out.is_known() && !out.needs) {
    const bool is_named = place.kind == PlaceKind::outside && place.outside[0] != '#';
    out.needs = place.needs;
    if (!out.needs) out.needs = needed_value(is_named ? place.outside : place.path).needs;
  }
  return out;
}

void Machine::store_cell(const Place& place, Value value) {
  const Type* const own = object_at(place.object).types[static_cast<std::size_t>(place.at)];
  const Type* const as = place.type;
  if (!agree(own, as)) return forget_object(place.object);
  value = converted(converted(std::move(value), as, place.path), own, place.path);
  if (own->is(TypeKind::unknown)) forget_outside(name_in(place.object, place.at));
  set_cell({place.object, place.at, {}}, std::move(value));
}

void Machine::store(const Place& place, Value value) {
  if (place.kind == PlaceKind::nowhere) return forget_all();
  if (place.kind == PlaceKind::somewhere) return forget_object(place.object);
  if (place.kind == PlaceKind::outside) {
    const std::string_view own = behind_root(place.outside);
    if (place.type != nullptr && !place.type->is(TypeKind::structure) && !place.type->is(TypeKind::array)) {
      value = converted(std::move(value), place.type, place.path);
    }
    value = converted(std::move(value), program_.parser->unknown_type(), place.path);
    std::vector<std::string> others;
    for (const auto& [name, one] : outside_) {
      // Forgets the old value's parts, and the same part of another object, which may be the same one.
      const bool part = name != place.outside && begins_with_name(name, place.outside);
      const bool alias = !own.empty() && name != place.outside && place.outside[0] != '#' && name[0] != '#' &&
                         behind_root(name) == own;
      if (part || alias) others.push_back(name);
    }
    for (const std::string& name : others) set_cell({-1, 0, name}, Value{});
    if (!own.empty() && place.outside[0] != '#') forget_shared();
    return set_cell({-1, 0, place.outside}, std::move(value));
  }
  if (!is_inside(place)) return forget_all();
  if (place.type->is(TypeKind::structure)) {
    const std::size_t count = cells_of(place.type);
    const Value whole = converted(std::move(value), place.type, place.path);
    for (std::size_t i = 0; i < count; ++i) {
      const Value part = whole.is(ValueKind::record) && !place.type->structure->is_special ? (*whole.cells)[i]
                                                                                           : unknown_of(whole, whole);
      set_cell({place.object, place.at + static_cast<std::int64_t>(i), {}}, part);
    }
    (void)spend(count / 8);
    return;
  }
  if (place.type->is(TypeKind::array)) return forget_object(place.object);
  store_cell(place, std::move(value));
}

void Machine::forget_object(int object) {
  Object& one = object_at(object);
  if (one.is_constant) return;
  (void)spend(one.cells.size() / 8);
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    Value lost;
    lost.number.kinds = one.types[i]->kinds;
    const Value& now = one.cells[i];
    if (now.is_known() || now.needs || !now.name.empty() || now.object >= 0) {
      set_cell({object, static_cast<std::int64_t>(i), {}}, lost);
    }
    if (one.types[i]->is(TypeKind::unknown)) forget_outside(name_in(object, static_cast<std::int64_t>(i)));
  }
}

// Functions of other files have the object's address from now on. Below 0: no object.
void Machine::escape(int object) {
  if (object < 0) return;
  forget_object(object);
  object_at(object).is_escaped = true;
}

// Forgets what a function of another file may change through a value that it is given, now or later.
void Machine::forget_pointed(const Value& value) {
  if (value.cells) {
    for (const Value& one : *value.cells) forget_pointed(one);
  }
  if (value.object < 0) {
    if (!value.is_known() && !value.name.empty()) forget_outside(value.name);
    return;
  }
  Object& object = object_at(value.object);
  const std::vector<Value> content = object.is_escaped ? std::vector<Value>{} : object.cells;
  object.is_escaped = true;
  forget_object(value.object);
  for (const Value& one : content) {
    if (one.object >= 0) forget_pointed(one);
  }
}

// Memory that no variable of the source is; only that of a name, and its parts.
void Machine::forget_outside(const std::string& prefix) {
  std::vector<std::string> names;
  for (const auto& [name, value] : outside_) {
    if ((prefix.empty() || begins_with_name(name, prefix)) && (value.is_known() || value.needs)) names.push_back(name);
  }
  for (const std::string& name : names) {
    if (prefix.empty() && name[0] == '#') continue;  // of a variable
    set_cell({-1, 0, name}, Value{});
  }
}

// Forgets what code of other files may change.
void Machine::forget_shared() {
  (void)spend(objects_.size() / 16);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i].is_global || objects_[i].is_escaped) forget_object(static_cast<int>(i));
  }
}

void Machine::forget_all() {
  forget_outside();
  (void)spend(objects_.size() / 4);
  for (std::size_t i = 0; i < objects_.size(); ++i) forget_object(static_cast<int>(i));
}

// The place that a pointer and an index lead to.
Place Machine::deref(const Value& pointer, const Value& index, const std::string& path) {
  Place out{.path = path};
  if (!index.is_known()) out.needs = index.needs;
  if (!pointer.is_known() && pointer.name.empty()) out.needs = unknown_of(pointer, index).needs;
  const auto i = integer_of(index);
  if (pointer.object >= 0) {
    out.object = pointer.object;
    out.kind = pointer.is(ValueKind::pointer) && i ? PlaceKind::cell : PlaceKind::somewhere;
    out.type = pointer.type;
    const std::vector<const Type*>& types = object_at(pointer.object).types;
    out.at = pointer.at + i.value_or(0) * static_cast<std::int64_t>(is_vague(out.type) ? 1 : cells_of(out.type));
    if (is_vague(out.type) && out.kind == PlaceKind::cell) {
      const bool inside = out.at >= 0 && out.at < static_cast<std::int64_t>(types.size());
      out.type = inside ? types[static_cast<std::size_t>(out.at)] : program_.parser->unknown_type();
      if (!inside) out.kind = PlaceKind::nowhere;
    }
    return out;
  }
  if (pointer.is_known() || pointer.name.empty() || !i) return out;
  out.kind = PlaceKind::outside;
  out.outside = pointer.name + "[" + std::to_string(*i) + "]";
  out.type = pointer.type;
  return out;
}

Place Machine::member(const Place& object, std::string_view name) {
  Place out = object;
  out.path += "." + std::string(name);
  out.type = nullptr;
  const Type* const type = object.type;
  if (type != nullptr && type->is(TypeKind::structure)) {
    const Member* const found = find_row(type->structure->members, &Member::name, name);
    if (found == nullptr) {
      out.kind = PlaceKind::nowhere;
    } else {
      out.type = found->type;
      out.at += static_cast<std::int64_t>(found->cell);
    }
  } else if (object.kind == PlaceKind::cell && type != nullptr && !type->is(TypeKind::unknown)) {
    out.kind = type->is(TypeKind::opaque) ? PlaceKind::somewhere : PlaceKind::nowhere;
  } else if (object.kind == PlaceKind::cell) {
    out.kind = PlaceKind::outside;
    out.outside = name_in(object.object, object.at);
  }
  if (out.kind == PlaceKind::outside) {
    if (out.outside.ends_with("[0]")) out.outside.resize(out.outside.size() - 3);
    out.outside += "." + std::string(name);
  }
  return out;
}

}  // namespace ninebit::code
