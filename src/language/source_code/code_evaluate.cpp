// Evaluates expressions.
#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

// The place of a member that names one of a vector's numbers; -1: none.
int component_of(std::string_view member) {
  constexpr std::array<std::string_view, 3> kLetters{"xyzw", "rgba", "RGBA"};
  if (member.size() != 1) return -1;
  for (const std::string_view letters : kLetters) {
    const std::size_t at = letters.find(member[0]);
    if (at != std::string_view::npos) return static_cast<int>(at);
  }
  return -1;
}

// 'a' and '\n' as numbers.
Value character(std::string_view text) {
  if (text.size() < 3) return {};
  if (text[1] != '\\') return integer_value(static_cast<unsigned char>(text[1]));
  const char c = text[2];
  return integer_value(c == 'n' ? 10 : c == 't' ? 9 : c == 'r' ? 13 : c == '0' ? 0 : c);
}

// The elements of an array from an index on, as &array[2] and array + 2 are; unknown: there is none.
Value elements_from(Value array, const Value& index) {
  const std::int64_t at = index.integer - array.low;
  const bool inside = array.kind == Value::Kind::list && index.kind == Value::Kind::integer && at >= 0 &&
                      at < static_cast<std::int64_t>(array.list.size());
  if (!inside) return unknown_of(array, index);
  array.list.erase(array.list.begin(), array.list.begin() + static_cast<std::ptrdiff_t>(at));
  array.low = 0;
  return array;
}

}  // namespace

Value Machine::number(std::string_view text) const {
  if (text.empty()) return {};
  if (text.front() == '\'') return character(text);
  std::string digits(text);
  if (digits.front() == '$') digits.replace(0, 1, "0x");  // Pascal's
  std::erase(digits, '_');
  std::erase(digits, '\'');
  // In Java and C#, 1f and 1d are real numbers.
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  const bool whole = !hex && digits.find_first_of(".eE") == std::string::npos;
  const bool java =
      !hex && digits.size() > 1 &&
      (digits.back() == 'd' || digits.back() == 'D' || (whole && (digits.back() == 'f' || digits.back() == 'F')));
  if (java) digits.pop_back();
  detail::GlArgument read;
  const bool pascal = program_.file.language == Language::pascal;
  // In Pascal, 010 is ten.
  while (pascal && digits.size() > 1 && digits[0] == '0' && detail::is_digit(digits[1])) digits.erase(0, 1);
  if (!detail::read_gl_number(digits, read)) return {};
  return read.is_integer && !java ? integer_value(read.integer) : real_value(read.real);
}

Value Machine::evaluate(const Expression& e) {
  if (depth_ >= 4 * kMostNestedExpressions + kMostChained || !spend()) return {};
  ++depth_;
  Value out = evaluate_once(e);
  --depth_;
  return out;
}

Value Machine::evaluate_once(const Expression& e) {
  switch (e.kind) {
    case ExpressionKind::unreadable: {
      Value out = needed_value(text_of(e));
      if (const Value* const given = defined(out.symbol)) return *given;
      return out;
    }
    case ExpressionKind::number:
      return number(e.text);
    case ExpressionKind::text: {
      Value out;
      out.kind = Value::Kind::text;
      out.begin = e.offset;
      out.end = e.end;
      if (e.is_pasted) out.symbol = std::string(e.text);
      return out;
    }
    case ExpressionKind::name:
      return value_of(e);
    case ExpressionKind::unary:
      return evaluate_unary(e);
    case ExpressionKind::binary: {
      if (e.text == ",") {
        evaluate(e.parts[0]);
        return evaluate(e.parts[1]);
      }
      const Value left = evaluate(e.parts[0]);
      // The right side is not executed where C does not.
      if ((e.text == "&&" || e.text == "||") && left.is_known() && is_true(left) == (e.text == "||")) {
        return integer_value(e.text == "||" ? 1 : 0);
      }
      const Value right = evaluate(e.parts[1]);
      if (e.text == "+" && left.kind == Value::Kind::list) return elements_from(left, right);
      return apply_binary(e.text, left, right);
    }
    case ExpressionKind::assignment:
      return evaluate_assignment(e);
    case ExpressionKind::conditional: {
      const Value condition = evaluate(e.parts[0]);
      if (condition.is_known()) return evaluate(e.parts[is_true(condition) ? 1 : 2]);
      const Value yes = evaluate(e.parts[1]), no = evaluate(e.parts[2]);
      const Value same = apply_binary("==", yes, no);
      return same.is_known() && is_true(same) ? yes : unknown_of(condition, condition);
    }
    case ExpressionKind::call:
      return call(e);
    case ExpressionKind::index:
      return evaluate_index(e);
    case ExpressionKind::member:
      return evaluate_member(e);
    case ExpressionKind::list:
      return evaluate_list(e);
    case ExpressionKind::cast:
      return converted(evaluate(e.parts[0]), e.text);
  }
  return {};
}

Value Machine::evaluate_unary(const Expression& e) {
  const Expression& operand = e.parts[0];
  if (!is_pure(operand) && operand.kind == ExpressionKind::index) {
    Expression once = e;
    once.parts[0] = settled(operand);
    if (is_pure(once.parts[0])) return evaluate_unary(once);
  }
  if (e.text == "++" || e.text == "--" || e.text == "post++" || e.text == "post--") {
    const Value before = evaluate(operand);
    const Value after = apply_binary(e.text.ends_with("++") ? "+" : "-", before, integer_value(1));
    assign(operand, after);
    return e.text.starts_with("post") ? before : after;
  }
  if (e.text == "&") {
    // &array[0], &color.r and &color are all the array's numbers; &array[2] are those from there.
    if (const Value* const given = defined(path_of(operand))) return *given;
    const bool element = operand.kind == ExpressionKind::index;
    const bool component = operand.kind == ExpressionKind::member && component_of(operand.text) == 0;
    if (element || component) {
      Value array = evaluate(operand.parts[0]);
      if (array.kind == Value::Kind::list && component) return array;
      const Value index = element ? evaluate(operand.parts[1]) : integer_value(0);
      Value from = elements_from(std::move(array), index);
      if (from.is_known()) return from;
    }
    Value value = evaluate(operand);
    if (!value.is_number()) return value;
    Value one;  // of one number
    one.kind = Value::Kind::list;
    one.list.push_back(std::move(value));
    return one;
  }
  Value value = evaluate(operand);
  if (e.text == "*") {
    if (value.kind == Value::Kind::list && value.type.empty() && !value.list.empty()) return value.list[0];
    return value;
  }
  return apply_unary(e.text, value);
}

Value Machine::evaluate_assignment(const Expression& e) {
  if (!is_pure(e.parts[0])) {
    Expression once = e;
    once.parts[0] = settled(e.parts[0]);
    if (is_pure(once.parts[0])) return evaluate_assignment(once);
  }
  if (const NamedWord word = named_word(e.parts[0]); word.field != nullptr) return assign_word(word, e);
  look_for_misspelled_member(e.parts[0]);
  Value value = evaluate(e.parts[1]);
  if (e.text != "=") {
    value = apply_binary(e.text.substr(0, e.text.size() - 1), evaluate(e.parts[0]), value);
  }
  // Integers stay integers, and floats floats.
  if (const Value* const target = place(e.parts[0])) {
    if (target->kind == Value::Kind::integer && value.kind == Value::Kind::real) value = converted(value, "int");
  }
  assign(e.parts[0], value);
  return value;
}

Value Machine::evaluate_index(const Expression& e) {
  if (!is_pure(e)) {
    const Expression once = settled(e);
    if (is_pure(once)) return evaluate_index(once);
  }
  if (const auto word = assigned_word(e)) return *word;
  const Value index = evaluate(e.parts[1]);
  const std::string path = path_of(e);
  if (const Value* const given = defined(path)) return *given;
  // An array that is stored is not copied for one of its elements.
  const Value* const stored_array = place(e.parts[0]);
  const Value array =
      stored_array != nullptr && stored_array->kind == Value::Kind::list ? Value{} : evaluate(e.parts[0]);
  const Value& from = stored_array != nullptr && stored_array->kind == Value::Kind::list ? *stored_array : array;
  if (from.kind == Value::Kind::list) {
    if (!index.is_known()) return unknown_of(index, index);
    const std::int64_t at = index.integer - from.low;
    const bool inside =
        index.kind == Value::Kind::integer && at >= 0 && at < static_cast<std::int64_t>(from.list.size());
    return inside ? from.list[static_cast<std::size_t>(at)] : Value{};
  }
  if (const Value* const known = stored(path)) return *known;
  if (!array.is_known() && !array.symbol.empty() && index.is_known()) return needed_value(path);
  return unknown_of(array, index);
}

Value Machine::evaluate_member(const Expression& e) {
  if (const auto word = assigned_word(e)) return *word;
  const std::string path = path_of(e);
  if (const Value* const given = defined(path)) return *given;
  if (const Value* const known = stored(path)) return *known;
  if (const auto known = constant(e)) return *known;
  Value object = evaluate(e.parts[0]);
  if (points_to_struct(object)) object = Value(object.list[0]);
  if (object.kind == Value::Kind::list) {
    const auto members = program_.outline.structs.find(object.type);
    std::size_t at = object.list.size();
    if (members != program_.outline.structs.end() && !object.type.empty()) {
      const auto found = std::find(members->second.begin(), members->second.end(), e.text);
      at = static_cast<std::size_t>(found - members->second.begin());
    } else if (const int component = component_of(e.text); component >= 0) {
      at = static_cast<std::size_t>(component);
    } else if (e.text == "length" || e.text == "Length") {
      return integer_value(static_cast<std::int64_t>(object.list.size()));
    } else {
      return object;  // .v, .data: the numbers
    }
    return at < object.list.size() ? std::move(object.list[at]) : Value{};
  }
  return !object.is_known() && object.symbol.empty() && !object.needs.empty() ? object : needed_value(path);
}

}  // namespace ninebit::code
