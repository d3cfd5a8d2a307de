// Calls: of the combiners, of the file's functions, and of those whose results are known.
#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/pixel_shader/shader_literal.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

using detail::GlCommand;
using detail::quoted;

constexpr std::size_t kMostNestedCalls = 24;

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
  constexpr std::array<std::string_view, 8> kParts{"glBegin",    "glDrawArrays", "glDrawElements", "glDrawRange",
                                                   "glCallList", "glRect",       "DrawElements",   "glEvalMesh"};
  return std::any_of(kParts.begin(), kParts.end(),
                     [&](std::string_view part) { return name.find(part) != std::string_view::npos; });
}

}  // namespace

const Expression& called_operand(const Expression& callee) {
  const Expression* at = &callee;
  while (at->kind == ExpressionKind::unary || at->kind == ExpressionKind::cast) at = &at->parts[0];
  // CHECK(glEnable)(…)
  const bool wrapped = at->kind == ExpressionKind::call && at->parts.size() == 2;
  return wrapped && detail::find_gl_call(at->parts[1].text) != nullptr ? at->parts[1] : *at;
}

const detail::GlSignature* signature_of(const Expression& callee, Language language) {
  const Expression& named = called_operand(callee);
  const auto letters = language == Language::pascal ? detail::NameCase::any : detail::NameCase::exact;
  if (const auto* const found = detail::find_gl_call(named.text, letters)) return found;
  const bool qualified = named.kind == ExpressionKind::member || named.is_qualified;
  return qualified ? detail::find_gl_method(named.text) : nullptr;
}

Value Machine::call(const Expression& e) {
  const Expression& callee = e.parts[0];
  const std::string_view name = own_name(callee);
  if (const Function* const function = function_of(callee, e.parts.size() - 1)) return call_function(*function, e);
  const detail::GlSignature* const signature = signature_of(callee, program_.file.language);
  if (signature != nullptr) {
    call_combiner(*signature, e);
    return {};
  }
  if (name == "nvparse" || name.ends_with("_nvparse")) return call_nvparse(e);
  const std::string path = path_of(e);
  if (const Value* const given = defined(path)) return *given;
  if (auto known = call_known(name, e)) return *std::move(known);
  look_for_misspelling(name, e);
  if (callee.kind == ExpressionKind::call || callee.kind == ExpressionKind::index) evaluate(callee);
  const bool wraps = may_set(e);  // a check around a call
  for (std::size_t i = 1; i < e.parts.size(); ++i) evaluate(e.parts[i]);
  forget_arguments(e);
  if (!wraps) skip(name, e);
  return needed_value(path);
}

void Machine::skip(std::string_view name, const Expression& e) {
  if (name.empty()) return;
  if (draws(name) && calls_made_ > 0) drawn_at_ = e.offset + 1;
  if (skips_++ == 0) first_skipped_ = e.offset;
  last_skipped_ = e.offset;
  constexpr std::size_t kMostNames = 1000;
  if (skipped_.size() < kMostNames) skipped_.insert(std::string(name));
}

// A call that is one letter away from one of the combiners'.
void Machine::look_for_misspelling(std::string_view name, const Expression& e) {
  const std::string meant = name.find("ombin") == std::string_view::npos ? "" : detail::meant_call(name);
  if (meant.empty() || !misspelled_.insert(e.offset).second) return;
  faults_.add(e.offset, quoted(name) + " is not a call of the register combiners" + meant);
}

// The file's function that a call means: that with as many parameters, or the only one.
const Function* Machine::function_of(const Expression& callee, std::size_t arguments) const {
  const auto found = program_.by_name.find(program_.key(own_name(callee)));
  if (found == program_.by_name.end()) return nullptr;
  // A wrapper that has the name of what it calls.
  const Function* const inside = frames_.empty() ? nullptr : frames_.back().function;
  const Function* best = nullptr;
  std::size_t fitting = 0;
  for (const Function* const one : found->second) {
    if (one == inside && callee.kind != ExpressionKind::name) continue;
    const bool fits = one->parameters.size() == arguments;
    const bool defaults = one->parameters.size() > arguments && !one->parameters[arguments].value.empty();
    if (!fits && !defaults && found->second.size() > 1) continue;
    fitting += 1;
    // Of several the one of the same class.
    const bool same_class = inside != nullptr && one->name.size() > one->own_name.size() &&
                            inside->name.starts_with(one->name.substr(0, one->name.size() - one->own_name.size()));
    if (best == nullptr || same_class) best = one;
  }
  return best == inside && fitting < 2 && detail::find_gl_call(own_name(callee)) != nullptr ? nullptr : best;
}

Value Machine::call_function(const Function& function, const Expression& e) {
  Frame frame{.function = &function};
  for (std::size_t i = 0; i < function.parameters.size(); ++i) {
    const Parameter& parameter = function.parameters[i];
    Value value;
    if (i + 1 < e.parts.size()) {
      value = evaluate(e.parts[i + 1]);
    } else if (!parameter.value.empty()) {
      value = evaluate(parameter.value[0]);
    }
    if (!value.is_known() && value.needs.empty()) value = needed_value(path_of(e));
    if (i + 1 < e.parts.size()) add_alias(parameter.name, e.parts[i + 1], frame);
    frame.values[program_.key(parameter.name)] = std::move(value);
  }
  for (std::size_t i = function.parameters.size() + 1; i < e.parts.size(); ++i) evaluate(e.parts[i]);
  if (frames_.size() >= kMostNestedCalls || !spend()) return needed_value(path_of(e));
  frames_.push_back(std::move(frame));
  need_conditions(&function);
  execute(body_of(function));
  Frame done = std::move(frames_.back());
  frames_.pop_back();
  // Arrays are given by address.
  for (std::size_t i = 0; i < function.parameters.size() && i + 1 < e.parts.size(); ++i) {
    Value* const array = place(e.parts[i + 1]);
    Value& after = done.values[program_.key(function.parameters[i].name)];
    const bool same_size = array != nullptr && array->kind == Value::Kind::list && after.kind == Value::Kind::list &&
                           array->list.size() == after.list.size();
    if (same_size) *array = std::move(after);
  }
  if (done.has_result && (done.result.is_known() || !done.result.needs.empty())) return std::move(done.result);
  return needed_value(path_of(e));
}

// Makes one argument of a call; false: it is not known, which is noted as a need, or a fault.
bool Machine::argument(const Expression& e, bool is_array, detail::GlArgument& out) {
  Value value = evaluate(e);
  use(value);
  out.offset = e.offset;
  out.text = program_.source.text.substr(e.offset, e.end - e.offset);
  // An array of three numbers was good enough where nothing read the fourth.
  if (is_array && value.kind == Value::Kind::list && value.list.size() == 3) {
    notes_.add(e.offset, quoted(out.text) + " has 3 values; took 0 for the fourth, which OpenGL reads, too");
    value.list.push_back(integer_value(0));
  }
  if (to_argument(value, out)) return true;
  if (value.kind == Value::Kind::text || value.kind == Value::Kind::entry_point || value.kind == Value::Kind::symbol) {
    faults_.add(e.offset, quoted(out.text) + " cannot be passed here; expected a number or an enumerant");
    return false;
  }
  Value unknown = unknown_of(value, value);
  for (const Value& element : value.list) {
    if (!element.is_known()) add_needs(unknown.needs, element.needs);
  }
  const bool is_gls_name = e.kind == ExpressionKind::name && e.text.starts_with("GL_") && unknown.needs.size() == 1;
  if (is_gls_name) {
    faults_.add(e.offset,
                quoted(e.text) + " is not an enumerant of the register combiners" + detail::meant_enumerant(e.text));
    return false;
  }
  // &color.r is all of color.
  const bool first_member = is_array && e.kind == ExpressionKind::unary && e.text == "&" &&
                            e.parts[0].kind == ExpressionKind::member && e.parts[0].text.size() == 1;
  if (first_member && value.list.size() < 2) unknown = needed_value(path_of(e.parts[0].parts[0]));
  // A row of an array has a name of its own.
  const std::string path = is_array ? path_of(e) : "";
  const bool own = is_array && unknown.needs.size() == 1 && path.starts_with(unknown.needs[0]);
  if (own) unknown = needed_value(path);
  if (is_array && (own || value.kind != Value::Kind::list)) arrays_.insert(unknown.needs.begin(), unknown.needs.end());
  if (first_member) arrays_.insert(unknown.needs.begin(), unknown.needs.end());
  need(unknown, e);
  return false;
}

// Notes that a call or a decision depends on a value.
void Machine::use(const Value& value) {
  used_origins_.insert(value.origins.begin(), value.origins.end());
  for (const Value& element : value.list) used_origins_.insert(element.origins.begin(), element.origins.end());
}

// Notes that a value is needed. Without a name that could be defined, its own text is one.
void Machine::need(const Value& value, const Expression& e) {
  if (value.needs.empty()) need(path_of(e), e.offset);
  for (const std::string& name : value.needs) need(name, e.offset);
}

void Machine::need(const std::string& name, std::uint32_t offset) {
  constexpr std::size_t kMostNeeds = 100;
  if (needs_.size() < kMostNeeds || needs_.count(name) != 0) needs_[name].insert(offset);
}

// Notes the names that decide which of a function's lines are read; nullptr: the lines outside of functions.
void Machine::need_conditions(const Function* function) {
  for (const OpenCondition& one : program_.file.open_conditions) {
    const auto holds = [&](const Function& f) { return f.begin <= one.begin && one.end <= f.end; };
    const std::vector<Function>& all = program_.outline.functions;
    const bool matters = function != nullptr ? one.begin < function->end && function->begin < one.end
                                             : std::none_of(all.begin(), all.end(), holds);
    if (matters) need(one.name, one.offset);
  }
}

void Machine::call_combiner(const detail::GlSignature& signature, const Expression& e) {
  const bool switches = enables(signature);
  std::vector<detail::GlArgument> arguments;
  bool known = true;
  for (std::size_t i = 1; i < e.parts.size(); ++i) {
    detail::GlArgument one;
    if (switches) {
      const Value capability = evaluate(e.parts[i]);
      const bool is_ours =
          capability.kind == Value::Kind::integer &&
          (capability.integer == gl::GL_REGISTER_COMBINERS_NV || capability.integer == gl::GL_PER_STAGE_CONSTANTS_NV);
      if (!is_ours) return;
    }
    const bool is_array = i <= signature.parameters.size() && signature.parameters[i - 1] == 'F' &&
                          signature.name != "CombinerParameterNV";
    known = argument(e.parts[i], is_array, one) && known;
    arguments.push_back(std::move(one));
  }
  if (!switches) {
    ++calls_made_;
    ++calls_made_on_context_;
    if (drawn_at_ != 0 && !noted_drawing_ && needs_.empty()) {
      notes_.add(drawn_at_ - 1, "draws before the combiners are set again; the program is that at the end");
      noted_drawing_ = true;
    }
    drawn_at_ = 0;
  }
  CallSite& site = sites_[e.offset];
  if (!known) {
    site.is_unknown = true;
    return;
  }
  // A call in a loop is reported once.
  detail::SourceFaults once(program_.source);
  detail::SourceFaults& faults = site.is_refused ? once : faults_;
  const std::size_t before = faults.count();
  detail::execute_gl_call(signature, arguments, e.offset, context_, faults);
  site.is_read = true;
  site.is_refused = site.is_refused || faults.count() > before;
}

Value Machine::call_nvparse(const Expression& e) {
  CallSite& site = sites_[e.offset];
  ++calls_made_;
  ++calls_made_on_context_;
  std::vector<Value> arguments;
  for (std::size_t i = 1; i < e.parts.size(); ++i) arguments.push_back(evaluate(e.parts[i]));
  const auto found =
      std::find_if(arguments.begin(), arguments.end(), [](const Value& one) { return one.kind == Value::Kind::text; });
  if (found == arguments.end()) {
    site.is_unknown = true;
    if (!arguments.empty()) need(arguments[0], e.parts[1]);
    return {};
  }
  const Value& text = *found;
  load(text.begin, text.end, e.offset, text.symbol);
  return integer_value(0);
}

void Machine::load(std::uint32_t begin, std::uint32_t end, std::uint32_t offset, const std::string& pasted) {
  const LiteralStyle style = program_.file.language == Language::pascal ? LiteralStyle::pascal : LiteralStyle::c;
  const SourceText made{.text = pasted, .file = program_.source.file};
  const LiteralText literal(pasted.empty() ? program_.source : made, style, pasted.empty() ? begin : 0,
                            pasted.empty() ? end : pasted.size());
  loaded_.insert(begin);
  // nvparse also loads programs for other units.
  const std::string_view language = foreign_language(literal.source().text);
  if (!language.empty() && literal.source().text.find("!!RC1.0") == std::string_view::npos) {
    notes_.add(begin, "skipped " + std::string(language) + ": it is not for combiners");
    skipped_language_ = language;
    sites_[offset].is_skipped = true;
    return;
  }
  CallSite& site = sites_[offset];
  const SourceText program = literal.source();
  const bool is_shader = is_pixel_shader(program.text) && program.text.find("!!RC1.0") == std::string_view::npos;
  std::set<std::string> used_by_shaders;
  Parsed<CombinerState> parsed =
      is_shader ? detail::parse_defined_shader(program, given_, context_.profile(), used_by_shaders)
                : parse_rc10(program, context_.profile());
  for (const std::string& name : used_by_shaders) used_.insert(program_.key(normal_path(name)));
  site.is_read = true;
  for (TextFault& fault : parsed.notes) notes_.add(std::move(fault));
  for (TextFault fault : parsed.faults()) {
    const TextPlace place = program_.source.place(begin);
    if (!pasted.empty()) std::tie(fault.line, fault.column) = std::tie(place.line, place.column);
    if (!site.is_refused) faults_.add(std::move(fault));
  }
  site.is_refused = site.is_refused || !parsed;
  if (!parsed) return;
  context_.state() = *parsed;
  const ByConstant<bool> read = constants_read(*parsed);
  for (std::size_t which = 0; which < 2; ++which) {
    for (std::size_t place = 0; place <= kFinalConstants; ++place) {
      const std::size_t of = parsed->per_stage_constants ? place : kFinalConstants;
      if (read[place][which] && !parsed->origin[place][which].unset) context_.constants_set()[of][which] = true;
    }
  }
}

}  // namespace ninebit::code
