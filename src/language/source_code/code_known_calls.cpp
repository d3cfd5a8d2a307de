// Functions whose results are known: of OpenGL, of mathematics, of memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {
namespace {

struct RealFunction {
  std::string_view name;
  double (*function)(double);
  float (*single)(float);
  bool is_exact;  // rounding apart, every library gives the same
};
constexpr std::array kRealFunctions{
    RealFunction{"sin", [](double x) { return std::sin(x); }, [](float x) { return std::sin(x); }, false},
    RealFunction{"cos", [](double x) { return std::cos(x); }, [](float x) { return std::cos(x); }, false},
    RealFunction{"tan", [](double x) { return std::tan(x); }, [](float x) { return std::tan(x); }, false},
    RealFunction{"exp", [](double x) { return std::exp(x); }, [](float x) { return std::exp(x); }, false},
    RealFunction{"log", [](double x) { return std::log(x); }, [](float x) { return std::log(x); }, false},
    RealFunction{"sqrt", [](double x) { return std::sqrt(x); }, [](float x) { return std::sqrt(x); }, true},
    RealFunction{"fabs", [](double x) { return std::abs(x); }, [](float x) { return std::abs(x); }, true},
    RealFunction{"floor", [](double x) { return std::floor(x); }, [](float x) { return std::floor(x); }, true},
    RealFunction{"ceil", [](double x) { return std::ceil(x); }, [](float x) { return std::ceil(x); }, true},
    RealFunction{"trunc", [](double x) { return std::trunc(x); }, [](float x) { return std::trunc(x); }, true},
    RealFunction{"round", [](double x) { return std::round(x); }, [](float x) { return std::round(x); }, true}};

// A function of floats has an f at its end; in C++, the other name has floats, too.
std::optional<Number> real_result(const RealFunction& known, bool is_single, const Number& argument) {
  const auto of_double = convert(argument, kFloat64), of_float = convert(argument, kFloat32);
  if (!of_double || !of_float) return std::nullopt;
  const double exact = known.function(of_double->real);
  const Number whole = real_number(exact);
  const Number single = real_number(static_cast<double>(known.single(static_cast<float>(of_float->real))), kFloat32);
  if (!known.is_exact) {
    // Libraries differ in the last bit of a double: a float that it could change is not known.
    const double slack = std::abs(exact) * 4e-16;
    if (static_cast<float>(exact - slack) != static_cast<float>(exact + slack)) return std::nullopt;
    if (argument.kinds == kFloat32 && single.real != static_cast<double>(static_cast<float>(exact)))
      return std::nullopt;
  }
  if (is_single) return single;
  // An inexact double is known as a float alone.
  if (!known.is_exact) return Number{kReals, 0, exact};
  return argument.kinds == kFloat32 ? either(single, whole) : std::optional(whole);
}

}  // namespace

// A function of numbers alone.
std::optional<Value> Machine::call_of_numbers(std::string_view name, const std::vector<Value>& arguments) const {
  Value origins;
  for (const Value& one : arguments) {
    if (!one.is_number()) return std::nullopt;
    origins = with_origins(origins, one);
  }
  const auto result = [&](const std::optional<Number>& number) {
    return with_origins(number ? number_value(*number) : needed_value({}), origins);
  };
  if (arguments.size() == 1) {
    const Number& x = arguments[0].number;
    for (const RealFunction& one : kRealFunctions) {
      const bool single = name.size() == one.name.size() + 1 && name.ends_with('f') && name.starts_with(one.name);
      if (name == one.name || single) return result(real_result(one, single, x));
    }
    // C converts the argument to int, C++ does not.
    if (name == "abs") {
      if (!x.may_be_real()) return result(x.integer < 0 ? calculate("-", x) : calculate("+", x));
      const auto whole = convert(x, kInt32);
      const bool same_in_both = whole && static_cast<double>(whole->integer) == x.real;
      return result(same_in_both ? loosen(int_number(std::abs(whole->integer))) : std::nullopt);
    }
  }
  if (arguments.size() == 2) {
    const Number &x = arguments[0].number, &y = arguments[1].number;
    const auto a = convert(x, kFloat64), b = convert(y, kFloat64);
    const bool reals = a && b && x.may_be_real() && y.may_be_real();
    if ((name == "fmod" || name == "fmodf") && reals && b->real != 0) {
      const bool floats = x.kinds == kFloat32 && y.kinds == kFloat32;
      const double rest = std::fmod(a->real, b->real);
      return result(Number{name == "fmodf" ? kFloat32 : floats ? kReals : kFloat64, 0, rest});
    }
    if ((name == "pow" || name == "powf") && a && b) {
      const double power = std::pow(a->real, b->real), slack = std::abs(power) * 4e-16;
      const bool sure = static_cast<float>(power - slack) == static_cast<float>(power + slack);
      const bool exact = name == "pow" || x.kinds == kFloat32;
      return result(sure && exact ? std::optional(Number{kReals, 0, power}) : std::nullopt);
    }
    const bool least = name == "min" || name == "fmin" || name == "fminf" || name == "MIN";
    const bool most = name == "max" || name == "fmax" || name == "fmaxf" || name == "MAX";
    if (least || most) {
      const auto less = calculate("<", x, y);
      if (!less) return result(std::nullopt);
      return result(convert(less->is_true() == least ? x : y, common_kinds(x.kinds, y.kinds)));
    }
  }
  return std::nullopt;
}

// memset, memcpy and their kin.
std::optional<Value> Machine::call_of_memory(std::string_view name, const Expression& e) {
  const std::size_t count = e.parts.size() - 1;
  const bool zeroes = name == "ZeroMemory" || name == "bzero";
  const bool copies = (name == "memcpy" || name == "memmove" || name == "CopyMemory") && count == 3;
  const bool sets = name == "memset" && count == 3;
  if (!copies && !sets && !(zeroes && count == 2)) return std::nullopt;
  const Value to = evaluate(e.parts[1]);
  const Value from = zeroes ? integer_value(0) : evaluate(e.parts[2]);
  const auto size = integer_of(evaluate(e.parts[count]));
  const auto give_up = [&] {
    to.object >= 0 ? forget_object(to.object) : forget_all();
    return to;
  };
  if (!to.is(ValueKind::pointer) || !size || *size < 0) return give_up();
  const Object& object = object_at(to.object);
  // As many cells as the bytes cover.
  std::int64_t cells = 0;
  if (to.type != nullptr && bytes_of(to.type) == *size && *size > 0) {
    cells = static_cast<std::int64_t>(cells_of(to.type));
  } else {
    const auto first = static_cast<std::size_t>(std::max<std::int64_t>(to.at, 0));
    const std::int64_t each = first < object.types.size() ? bytes_of(object.types[first]) : 0;
    if (each == 0 || *size % each != 0) return give_up();
    cells = *size / each;
    for (std::int64_t i = 0; i < cells; ++i) {
      const auto at = static_cast<std::size_t>(to.at + i);
      if (to.at + i < 0 || at >= object.types.size() || bytes_of(object.types[at]) != each) return give_up();
    }
  }
  if (to.at < 0 || static_cast<std::size_t>(to.at + cells) > object.cells.size()) return give_up();
  const bool clears = (zeroes || sets) && from.is_number() && !from.number.may_be_real() && from.number.integer == 0;
  if (!copies && !clears) return give_up();
  std::vector<Value> values;
  for (std::int64_t i = 0; i < cells; ++i) {
    const Type* const type = object_at(to.object).types[static_cast<std::size_t>(to.at + i)];
    if (copies) {
      Value source = from;
      source.type = nullptr;
      const Place at = deref(source, integer_value(i), "");
      if (at.kind != PlaceKind::cell || at.type != type) return give_up();
      values.push_back(load_cell(at));
    } else {
      const bool has_zero = type->is(TypeKind::number) || type->is(TypeKind::pointer);
      values.push_back(has_zero ? converted(integer_value(0), type, "") : Value{});
    }
  }
  for (std::int64_t i = 0; i < cells; ++i) {
    set_cell({to.object, to.at + i, {}}, std::move(values[static_cast<std::size_t>(i)]));
  }
  (void)spend(static_cast<std::size_t>(cells) / 8);
  return to;
}

// Empty: nobody knows what the function does.
std::optional<Value> Machine::call_known(std::string_view name, const Expression& e) {
  const std::string lower = detail::lower_case(name);
  if (lower.ends_with("glgeterror")) return integer_value(0);
  const std::size_t count = e.parts.size() - 1;
  const Expression& callee = e.parts[0];
  if (lower.ends_with("getintegerv") && count == 2) {
    const Value what = evaluate(e.parts[1]);
    constexpr std::int64_t kMaxTextureUnits = 0x84E2;
    const HardwareProfile& profile = context_.profile();
    const bool known = what.is_number();
    const bool combiners = known && what.number.integer == gl::GL_MAX_GENERAL_COMBINERS_NV;
    const bool units = e.parts[1].text.find("MAX_TEXTURE_UNITS") != std::string_view::npos ||
                       (known && what.number.integer == kMaxTextureUnits);
    if (!combiners && !units) return std::nullopt;
    store(deref(evaluate(e.parts[2]), integer_value(0), path_of(e.parts[2])),
          integer_value(combiners ? profile.general_combiners.value : profile.texture_units.value));
    return Value{};
  }
  // Whether an extension is there, by its name in a string.
  for (std::size_t i = 1; i <= count; ++i) {
    if (e.parts[i].kind != ExpressionKind::text) continue;
    const std::string_view text = program_.source.text.substr(e.parts[i].offset, e.parts[i].end - e.parts[i].offset);
    const auto there = contains_any(lower, {"support", "ext", "strstr", "has", "init", "check", "find", "avail"})
                           ? says_extension(text, context_.profile())
                           : std::nullopt;
    if (there) return integer_value(*there ? 1 : 0);
  }
  if (auto of_xbox = call_of_xbox(name, e)) return of_xbox;
  if (auto memory = call_of_memory(name, e)) return memory;
  if (callee.kind == ExpressionKind::member && count == 0) {
    // A vector's own function gives its numbers.
    const bool gives = contains_any(lower, {"ptr", "data", "array", "value", "c_str"});
    const Value object = gives ? evaluate(callee.parts[0]) : Value{};
    if (object.is(ValueKind::text) || (object.is(ValueKind::pointer) && callee.parts[0].kind == ExpressionKind::name)) {
      return object;
    }
  }
  if (callee.kind != ExpressionKind::name) return std::nullopt;
  if (count == 1 && detail::is_conversion(name)) return evaluate(e.parts[1]);
  if (names_vector(name, count) && program_.prototypes.count(name) == 0) {
    Expression list = e;
    list.kind = ExpressionKind::list;
    list.parts.erase(list.parts.begin());
    return list_value(list);
  }
  if (count == 0 || count > 2 || !callee.qualifier.empty()) return std::nullopt;
  const auto quiet = quietly([&] {
    std::vector<Value> values(count, number_value(real_number(0.5)));
    return call_of_numbers(name, values).has_value();
  });
  if (!quiet) return std::nullopt;
  std::vector<Value> arguments;
  for (std::size_t i = 1; i <= count; ++i) arguments.push_back(evaluate(e.parts[i]));
  if (auto known = call_of_numbers(name, arguments)) return known;
  return unknown_of(arguments[0], arguments.back());
}

}  // namespace ninebit::code
