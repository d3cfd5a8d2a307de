// The flags of verbs that read a program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"

namespace ninebit::tools {

struct ProgramFlags {
  std::string file{};                    // "-": stdin; LOG#N: a set-up of a log; SOURCE#N: a program of a function
  std::string from{};                    // a form, as --from names it; empty: detected
  std::string chip{};                    // of register words: "nv10" or "nv20"; empty: from the profile
  std::vector<std::string> functions{};  // of a source
  std::vector<std::string> defines{};    // of a source or a pixel shader: NAME=VALUE
  bool writes_words = false;             // the verb writes register words, for --chip
};

// Adds the argument PROGRAM to a verb.
void add_program_argument(CLI::App& verb, const std::string& name, ProgramFlags& flags);
// Adds --define, whose values are NAME=VALUE.
void add_define_flag(CLI::App& verb, std::vector<std::string>& defines);
// Adds PROGRAM, --from, --chip, --function and --define to a verb.
void add_program_flags(CLI::App& verb, ProgramFlags& flags);

// The chip whose register words are read.
[[nodiscard]] ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile);

// The values of --function and --define.
[[nodiscard]] SourceSelection selection_of(const ProgramFlags& flags);

}  // namespace ninebit::tools
