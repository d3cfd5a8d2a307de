#include "src/language/source_code/code_value.h"

#include <algorithm>
#include <cmath>

namespace ninebit::code {
namespace {

constexpr std::size_t kMostNames = 12;

std::shared_ptr<const Names> joined(const std::shared_ptr<const Names>& a, const std::shared_ptr<const Names>& b) {
  if (!b || b == a) return a;
  if (!a) return b;
  auto all = std::make_shared<Names>(*a);
  for (const std::string& one : *b) {
    if (all->size() < kMostNames) all->insert(one);
  }
  return all;
}

bool same_names(const std::shared_ptr<const Names>& a, const std::shared_ptr<const Names>& b) {
  return a == b || (a && b && *a == *b);
}

std::int64_t alignment_of(const Type* type) {
  if (type->is(TypeKind::array)) return alignment_of(type->of);
  if (!type->is(TypeKind::structure)) return bytes_of(type);
  std::int64_t most = 1;
  for (const Member& one : type->structure->members) {
    const std::int64_t own = alignment_of(one.type);
    if (own == 0) return 0;
    most = std::max(most, own);
  }
  return most;
}

}  // namespace

Value number_value(const Number& number) {
  return {.kind = ValueKind::number, .number = number};
}

Value integer_value(std::int64_t value) {
  constexpr std::int64_t kBeyond = std::int64_t{1} << 31;
  return number_value(int_number(value, value < kBeyond ? kInt32 : kUint32));
}

Value pointer_value(int object, std::int64_t at, const Type* type) {
  return {.kind = ValueKind::pointer, .object = object, .at = at, .type = type};
}

Value record_value(const Type* type, std::span<const Value> cells) {
  return {.kind = ValueKind::record,
          .type = type,
          .cells = std::make_shared<const std::vector<Value>>(cells.begin(), cells.end())};
}

Value needed_value(const std::string& name, Kinds kinds) {
  Value out;
  out.number.kinds = kinds;
  out.name = name;
  if (!name.empty()) out.needs = std::make_shared<const Names>(Names{name});
  return out;
}

Value unknown_of(const Value& a, const Value& b, Kinds kinds) {
  Value out;
  out.number.kinds = kinds;
  if (!a.is_known()) out.needs = a.needs;
  if (!b.is_known()) out.needs = joined(out.needs, b.needs);
  return out;
}

Value with_origins(Value value, const Value& other) {
  value.origins = joined(value.origins, other.origins);
  return value;
}

bool same(const Value& a, const Value& b) {
  if (a.kind != b.kind || a.number.kinds != b.number.kinds || a.object != b.object) return false;
  switch (a.kind) {
    case ValueKind::unknown:
      return same_names(a.needs, b.needs) && a.name == b.name;
    case ValueKind::number:
      return a.number.integer == b.number.integer && a.number.value() == b.number.value() &&
             std::signbit(a.number.real) == std::signbit(b.number.real);
    case ValueKind::pointer:
      return a.at == b.at;
    case ValueKind::text:
      return a.begin == b.begin && a.end == b.end && a.name == b.name;
    case ValueKind::function:
      return a.function == b.function;
    default:
      return a.name == b.name && a.cells == b.cells;
  }
}

std::optional<bool> truth(const Value& value) {
  switch (value.kind) {
    case ValueKind::unknown:
    case ValueKind::symbol:
    case ValueKind::record:
      return std::nullopt;
    case ValueKind::number:
      return value.number.is_true();
    default:
      return true;
  }
}

std::optional<std::int64_t> integer_of(const Value& value) {
  if (!value.is_number() || (value.number.kinds & ~kReals) == 0) return std::nullopt;
  const auto number = convert(value.number, kInt64);
  return number ? std::optional(number->integer) : std::nullopt;
}

void add_cell_types(const Type* type, std::vector<const Type*>& out) {
  if (type->is(TypeKind::array)) {
    for (std::int64_t i = 0; i < type->count; ++i) add_cell_types(type->of, out);
  } else if (type->is(TypeKind::structure)) {
    for (const Member& one : type->structure->members) add_cell_types(one.type, out);
  } else {
    out.push_back(type);
  }
}

std::int64_t bytes_of(const Type* type) {
  switch (type->kind) {
    case TypeKind::number:
      return size_of(type->kinds);
    case TypeKind::pointer:
      return 8;
    case TypeKind::array:
      return std::max<std::int64_t>(type->count, 0) * bytes_of(type->of);
    case TypeKind::structure: {
      std::int64_t at = 0;
      const std::int64_t whole = alignment_of(type);
      for (const Member& one : type->structure->members) {
        const std::int64_t own = alignment_of(one.type), size = bytes_of(one.type);
        if (own == 0 || size == 0) return 0;
        at = (at + own - 1) / own * own + size;
      }
      return whole == 0 ? 0 : (at + whole - 1) / whole * whole;
    }
    default:
      return 0;
  }
}

}  // namespace ninebit::code
