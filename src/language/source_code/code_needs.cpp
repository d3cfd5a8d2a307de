// Definitions that the caller gives, and what is said of what is not known.
#include <algorithm>
#include <utility>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {

// A name without blanks and without this., with . for ->.
std::string normal_path(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (detail::is_blank(name[i])) continue;
    if (name.substr(i).starts_with("->")) {
      out += '.';
      ++i;
    } else {
      out += name[i];
    }
  }
  if (out.starts_with("this.")) out.erase(0, 5);
  return out;
}

namespace {

// "line 3", "lines 3, 7 and 9", "lines 3, 7, 9, …".
std::string lines_of(const SourceText& source, const std::set<std::uint32_t>& offsets) {
  constexpr std::size_t kMostLines = 4;
  std::vector<int> lines;
  for (const std::uint32_t offset : offsets) {
    const int line = source.place(offset).line;
    if (lines.empty() || lines.back() != line) lines.push_back(line);
    if (lines.size() > kMostLines) break;
  }
  std::string out = lines.size() == 1 ? "line " : "lines ";
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) {
    out += (i == 0 ? "" : ", ") + std::to_string(lines[i]);
  }
  return out + (lines.size() > kMostLines ? ", …" : "");
}

}  // namespace

Machine::Machine(Program& program, const std::vector<Definition>& definitions, const HardwareProfile& profile,
                 detail::SourceFaults& faults, detail::SourceFaults& notes)
    : program_(program), given_(definitions), faults_(faults), notes_(notes), context_(profile) {
  frames_.emplace_back();
  const std::size_t steps_before = std::exchange(program_.steps, 0);
  read_definitions();
  // Definitions cost a function nothing.
  steps_ = 0;
  program_.steps = steps_before;
  log_.clear();
  frames_.clear();
}

void Machine::read_definitions() {
  std::vector<std::pair<std::string, Value>> all;
  for (const Definition& one : given_) {
    File text;
    detail::SourceFaults none({one.value, {}});
    read_file(text, {one.value, {}}, {}, none, none);
    Outline nothing;
    bool is_known = true;
    std::vector<Value> values;
    for (const Expression& e : Parser(text, nothing).expressions()) {
      Value value = evaluate(e);
      // A name that means nothing here is equal to itself.
      if (!value.is_known() && e.kind == ExpressionKind::name) {
        const auto member = std::find_if(program_.globals.begin(), program_.globals.end(), [&](const auto& global) {
          return global.first.ends_with("::" + std::string(e.text)) && global.second->is_constant;
        });
        if (member != program_.globals.end()) value = load(*global(member->first));
      }
      if (!value.is_known() && !value.name.empty() && e.kind == ExpressionKind::name) value.kind = ValueKind::symbol;
      is_known = is_known && (value.is_number() || value.is(ValueKind::symbol));
      values.push_back(std::move(value));
    }
    if (values.empty() || !is_known) {
      faults_.add(0, "the value '" + one.value + "' that is defined for '" + one.name +
                         "' cannot be read; expected a number, an enumerant, or several separated by commas");
      continue;
    }
    Value whole = values[0];
    const bool has_braces = one.value.find('{') != std::string::npos;
    if (values.size() > 1 || has_braces) {
      // One kind for all: of 1, 0.5 the first is a real number, too.
      const bool real = std::any_of(values.begin(), values.end(),
                                    [](const Value& v) { return v.is_number() && (v.number.kinds & ~kReals) == 0; });
      for (Value& v : values) {
        if (real && v.is_number() && !v.number.may_be_real()) v.number = *convert(v.number, kFloat64);
      }
      whole = {};
      whole.kind = ValueKind::record;
      whole.cells = std::make_shared<const std::vector<Value>>(std::move(values));
    }
    all.emplace_back(normal_path(one.name), std::move(whole));
  }
  for (auto& [name, value] : all) definitions_[name] = std::move(value);
}

// The definition for a path, or for the array that it is an element of; nullptr: there is none.
const Value* Machine::defined(const std::string& path) {
  if (definitions_.empty() || path.empty()) return nullptr;
  if (const auto found = definitions_.find(path); found != definitions_.end()) {
    used_.insert(path);
    return &found->second;
  }
  const std::size_t open = path.rfind('[');
  if (open == std::string::npos || !path.ends_with(']')) return nullptr;
  const auto array = definitions_.find(path.substr(0, open));
  const auto index = read_number(std::string_view(path).substr(open + 1, path.size() - open - 2));
  if (array == definitions_.end() || !array->second.cells || !index || index->may_be_real()) return nullptr;
  const auto at = static_cast<std::size_t>(index->integer);
  if (at >= array->second.cells->size()) return nullptr;
  used_.insert(array->first);
  return &(*array->second.cells)[at];
}

// A defined value as a variable of this type has it. Several numbers are an array.
Value Machine::definition_for(const Value& given, const Type* type, const std::string& name) {
  const Type* const unknown = program_.parser->unknown_type();
  if (!given.cells) return converted(given, type == nullptr ? unknown : type, name);
  const bool has_elements = type != nullptr && (type->is(TypeKind::array) || type->is(TypeKind::pointer));
  const Type* element = has_elements ? type->of : unknown;
  if (!element->is(TypeKind::number)) element = unknown;
  const std::string key = name + (element->is(TypeKind::number) ? "/" + std::to_string(element->kinds) : "");
  const auto [known, is_new] = given_arrays_.try_emplace(key, -1);
  if (is_new) {
    known->second = new_array(element, given.cells->size(), name);
    Object& made = object_at(known->second);
    for (std::size_t i = 0; i < made.cells.size(); ++i) made.cells[i] = converted((*given.cells)[i], element, name);
    made.is_constant = true;
  }
  return pointer_value(known->second, 0, element);
}

// The value that is stored in a place; where it is not known, the value that is defined for it.
Value Machine::read(const Place& place) {
  Value out = load(place);
  if (out.is_known()) return out;
  for (const std::string* const name : {&place.path, &place.outside}) {
    if (const Value* const given = defined(*name)) return definition_for(*given, place.type, *name);
  }
  return out;
}

// Notes that a call or a decision depends on a value.
void Machine::use(const Value& value) {
  if (value.origins && quiet_ == 0) used_origins_.insert(value.origins->begin(), value.origins->end());
}

// Notes that a value is needed. Without a name that could be defined, its own text is one.
void Machine::need(const Value& value, const Expression& e) {
  if (quiet_ > 0) return;
  const Names own{path_of(e)};
  for (const std::string& name : value.needs ? *value.needs : own) need(name, e.offset);
}

void Machine::need(const std::string& name, std::uint32_t offset) {
  constexpr std::size_t kMostNeeds = 100;
  if (needs_.size() < kMostNeeds || needs_.count(name) != 0) needs_[name].insert(offset);
}

// Notes the names that decide which of a function's lines are read; nullptr: the lines outside of functions.
void Machine::need_conditions(const Function* function) {
  for (const OpenCondition& one : program_.file.open_conditions) {
    const auto holds = [&](const Function& f) { return f.begin <= one.begin && one.end <= f.end; };
    const auto& all = program_.outline.functions;
    const bool matters = function != nullptr ? one.begin < function->end && function->begin < one.end
                                             : std::none_of(all.begin(), all.end(), holds);
    if (matters) need(one.name, one.offset);
  }
}

// The values that decide whether a call is reached at all.
void Machine::need_guards(const Expression& e) {
  const auto look = [&](const Value& why, const Expression* condition) {
    if (condition != nullptr) return need(why, *condition);
    report(e.offset, "whether this call is reached is not known: what stands before it cannot be read");
  };
  for (const Guard& one : guards_) look(one.why, one.condition);
  for (const Exit& one : exits_) look(one.why, one.condition);
}

// The values that are needed; several elements of an array are the array.
std::map<std::string, Machine::Need> Machine::collected_needs() const {
  std::map<std::string, std::size_t> elements;  // of arrays
  const auto array_of = [](const std::string& name) {
    const std::size_t open = name.rfind('[');
    return open == std::string::npos || !name.ends_with(']') ? std::string() : name.substr(0, open);
  };
  for (const auto& [name, where] : needs_) ++elements[array_of(name)];
  std::map<std::string, Need> all;
  for (const auto& [name, where] : needs_) {
    const std::string array = array_of(name);
    const bool several = !array.empty() && (elements[array] > 1 || needs_.count(array) != 0);
    const bool whole = several && arrays_.count(name) == 0;
    Need& one = all[whole ? array : name];
    one.where.insert(where.begin(), where.end());
    one.is_array = one.is_array || whole || arrays_.count(name) != 0;
  }
  return all;
}

std::vector<std::string> Machine::needs() const {
  std::vector<std::string> names;
  for (const auto& [name, need] : collected_needs()) names.push_back(name);
  return names;
}

void Machine::finish() {
  if (stages_at_ && !switches_stages_) {
    notes_.add(*stages_at_, "nothing here enables or disables GL_TEXTURE_SHADER_NV; these stages are taken as enabled");
    context_.texture_shader().enabled = true;
    for (WholeState& one : drawn_) one.stages.enabled = !(one.stages == TextureShaderState{});
  }
  const auto needs = collected_needs();
  if (!needs.empty()) {
    std::string list, flags;
    constexpr std::size_t kMostExamples = 3;
    std::size_t count = 0;
    std::uint32_t first = *needs.begin()->second.where.begin();
    for (const auto& [name, need] : needs) {
      first = std::min(first, *need.where.begin());
      list += (list.empty() ? "'" : ", '") + name + "' (" + lines_of(program_.source, need.where) +
              (need.is_array ? ", 4 numbers)" : ")");
      if (++count <= kMostExamples) flags += " --define '" + name + (need.is_array ? "=0,0,0,1'" : "=…'");
    }
    const bool one = needs.size() == 1;
    faults_.add(first, (one ? "a value is" : std::to_string(needs.size()) + " values are") + " not known: " + list +
                           "; give " + (one ? "it" : "each") + " as in" + flags);
  }
  const bool only_skipped = !sites_.empty() && std::all_of(sites_.begin(), sites_.end(),
                                                           [](const auto& one) { return one.second.is_skipped; });
  if (only_skipped) faults_.add(sites_.begin()->first, cannot_run(skipped_language_));
  if (has_left_out_all()) {
    faults_.add(*left_out_at_, no_texture_shaders(context_.profile()), GlError::invalid_enum);
  } else if (left_out_at_) {
    notes_.add(*left_out_at_,
               "texture shaders are set and not enabled by GL_TEXTURE_SHADER_NV: they are left out; profile " +
                   std::string(context_.profile().name) + " has none");
  }
  if (out_of_steps_) faults_.add(0, too_many_steps());
  for (const auto& [name, note] : assumptions_) {
    if (used_origins_.count(name) != 0) notes_.add(note.first, note.second);
  }
  for (const Definition& one : given_) {
    const bool used = used_.count(normal_path(one.name)) != 0 || program_.file.used_by_conditions.contains(one.name);
    if (!used) {
      notes_.add(0, detail::not_needed(one));
    }
  }
  if (skipped_.empty() || !needs.empty()) return;
  constexpr std::size_t kMostNames = 6;
  std::string names;
  std::size_t shown = 0;
  for (const std::string& name : skipped_) {
    if (++shown <= kMostNames + 1) names += (names.empty() ? "" : ", ") + (shown > kMostNames ? "…" : name);
  }
  notes_.add(first_skipped_, "skipped calls that set no combiners, " +
                                 lines_of(program_.source, {first_skipped_, last_skipped_}) + ": " + names);
}

}  // namespace ninebit::code
