// Names, and the places that they stand for.
#include <algorithm>
#include <array>
#include <utility>

#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"
#include "src/language/xbox/xbox_macros.h"

namespace ninebit::code {
namespace {

constexpr std::string_view kExtension = "register_combiners", kSecondExtension = "register_combiners2";

// Whether a name says that the combiners' extension is there: GLEW_NV_register_combiners, hasRegisterCombiners, …
std::optional<bool> says_extension(std::string_view name, const HardwareProfile& profile) {
  std::string plain = lower_case(name);
  if (plain.find("registercombiners") != std::string::npos) plain.insert(plain.find("registercombiners") + 8, "_");
  const std::size_t at = plain.find(kExtension);
  const bool counts = plain.find("num") != std::string::npos || plain.find("max") != std::string::npos ||
                      plain.find("count") != std::string::npos;
  if (at == std::string::npos || counts) return std::nullopt;
  const bool second = plain.substr(at).starts_with(kSecondExtension);
  return !second || profile.per_stage_constants;
}

bool is_self(std::string_view name) {
  return name == "this" || name == "self" || name == "Self" || name == "me";
}

}  // namespace

std::string Program::key(std::string_view name) const {
  return file.language == Language::pascal ? lower_case(name) : std::string(name);
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
    out += words ? std::string(" ") + c : std::string(1, c);
    blank = false;
  }
  // What is not a letter of C has no place in a message.
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

// The name under which a place is stored and defined, with . for ->; of other expressions their text.
std::string Machine::path_of(const Expression& e) {
  switch (e.kind) {
    case ExpressionKind::name:
      return program_.key(e.text);
    case ExpressionKind::member: {
      const Expression& object = e.parts[0];
      const std::string member = program_.key(e.text);
      if (object.kind == ExpressionKind::name && is_self(object.text)) return member;
      return path_of(object) + "." + member;
    }
    case ExpressionKind::index: {
      const Value index = is_pure(e.parts[1]) ? evaluate(e.parts[1]) : Value{};
      const bool known = index.kind == Value::Kind::integer;
      return path_of(e.parts[0]) + "[" + (known ? std::to_string(index.integer) : text_of(e.parts[1])) + "]";
    }
    case ExpressionKind::call: {
      std::string out = path_of(e.parts[0]) + "(";
      for (std::size_t i = 1; i < e.parts.size(); ++i) out += (i > 1 ? "," : "") + normal_path(text_of(e.parts[i]));
      return out + ")";
    }
    case ExpressionKind::cast:
      return path_of(e.parts[0]);
    case ExpressionKind::unary:
      if (e.text == "*" || e.text == "&") return path_of(e.parts[0]);
      return normal_path(text_of(e));
    default:
      return normal_path(text_of(e));
  }
}

const Value* Machine::defined(const std::string& path) {
  const auto found = definitions_.find(path);
  if (found == definitions_.end()) return nullptr;
  used_.insert(path);
  return &found->second;
}

// Whether evaluating an expression changes nothing.
bool Machine::is_pure(const Expression& e) {
  const bool steps = e.kind == ExpressionKind::unary && (e.text.ends_with("++") || e.text.ends_with("--"));
  if (steps || e.kind == ExpressionKind::assignment || e.kind == ExpressionKind::call) return false;
  return std::all_of(e.parts.begin(), e.parts.end(), [](const Expression& part) { return is_pure(part); });
}

// A place whose indices are evaluated, each once: a[i++] is a[3].
Expression Machine::settled(const Expression& e) {
  Expression out = e;
  if (!out.parts.empty() && out.kind != ExpressionKind::call) out.parts[0] = settled(e.parts[0]);
  if (e.kind != ExpressionKind::index || is_pure(e.parts[1])) return out;
  const Value index = evaluate(e.parts[1]);
  if (index.kind != Value::Kind::integer) return out;
  texts_.push_back(std::to_string(index.integer));
  Expression number;
  number.kind = ExpressionKind::number;
  number.text = texts_.back();
  number.offset = e.parts[1].offset;
  number.end = e.parts[1].end;
  out.parts[1] = std::move(number);
  return out;
}

// Marks a value and its elements as the first one of a variable.
void Machine::mark_origin(Value& value, const std::string& path) {
  value.origins.assign(1, path);
  for (Value& element : value.list) mark_origin(element, path);
}

// A variable of the function, or of the file.
Value* Machine::stored(const std::string& path) {
  if (!frames_.empty()) {
    auto& values = frames_.back().values;
    if (const auto local = values.find(path); local != values.end()) return &local->second;
  }
  if (const auto known = globals_.find(path); known != globals_.end()) return &known->second;
  const auto global = program_.globals.find(path);
  if (global == program_.globals.end()) return nullptr;
  const Declared& declared = *global->second;
  // While its value is read, it has none.
  globals_.emplace(path, needed_value(path));
  std::vector<Frame> frames(1);
  frames_.swap(frames);
  Value value = initial(declared);
  frames_.swap(frames);
  const bool changes = !declared.is_constant && program_.assigned.count(path) != 0;
  if (changes) {
    value = needed_value(path);
  } else if (!declared.is_constant && value.is_known()) {
    initial_values_.emplace(path, declared.offset);
    mark_origin(value, path);
  }
  globals_[path] = std::move(value);
  return &globals_[path];
}

// The stored value that an expression names; nullptr: there is none.
Value* Machine::place(const Expression& e) {
  if (e.kind == ExpressionKind::name) return stored(path_of(e));
  if (e.kind == ExpressionKind::cast || (e.kind == ExpressionKind::unary && (e.text == "*" || e.text == "&"))) {
    return place(e.parts[0]);
  }
  if (e.kind == ExpressionKind::index) {
    Value* const array = place(e.parts[0]);
    if (array == nullptr || array->kind != Value::Kind::list) return stored(path_of(e));
    const Value index = evaluate(e.parts[1]);
    const std::int64_t at = index.integer - array->low;
    const bool inside =
        index.kind == Value::Kind::integer && at >= 0 && at < static_cast<std::int64_t>(array->list.size());
    return inside ? &array->list[static_cast<std::size_t>(at)] : nullptr;
  }
  if (e.kind != ExpressionKind::member) return nullptr;
  Value* object = place(e.parts[0]);
  if (object == nullptr || object->kind != Value::Kind::list) return stored(path_of(e));
  if (points_to_struct(*object)) object = object->list.data();
  const auto members = program_.outline.structs.find(object->type);
  if (members != program_.outline.structs.end() && !object->type.empty()) {
    const auto found = std::find(members->second.begin(), members->second.end(), e.text);
    const auto at = static_cast<std::size_t>(found - members->second.begin());
    return at < object->list.size() ? &object->list[at] : nullptr;
  }
  const std::size_t at = std::min(std::string_view("xyzw").find(e.text), std::string_view("rgba").find(e.text));
  return e.text.size() == 1 && at < object->list.size() ? &object->list[at] : nullptr;
}

// Of an array whose bounds are not known here; false: its base or the index is not known.
bool Machine::assign_element(const Expression& target, Value& value) {
  const std::string path = path_of(target.parts[0]);
  Value* array = place(target.parts[0]);
  if (array == nullptr && !frames_.empty()) array = &(frames_.back().values[path] = needed_value(path));
  if (array == nullptr) return false;
  const Value index = evaluate(target.parts[1]);
  if (!index.is_known()) {
    *array = needed_value(path);
    return true;
  }
  const std::int64_t at = index.integer - array->low;
  const bool is_open = array->kind == Value::Kind::list || !array->is_known();
  if (!is_open || index.kind != Value::Kind::integer || at < 0 || at >= static_cast<std::int64_t>(kMostElements))
    return false;
  array->kind = Value::Kind::list;
  if (!value.is_known() && value.needs.empty()) value = needed_value(path);
  while (array->list.size() <= static_cast<std::size_t>(at))
    array->list.push_back(unknown_of(needed_value(path), Value{}));
  array->list[static_cast<std::size_t>(at)] = std::move(value);
  return true;
}

void Machine::assign(const Expression& target, Value value) {
  if (target.kind == ExpressionKind::cast || target.kind == ExpressionKind::unary) {
    return assign(target.parts[0], std::move(value));
  }
  if (Value* const known = place(target)) {
    if (value.is_known() || !value.needs.empty()) {
      *known = std::move(value);
    } else {
      *known = needed_value(path_of(target));
    }
    return;
  }
  if (target.kind == ExpressionKind::index && assign_element(target, value)) return;
  if (frames_.empty()) return;
  const std::string path = path_of(target);
  if (!value.is_known() && value.needs.empty()) value = needed_value(path);
  frames_.back().values[path] = std::move(value);
}

// What a name is where nothing is stored under it: an enumerant, a function of OpenGL, a word of the language.
std::optional<Value> Machine::constant(const Expression& e) const {
  const bool pascal = program_.file.language == Language::pascal;
  const auto letters = pascal ? detail::NameCase::any : detail::NameCase::exact;
  const bool qualified = e.is_qualified || e.kind == ExpressionKind::member;
  if (const auto exact = detail::value_of_name(e.text)) return integer_value(*exact);
  if (e.text.starts_with("PS_")) {
    if (const xbox::Constant* const known = xbox::find_constant(e.text)) return integer_value(known->value);
  }
  if (detail::find_gl_call(e.text, letters) != nullptr) {
    Value out;
    out.kind = Value::Kind::entry_point;
    if (lower_case(e.text).find("stage") != std::string::npos && !context_.profile().per_stage_constants) {
      return integer_value(0);
    }
    return out;
  }
  const std::string plain = lower_case(e.text);
  if (plain == "null" || plain == "nullptr" || plain == "nil") return integer_value(0);
  if (plain == "true" || plain == "false") return integer_value(plain == "true" ? 1 : 0);
  const bool is_pascals = pascal && (plain.starts_with("gl_") || qualified);
  if (const auto spelled = detail::value_of_spelling(e.text, qualified || is_pascals)) return integer_value(*spelled);
  if (const auto there = says_extension(e.text, context_.profile())) return integer_value(*there ? 1 : 0);
  return std::nullopt;
}

Value Machine::value_of(const Expression& e) {
  const std::string path = path_of(e);
  if (const Value* const given = defined(path)) return *given;
  if (const Value* const known = stored(path)) {
    constexpr std::size_t kElementsAStep = 16;
    (void)spend(known->list.size() / kElementsAStep);
    return *known;
  }
  if (const auto known = constant(e)) return *known;
  return needed_value(path);
}

}  // namespace ninebit::code
