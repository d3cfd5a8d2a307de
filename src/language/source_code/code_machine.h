// Executes functions of a source on a GL context, as far as their values are known.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ninebit/language/gl_nv.h"
#include "ninebit/language/source_code.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_file.h"
#include "src/language/source_code/code_tree.h"
#include "src/language/source_code/code_value.h"
#include "src/language/source_code/code_xbox.h"

namespace ninebit::code {

// How often a call of the source was executed, and how it went.
struct CallSite {
  bool is_read = false;     // with known arguments
  bool is_unknown = false;  // with arguments that are not known
  bool is_refused = false;  // GL raised an error
  bool is_skipped = false;  // it loads a program that is not for combiners
};

// A source, parsed once for all that is executed of it.
struct Program {
  SourceText source;
  File file;
  Outline outline;
  // By names as they are compared: in Pascal, in lower case.
  std::map<std::string, std::vector<const Function*>> by_name{};  // functions by the last part of their names
  std::map<std::string, const Declared*> globals{};
  std::map<const Function*, std::vector<Statement>> bodies{};  // parsed so far
  std::map<const Function*, bool> sets_combiners{};            // decided so far
  std::set<std::string> assigned{};                            // names that functions assign to
  std::size_t steps = 0;                                       // executed so far, by all functions together

  // A name as it is compared.
  [[nodiscard]] std::string key(std::string_view name) const;
};
[[nodiscard]] Program read_program(const SourceText& source, const std::vector<Definition>& definitions,
                                   detail::SourceFaults& faults, detail::SourceFaults& notes);
// Called once a program has its final address.
void index_program(Program& program);

// The name or member that a call calls: of p->f, (*f) and CHECK(f) it is f.
[[nodiscard]] const Expression& called_operand(const Expression& callee);
// The combiners' call that a callee names; nullptr: none.
[[nodiscard]] const detail::GlSignature* signature_of(const Expression& callee, Language language);

// A name without blanks and without this., with . for ->.
[[nodiscard]] std::string normal_path(std::string_view name);

class Machine {
 public:
  Machine(Program& program, const std::vector<Definition>& definitions, const HardwareProfile& profile,
          detail::SourceFaults& faults, detail::SourceFaults& notes);

  // Executes a function on the context, as the first one or after others.
  void run(const Function& function);
  // Executes the code outside of functions.
  void run_code();
  // Loads a program in string literals, as a call of nvparse does; `offset` is that of the call. `pasted`: the
  // literals, if macros made them.
  void load(std::uint32_t begin, std::uint32_t end, std::uint32_t offset, const std::string& pasted = {});
  // Reports the values that were needed and are not known, in one fault, and notes what was skipped.
  void finish();

  [[nodiscard]] CombinerState state() const {
    CombinerState state = context_.state();
    mark_unset_constants(state, context_.constants_set());
    return state;
  }
  [[nodiscard]] std::vector<std::string> needs() const;
  [[nodiscard]] bool is_out_of_steps() const { return out_of_steps_; }
  [[nodiscard]] std::string too_many_steps() const;
  [[nodiscard]] std::map<std::string, std::set<std::uint32_t>> collected_needs() const;
  [[nodiscard]] const std::map<std::uint32_t, CallSite>& sites() const { return sites_; }
  // Where the string literals begin that were loaded.
  [[nodiscard]] const std::set<std::uint32_t>& loaded() const { return loaded_; }
  // Whether executing a statement or an expression may set combiners.
  [[nodiscard]] bool may_set(const std::vector<Statement>& statements);
  [[nodiscard]] bool may_set(const Expression& expression);
  [[nodiscard]] bool may_set(const Function& function);
  [[nodiscard]] const std::vector<Statement>& body_of(const Function& function);
  // The file's function that a call means; nullptr: none.
  [[nodiscard]] const Function* called(const Expression& call) const {
    const bool calls = call.kind == ExpressionKind::call;
    return calls ? function_of(call.parts[0], call.parts.size() - 1) : nullptr;
  }
  // Whether a definition of the Xbox was filled, and the program that it is; reports what is wrong with it.
  [[nodiscard]] bool fills_definition() const { return !filled_.empty(); }
  [[nodiscard]] Parsed<CombinerState> program_of_words(std::vector<RegisterWord>* other_words);

 private:
  enum class Flow { normal, leave, next, give_back };
  struct Frame {
    const Function* function = nullptr;
    std::unordered_map<std::string, Value> values{};
    std::unordered_map<std::string, std::string> aliases{};  // of pointers: the objects that they point to
    Value result{};
    bool has_result = false;
  };

  // Statements: code_machine.cpp; declarations: code_initial.cpp
  Flow execute(const std::vector<Statement>& statements);
  Flow execute(const Statement& statement);
  Flow branch(const Statement& statement);
  Flow loop(const Statement& statement);
  Flow each(const Statement& statement);
  Flow jump(const Statement& statement);
  [[nodiscard]] bool leads_to_calls(const Statement& jump) const;
  [[nodiscard]] bool jumps_to_calls(const std::vector<Statement>& statements) const;
  Flow choice(const Statement& statement);
  Flow either(const Value& condition, const Statement& statement);
  void declare(const Declared& declared);
  Value initial(const Declared& declared);
  std::map<std::string_view, Members>::const_iterator designated_struct(const Expression& e) const;
  Value evaluate_list(const Expression& e);
  Value shaped(const Declared& declared, Value value, std::size_t level);
  bool spend(std::size_t steps = 1);

  // Expressions: code_evaluate.cpp
  Value evaluate(const Expression& e);
  Value evaluate_once(const Expression& e);
  Value evaluate_unary(const Expression& e);
  Value evaluate_assignment(const Expression& e);
  Value evaluate_index(const Expression& e);
  Value evaluate_member(const Expression& e);
  Value number(std::string_view text) const;

  // Names and places: code_places.cpp
  Value value_of(const Expression& e);
  const Value* defined(const std::string& path);
  Value* stored(const std::string& path);
  Value* place(const Expression& e);
  static void mark_origin(Value& value, const std::string& path);
  void assign(const Expression& target, Value value);
  bool assign_element(const Expression& target, Value& value);
  std::string path_of(const Expression& e);
  std::string text_of(const Expression& e) const;
  std::optional<Value> constant(const Expression& e) const;
  static bool is_pure(const Expression& e);
  Expression settled(const Expression& e);
  void forget(const std::vector<Statement>& statements, const Value& why);
  void forget(const Expression& e, const Value& why);
  void forget_arguments(const Expression& call);

  // Calls: code_calls.cpp
  Value call(const Expression& e);
  Value call_function(const Function& function, const Expression& e);
  void call_combiner(const detail::GlSignature& signature, const Expression& e);
  Value call_nvparse(const Expression& e);
  std::optional<Value> call_known(std::string_view name, const Expression& e);
  std::optional<Value> call_buffer(std::string_view name, const Expression& e);
  std::optional<Value> call_of_numbers(std::string_view name, const std::vector<Value>& arguments) const;
  void skip(std::string_view name, const Expression& e);
  const Function* function_of(const Expression& callee, std::size_t arguments) const;
  void look_for_misspelling(std::string_view name, const Expression& e);
  bool argument(const Expression& e, bool is_array, detail::GlArgument& out);
  void need(const Value& value, const Expression& e);
  void need(const std::string& name, std::uint32_t offset);
  void need_conditions(const Function* function);
  void use(const Value& value);

  // Definitions of the Xbox: code_xbox.cpp
  std::string object_of(const Expression& e);
  void add_alias(std::string_view name, const Expression& value, Frame& frame);
  std::optional<std::size_t> number_of_word(const NamedWord& word, const Expression& e);
  Value refuse_value(const Expression& e);
  Value assign_word(const NamedWord& word, const Expression& e);
  std::optional<Value> assigned_word(const Expression& e);
  void look_for_misspelled_member(const Expression& target);
  std::optional<Value> call_of_xbox(std::string_view name, const Expression& e);

  Program& program_;
  const std::vector<Definition>& given_;
  detail::SourceFaults& faults_;
  detail::SourceFaults& notes_;
  gl::Context context_;
  std::unordered_map<std::string, Value> definitions_;
  std::unordered_map<std::string, Value> globals_;
  std::vector<Frame> frames_;
  std::map<std::uint32_t, CallSite> sites_;
  std::map<std::string, std::set<std::uint32_t>> needs_;  // where each is used
  std::set<std::string> used_;                            // definitions that were looked at
  std::map<std::string, std::uint32_t> initial_values_;   // globals that are not constant, and where they stand
  std::set<std::string> used_origins_;                    // those on which a call or a decision depends
  std::set<std::string> arrays_;                          // needed names of which four numbers are needed
  std::set<std::string> skipped_;                         // functions that were not executed
  std::string_view skipped_language_{};                   // of a program in a literal that is not for combiners
  std::set<std::uint32_t> loaded_;                        // programs in literals
  std::set<std::uint32_t> misspelled_;                    // places that were reported
  std::map<std::string, FilledDefinition> filled_;        // by their objects
  std::uint32_t first_skipped_ = 0, last_skipped_ = 0;
  std::map<std::string, bool> assumed_;  // conditions whose value was assumed
  std::map<const void*, bool> may_set_;  // statements that were looked at
  std::deque<std::string> texts_;        // of settled expressions
  std::size_t steps_ = 0, calls_made_ = 0, calls_made_on_context_ = 0, skips_ = 0, elements_ = 0;
  std::uint32_t drawn_at_ = 0;  // where the last drawing call stands; 0: none since the last set-up
  bool out_of_steps_ = false, noted_drawing_ = false;
  int depth_ = 0;
  int guesses_ = 0;  // conditions around the current statement that are not known
};

}  // namespace ninebit::code
