// Executes functions of a source on a GL context, as far as their values are known. What it does not follow makes all
// that it may have changed unknown.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ninebit/language/gl_nv.h"
#include "ninebit/language/source_code.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_value.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::code {

// How often a call of the source was executed, and how it went.
struct CallSite {
  bool is_read = false;      // with known arguments
  bool is_unknown = false;   // with arguments that are not known
  bool is_refused = false;   // GL raised an error
  bool is_skipped = false;   // it loads a program that is not for combiners
  bool is_left_out = false;  // it sets stages of texture shaders, which the profile does not have
};

// A source, parsed once for all that is executed of it.
struct Program {
  // Calls of texture shaders are read if the text names them.
  Program(const SourceText& text, const SourceSelection& selection, detail::SourceFaults& faults,
          detail::SourceFaults& notes);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  SourceText source;
  File file{};
  Outline outline{};
  std::unique_ptr<Parser> parser;
  std::map<std::string_view, std::vector<const Function*>> by_name{};     // by the last part of their names
  std::map<std::string_view, std::vector<const Function*>> prototypes{};  // functions without bodies
  std::map<std::string, const Declared*> globals{};                       // with their classes: "Class::name"
  std::set<std::string_view> assigned{};                                  // names that functions may change
  std::map<const Function*, std::vector<Statement>> bodies{};             // parsed so far
  std::map<const void*, bool> may_set{};                                  // decided so far
  std::size_t steps = 0;                                                  // executed so far, by all functions together

  [[nodiscard]] const std::vector<Statement>& body_of(const Function& function);
  // Whether executing something may set combiners.
  [[nodiscard]] bool sets(const std::vector<Statement>& statements);
  [[nodiscard]] bool sets(const Expression& expression);
  [[nodiscard]] bool is_setter(const Expression& call) const;
  [[nodiscard]] bool sets(const Function& function);
  // The file's function that a callee means, called inside of another one; nullptr: none, or it is not decided.
  [[nodiscard]] const Function* function_of(const Expression& callee, std::size_t arguments,
                                            const Function* inside) const;
};

// The name or member that a call calls: of p->f, (*f) and CHECK(f) it is f.
[[nodiscard]] const Expression& called_operand(const Expression& callee);
// The combiners' call that a callee names; nullptr: none.
[[nodiscard]] const detail::GlSignature* signature_of(const Expression& callee);
// Whether a name is that of a GL function, also of a pointer to one: glEnable, qglEnable, pfn_glEnable.
[[nodiscard]] bool names_gl_function(std::string_view name);
[[nodiscard]] inline bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}
[[nodiscard]] bool contains_any(std::string_view name, std::initializer_list<std::string_view> parts);
// Whether a name or a text says that an extension of the combiners or of texture shaders is there; empty: it does not
// say.
[[nodiscard]] std::optional<bool> says_extension(std::string_view name, const HardwareProfile& profile);
// Whether a class without a declaration in the file seems to hold a few numbers: Vec4, Color, GLfloat4, …
[[nodiscard]] bool names_vector(std::string_view word, std::size_t numbers);
// A name without blanks and without this., with . for ->.
[[nodiscard]] std::string normal_path(std::string_view name);

// A member of the Xbox's pixel shader definition, D3DPIXELSHADERDEF, that an expression names: of
// definition->PSRGBInputs[i] the object is definition.
struct NamedWord {
  std::string_view name{};  // empty: the expression cannot name one
  const Expression* object = nullptr;
  const Expression* index = nullptr;   // nullptr: there is none
  const xbox::Field* field = nullptr;  // nullptr: the name is not one of a member
  bool is_arrow = false;
};
[[nodiscard]] NamedWord named_word(const Expression& e);
// Whether an expression assigns to a member of a definition.
[[nodiscard]] bool assigns_word(const Expression& e);

// The words that were assigned to one object.
struct FilledDefinition {
  xbox::Definition definition{};
  std::optional<std::uint32_t> offset{};  // of the first assignment
  std::string name{};                     // of the object, as the source writes it there
};

// Both halves of a program.
struct WholeState {
  CombinerState combiners;
  TextureShaderState stages;
  friend bool operator==(const WholeState&, const WholeState&) = default;
};

class Machine {
 public:
  Machine(Program& program, const std::vector<Definition>& definitions, const HardwareProfile& profile,
          detail::SourceFaults& faults, detail::SourceFaults& notes);

  // Executes a function on the context, as the first one or after others; nullptr: the code outside of functions.
  void run(const Function* function);
  // Loads a program in string literals, as a call of nvparse does; `offset` is that of the call. `pasted`: the
  // literals, if macros made them.
  void load(std::uint32_t begin, std::uint32_t end, std::uint32_t offset, const std::string& pasted = {});
  // Reports the values that were needed and are not known, in one fault, and notes what was skipped.
  void finish();

  [[nodiscard]] WholeState state() const {
    WholeState state{context_.state(), context_.texture_shader()};
    mark_unset_constants(state.combiners, context_.constants_set());
    return state;
  }
  // The programs with which something was drawn, and the one at the end if it is another one.
  [[nodiscard]] std::vector<WholeState> programs() const;
  [[nodiscard]] std::vector<std::string> needs() const;
  [[nodiscard]] bool is_out_of_steps() const { return out_of_steps_; }
  [[nodiscard]] std::string too_many_steps() const;
  [[nodiscard]] const std::map<std::uint32_t, CallSite>& sites() const { return sites_; }
  // Whether all that was set are stages, which the profile does not have.
  [[nodiscard]] bool has_left_out_all() const {
    return !sites_.empty() &&
           std::all_of(sites_.begin(), sites_.end(), [](const auto& one) { return one.second.is_left_out; });
  }
  // Where the string literals begin that were loaded.
  [[nodiscard]] const std::set<std::uint32_t>& loaded() const { return loaded_; }
  // Whether a definition of the Xbox was filled, and the program that it is; reports what is wrong with it.
  [[nodiscard]] bool fills_definition() const { return !filled_.empty(); }
  [[nodiscard]] Parsed<CombinerState> program_of_words(std::vector<RegisterWord>* other_words);

 private:
  enum class Flow { normal, next, leave, jump, give_back };
  struct Variable {
    std::string_view name;
    Place place;
  };
  // A loop or a choice.
  struct Target {
    std::size_t mark = 0;  // of the log, where it begins
    bool is_choice = false;
  };
  struct Frame {
    const Function* function = nullptr;
    std::vector<Variable> variables{};  // the innermost last
    Place result{};
    Value self{};                 // this
    std::size_t mark = 0;         // of the log, where it begins
    std::vector<Target> loops{};  // those that are executed
  };
  // A way that left a loop, a function or went to a label under a condition that is not known: what it changed since
  // the mark of its target.
  struct Exit {
    Flow flow = Flow::normal;
    std::string label{};
    std::size_t frame = 0, loop = 0;
    Changes changes{};
    Value why{};
    const Expression* condition = nullptr;
  };
  struct Logged {
    CellKey key;
    Value before;
  };
  struct Need {
    std::set<std::uint32_t> where{};
    bool is_array = false;  // of four numbers
  };
  struct Guard {
    Value why;
    const Expression* condition;
  };

  // Statements: code_machine.cpp
  Flow execute(const std::vector<Statement>& statements, std::size_t from = 0);
  Flow execute(const Statement& statement);
  Flow branch(const Statement& statement);
  Flow loop(const Statement& statement);
  Flow rounds(const Statement& statement);
  Flow each(const Statement& statement);
  Flow end_loop(Flow flow, std::size_t variables);
  Flow choice(const Statement& statement);
  void widen(const Statement& statement, const Value& why);
  [[nodiscard]] bool leaves(const std::vector<Statement>& statements);
  bool execute_body(const std::vector<Statement>& body, bool sets);
  void declare(const Declared& declared);
  void construct(const Declared& declared);
  void initialize(const Place& place, const Declared& declared);
  std::optional<std::size_t> designated(const Expression& part, const Type& type);
  int first_value(const Declared& declared, bool changes);
  const Type* sized_type(const Declared& declared);
  std::int64_t open_count(const Expression& list);
  void fill(const Place& place, const Expression& list);
  void fill_part(const Place& place, const std::vector<Expression>& parts, std::size_t& next, bool has_braces);
  Value list_value(const Expression& e);
  int new_array(const Type* element, std::size_t count, const std::string& name);
  bool spend(std::size_t steps = 1);

  // Ways that are not decided.
  Flow fork(const Value& why, const Expression* condition, const std::vector<std::function<Flow()>>& ways);
  [[nodiscard]] Changes changes_since(std::size_t mark) const;
  void roll_back(std::size_t mark);
  void join(const Changes& changes, std::size_t mark, const Value& why);
  void add_exit(Flow flow, const Changes& last, const Value& why, const Expression* condition);
  void resolve(Flow flow, std::size_t mark, std::string_view label = {});
  [[nodiscard]] std::map<std::string, Need> collected_needs() const;
  [[nodiscard]] bool is_conditional() const { return !guards_.empty() || !exits_.empty(); }

  // Memory: code_memory.cpp
  Object& object_at(int object) { return objects_[static_cast<std::size_t>(object)]; }
  [[nodiscard]] const Object& object_at(int object) const { return objects_[static_cast<std::size_t>(object)]; }
  int new_object(const Type* type, const std::string& name);
  [[nodiscard]] Place place_of(int object) const;
  Place new_variable(const Type* type, std::string_view name);
  Place static_variable(const Declared& declared, bool changes, bool is_global);
  void bind(std::string_view name, const Place& place) { frames_.back().variables.push_back({name, place}); }
  [[nodiscard]] const Value& cell(const CellKey& key) const;
  void set_cell(const CellKey& key, Value value);
  Value load(const Place& place);
  Value load_cell(const Place& place);
  void store(const Place& place, Value value);
  void store_cell(const Place& place, Value value);
  [[nodiscard]] Value converted(Value value, const Type* type, const std::string& path) const;
  [[nodiscard]] bool is_inside(const Place& place) const;
  void forget_object(int object);
  void escape(int object);
  void forget_pointed(const Value& value);
  void forget_outside(const std::string& prefix = {});
  void forget_shared();
  void forget_all();
  Place deref(const Value& pointer, const Value& index, const std::string& path);
  Place member(const Place& object, std::string_view name);
  Place lookup(const Expression& e);
  std::optional<Place> global(const std::string& name);

  // Expressions: code_evaluate.cpp
  Value evaluate(const Expression& e);
  Value evaluate_once(const Expression& e);
  Value evaluate_name(const Expression& e);
  static Value part_of(const Value& record, std::string_view name);
  Value evaluate_unary(const Expression& e);
  Value evaluate_binary(const Expression& e);
  Value evaluate_assignment(const Expression& e);
  Value evaluate_conditional(const Expression& e);
  Value evaluate_make(const Expression& e);
  Value evaluate_size(const Expression& e);
  Value combine(std::string_view op, const Value& left, const Value& right);
  Value compare_pointers(std::string_view op, const Value& left, const Value& right) const;
  Value cast(const Value& value, const Type* type, const std::string& path) const;
  // The value that an expression would give; nothing is changed and nothing is reported.
  template <class Evaluate>
  auto quietly(const Evaluate& evaluate) {
    const std::size_t mark = log_.size();
    ++quiet_;
    auto out = evaluate();
    --quiet_;
    roll_back(mark);
    return out;
  }
  Place place(const Expression& e);
  std::optional<Value> constant(const Expression& e) const;
  Place object_of_member(const Expression& member);
  [[nodiscard]] std::string text_of(const Expression& e) const;
  [[nodiscard]] std::string path_of(const Expression& e) const { return normal_path(text_of(e)); }
  void assume_unchanged(const Place& at, std::string_view function, const Expression& e);

  // Definitions and needs: code_needs.cpp
  void read_definitions();
  const Value* defined(const std::string& path);
  Value read(const Place& place);
  Value definition_for(const Value& given, const Type* type, const std::string& name);
  void need(const Value& value, const Expression& e);
  void need(const std::string& name, std::uint32_t offset);
  void need_conditions(const Function* function);
  void need_guards(const Expression& e);
  // Reports a fault, of each place the first.
  void report(std::uint32_t offset, const std::string& message) {
    if (reported_.insert(offset).second) faults_.add(offset, message);
  }
  void use(const Value& value);

  // Calls: code_calls.cpp, code_known_calls.cpp, code_nvparse.cpp
  Value call(const Expression& e);
  Value call_function(const Function& function, const Expression& e, const Value& self);
  Value call_unknown(const Expression& e, std::string_view name);
  void call_combiner(const detail::GlSignature& signature, const Expression& e);
  bool call_stage(const detail::GlSignature& signature, const Expression& e);
  std::optional<std::vector<detail::GlArgument>> arguments(const detail::GlSignature& signature, const Expression& e,
                                                           bool of_stages);
  void execute_call(const detail::GlSignature& signature, const Expression& e,
                    const std::optional<std::vector<detail::GlArgument>>& arguments);
  void select_unit(const Value& unit);
  // A call, at `offset`, sets stages that the profile does not have; what sets them stands at `at`.
  void leave_out_stages(std::uint32_t offset, std::uint32_t at) {
    sites_[offset].is_read = sites_[offset].is_left_out = true;
    if (!left_out_at_) left_out_at_ = at;
  }
  Value call_nvparse(const Expression& e);
  std::optional<Value> call_known(std::string_view name, const Expression& e);
  std::optional<Value> call_of_numbers(std::string_view name, const std::vector<Value>& arguments) const;
  std::optional<Value> call_of_memory(std::string_view name, const Expression& e);
  void look_for_misspelling(std::string_view name, const Expression& e);
  bool argument(const Expression& e, char kind, detail::GlArgument& out);
  bool array_argument(Value value, const Expression& e, char kind, detail::GlArgument& out);
  void note_drawing(std::string_view name);

  // Definitions of the Xbox: code_xbox.cpp
  std::string object_of(const Expression& e);
  std::optional<std::size_t> number_of_word(const NamedWord& word, const Expression& e);
  bool begins_with_zeros(const NamedWord& word);
  Value refuse_value(const Expression& e);
  Value assign_word(const NamedWord& word, const Expression& e);
  std::optional<Value> assigned_word(const Expression& e);
  std::optional<Value> call_of_xbox(std::string_view name, const Expression& e);

  Program& program_;
  const std::vector<Definition>& given_;
  detail::SourceFaults& faults_;
  detail::SourceFaults& notes_;
  gl::Context context_;
  std::vector<Object> objects_;
  std::unordered_map<std::string, Value> outside_;  // memory that no variable of the source is
  std::vector<Logged> log_;                         // of stores
  std::vector<Frame> frames_;
  std::vector<Guard> guards_;
  std::vector<Exit> exits_;
  std::unordered_map<std::string, Value> definitions_;
  std::map<const Declared*, int> statics_;   // objects
  std::map<std::string, int> given_arrays_;  // objects of definitions, by their names and types
  std::map<std::uint32_t, CallSite> sites_;
  std::map<std::string, std::set<std::uint32_t>> needs_;                      // where each is used
  std::set<std::string> used_;                                                // definitions that were looked at
  std::map<std::string, std::pair<std::uint32_t, std::string>> assumptions_;  // notes, by their names in origins
  std::set<std::string> used_origins_;                       // those on which a call or a decision depends
  std::set<std::string> arrays_;                             // needed names of which four numbers are needed
  std::set<std::string> skipped_;                            // functions that were not executed
  std::string_view skipped_language_{};                      // of a program in a literal that is not for combiners
  std::set<std::uint32_t> loaded_;                           // programs in literals
  std::set<std::uint32_t> reported_;                         // places that were reported
  std::set<std::pair<std::uint32_t, std::string>> spelled_;  // places and names there that were compared
  std::map<std::string, FilledDefinition> filled_;           // by their objects
  std::vector<WholeState> drawn_;                            // programs with which something was drawn
  std::uint32_t first_skipped_ = 0, last_skipped_ = 0;
  std::map<std::string, bool> assumed_;  // conditions whose value was assumed
  std::size_t steps_ = 0, calls_made_ = 0, calls_made_on_context_ = 0;
  bool out_of_steps_ = false, set_since_drawing_ = false;
  bool switches_stages_ = false;                // a call enables or disables texture shaders
  std::optional<std::uint32_t> stages_at_{};    // of the last program in a literal that has stages
  std::optional<std::uint32_t> left_out_at_{};  // of the first stages, on a profile without texture shaders
  std::optional<Value> unknown_unit_;           // why it is not known which texture unit is active
  bool is_thrown_ = false;                      // an exception leaves functions
  int depth_ = 0, quiet_ = 0, tries_ = 0;
  std::string jump_label_;  // of Flow::jump
};

}  // namespace ninebit::code
