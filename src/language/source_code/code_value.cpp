#include "src/language/source_code/code_value.h"

#include <algorithm>
#include <cmath>

#include "src/language/source/c_operators.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

using ValueKind = Value::Kind;

Value truth(bool value) {
  return integer_value(value ? 1 : 0);
}

Value of_integers(std::string_view op, std::int64_t a, std::int64_t b) {
  const auto result = detail::c_result(op, a, b);
  return result ? integer_value(*result) : Value{};
}

Value of_reals(std::string_view op, double a, double b) {
  if (op == "+") return real_value(a + b);
  if (op == "-") return real_value(a - b);
  if (op == "*") return real_value(a * b);
  if (op == "/" && b != 0) return real_value(a / b);
  if (op == "%" && b != 0) return real_value(std::fmod(a, b));
  const bool less = a < b, equal = a == b;
  if (op == "==") return truth(equal);
  if (op == "!=") return truth(!equal);
  if (op == "<") return truth(less);
  if (op == ">") return truth(!less && !equal);
  if (op == "<=") return truth(less || equal);
  if (op == ">=") return truth(!less);
  return {};
}

bool compares(std::string_view op) {
  return op == "==" || op == "!=" || op == "<" || op == ">" || op == "<=" || op == ">=";
}

// Whether an unknown value is one name, whose last part is written as constants are.
bool names_constant(const Value& value) {
  const std::string_view last = std::string_view(value.symbol).substr(value.symbol.rfind('.') + 1);
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  // Prefixes of a class or a module may be in lower case.
  const std::size_t capitals =
      static_cast<std::size_t>(std::count_if(last.begin(), last.end(), [](char c) { return c >= 'A' && c <= 'Z'; }));
  const std::size_t run =
      last.size() - static_cast<std::size_t>(std::find_if(last.rbegin(), last.rend(), is_lower).base() - last.begin());
  return !value.is_known() && capitals >= 2 && run >= 3;
}

// A symbol is equal to the same name, and to no other name or number.
Value of_symbols(std::string_view op, const Value& a, const Value& b) {
  if (op != "==" && op != "!=") return {};
  const bool named = !a.symbol.empty() && !b.symbol.empty();
  const bool numbered = a.is_number() || b.is_number();
  if (!named && !numbered) return unknown_of(a, b);
  return truth((named && a.symbol == b.symbol) == (op == "=="));
}

}  // namespace

Value integer_value(std::int64_t value) {
  Value out;
  out.kind = ValueKind::integer;
  out.integer = value;
  out.real = static_cast<double>(value);
  return out;
}

Value real_value(double value) {
  Value out;
  out.kind = ValueKind::real;
  out.real = value;
  return out;
}

Value needed_value(const std::string& name) {
  Value out;
  out.symbol = name;
  out.needs.push_back(name);
  return out;
}

void add_needs(std::vector<std::string>& to, const std::vector<std::string>& more) {
  constexpr std::size_t kMostNeeds = 16;
  for (const std::string& name : more) {
    if (to.size() < kMostNeeds && std::find(to.begin(), to.end(), name) == to.end()) to.push_back(name);
  }
}

Value unknown_of(const Value& a, const Value& b) {
  Value out;
  if (!a.is_known()) add_needs(out.needs, a.needs);
  if (!b.is_known()) add_needs(out.needs, b.needs);
  return out;
}

namespace {

// Gives a result the origins of what it was computed from.
Value from(Value result, const Value& a, const Value& b) {
  if (result.is_known()) {
    add_needs(result.origins, a.origins);
    add_needs(result.origins, b.origins);
  }
  return result;
}

Value unary(std::string_view op, const Value& operand) {
  if (!operand.is_known()) return unknown_of(operand, operand);
  if (op == "!") return truth(!is_true(operand));
  if (!operand.is_number()) return {};
  if (op == "+") return operand;
  if (op == "-") {
    if (operand.kind == ValueKind::real) return real_value(-operand.real);
    return of_integers("-", 0, operand.integer);
  }
  return op == "~" && operand.kind == ValueKind::integer ? integer_value(~operand.integer) : Value{};
}

Value binary(std::string_view op, const Value& left, const Value& right) {
  if (left.kind == ValueKind::symbol || right.kind == ValueKind::symbol) return of_symbols(op, left, right);
  if (op == "&&" || op == "||") {
    const bool decides = op == "||";
    for (const Value* const one : {&left, &right}) {
      if (one->is_known() && is_true(*one) == decides) return truth(decides);
    }
    return left.is_known() && right.is_known() ? truth(!decides) : unknown_of(left, right);
  }
  if (!left.is_known() || !right.is_known()) {
    // A constant of another file is not what is asked for.
    if (compares(op) && !left.is_known() && names_constant(right)) return unknown_of(left, left);
    if (compares(op) && !right.is_known() && names_constant(left)) return unknown_of(right, right);
    return unknown_of(left, right);
  }
  if (left.kind == ValueKind::text && right.kind == ValueKind::text && op == "+") {
    Value joined = left;
    joined.begin = std::min(left.begin, right.begin);
    joined.end = std::max(left.end, right.end);
    return joined;
  }
  // Pointers to functions against NULL.
  if (left.kind == ValueKind::entry_point || right.kind == ValueKind::entry_point) {
    const Value& other = left.kind == ValueKind::entry_point ? right : left;
    if ((op != "==" && op != "!=") || other.kind != ValueKind::integer) return {};
    return truth((other.integer != 0) == (op == "=="));
  }
  if (!left.is_number() || !right.is_number()) return {};
  if (left.kind == ValueKind::integer && right.kind == ValueKind::integer) {
    return of_integers(op, left.integer, right.integer);
  }
  return of_reals(op, left.real, right.real);
}

}  // namespace

Value apply_unary(std::string_view op, const Value& operand) {
  return from(unary(op, operand), operand, operand);
}

Value apply_binary(std::string_view op, const Value& left, const Value& right) {
  return from(binary(op, left, right), left, right);
}

bool points_to_struct(const Value& value) {
  return value.kind == Value::Kind::list && value.type.empty() && !value.list.empty() &&
         value.list[0].kind == Value::Kind::list && !value.list[0].type.empty();
}

bool is_true(const Value& value) {
  return value.is_number() ? value.real != 0 : true;
}

namespace {

Value number_of(const Value& value, std::string_view type) {
  switch (type_kind(type)) {
    case TypeKind::real: {
      const bool single = type.find("ouble") == std::string_view::npos && type.find("clampd") == std::string_view::npos;
      return real_value(single ? static_cast<double>(static_cast<float>(value.real)) : value.real);
    }
    case TypeKind::boolean:
      return truth(is_true(value));
    case TypeKind::integer: {
      constexpr double kLargest = 9.0e18;
      if (value.kind == ValueKind::integer) return value;
      return std::abs(value.real) < kLargest ? integer_value(static_cast<std::int64_t>(value.real)) : Value{};
    }
    case TypeKind::other:
      break;
  }
  return value;
}

}  // namespace

Value converted(const Value& value, std::string_view type) {
  if (!value.is_number() || type.empty()) return value;
  return from(number_of(value, type), value, value);
}

bool to_argument(const Value& value, detail::GlArgument& out) {
  if (value.is_number()) {
    out.is_integer = value.kind == ValueKind::integer;
    out.integer = value.integer;
    out.real = value.real;
    return true;
  }
  if (value.kind != ValueKind::list) return false;
  out.is_array = true;
  out.count = value.list.size();
  constexpr std::size_t kRead = 4;  // the most that GL reads of an array
  for (std::size_t i = 0; i < std::min(kRead, value.list.size()); ++i) {
    detail::GlArgument element;
    if (!value.list[i].is_number() || !to_argument(value.list[i], element)) return false;
    out.values.push_back(std::move(element));
  }
  return true;
}

}  // namespace ninebit::code
