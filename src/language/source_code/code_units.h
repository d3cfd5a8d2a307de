// The parts of a source that can be executed by themselves: functions, the code outside of them, programs in strings.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ninebit/language/source_code.h"
#include "src/language/source_code/code_machine.h"

namespace ninebit::code {

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
  bool is_root = false;                // it has calls of its own, or gives their arguments, and is no helper
};

// A source with its units, in the order of the text; the code outside of functions comes first.
class Units {
 public:
  Units(const SourceText& text, const SourceSelection& selection, const HardwareProfile& profile);

  [[nodiscard]] const std::vector<Unit>& all() const { return units_; }
  [[nodiscard]] Program& program() { return program_; }
  [[nodiscard]] detail::SourceFaults& faults() { return faults_; }
  [[nodiscard]] detail::SourceFaults& notes() { return notes_; }

  // The units of these names, or without names the only one; reports what is wrong with the choice.
  [[nodiscard]] std::vector<const Unit*> choose(const std::vector<std::string>& names);
  // Whether a function that was described loads this text.
  [[nodiscard]] bool is_loaded(const Unit& text) const { return loaded_.count(text.offset) != 0; }
  // Executes a unit and describes it.
  [[nodiscard]] SourceFunction describe(const Unit& unit);
  static void run(Machine& machine, const Unit& unit);

 private:
  void find_functions();
  [[nodiscard]] std::vector<const Token*> misspelled_calls() const;
  void report_no_units();
  [[nodiscard]] bool depends_on_parameters(const Function& function);
  void find_texts();
  [[nodiscard]] bool is_joined(std::size_t token) const;
  [[nodiscard]] std::string name_of_text(std::size_t token) const;
  [[nodiscard]] const Unit* named(const std::string& wanted);
  [[nodiscard]] std::string list_of_units() const;
  [[nodiscard]] int line_of(const Unit& unit) const { return program_.source.place(unit.offset).line; }

  const std::vector<Definition>& definitions_;
  const HardwareProfile& profile_;
  detail::SourceFaults faults_, notes_;
  Program program_;
  std::vector<Unit> units_;
  std::set<std::uint32_t> loaded_;  // texts
};

}  // namespace ninebit::code
