// The members of D3DPIXELSHADERDEF.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/register_words.h"
#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit::xbox {

struct Field {
  std::string_view name;
  std::size_t first = 0;  // its first word
  std::size_t count = 1;  // more than one: an array
};

// In the order of the struct.
[[nodiscard]] std::span<const Field> fields();

// The member of a name, in any case; null: there is none. "PSAphaInputs" is one that Cxbx prints by mistake.
[[nodiscard]] const Field* find_field(std::string_view name);

// The names of all members, for suggestions.
[[nodiscard]] std::vector<std::string_view> field_names();

// The member that a word belongs to, and the word's name: "PSRGBInputs[3]".
[[nodiscard]] const Field& field_of(std::size_t word);
[[nodiscard]] std::string word_name(std::size_t word);

// The fault of a member's index, or of a missing one; empty: none.
[[nodiscard]] std::string index_fault(const Field& field, std::optional<std::int64_t> index);

// Whether a function sets memory to a value, which for a definition is 0: memset, ZeroMemory, …
[[nodiscard]] bool clears_memory(std::string_view function);

// A definition, with the offset of every word that the text has.
struct Definition {
  std::array<std::uint32_t, kXboxDefinitionWords> words{};
  std::array<std::optional<std::size_t>, kXboxDefinitionWords> offsets{};
};

// The program of a definition; `other_words` receives what parse_xbox_pixel_shader says.
[[nodiscard]] Parsed<CombinerState> program_of_definition(const Definition& definition, const SourceText& source,
                                                          const HardwareProfile& profile,
                                                          std::vector<RegisterWord>* other_words);

}  // namespace ninebit::xbox
