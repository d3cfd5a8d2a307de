// Calls: of the combiners, of the file's functions, and of others.
#include <algorithm>
#include <array>
#include <utility>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {
namespace {

using detail::GlCommand;
using detail::quoted;

constexpr std::size_t kMostNestedCalls = 24;

// Kinds of arguments beyond those of GlSignature: arrays of texture shaders, of which GL reads as many numbers as their
// parameter has.
constexpr char kExactFloats = 'G', kExactIntegers = 'J';

// The name that a callee ends with.
std::string_view own_name(const Expression& callee) {
  const Expression& named = called_operand(callee);
  const bool is_name = named.kind == ExpressionKind::name || named.kind == ExpressionKind::member;
  return is_name ? named.text : std::string_view();
}

bool enables(const detail::GlSignature& signature) {
  return signature.command == GlCommand::enable || signature.command == GlCommand::disable;
}

// Whether a call draws, by its name.
bool draws(std::string_view name) {
  return contains_any(name, {"glBegin", "glDrawArrays", "glDrawElements", "glDrawRange", "glCallList", "glRect",
                             "DrawElements", "glEvalMesh"});
}

// Functions of C's library, and macros, that change nothing of the caller's.
bool changes_nothing(std::string_view name) {
  constexpr std::array<std::string_view, 20> kNames{
      "printf", "fprintf", "puts",   "fputs", "putchar", "assert", "ASSERT", "free",       "fflush",  "strlen",
      "strcmp", "strstr",  "delete", "exit",  "abort",   "atoi",   "atof",   "strcasecmp", "stricmp", "strncmp"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

void set_number(detail::GlArgument& out, const Number& number) {
  out.is_integer = (number.kinds & ~kReals) != 0;
  out.integer = number.integer;
  out.real = number.value();
}

}  // namespace

bool contains_any(std::string_view name, std::initializer_list<std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(), [&](auto part) { return name.find(part) != std::string_view::npos; });
}

bool names_gl_function(std::string_view name) {
  constexpr std::size_t kLongestPrefix = 6;
  const std::size_t at = name.find("gl");
  const std::string_view own = at <= kLongestPrefix ? name.substr(at + 2) : std::string_view();
  return own.size() > 2 && is_capital(own[0]) && !is_capital(own[1]) && own[1] != '_';
}

const Expression& called_operand(const Expression& callee) {
  const Expression* at = &callee;
  while (at->kind == ExpressionKind::unary || at->kind == ExpressionKind::cast) at = &at->parts[0];
  // CHECK(glEnable)(…)
  const bool wrapped = at->kind == ExpressionKind::call && at->parts.size() == 2;
  return wrapped && detail::find_gl_call(at->parts[1].text) != nullptr ? at->parts[1] : *at;
}

const detail::GlSignature* signature_of(const Expression& callee) {
  const Expression& named = called_operand(callee);
  if (named.kind != ExpressionKind::name && named.kind != ExpressionKind::member) return nullptr;
  if (const auto* const found = detail::find_gl_call(named.text)) return found;
  const bool qualified = named.kind == ExpressionKind::member || !named.qualifier.empty();
  return qualified ? detail::find_gl_method(named.text) : nullptr;
}

Value Machine::call(const Expression& e) {
  const Expression& callee = e.parts[0];
  const std::string_view name = own_name(callee);
  const Function* function = program_.function_of(callee, e.parts.size() - 1, frames_.back().function);
  // A variable that holds a function.
  const Expression& named = called_operand(callee);
  if (function == nullptr && detail::find_gl_call(name) == nullptr) {
    const bool is_variable = named.kind == ExpressionKind::index || callee.kind == ExpressionKind::unary ||
                             (named.kind == ExpressionKind::name && lookup(named).kind == PlaceKind::cell);
    const Value held = is_variable ? evaluate(callee) : Value{};
    if (held.is(ValueKind::function)) function = held.function;
  }
  if (function != nullptr) {
    if (quiet_ > 0) return needed_value({}, function->result->kinds);
    Value self = named.kind == ExpressionKind::name && !function->scope.empty() ? frames_.back().self : Value{};
    if (named.kind == ExpressionKind::member) {
      const Place object = object_of_member(named);
      if (object.kind == PlaceKind::cell) self = pointer_value(object.object, object.at, object.type);
    }
    return call_function(*function, e, self);
  }
  if (const detail::GlSignature* const signature = signature_of(callee)) {
    if (quiet_ == 0) call_combiner(*signature, e);
    return {};
  }
  if (program_.file.reads_stages) {
    const detail::GlSignature* const stage = detail::find_stage_call(name);
    if (stage != nullptr && (quiet_ > 0 || call_stage(*stage, e))) return {};
  }
  if (name == "nvparse" || name.ends_with("_nvparse")) return quiet_ > 0 ? integer_value(0) : call_nvparse(e);
  if (auto known = call_known(name, e)) return *std::move(known);
  return call_unknown(e, name);
}

// A function whose body is not known may change what it is given by address, and what other code can change.
Value Machine::call_unknown(const Expression& e, std::string_view name) {
  const Expression& callee = e.parts[0];
  const auto declared = program_.prototypes.find(name);
  const Function* const prototype = declared != program_.prototypes.end() ? declared->second[0] : nullptr;
  Value out = needed_value(path_of(e), prototype != nullptr ? prototype->result->kinds : Kinds{0});
  if (prototype != nullptr && prototype->result->is(TypeKind::pointer)) out.type = prototype->result->of;
  if (quiet_ > 0) return out;
  look_for_misspelling(name, e);
  const bool is_member = callee.kind == ExpressionKind::member;
  if (const auto found = program_.by_name.find(name); found != program_.by_name.end()) {
    for (const Function* const one : found->second) {
      const bool may_be_it = !is_member || one->parameters.size() == e.parts.size() - 1;
      if (!may_be_it || one == frames_.back().function || !program_.sets(*one)) continue;
      report(e.offset, quoted(name) + " sets combiners, and which function of this name is called is not known");
    }
  }
  std::vector<Value> given;
  if (callee.kind == ExpressionKind::call || callee.kind == ExpressionKind::index) given.push_back(evaluate(callee));
  const bool is_gl = names_gl_function(name) || (is_member && callee.parts[0].text.starts_with("gl") &&
                                                 detail::is_word(name.empty() ? ' ' : name[0]));
  // A class's own function may change the object.
  if (is_member && !is_gl) escape(object_of_member(callee).object);
  for (std::size_t i = 1; i < e.parts.size(); ++i) {
    given.push_back(evaluate(e.parts[i]));
    const bool by_reference =
        prototype != nullptr && i <= prototype->parameters.size() && prototype->parameters[i - 1].is_reference;
    const ExpressionKind kind = e.parts[i].kind;
    const bool is_place =
        kind == ExpressionKind::name || kind == ExpressionKind::index || kind == ExpressionKind::member;
    const bool may_refer =
        prototype == nullptr && is_place && !is_gl && !changes_nothing(name) && !program_.source.file.ends_with(".c");
    if (!by_reference && !may_refer) continue;
    const Place at = quietly([&] { return place(e.parts[i]); });
    if (!by_reference && callee.qualifier != "std" && name != "swap") {
      assume_unchanged(at, name, e.parts[i]);
    } else if (at.object >= 0) {
      escape(at.object);
    } else {
      forget_outside();
    }
  }
  const bool only_reads = changes_nothing(name) ||
                          (is_gl && !contains_any(name, {"Get", "Gen", "Read", "Select", "Feedback", "Map", "Query"}));
  const auto is_filled = [&](const Expression& one) {
    return filled_.count(quietly([&] { return object_of(one); })) != 0;
  };
  const bool may_fill = !filled_.empty() && !only_reads && name.find("PixelShader") == std::string_view::npos;
  if (may_fill &&
      ((is_member && is_filled(callee.parts[0])) || std::any_of(e.parts.begin() + 1, e.parts.end(), is_filled)) &&
      reported_.insert(e.offset).second) {
    notes_.add(e.offset, "assumed that " + quoted(name) + " does not change the definition that is filled");
  }
  const bool wraps = program_.sets(e);  // a check around a call
  if (!only_reads) {
    for (const Value& one : given) forget_pointed(one);
  }
  if (!only_reads && !is_gl && !wraps) {
    forget_outside();
    forget_shared();
  }
  if (wraps || name.empty()) return out;
  note_drawing(name);
  if (skipped_.empty()) first_skipped_ = e.offset;
  last_skipped_ = e.offset;
  constexpr std::size_t kMostNames = 1000;
  if (skipped_.size() < kMostNames) skipped_.insert(std::string(name));
  return out;
}

// In C++ a function that the file does not declare may take a number by reference.
void Machine::assume_unchanged(const Place& at, std::string_view function, const Expression& e) {
  const bool is_number =
      at.kind == PlaceKind::cell && at.type != nullptr && at.type->is(TypeKind::number) && is_inside(at);
  if (!is_number || object_at(at.object).is_constant) return;
  const CellKey key{at.object, at.at, {}};
  const Value now = cell(key);
  if (!now.is_known()) return;
  const std::string variable = text_of(e), origin = std::string(function) + "(" + variable + ")";
  assumptions_.try_emplace(origin, e.offset,
                           "assumed that " + quoted(function) + " does not change " + quoted(variable));
  Value assumed;
  assumed.origins = std::make_shared<const Names>(Names{origin});
  set_cell(key, with_origins(now, assumed));
}

// A program that something is drawn with is one by itself.
void Machine::note_drawing(std::string_view name) {
  if (!draws(name) || !set_since_drawing_) return;
  if (drawn_.empty() || !(drawn_.back() == state())) drawn_.push_back(state());
  set_since_drawing_ = false;
}

std::vector<WholeState> Machine::programs() const {
  std::vector<WholeState> all = drawn_;
  if (all.empty() || (set_since_drawing_ && !(all.back() == state()))) all.push_back(state());
  return all;
}

// A call that is one letter away from one of the combiners'.
void Machine::look_for_misspelling(std::string_view name, const Expression& e) {
  if (name.find("ombin") == std::string_view::npos || !spelled_.emplace(e.offset, name).second) return;
  const std::string meant = detail::meant_call(name);
  if (!meant.empty()) report(e.offset, quoted(name) + " is not a call of the register combiners" + meant);
}

Value Machine::call_function(const Function& function, const Expression& e, const Value& self) {
  const std::string path = path_of(e);
  Frame frame{.function = &function, .self = self};
  for (std::size_t i = 0; i < std::max(function.parameters.size(), e.parts.size() - 1); ++i) {
    const Expression* given = i + 1 < e.parts.size() ? &e.parts[i + 1] : nullptr;
    if (i >= function.parameters.size()) {
      (void)evaluate(*given);
      continue;
    }
    const Declared& parameter = function.parameters[i];
    if (parameter.is_reference && given != nullptr && given->kind != ExpressionKind::number) {
      frame.variables.push_back({parameter.name, place(*given)});
      continue;
    }
    if (given == nullptr && !parameter.value.empty()) given = &parameter.value[0];
    Value value = given != nullptr ? evaluate(*given) : Value{};
    if (!value.is_known() && !value.needs && value.object < 0) value.needs = needed_value(path).needs;
    const Place at = place_of(new_object(parameter.type, std::string(parameter.name)));
    if (!object_at(at.object).cells.empty()) store(at, std::move(value));
    frame.variables.push_back({parameter.name, at});
  }
  Value out = needed_value(path, function.result->kinds);
  const bool too_deep = frames_.size() >= kMostNestedCalls;
  if (too_deep || function.is_special || function.is_template || !spend()) {
    if (!too_deep && program_.sets(function)) {
      report(e.offset, quoted(function.own_name) + " sets combiners, and is not followed");
    }
    forget_all();
    return out;
  }
  const bool gives = !function.result->is(TypeKind::nothing);
  need_conditions(&function);
  frame.mark = log_.size();
  frame.result = place_of(new_object(function.result, "the result"));
  frame.result.type = gives ? function.result : nullptr;
  frames_.push_back(std::move(frame));
  const bool is_lost = execute_body(program_.body_of(function), program_.sets(function));
  if (gives && !is_lost) {
    Value result = load(frames_.back().result);
    const std::string own = "the result";
    const bool is_own = result.needs && result.needs->count(own) != 0;
    if (result.is_known() || (result.needs && !is_own)) out = std::move(result);
  }
  frames_.pop_back();
  return out;
}

// The arguments of a call; empty: some are not known.
std::optional<std::vector<detail::GlArgument>> Machine::arguments(const detail::GlSignature& signature,
                                                                  const Expression& e, bool of_stages) {
  std::vector<detail::GlArgument> all;
  bool known = true;
  for (std::size_t i = 1; i < e.parts.size(); ++i) {
    char kind = i <= signature.parameters.size() ? signature.parameters[i - 1] : ' ';
    if (signature.name == "CombinerParameterNV") kind = 'A';
    if (of_stages) kind = kind == 'F' ? kExactFloats : kind == 'I' ? kExactIntegers : kind;
    known = argument(e.parts[i], kind, all.emplace_back()) && known;
  }
  return known ? std::optional(std::move(all)) : std::nullopt;
}

void Machine::call_combiner(const detail::GlSignature& signature, const Expression& e) {
  const bool switches = enables(signature);
  for (std::size_t i = 1; switches && i < e.parts.size(); ++i) {
    const Value capability = evaluate(e.parts[i]);
    const auto is = [&](gl::GLenum wanted) { return capability.is_number() && capability.number.integer == wanted; };
    const bool is_ours = is(gl::GL_REGISTER_COMBINERS_NV) || is(gl::GL_PER_STAGE_CONSTANTS_NV) ||
                         (program_.file.reads_stages && is(gl::GL_TEXTURE_SHADER_NV));
    if (!is_ours) return;
  }
  const auto given = arguments(signature, e, false);
  const bool is_stages = switches && given && !given->empty() && given->front().integer == gl::GL_TEXTURE_SHADER_NV;
  // What a chip does not have is disabled anyway.
  if (is_stages && signature.command == GlCommand::disable && !context_.profile().texture_shaders) {
    sites_[e.offset].is_read = true;
    return;
  }
  need_guards(e);
  switches_stages_ = switches_stages_ || is_stages;
  if (!switches) {
    ++calls_made_;
    ++calls_made_on_context_;
  }
  execute_call(signature, e, given);
}

void Machine::execute_call(const detail::GlSignature& signature, const Expression& e,
                           const std::optional<std::vector<detail::GlArgument>>& arguments) {
  set_since_drawing_ = true;
  CallSite& site = sites_[e.offset];
  if (!arguments) {
    site.is_unknown = true;
    return;
  }
  // A call in a loop is reported once.
  detail::SourceFaults once(program_.source);
  detail::SourceFaults& faults = site.is_refused ? once : faults_;
  const std::size_t before = faults.count();
  detail::execute_gl_call(signature, *arguments, e.offset, context_, faults);
  site.is_read = true;
  site.is_refused = site.is_refused || faults.count() > before;
}

void Machine::select_unit(const Value& unit) {
  const bool is_stage = unit.is_number() && unit.number.integer >= gl::GL_TEXTURE0_ARB &&
                        unit.number.integer < gl::GL_TEXTURE0_ARB + kTextureStages;
  unknown_unit_.reset();
  if (is_conditional()) unknown_unit_ = guards_.empty() ? exits_.back().why : guards_.back().why;
  if (!is_stage) unknown_unit_ = unit;
  if (is_stage) context_.set_active_texture(static_cast<int>(unit.number.integer - gl::GL_TEXTURE0_ARB));
}

// A call of glTexEnv with the target of texture shaders, or of glActiveTexture. False: it has another target.
bool Machine::call_stage(const detail::GlSignature& signature, const Expression& e) {
  if (e.parts.size() != signature.parameters.size() + 1) return false;
  const Value first = quietly([&] { return evaluate(e.parts[1]); });
  if (signature.command == GlCommand::active_texture) {
    select_unit(first);
    return true;
  }
  if (first.is_number() && first.number.integer != gl::GL_TEXTURE_SHADER_NV) return false;
  // Stages of a chip that has none have no effect; enabling them is refused.
  if (!context_.profile().texture_shaders) {
    if (!first.is_number()) return false;
    leave_out_stages(e.offset, e.offset);
    return true;
  }
  auto given = arguments(signature, e, true);
  need_guards(e);
  if (unknown_unit_ && unknown_unit_->is_number()) {
    report(e.offset,
           "the active texture unit has no texture-shader stage; there are " + std::to_string(kTextureStages));
    return true;
  }
  if (unknown_unit_) {
    need(*unknown_unit_, e);
    given.reset();
  }
  ++calls_made_;
  ++calls_made_on_context_;
  execute_call(signature, e, given);
  return true;
}

// Makes one argument of a call; false: it is not known, which is noted as a need, or a fault.
bool Machine::argument(const Expression& e, char kind, detail::GlArgument& out) {
  Value value = evaluate(e);
  use(value);
  out.offset = e.offset;
  out.text = program_.source.text.substr(e.offset, e.end - e.offset);
  if (value.is_number()) {
    set_number(out, value.number);
    return true;
  }
  const bool is_array = std::string_view("AFIGJ").find(kind) != std::string_view::npos;
  if (is_array && (value.is(ValueKind::pointer) || !value.is_known())) {
    return array_argument(std::move(value), e, kind == 'A' ? 'F' : kind, out);
  }
  if (value.is_known()) {
    faults_.add(e.offset, quoted(out.text) + " cannot be passed here; expected a number or an enumerant");
  } else if (e.kind == ExpressionKind::name && e.text.starts_with("GL_") && value.name == e.text) {
    if (reported_.count(e.offset) != 0) return false;
    report(e.offset,
           quoted(e.text) + " is not an enumerant of the register combiners" + detail::meant_enumerant(e.text));
  } else {
    need(value, e);
  }
  return false;
}

// The numbers that a pointer leads to.
bool Machine::array_argument(Value value, const Expression& e, char kind, detail::GlArgument& out) {
  constexpr std::int64_t kRead = 4;  // the most that GL reads of an array
  out.is_array = true;
  const Type* const element = program_.parser->number_type(kind == 'I' || kind == kExactIntegers ? kInt32 : kFloat32);
  const bool is_pointer = value.is(ValueKind::pointer);
  const std::int64_t size =
      is_pointer ? std::max<std::int64_t>(static_cast<std::int64_t>(object_at(value.object).cells.size()) - value.at, 0)
                 : kRead;
  value.type = element;
  Value missing;
  bool misses = false;
  const std::string path = path_of(e);
  for (std::int64_t i = 0; i < std::min(size, kRead); ++i) {
    const Value one = read(deref(value, integer_value(i), path + "[" + std::to_string(i) + "]"));
    use(one);
    const auto number = one.is_number() ? convert(one.number, element->kinds) : std::nullopt;
    misses = misses || !number;
    if (!number) {
      missing = unknown_of(missing, one);
      continue;
    }
    detail::GlArgument& made = out.values.emplace_back();
    made.offset = out.offset;
    made.text = out.text;
    set_number(made, *number);
  }
  if (!misses && (kind == 'F' || kind == 'I') && is_pointer && size == kRead - 1) {
    // An array of three numbers was good enough where nothing read the fourth.
    notes_.add(e.offset, quoted(out.text) + " has 3 values; took 0 for the fourth, which OpenGL reads, too");
    out.values.push_back(out.values[0]);
    set_number(out.values.back(), int_number(0));
  }
  out.count = is_pointer ? std::max(out.values.size(), static_cast<std::size_t>(size)) : out.values.size();
  if (!misses) return true;
  // A pointer that is not known, and the elements of one array, are the array.
  const bool is_needed = !is_pointer && value.needs;
  Names own = is_needed ? *value.needs : Names{};
  for (const std::string& one : !is_needed && missing.needs ? *missing.needs : Names{}) {
    own.insert(one.starts_with(path + "[") && one.ends_with(']') ? path : one);
  }
  if (own.empty()) own.insert(path);
  if (own.count(path) != 0) arrays_.insert(path);
  if (own.size() == 1 && is_needed) arrays_.insert(*own.begin());
  missing.needs = std::make_shared<const Names>(std::move(own));
  need(missing, e);
  return false;
}

}  // namespace ninebit::code
