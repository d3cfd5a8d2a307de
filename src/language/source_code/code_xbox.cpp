// The Xbox's pixel shader definition, D3DPIXELSHADERDEF, as code fills it: assignments to its members.
#include <algorithm>
#include <span>
#include <utility>

#include "src/language/source_code/code_machine.h"
#include "src/language/xbox/xbox_expression.h"
#include "src/system/nearest_name.h"

namespace ninebit::code {
namespace {

using detail::quoted;

constexpr std::int64_t kBeyondWord = std::int64_t{1} << 32;

const Expression& without_cast(const Expression& e) {
  const Expression* at = &e;
  while (at->kind == ExpressionKind::cast && at->parts.size() == 1) at = &at->parts[0];
  return *at;
}

// Whether a member's name could only be one of a definition.
bool looks_like_member(std::string_view name) {
  return name.size() > 4 && name.starts_with("PS") && name[2] >= 'A' && name[2] <= 'Z' && name[3] != '_';
}

std::string fault_of_range(const xbox::Macro& macro, std::size_t argument) {
  return "argument " + std::to_string(argument + 1) + " of " + std::string(macro.name) +
         " is out of range; expected 0 to " + std::to_string(macro.arguments[argument].most);
}

}  // namespace

NamedWord named_word(const Expression& whole) {
  const Expression& e = without_cast(whole);
  const bool is_element = e.kind == ExpressionKind::index && e.parts.size() == 2;
  const Expression& member = is_element ? without_cast(e.parts[0]) : e;
  if (member.kind != ExpressionKind::member || !looks_like_member(member.text)) return {};
  return {member.text, &member.parts[0], is_element ? &e.parts[1] : nullptr, xbox::find_field(member.text),
          member.is_arrow};
}

bool assigns_word(const Expression& e) {
  return e.kind == ExpressionKind::assignment && named_word(e.parts[0]).field != nullptr;
}

// An object by the memory that it is in.
std::string Machine::object_of(const Expression& e) {
  if (e.kind == ExpressionKind::unary && e.text == "&") return object_of(e.parts[0]);
  const Value value = evaluate(e);
  const Place at =
      value.is(ValueKind::pointer) ? deref(value, integer_value(0), "") : quietly([&] { return place(e); });
  if (at.object >= 0) return "#" + std::to_string(at.object) + ":" + std::to_string(at.at);
  const std::string outside = value.name.empty() ? at.outside : value.name;
  return outside.empty() ? path_of(e) : outside;
}

// The word that an expression names, by its number; reports a wrong index.
std::optional<std::size_t> Machine::number_of_word(const NamedWord& word, const Expression& e) {
  std::optional<std::int64_t> index;
  if (word.index != nullptr) {
    const Value value = evaluate(*word.index);
    index = integer_of(value);
    if (!index) {
      need(value, *word.index);
      return std::nullopt;
    }
  }
  if (const std::string fault = index_fault(*word.field, index); !fault.empty()) {
    report(e.offset, fault);
    return std::nullopt;
  }
  return word.field->first + static_cast<std::size_t>(index.value_or(0));
}

// Whether an object that is filled has nothing in it before: no first value but zeros, and no other function had it.
bool Machine::begins_with_zeros(const NamedWord& word) {
  const Place at = quietly([&] {
    const Value value = evaluate(*word.object);
    if (value.is(ValueKind::pointer)) return deref(value, integer_value(0), "");
    return word.is_arrow ? Place{} : place(*word.object);
  });
  if (at.object < 0 || at.type == nullptr || !is_inside(at)) return true;
  const auto is_zero = [](const Value& one) {
    return one.is_number() ? !one.number.is_true() : !one.is_known() && !one.needs && one.name.empty();
  };
  const Object& object = object_at(at.object);
  const std::span<const Value> behind = std::span(object.cells).subspan(static_cast<std::size_t>(at.at));
  const std::size_t count = is_vague(at.type) ? behind.size() : std::min(cells_of(at.type), behind.size());
  return !object.is_escaped &&
         std::all_of(behind.begin(), behind.begin() + static_cast<std::ptrdiff_t>(count), is_zero);
}

Value Machine::refuse_value(const Expression& e) {
  report(e.offset, "the value is not a whole number of 32 bits");
  return {};
}

Value Machine::assign_word(const NamedWord& word, const Expression& e) {
  if (quiet_ > 0) return needed_value({}, kUint32);
  ++calls_made_;
  need_guards(e);
  CallSite& site = sites_[e.offset];
  const std::optional<std::size_t> at = number_of_word(word, e);
  Value value = evaluate(e.parts[1]);
  use(value);
  if (at && value.is_number()) {
    FilledDefinition& filled = filled_[object_of(*word.object)];
    if (!filled.offset) {
      filled.offset = e.offset;
      filled.name = path_of(*word.object);
      if (!begins_with_zeros(word)) {
        report(e.offset, quoted(filled.name) + " has values before, which are not read; expected one that is all 0");
      }
    }
    std::uint32_t& stored_word = filled.definition.words[*at];
    if (e.text != "=") {
      value = combine(e.text.substr(0, e.text.size() - 1), integer_value(stored_word), value);
    }
    const bool is_whole = value.is_number() && (value.number.kinds & ~kReals) != 0;
    if (is_whole && value.number.integer > -kBeyondWord && value.number.integer < kBeyondWord) {
      stored_word = static_cast<std::uint32_t>(value.number.integer);
      filled.definition.offsets[*at] = e.offset;
      site.is_read = true;
      return value;
    }
    return refuse_value(e);
  }
  site.is_unknown = true;
  if (value.is_number()) return value;
  if (e.parts[1].kind == ExpressionKind::number) return refuse_value(e);
  const std::string name = value.needs && !value.needs->empty() ? *value.needs->begin() : text_of(e.parts[1]);
  if (!name.starts_with("PS_") && !name.starts_with("D3DCOLOR_")) {
    need(value, e.parts[1]);
  } else {
    report(e.parts[1].offset, "unknown name " + quoted(name) + did_you_mean(name, xbox::macro_names()));
  }
  return value;
}

// A member as it was assigned; members that were not are 0.
std::optional<Value> Machine::assigned_word(const Expression& e) {
  if (filled_.empty()) return std::nullopt;
  const NamedWord word = named_word(e);
  if (word.field == nullptr) return std::nullopt;
  const auto filled = filled_.find(object_of(*word.object));
  if (filled == filled_.end()) return std::nullopt;
  const std::optional<std::size_t> at = number_of_word(word, e);
  return at ? integer_value(filled->second.definition.words[*at]) : Value{};
}

// The macros of the Xbox's headers, and what clears a definition.
std::optional<Value> Machine::call_of_xbox(std::string_view name, const Expression& e) {
  const std::size_t count = e.parts.size() - 1;
  if (count > 0 && xbox::clears_memory(name)) {
    const Expression& object = without_cast(e.parts[1]);
    if (filled_.erase(object_of(object)) == 0) return std::nullopt;
    need_guards(e);
    return Value{};
  }
  const xbox::Macro* const macro = xbox::find_macro(name);
  if (macro == nullptr) return std::nullopt;
  if (count != macro->arguments.size()) {
    report(e.offset, std::string(macro->name) + " has " + std::to_string(count) + " arguments; expected " +
                         std::to_string(macro->arguments.size()));
    return integer_value(0);
  }
  std::uint32_t bits = macro->always;
  Value unknown = integer_value(0);
  for (std::size_t i = 0; i < count; ++i) {
    const Value value = evaluate(e.parts[i + 1]);
    if (!value.is_number()) {
      unknown = unknown.is_known() ? unknown_of(value, value, kUint32) : unknown_of(unknown, value, kUint32);
      continue;
    }
    use(value);
    const auto whole = integer_of(value);
    if (whole && accepts(macro->arguments[i], *whole)) {
      bits |= bits_of(macro->arguments[i], *whole);
    } else {
      report(e.parts[i + 1].offset, fault_of_range(*macro, i));
    }
  }
  return unknown.is_known() ? integer_value(bits) : unknown;
}

Parsed<CombinerState> Machine::program_of_words(std::vector<RegisterWord>* other_words) {
  FilledDefinition& filled = filled_.begin()->second;
  if (filled_.size() > 1) {
    std::string list;
    for (const auto& [object, one] : filled_) {
      list += (list.empty() ? "" : ", ") + quoted(one.name) + " (line " +
              std::to_string(program_.source.place(*one.offset).line) + ")";
    }
    faults_.add(*filled.offset, "several definitions are filled: " + list + "; a program is one of them");
    return faults_.take();
  }
  if (calls_made_on_context_ > 0) {
    faults_.add(*filled.offset, "a D3DPIXELSHADERDEF is filled and GL calls set combiners; a program is one of them");
    return faults_.take();
  }
  return xbox::program_of_definition(filled.definition, program_.source, context_.profile(), other_words);
}

}  // namespace ninebit::code
