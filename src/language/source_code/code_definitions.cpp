// A machine's beginning and end: definitions that the caller gives, and what is said of what was not known.
#include <algorithm>
#include <iterator>
#include <utility>

#include "src/language/source/foreign_language.h"
#include "src/language/source_code/code_machine.h"
#include "src/language/source_code/code_parser.h"

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
  for (const std::string_view self : {"this.", "self.", "Self."}) {
    if (out.starts_with(self)) out.erase(0, self.size());
  }
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
  const std::size_t steps_before = std::exchange(program_.steps, 0);
  for (const Definition& one : given_) {
    File value{.text = one.value, .language = Language::c};
    read_tokens(value);
    TokenCursor in(value, 0, value.tokens.size() - 1);
    ExpressionParser parser(in);
    Value known;
    if (in.peek().is("{")) {
      known = evaluate(parser.list("}"));
    } else {
      std::vector<Value> several;
      do {
        several.push_back(evaluate(parser.expression()));
      } while (in.takes(","));
      known = several[0];
      if (several.size() > 1) {
        known = {};
        known.kind = Value::Kind::list;
        known.list = std::move(several);
      }
    }
    // A name that means nothing here is equal to itself.
    if (!known.is_known() && !known.symbol.empty()) known.kind = Value::Kind::symbol;
    const bool unknown_element =
        std::any_of(known.list.begin(), known.list.end(), [](const Value& v) { return !v.is_known(); });
    if (!in.at_end() || !known.is_known() || unknown_element) {
      faults_.add(0, "the value '" + one.value + "' that is defined for '" + one.name +
                         "' cannot be read; expected a number, an enumerant, or several separated by commas");
      continue;
    }
    definitions_[program_.key(normal_path(one.name))] = std::move(known);
  }
  // Definitions cost a function nothing.
  steps_ = 0;
  program_.steps = steps_before;
}

// The values that are needed; several elements of an array are the array.
std::map<std::string, std::set<std::uint32_t>> Machine::collected_needs() const {
  std::map<std::string, std::size_t> arrays;
  const auto array_of = [](const std::string& name) {
    const std::size_t open = name.rfind('[');
    return open == std::string::npos || !name.ends_with(']') ? std::string() : name.substr(0, open);
  };
  for (const auto& [name, where] : needs_) ++arrays[array_of(name)];
  std::map<std::string, std::set<std::uint32_t>> all;
  for (const auto& [name, where] : needs_) {
    const std::string array = array_of(name);
    const bool several = !array.empty() && (arrays[array] > 1 || needs_.count(array) != 0);
    const bool whole = several && arrays_.count(name) == 0;
    all[whole ? array : name].insert(where.begin(), where.end());
  }
  return all;
}

std::vector<std::string> Machine::needs() const {
  std::vector<std::string> names;
  for (const auto& [name, where] : collected_needs()) names.push_back(name);
  return names;
}

void Machine::finish() {
  const auto needs = collected_needs();
  if (!needs.empty()) {
    std::string list, flags;
    constexpr std::size_t kMostExamples = 3;
    std::size_t count = 0;
    std::uint32_t first = *needs.begin()->second.begin();
    for (const auto& [name, where] : needs) {
      first = std::min(first, *where.begin());
      const std::string element = name + '[';
      const auto next = needs_.lower_bound(element);
      const bool collapsed = next != needs_.end() && next->first.starts_with(element);
      const bool array = arrays_.count(name) != 0 || collapsed;
      list += (list.empty() ? "'" : ", '") + name + "' (" + lines_of(program_.source, where) +
              (array ? ", 4 numbers)" : ")");
      if (++count <= kMostExamples) flags += " --define '" + name + (array ? "=0,0,0,1'" : "=…'");
    }
    faults_.add(first, std::string(needs.size() == 1 ? "a value is" : std::to_string(needs.size()) + " values are") +
                           " not known: " + list + "; give " + (needs.size() == 1 ? "it" : "each") + " as in" + flags);
  }
  const bool only_skipped = !sites_.empty() && std::all_of(sites_.begin(), sites_.end(),
                                                           [](const auto& one) { return one.second.is_skipped; });
  if (only_skipped) faults_.add(sites_.begin()->first, cannot_run(skipped_language_));
  if (out_of_steps_) faults_.add(0, too_many_steps());
  for (const auto& [name, offset] : initial_values_) {
    if (used_origins_.count(name) == 0) continue;
    notes_.add(offset, "took the initial value of " + detail::quoted(name) + ", which is not a constant");
  }
  for (const Definition& one : given_) {
    const bool used =
        used_.count(program_.key(normal_path(one.name))) != 0 || program_.file.used_by_conditions.contains(one.name);
    if (!used) {
      notes_.add(0, detail::not_needed(one));
    }
  }
  if (skipped_.empty() || !needs.empty()) return;
  constexpr std::size_t kMostNames = 6;
  std::string names;
  std::size_t shown = 0;
  for (const std::string& name : skipped_) {
    if (shown++ == kMostNames) {
      names += ", …";
      break;
    }
    names += (names.empty() ? "" : ", ") + name;
  }
  notes_.add(first_skipped_, "skipped calls that set no combiners, " +
                                 lines_of(program_.source, {first_skipped_, last_skipped_}) + ": " + names);
}

}  // namespace ninebit::code
