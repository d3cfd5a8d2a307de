// The Xbox's pixel shader definition, D3DPIXELSHADERDEF, as code fills it: assignments to its members.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "src/language/source_code/code_tree.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::code {

// A member of a definition that an expression names: of definition->PSRGBInputs[i] the object is definition.
struct NamedWord {
  const xbox::Field* field = nullptr;  // nullptr: the expression names none
  const Expression* object = nullptr;
  const Expression* index = nullptr;  // nullptr: there is none
};
[[nodiscard]] NamedWord named_word(const Expression& e);

// Whether an expression assigns to a member of a definition.
[[nodiscard]] bool assigns_word(const Expression& e);

// The words that were assigned to one object, and where.
struct FilledDefinition {
  xbox::Definition definition{};
  std::map<std::size_t, std::uint32_t> offsets{};  // of the words that have a value
  std::uint32_t offset = 0;                        // of the first
  std::string name{};                              // of the object, as the source writes it there
};

}  // namespace ninebit::code
