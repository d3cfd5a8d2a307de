// Combiner programs as the verbs read them: files in any form, detected from the content or given by --from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/program_text.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

struct ProgramFlags {
  std::string file;  // "-": stdin
  std::string from;  // "gl", "rc10", "words" or "json"; empty: detected
  std::string chip;  // of register words: "nv10" or "nv20"; empty: from the profile
};

// Adds the argument PROGRAM to a verb.
void add_program_argument(CLI::App& verb, const std::string& name, ProgramFlags& flags);
// Adds PROGRAM, --from and --chip to a verb.
void add_program_flags(CLI::App& verb, ProgramFlags& flags);

// The chip whose register words are read.
[[nodiscard]] ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile);

struct ProgramFile {
  std::string name;  // for messages
  std::string text;
  ProgramForm form = ProgramForm::gl;
  Parsed<CombinerState> parsed;
};

// Reads and parses a file. Reports a file that cannot be read, or that has faults and seems to be of another kind or
// language; other faults in the text are in `parsed`.
[[nodiscard]] Result<ProgramFile> read_program_file(const ProgramFlags& flags, const HardwareProfile& profile);

// The same for verbs that need a valid program. If it is not, prints everything that is wrong, sets `exit_code` and
// returns nothing.
[[nodiscard]] std::optional<CombinerState> load_program(const ProgramFlags& flags, const HardwareProfile& profile,
                                                        int& exit_code);

// Prints every fault as "ninebit: error: FILE:LINE:COLUMN: MESSAGE"; returns kInvalidInput.
[[nodiscard]] int report(const std::vector<TextFault>& faults);

}  // namespace ninebit::tools
