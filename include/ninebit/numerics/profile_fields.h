// The fields of a hardware profile as one table.
//
// A field stands in HardwareProfile, in this table, and in the rule that reads it. Everything that goes through a
// profile field by field walks the table: profile files, `ninebit profiles`, the controls of pages, proofs, verify.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The part of the hardware that a field belongs to.
enum class FieldGroup : std::uint8_t {
  numbers,          // the numbers that registers hold, with any arithmetic
  integer_rules,    // rules of integer arithmetic; other arithmetics do not read them
  features,         // what the chip has
  start_registers,  // registers before the first general combiner
  rasterizer,       // coverage, depth, interpolation, textures
  texture_shader    // texture-shader stages
};

// The type of a field's value.
enum class FieldKind : std::uint8_t { number, flag, word };

// A word that a field may have as its value.
struct FieldWord {
  std::string_view word;  // as a profile file writes it: "toward-zero"
  std::string_view text;  // as `ninebit profiles` prints it: "toward zero"
};

// Two numbers: the ends of a range, or two rivals.
struct FieldNumbers {
  int first = 0;   // the lowest, or one rival
  int second = 0;  // the highest, or the other rival
};

// A field of HardwareProfile. A value is a number: of a flag 0 or 1, of a word its place in `words`.
struct ProfileField {
  std::string_view name;             // as a profile file writes it
  FieldGroup group;                  // the part of the hardware that it belongs to
  FieldKind kind;                    // of its value
  std::span<const FieldWord> words;  // of a word, in the order of its enumeration
  // The lowest and the highest value of a number that fit the other fields of the profile.
  FieldNumbers (*range)(const HardwareProfile& profile);
  // The two values of a number that the evidence lets compete; nullptr: it has no rival.
  FieldNumbers (*rivals)(const HardwareProfile& profile);
  std::string_view rules;  // of docs/numerics.md, as "5, 8"; empty: none
  std::string_view help;   // one sentence
  Choice<int> (*get)(const HardwareProfile& profile);
  void (*set)(HardwareProfile& profile, const Choice<int>& choice);

  // The value that a profile file writes as `word`, of a field with words.
  [[nodiscard]] std::optional<int> value_of(std::string_view word) const;
  // A value as a profile file writes it, without quotation marks: "128", "true", "toward-zero".
  [[nodiscard]] std::string word_of(int value) const;
  // A value as `ninebit profiles` prints it: "128", "yes", "toward zero".
  [[nodiscard]] std::string text_of(int value) const;
};

// All fields, in the order of HardwareProfile.
[[nodiscard]] std::span<const ProfileField> profile_fields();

// The field of that name, or nullptr.
[[nodiscard]] const ProfileField* find_profile_field(std::string_view name);

// Sets the value of a field and leaves its evidence. No output lies below what a register can hold: `lowest` and
// `lowest_output` move each other along.
void set_field(HardwareProfile& profile, const ProfileField& field, int value);

// Returns the same chip with exact combiners: the fields of the groups `numbers` and `integer_rules` are those of
// `ideal`. Pictures under both differ by the combiners' arithmetic alone.
[[nodiscard]] HardwareProfile with_exact_combiners(HardwareProfile profile);

}  // namespace ninebit
