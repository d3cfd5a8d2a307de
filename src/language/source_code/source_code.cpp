#include "ninebit/language/source_code.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/source_faults.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_machine.h"
#include "src/system/nearest_name.h"

namespace ninebit {
namespace code {
namespace {

using detail::quoted;

// The program of a number from 1, or the only one. Its stages count if they are enabled.
Parsed<CombinerState> program_of(const std::vector<WholeState>& all, std::size_t number, const SourceText& source,
                                 std::vector<TextFault> notes, TextureShaderState* texture_shader) {
  const std::size_t chosen = number == 0 && all.size() == 1 ? 1 : number;
  if (chosen > 0 && chosen <= all.size()) {
    const auto& [combiners, stages] = all[chosen - 1];
    if (stages.enabled && texture_shader != nullptr) *texture_shader = stages;
    if (!stages.enabled && stages != TextureShaderState{}) {
      notes.push_back({std::string(source.file), 1, 1,
                       "texture shaders are set and not enabled by GL_TEXTURE_SHADER_NV: they have no effect"});
    }
    return {combiners, notes};
  }
  detail::SourceFaults faults(source);
  const std::string count = std::to_string(all.size());
  // src/playground/read.cpp reads the count from "draws with … pick one with #1".
  faults.add(0,
             number == 0
                 ? "draws with " + count + " programs; pick one with #1 to #" + count + " behind the file's name"
                 : "has " + count + (all.size() == 1 ? " program" : " programs") + ", not " + std::to_string(number));
  return {faults.take(), notes};
}

// The parts of a source that can be executed by themselves: functions, the code outside of them, programs in strings.
struct Unit {
  enum class Kind : std::uint8_t { function, code, text };
  Kind kind = Kind::function;
  std::string name{};                  // with its class; of a text the variable's, if it has one
  std::string own_name{};              // the last part of it
  std::uint32_t offset = 0;            // where it stands
  const Function* function = nullptr;  // of Kind::function
  std::uint32_t end = 0;               // of a text, which begins at `offset`
  bool is_part = false;                // of a text: as far as the source shows, not a whole program
  bool is_helper = false;              // its calls depend on its parameters, and another function calls it
  bool is_root = false;                // it calls combiners or gives their arguments, and is not a helper
};
using UnitKind = Unit::Kind;

void run_unit(Machine& machine, const Unit& unit) {
  if (unit.kind == UnitKind::text) return machine.load(unit.offset, unit.end, unit.offset);
  machine.run(unit.function);
}

// Visits calls and assignments.
template <class Visit>
void visit_effects(const Expression& e, const Visit& visit) {
  if (e.kind == ExpressionKind::call || e.kind == ExpressionKind::assignment) visit(e);
  for (const Expression& part : e.parts) visit_effects(part, visit);
}
template <class Visit>
void visit_effects(const std::vector<Statement>& statements, const Visit& visit) {
  for (const Statement& s : statements) {
    for (const Expression& e : s.value) visit_effects(e, visit);
    for (const Expression& e : s.step) visit_effects(e, visit);
    for (const Declared& one : s.declared) {
      for (const Expression& e : one.value) visit_effects(e, visit);
    }
    visit_effects(s.first, visit);
    visit_effects(s.body, visit);
    visit_effects(s.otherwise, visit);
  }
}

// Whether a string literal holds a program.
bool holds_program(std::string_view literal) {
  return literal.find("!!RC1.0") != std::string_view::npos ||
         detail::find_shader_literal(literal) != std::string_view::npos;
}

// Whether the bytes of a text, which holds a program, do not look like all of it: "!!RC1.0" alone is compared with.
bool is_header_alone(std::string_view literal) {
  return literal.find("!!RC1.0") != std::string_view::npos && literal.find('=') == std::string_view::npos;
}

// A source with its units, in the order of the text; the code outside of functions comes first.
class Units {
 public:
  Units(const SourceText& text, const SourceSelection& selection, const HardwareProfile& profile)
      : selection_(selection),
        profile_(profile),
        faults_(text),
        notes_(text),
        program_(text, selection, faults_, notes_) {
    if (program_.sets(program_.outline.code)) {
      units_.push_back({.kind = UnitKind::code, .offset = program_.outline.code[0].offset, .is_root = true});
    }
    find_functions();
    find_texts();
  }

  // All that set combiners, each executed by itself.
  std::vector<SourceFunction> describe() {
    std::vector<SourceFunction> all;
    for (const Unit& unit : units_) {
      if (unit.kind == UnitKind::text && loaded_.count(unit.offset) != 0) continue;
      SourceFunction one = describe(unit);
      if (one.calls_read + one.calls_not_read > 0 || !one.faults.empty()) all.push_back(std::move(one));
    }
    return all;
  }

  // Executes the units that are selected.
  Parsed<CombinerState> execute(std::vector<RegisterWord>* other_words, TextureShaderState* texture_shader) {
    std::vector<const Unit*> chosen;
    if (faults_.empty()) chosen = choose(selection_.functions);
    if (!faults_.empty()) return {faults_.take(), notes_.take()};
    program_.steps = 0;  // what was needed to choose does not count
    Machine machine(program_, selection_.definitions, profile_, faults_, notes_);
    for (const Unit* const one : chosen) run_unit(machine, *one);
    machine.finish();
    const std::vector<TextFault> notes = notes_.take();
    if (!faults_.empty()) return {faults_.take(), notes};
    if (!machine.fills_definition()) {
      return program_of(machine.programs(), selection_.program, program_.source, notes, texture_shader);
    }
    Parsed<CombinerState> program = machine.program_of_words(other_words);
    program.notes.insert(program.notes.begin(), notes.begin(), notes.end());
    return program;
  }

 private:
  void find_functions() {
    std::map<const Function*, std::size_t> found;
    const std::vector<const Token*> misspelled = misspelled_calls();
    for (const Function& function : program_.outline.functions) {
      const bool misspells = std::any_of(misspelled.begin(), misspelled.end(), [&](const Token* one) {
        return function.begin <= one->offset && one->offset < function.end;
      });
      if (!misspells && !program_.sets(function)) continue;
      found[&function] = units_.size();
      units_.push_back({.name = function.name,
                        .own_name = std::string(function.own_name),
                        .offset = function.offset,
                        .function = &function});
    }
    std::map<std::size_t, std::set<std::size_t>> called;  // units by units
    for (const auto& [function, at] : found) {
      const Function* const caller = function;  // clang 14 captures no structured binding
      std::set<std::size_t>& all = called[at];
      visit_effects(program_.body_of(*function), [&](const Expression& call) {
        if (call.kind != ExpressionKind::call) return;
        const auto callee = found.find(program_.function_of(call.parts[0], call.parts.size() - 1, caller));
        if (callee != found.end()) all.insert(callee->second);
      });
    }
    for (const auto& [caller, all] : called) {
      for (const std::size_t one : all) {
        if (one != caller && !units_[one].is_helper)
          units_[one].is_helper = depends_on_parameters(*units_[one].function);
      }
    }
    for (const auto& [at, all] : called) {
      Unit& unit = units_[at];
      const bool calls_helper =
          std::any_of(all.begin(), all.end(), [&](std::size_t one) { return units_[one].is_helper; });
      const bool direct = program_.file.calls_between(unit.function->begin, unit.function->end);
      unit.is_root = !unit.is_helper && (direct || calls_helper);
    }
  }

  // Calls whose names are nearly those of the combiners' calls.
  std::vector<const Token*> misspelled_calls() const {
    std::vector<const Token*> found;
    const std::vector<Token>& tokens = program_.file.tokens;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
      const std::string_view name = tokens[i].text;
      if (!tokens[i].is_name() || !tokens[i + 1].is("(") || name.find("ombin") == std::string_view::npos) continue;
      if (detail::find_gl_call(name) != nullptr) continue;
      const bool is_own = program_.by_name.find(name) != program_.by_name.end();
      if (!is_own && !detail::meant_call(name).empty()) found.push_back(&tokens[i]);
    }
    return found;
  }

  void report_no_units() {
    for (const Token* const one : misspelled_calls()) {
      faults_.add(one->offset,
                  quoted(one->text) + " is not a call of the register combiners" + detail::meant_call(one->text));
    }
    if (!faults_.empty()) return;
    const std::string_view other = foreign_calls(program_.source.text);
    faults_.add(0, other.empty() ? "no call of the register combiners was found in this source" : cannot_run(other));
  }

  // Whether a function that is executed by itself needs values of its parameters.
  bool depends_on_parameters(const Function& function) {
    if (function.parameters.empty()) return false;
    detail::SourceFaults none(program_.source), nothing(program_.source);
    static const std::vector<Definition> kNone;
    Machine machine(program_, kNone, profile_, none, nothing);
    machine.run(&function);
    for (const std::string& need : machine.needs()) {
      const std::string root = need.substr(0, need.find_first_of(".[("));
      for (const Declared& one : function.parameters) {
        if (one.name == root) return true;
      }
    }
    return false;
  }

  SourceFunction describe(const Unit& unit) {
    detail::SourceFaults faults(program_.source), notes(program_.source);
    Machine machine(program_, selection_.definitions, profile_, faults, notes);
    run_unit(machine, unit);
    loaded_.insert(machine.loaded().begin(), machine.loaded().end());
    SourceFunction out;
    out.name = unit.name;
    out.line = line_of(unit);
    out.is_helper = unit.is_helper;
    // The calls that stand in the unit itself; without any, those of the functions that it calls.
    std::set<std::uint32_t> own;
    const auto note = [&](const Expression& call) {
      if (program_.is_setter(call)) own.insert(call.offset);
    };
    if (unit.kind == UnitKind::function) visit_effects(program_.body_of(*unit.function), note);
    if (unit.kind == UnitKind::code) visit_effects(program_.outline.code, note);
    for (const auto& [offset, site] : machine.sites()) {
      if (site.is_skipped || (!own.empty() && own.count(offset) == 0)) continue;
      const bool read = site.is_read && !site.is_unknown;
      out.calls_read += read ? 1 : 0;
      out.calls_not_read += read ? 0 : 1;
      out.calls_refused += site.is_refused ? 1 : 0;
    }
    for (const std::uint32_t offset : own) out.calls_not_read += machine.sites().count(offset) == 0 ? 1 : 0;
    out.needs = machine.needs();
    if (machine.is_out_of_steps()) faults.add(unit.offset, machine.too_many_steps());
    if (machine.has_left_out_all()) {
      faults.add(machine.sites().begin()->first, no_texture_shaders(profile_), GlError::invalid_enum);
      std::swap(out.calls_read, out.calls_refused);
    }
    out.faults = faults.take();
    if (!unit.is_part || out.faults.empty()) return out;
    // A fault of a part need not be one of the whole text, which is not read.
    out.faults.clear();
    std::swap(out.calls_read, out.calls_not_read);
    out.calls_refused = 0;
    return out;
  }

  void find_texts() {
    constexpr std::size_t kMostTexts = 1000;
    const std::vector<Token>& tokens = program_.file.tokens;
    std::size_t texts = 0;
    for (std::size_t i = 0; i < tokens.size() && texts < kMostTexts; ++i) {
      if (tokens[i].kind != Token::Kind::text || !holds_program(tokens[i].text)) continue;
      const std::size_t end = end_of_literals(program_.source.text, tokens[i].offset);
      std::string name = name_of_text(i);
      if (name.empty()) name = "string";
      const std::size_t first = i, begin = tokens[i].offset;
      while (i + 1 < tokens.size() && tokens[i + 1].offset < end) ++i;
      units_.push_back({.kind = Unit::Kind::text,
                        .name = name,
                        .own_name = name,
                        .offset = tokens[first].offset,
                        .end = static_cast<std::uint32_t>(end),
                        .is_part = is_joined(first) || is_joined(i + 2) ||
                                   is_header_alone(program_.source.text.substr(begin, end - begin))});
      ++texts;
    }
  }

  // Whether a text that begins at this token, or ends before the one before it, is one of the parts of a longer text.
  bool is_joined(std::size_t token) const {
    if (token == 0 || token >= program_.file.tokens.size()) return false;
    const Token& before = program_.file.tokens[token - 1];
    return before.is("+") || before.is("<<") || before.is("%") || before.is("+=");
  }

  // The variable that a text is the value of; empty: it has none.
  std::string name_of_text(std::size_t token) const {
    const std::vector<Token>& tokens = program_.file.tokens;
    const auto is = [&](std::size_t i, std::string_view text) { return tokens[i].is(text); };
    std::size_t i = token;
    while (i > 0 && (tokens[i - 1].kind == Token::Kind::text || is(i - 1, "{") || is(i - 1, "(") || is(i - 1, "+")))
      --i;
    if (i == 0 || !is(i - 1, "=")) return "";
    --i;
    while (i > 0 && (is(i - 1, "]") || is(i - 1, "[") || tokens[i - 1].kind == Token::Kind::number)) --i;
    return i > 0 && tokens[i - 1].is_name() ? std::string(tokens[i - 1].text) : "";
  }

  std::string list_of_units() const {
    constexpr std::size_t kMostNames = 24;
    std::string list;
    std::size_t shown = 0;
    for (const Unit& unit : units_) {
      const auto holds = [&](const Unit& other) {
        return other.kind == UnitKind::function && other.function->begin < unit.offset &&
               unit.offset < other.function->end;
      };
      const bool is_inner = unit.kind == UnitKind::text && std::any_of(units_.begin(), units_.end(), holds);
      if (unit.is_helper || is_inner) continue;
      if (++shown > kMostNames) return list + ", …";
      const std::string line = std::to_string(line_of(unit));
      list += list.empty() ? "" : ", ";
      list += unit.kind == UnitKind::code ? "the code outside of functions" : unit.name + " (line " + line + ")";
    }
    return list;
  }

  // The units of these names, or without names the only one; reports what is wrong with the choice.
  std::vector<const Unit*> choose(const std::vector<std::string>& names) {
    std::vector<const Unit*> chosen;
    if (!names.empty()) {
      for (const std::string& name : names) {
        if (const Unit* const one = named(name)) chosen.push_back(one);
      }
      return chosen;
    }
    const auto add = [&](bool texts) {
      for (const Unit& unit : units_) {
        if (texts ? unit.kind == UnitKind::text : unit.is_root) chosen.push_back(&unit);
      }
    };
    add(false);
    if (chosen.empty()) add(true);
    if (chosen.empty()) {  // they only enable
      for (const Unit& unit : units_) chosen.push_back(&unit);
    }
    if (chosen.size() == 1) return chosen;
    if (units_.empty()) {
      report_no_units();
    } else {
      faults_.add(chosen.empty() ? units_[0].offset : chosen[0]->offset,
                  "several functions set combiners; choose by --function NAME: " + list_of_units());
    }
    return {};
  }

  // A unit by its name, its name with its class, or either with ":LINE". Of several, those that set combiners.
  const Unit* named(const std::string& wanted) {
    std::vector<const Unit*> found;
    std::vector<std::string> known;
    for (const Unit& unit : units_) {
      if (!unit.name.empty()) known.push_back(unit.name);
      const std::string line = ":" + std::to_string(line_of(unit));
      const bool same = unit.name == wanted || unit.own_name == wanted || unit.name + line == wanted ||
                        unit.own_name + line == wanted;
      if (same) found.push_back(&unit);
    }
    if (found.size() == 1) return found[0];
    if (found.size() > 1) {
      std::string list;
      for (const Unit* const one : found) {
        list += (list.empty() ? "" : ", ") + one->name + ":" + std::to_string(line_of(*one));
      }
      faults_.add(found[0]->offset, "several functions are named " + quoted(wanted) + "; choose by --function " + list);
      return nullptr;
    }
    const bool exists = std::any_of(program_.outline.functions.begin(), program_.outline.functions.end(),
                                    [&](const Function& f) { return f.name == wanted || f.own_name == wanted; });
    const std::string list = list_of_units();
    faults_.add(0, (exists ? "function " + quoted(wanted) + " sets no combiners"
                           : "no function " + quoted(wanted) + did_you_mean(wanted, known)) +
                       (list.empty() ? "" : "; combiners are set by " + list));
    return nullptr;
  }

  [[nodiscard]] int line_of(const Unit& unit) const { return program_.source.place(unit.offset).line; }

  const SourceSelection& selection_;
  const HardwareProfile& profile_;
  detail::SourceFaults faults_, notes_;
  Program program_;
  std::vector<Unit> units_{};
  std::set<std::uint32_t> loaded_{};  // texts that functions load that were described
};

}  // namespace
}  // namespace code

namespace {

// Whether a token shows that a text is more than a sequence of calls.
bool shows_structure(const code::Token& token) {
  return (token.is("#") && token.begins_line) ||
         code::is_one_of(token, {"if", "for", "while", "switch", "return", "void", "class", "struct", "namespace",
                                 "public", "private", "else", "do", "import", "using"});
}

bool is_page(std::string_view text) {
  return text.find("\n```") != std::string_view::npos || text.find("\n## ") != std::string_view::npos;
}

}  // namespace

bool is_gl_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes || is_page(text)) return false;
  bool has_function = false, calls_gl = false, is_name = false;
  // Whether each parenthesis that is open stands behind a name, as parameters do.
  std::vector<bool> open;
  bool closed_parameters = false;
  std::string_view last;
  for (const code::Token& token : code::tokens_of(text)) {
    if (token.is("(")) {
      open.push_back(is_name);
      calls_gl = calls_gl || (is_name && code::names_gl_function(last));
    }
    has_function = has_function || (token.is("{") && closed_parameters);
    closed_parameters = token.is(")") && !open.empty() && open.back();
    if (token.is(")") && !open.empty()) open.pop_back();
    if (has_function && calls_gl) return true;
    is_name = token.is_name();
    last = token.text;
  }
  return false;
}

bool is_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes) return false;
  if (find_literal(text, "!!RC1.0") != std::string_view::npos) return true;
  if (detail::find_shader_literal(text) != std::string_view::npos) return true;
  // A page may show calls.
  if (is_page(text)) return false;
  const std::vector<std::uint32_t> calls = code::calls_of(text, code::names_stages(text));
  if (calls.empty()) return false;
  if (text.substr(calls[0]).starts_with("nvparse")) return true;
  const std::vector<code::Token> tokens = code::tokens_of(text);
  return std::any_of(tokens.begin(), tokens.end(), shows_structure);
}

std::vector<SourceFunction> find_source_functions(const SourceText& source, const std::vector<Definition>& definitions,
                                                  const HardwareProfile& profile, const SourceInclude& include) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return {};
  const SourceSelection selection{.functions = {}, .definitions = definitions, .include = include};
  return code::Units(source, selection, profile).describe();
}

Parsed<CombinerState> parse_source_code(const SourceText& source, const SourceSelection& selection,
                                        const HardwareProfile& profile, std::vector<RegisterWord>* other_words,
                                        TextureShaderState* texture_shader) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return faults.take();
  return code::Units(source, selection, profile).execute(other_words, texture_shader);
}

}  // namespace ninebit
