// Functions whose results are known: of OpenGL, of mathematics, constructors of types.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

struct RealFunction {
  std::string_view name;
  double (*function)(double);
};
constexpr std::array kRealFunctions{RealFunction{"sin", [](double x) { return std::sin(x); }},
                                    RealFunction{"cos", [](double x) { return std::cos(x); }},
                                    RealFunction{"tan", [](double x) { return std::tan(x); }},
                                    RealFunction{"sqrt", [](double x) { return std::sqrt(x); }},
                                    RealFunction{"exp", [](double x) { return std::exp(x); }},
                                    RealFunction{"log", [](double x) { return std::log(x); }},
                                    RealFunction{"fabs", [](double x) { return std::abs(x); }},
                                    RealFunction{"abs", [](double x) { return std::abs(x); }},
                                    RealFunction{"floor", [](double x) { return std::floor(x); }},
                                    RealFunction{"ceil", [](double x) { return std::ceil(x); }},
                                    RealFunction{"round", [](double x) { return std::nearbyint(x); }}};

std::string lower_name(std::string_view name) {
  std::string out;
  for (const char c : name) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

bool is_real_function(std::string_view name) {
  return std::any_of(kRealFunctions.begin(), kRealFunctions.end(),
                     [&](const RealFunction& one) { return one.name == name; });
}

// The function's name in lower case, without the f of C's functions of floats.
std::string plain_name(std::string_view called) {
  std::string name = lower_name(called);
  if (name.ends_with('f') && is_real_function(name.substr(0, name.size() - 1))) name.pop_back();
  return name;
}

// How many numbers and pointers a value holds.
std::int64_t numbers_in(const Value& value) {
  if (value.kind != Value::Kind::list) return 1;
  std::int64_t numbers = 0;
  for (const Value& one : value.list) numbers += numbers_in(one);
  return numbers;
}

bool is_of_two(std::string_view name) {
  return name == "pow" || name == "powf" || name == "min" || name == "max" || name == "fmin" || name == "fmax";
}

bool is_of_numbers(std::string_view called) {
  const std::string name = plain_name(called);
  return type_kind(called) != TypeKind::other || is_real_function(name) || is_of_two(name) || is_vector_type(called);
}

}  // namespace

// A function of numbers alone.
std::optional<Value> Machine::call_of_numbers(std::string_view called, const std::vector<Value>& arguments) const {
  const bool numbers = !arguments.empty() && std::all_of(arguments.begin(), arguments.end(),
                                                         [](const Value& one) { return one.is_number(); });
  const std::string name = plain_name(called);
  if (numbers && arguments.size() == 1 && type_kind(called) != TypeKind::other) return converted(arguments[0], called);
  if (numbers && arguments.size() == 1 && is_real_function(name)) {
    const auto* const found = std::find_if(kRealFunctions.begin(), kRealFunctions.end(),
                                           [&](const RealFunction& one) { return one.name == name; });
    const double result = found->function(arguments[0].real);
    const bool whole = arguments[0].kind == Value::Kind::integer && name == "abs";
    return whole ? integer_value(static_cast<std::int64_t>(result)) : real_value(result);
  }
  if (numbers && arguments.size() == 2 && is_of_two(name)) {
    if (name.starts_with("pow")) return real_value(std::pow(arguments[0].real, arguments[1].real));
    const bool first = (arguments[0].real < arguments[1].real) == name.ends_with("min");
    return arguments[first ? 0 : 1];
  }
  // Vec4(1, 0, 0, 1)
  if (numbers && (arguments.size() == 3 || arguments.size() == 4) && is_vector_type(called)) {
    Value out;
    out.kind = Value::Kind::list;
    out.list = arguments;
    return out;
  }
  return std::nullopt;
}

// Empty: nobody knows what the function does.
std::optional<Value> Machine::call_known(std::string_view name, const Expression& e) {
  const std::string lower = lower_name(name);
  if (lower.ends_with("glgeterror")) return integer_value(0);
  const std::size_t count = e.parts.size() - 1;
  if (lower.ends_with("glgetintegerv") && count == 2) {
    const Value what = evaluate(e.parts[1]);
    constexpr std::int64_t kMaxTextureUnits = 0x84E2;
    const HardwareProfile& profile = context_.profile();
    if (what.kind == Value::Kind::integer && what.integer == gl::GL_MAX_GENERAL_COMBINERS_NV) {
      assign(e.parts[2], integer_value(profile.general_combiners.value));
      return Value{};
    }
    const bool units = e.parts[1].text.find("MAX_TEXTURE_UNITS") != std::string_view::npos;
    if (units || (what.kind == Value::Kind::integer && what.integer == kMaxTextureUnits)) {
      assign(e.parts[2], integer_value(profile.texture_units.value));
      return Value{};
    }
    return std::nullopt;
  }
  if (lower == "sizeof" && count == 1) {
    const Value value = evaluate(e.parts[1]);
    constexpr std::int64_t kSizeOfNumber = 4;
    const bool is_element = e.parts[1].kind == ExpressionKind::index && place(e.parts[1]) != nullptr;
    if (!value.is_known() && !is_element) return std::nullopt;
    return integer_value(kSizeOfNumber * numbers_in(value));
  }
  // Whether an extension is there, by its name in a string.
  for (std::size_t i = 1; i <= count; ++i) {
    if (e.parts[i].kind != Expression::Kind::text) continue;
    const std::string_view text = program_.source.text.substr(e.parts[i].offset, e.parts[i].end - e.parts[i].offset);
    const bool asks = lower.find("support") != std::string::npos || lower.find("ext") != std::string::npos ||
                      lower.find("strstr") != std::string::npos || lower.find("has") != std::string::npos ||
                      lower.find("init") != std::string::npos || lower.find("check") != std::string::npos ||
                      lower.find("find") != std::string::npos || lower.find("avail") != std::string::npos;
    if (!asks || text.find("GL_NV_register_combiners") == std::string_view::npos) continue;
    const bool second = text.find("GL_NV_register_combiners2") != std::string_view::npos;
    return integer_value(!second || context_.profile().per_stage_constants ? 1 : 0);
  }
  if (program_.file.language == Language::pascal && (lower == "inc" || lower == "dec") && count > 0) {
    const Value step = count > 1 ? evaluate(e.parts[2]) : integer_value(1);
    assign(e.parts[1], apply_binary(lower == "inc" ? "+" : "-", evaluate(e.parts[1]), step));
    return Value{};
  }
  if (program_.file.language == Language::pascal && count == 1) {
    const bool is_bound = lower == "low" || lower == "high" || lower == "length";
    const Value value = is_bound || lower == "pchar" || lower == "pansichar" ? evaluate(e.parts[1]) : Value{};
    if (value.kind == Value::Kind::text) return value;
    if (is_bound && value.kind == Value::Kind::list) {
      const auto size = static_cast<std::int64_t>(value.list.size());
      return integer_value(lower == "length" ? size : value.low + (lower == "low" ? 0 : size - 1));
    }
  }
  if (auto of_xbox = call_of_xbox(name, e)) return of_xbox;
  if (auto buffer = call_buffer(name, e)) return buffer;
  if (e.parts[0].kind == Expression::Kind::member) {
    const Expression& object = e.parts[0].parts[0];
    Value* const vector = place(object);
    const bool is_text = vector != nullptr && vector->kind == Value::Kind::text;
    if (is_text && count == 0 && (lower == "c_str" || lower == "data")) return *vector;
    if (vector != nullptr && vector->kind == Value::Kind::list) {
      // A vector's own function gives its numbers, or may change them.
      const bool gives = lower.find("ptr") != std::string::npos || lower.find("data") != std::string::npos ||
                         lower.find("array") != std::string::npos || lower.find("value") != std::string::npos;
      if (gives && count == 0) return *vector;
      *vector = needed_value(path_of(object));
    }
  }
  if (count == 1 && detail::is_conversion(name) && program_.by_name.count(program_.key(name)) == 0) {
    return converted(evaluate(e.parts[1]), name);
  }
  if (count == 0 || count > 4 || !is_of_numbers(name)) return std::nullopt;
  std::vector<Value> arguments;
  for (std::size_t i = 1; i <= count; ++i) arguments.push_back(evaluate(e.parts[i]));
  return call_of_numbers(name, arguments);
}

}  // namespace ninebit::code
