// #if, #ifdef and their kin: which parts of a file are read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/source_code.h"
#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_token.h"

namespace ninebit::code {

class MacroExpander;
struct File;

class Conditions {
 public:
  Conditions(File& file, const std::vector<Definition>& definitions, const MacroExpander& macros,
             detail::SourceFaults& notes);

  // Obeys a directive, if it is one of conditions; false: it is another one.
  bool obey(const Token& directive, const std::vector<Token>& line);
  // Whether the current part is read.
  [[nodiscard]] bool reads() const { return open_.empty() || open_.back().reads; }

 private:
  // A whole #if … #endif: where it begins, each further branch begins, and it ends.
  struct Group {
    std::vector<std::uint32_t> branches{};
    std::uint32_t end = 0;
  };
  struct OpenGroup {
    const Group* group = nullptr;  // nullptr: not known
    bool outer = true;             // whether the part around it is read
    bool reads = false;            // the current branch
    bool taken = false;            // a branch was read
  };
  // A condition with names that are not defined taken as 0, as C does; `sure` if there are none.
  struct Answer {
    bool value = false;
    bool sure = true;
    std::string unknown{};  // a name without a value that decides; empty: none
  };

  void find_groups();
  [[nodiscard]] const Definition* definition(std::string_view name);
  [[nodiscard]] bool is_defined(std::string_view name);
  [[nodiscard]] Answer answer(const Token& directive, const std::vector<Token>& line);
  [[nodiscard]] bool chosen(const OpenGroup& open, const Token& directive, const std::vector<Token>& line);
  [[nodiscard]] bool holds_all_calls(const Group& group) const;
  [[nodiscard]] bool has_calls(const Group& group, std::size_t branch) const;

  File& file_;
  const std::vector<Definition>& definitions_;
  const MacroExpander& macros_;
  detail::SourceFaults& notes_;
  std::vector<Group> groups_;  // in the order of their first lines
  std::vector<OpenGroup> open_;
};

}  // namespace ninebit::code
