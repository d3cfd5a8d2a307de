// The words of the Xbox's pixel shader definition that combiners do not read, by all their names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/register_words.h"
#include "src/language/register_words/register_words_faults.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {
namespace words {

// The name in kOtherWordNames of a name or an alias, case-insensitive and with any prefix; empty if it is none of them.
[[nodiscard]] std::string_view find_other_word(std::string_view name);

// Collects those of a text's words.
struct OtherWords {
  // Keeps a word that is one of them, under its own name; on NV10, and a second time, it is a fault. Returns whether it
  // is one.
  bool take(const RegisterWord& word, ChipClass chip, TextFaults& faults);

  std::vector<RegisterWord> found{};
};

}  // namespace words
}  // namespace ninebit
