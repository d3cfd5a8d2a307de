// The meaning of names, and the places of values.
#include <algorithm>
#include <utility>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_machine.h"
#include "src/language/xbox/xbox_expression.h"

namespace ninebit::code {
namespace {

// Whether a qualifier or an object's name may have OpenGL's names: vtkgl::, GL., NvRegisterCombiners.
bool may_qualify(const Expression& e) {
  if (!e.qualifier.empty()) return true;
  if (e.kind != ExpressionKind::member) return false;
  const Expression& object = e.parts[0];
  if (object.kind != ExpressionKind::name && object.kind != ExpressionKind::member) return false;
  return is_capital(object.text[0]) || object.text.starts_with("gl");
}

}  // namespace

// Whether a name or a text says that an extension of the combiners or of texture shaders is there; empty: it does not
// say.
std::optional<bool> says_extension(std::string_view name, const HardwareProfile& profile) {
  std::string plain = detail::lower_case(name);
  plain.erase(std::remove(plain.begin(), plain.end(), '_'), plain.end());
  if (plain.find("nvtextureshader") != std::string::npos) return profile.texture_shaders.value;
  const std::size_t at = plain.find("registercombiners");
  if (at == std::string::npos) return std::nullopt;
  const bool second = plain.substr(at).starts_with("registercombiners2");
  return !second || profile.per_stage_constants.value;
}

std::string Machine::text_of(const Expression& e) const {
  constexpr std::size_t kLongest = 200;
  std::string out;
  bool blank = false;
  for (const char c : program_.source.text.substr(e.offset, e.end - e.offset)) {
    if (out.size() >= kLongest) break;
    if (detail::is_blank(c)) {
      blank = true;
      continue;
    }
    const bool words = blank && !out.empty() && detail::is_word(out.back()) && detail::is_word(c);
    if (words) out += ' ';
    // Messages show letters of C alone.
    out += c < ' ' || c > '~' ? '?' : c;
    blank = false;
  }
  return out;
}

// The value of a name that has no place: an enumerant, a function of OpenGL, a word of the language.
std::optional<Value> Machine::constant(const Expression& e) const {
  if (const auto exact = detail::value_of_name(e.text)) return integer_value(*exact);
  if (program_.file.reads_stages) {
    if (const auto exact = detail::stage_value_of_name(e.text)) return integer_value(*exact);
  }
  if (e.text.starts_with("PS_")) {
    if (const xbox::Constant* const known = xbox::find_constant(e.text)) return integer_value(known->value);
  }
  if (e.kind == ExpressionKind::name || e.kind == ExpressionKind::member) {
    if (detail::find_gl_call(e.text) != nullptr) {
      if (e.text.find("tage") != std::string_view::npos && !context_.profile().per_stage_constants) {
        return integer_value(0);
      }
      return Value{.kind = ValueKind::entry_point};
    }
  }
  for (const std::string_view word : {"NULL", "nullptr", "null", "GL_NO_ERROR"}) {
    if (e.text == word) return integer_value(0);
  }
  const bool qualified = may_qualify(e);
  const bool is_spelled = e.kind == ExpressionKind::name || (qualified && is_capital(e.text[0])) ||
                          e.text.ends_with("_NV") || e.text.ends_with("_ARB") || e.text.ends_with("_EXT");
  if (const auto spelled = is_spelled ? detail::value_of_spelling(e.text, qualified) : std::nullopt) {
    return integer_value(*spelled);
  }
  if (const auto there = says_extension(e.text, context_.profile())) return integer_value(*there ? 1 : 0);
  return std::nullopt;
}

// The object of OBJECT.MEMBER or OBJECT->MEMBER.
Place Machine::object_of_member(const Expression& e) {
  return e.is_arrow ? deref(evaluate(e.parts[0]), integer_value(0), "") : place(e.parts[0]);
}

// Where an expression's value is stored.
Place Machine::place(const Expression& e) {
  Place out{.path = path_of(e)};
  if (++depth_ > kMostChained) {
    --depth_;
    return out;
  }
  switch (e.kind) {
    case ExpressionKind::name:
      out = lookup(e);
      break;
    case ExpressionKind::index: {
      const Value base = evaluate(e.parts[0]), index = evaluate(e.parts[1]);
      const Expression& array = e.parts[0];
      std::string path = path_of(array);
      if (array.kind == ExpressionKind::index || array.kind == ExpressionKind::member) {
        path = quietly([&] { return place(array).path; });
      }
      const auto known = integer_of(index);
      path += "[" + (known ? std::to_string(*known) : path_of(e.parts[1])) + "]";
      out = deref(base, index, path);
      break;
    }
    case ExpressionKind::member: {
      const Expression& object = e.parts[0];
      const bool is_self = object.kind == ExpressionKind::name && object.text == "this";
      if (is_self && frames_.back().self.object < 0) {
        Expression own = e;
        own.kind = ExpressionKind::name;
        own.parts.clear();
        out = lookup(own);
        break;
      }
      Place whole;
      const std::string path = is_self ? "" : path_of(object);
      if (e.is_arrow || is_self) {
        whole = deref(evaluate(object), integer_value(0), path);
      } else {
        whole = place(object);
        // Another language's object is a pointer.
        const bool may_point = whole.kind == PlaceKind::outside || whole.kind == PlaceKind::cell;
        const bool is_struct = whole.type != nullptr && whole.type->is(TypeKind::structure);
        if (may_point && !is_struct && (whole.kind == PlaceKind::outside || is_inside(whole))) {
          const Value pointer = load(whole);
          const bool is_array = whole.type != nullptr && whole.type->is(TypeKind::array);
          if (pointer.is(ValueKind::pointer) && !is_array) whole = deref(pointer, integer_value(0), whole.path);
        }
      }
      out = member(whole, e.text);
      if (e.is_arrow || is_self) out.path = path + (path.empty() ? "" : ".") + std::string(e.text);
      break;
    }
    case ExpressionKind::unary:
      if (e.text == "*") {
        out = deref(evaluate(e.parts[0]), integer_value(0), out.path);
      } else {
        (void)evaluate(e);
      }
      break;
    case ExpressionKind::make: {
      const Value made = evaluate(e);
      if (made.is(ValueKind::pointer)) out = deref(made, integer_value(0), out.path);
      break;
    }
    case ExpressionKind::call: {
      const Value object = evaluate(e);
      if (object.object >= 0) {
        out = deref(object, integer_value(0), out.path);
      } else if (!object.is_known() && !object.name.empty()) {
        out.kind = PlaceKind::outside;
        out.outside = object.name;
        out.type = object.type;
      }
      break;
    }
    default:
      (void)evaluate(e);
      break;
  }
  --depth_;
  return out;
}

}  // namespace ninebit::code
