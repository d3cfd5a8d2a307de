// Combiner programs as the verbs read them: files in any form, detected from the content or given by --from.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/program_text.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/source_text.h"
#include "src/tools/input/eval_table.h"
#include "src/tools/input/input_file.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// The flags of verbs that read a program.
struct ProgramFlags {
  std::string file{};                    // "-": stdin; LOG#N: a set-up of a log; SOURCE#N: a program of a function
  std::string from{};                    // a form, as --from names it; empty: detected
  std::string chip{};                    // of register words: "nv10" or "nv20"; empty: from the profile
  std::vector<std::string> functions{};  // of a source
  std::vector<std::string> defines{};    // of a source or a pixel shader: NAME=VALUE
  bool writes_words = false;             // the verb writes register words, for --chip
  bool allow_outside = false;            // files that it includes may lie outside of its folder
};

// Adds the argument PROGRAM to a verb.
void add_program_argument(CLI::App& verb, const std::string& name, ProgramFlags& flags);
// Adds --define, whose values are NAME=VALUE.
void add_define_flag(CLI::App& verb, std::vector<std::string>& defines);
// Adds PROGRAM, --from, --chip, --function and --define to a verb.
void add_program_flags(CLI::App& verb, ProgramFlags& flags);
// Adds --allow-outside to a verb that has no other files than programs.
void add_include_flag(CLI::App& verb, bool& allow_outside);

// The chip whose register words are read.
[[nodiscard]] ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile);

// The values of --function and --define.
[[nodiscard]] SourceSelection selection_of(const ProgramFlags& flags);

// A name of a program as it is given: the file and, of LOG#N, the set-up N of the log of register writes in it.
struct SetupName {
  std::string file;                    // "-": standard input
  std::optional<std::size_t> setup{};  // the number behind #, which may be 0; empty: there is none
};

// Takes "#N" from the end of a name, unless there is a file of the whole name.
[[nodiscard]] SetupName setup_name(const std::string& name);

// A file whose form is known, before it is parsed.
struct ProgramSource {
  std::string name;  // for messages
  std::string text;  // of a log, its beginning
  ProgramForm form = ProgramForm::gl;
  std::optional<std::size_t> setup{};  // of LOG#N or SOURCE#N
  std::optional<InputFile> rest{};     // of a log that is longer than a program may be
};

// Reads a file until its form is known, and all of it unless it is a long log. Reports a file that cannot be read, is
// empty or too long, and a set-up of a file that is not a log.
[[nodiscard]] Result<ProgramSource> open_program(const ProgramFlags& flags);

// Reads a log to its end. `frame`: as in RegisterLogOptions.
[[nodiscard]] Result<Parsed<RegisterLog>> read_log(ProgramSource& source, const ProgramFlags& flags,
                                                   const HardwareProfile& profile,
                                                   std::optional<std::uint32_t> frame = {});

struct ProgramFile {
  std::string name;  // for messages
  std::string text;
  ProgramForm form = ProgramForm::gl;
  Parsed<TextProgram> parsed;
};

// Reads and parses a file. Reports a file that cannot be read, or that has faults and seems to be of another kind or
// language; other faults in the text are in `parsed`.
[[nodiscard]] Result<ProgramFile> read_program_file(const ProgramFlags& flags, const HardwareProfile& profile);
// The same for a file that is open.
[[nodiscard]] Result<ProgramFile> read_program_file(ProgramSource source, const ProgramFlags& flags,
                                                    const HardwareProfile& profile);

// The same for verbs that need a valid program. If it is not, prints everything that is wrong, sets `exit_code` and
// returns nothing. Prints what was skipped or assumed, unless `quiet`.
[[nodiscard]] std::optional<TextProgram> load_text_program(const ProgramFlags& flags, const HardwareProfile& profile,
                                                           bool quiet, int& exit_code);
[[nodiscard]] std::optional<TextProgram> load_text_program(ProgramSource source, const ProgramFlags& flags,
                                                           const HardwareProfile& profile, bool quiet, int& exit_code);
// Reads the files that a source or a shader includes, where they lie in its folder or may lie outside of it.
[[nodiscard]] SourceInclude include_beside(const std::string& file, bool allow_outside);

// The set-up `source.setup` of a log that was read from the source.
[[nodiscard]] std::optional<TextProgram> load_setup(Parsed<RegisterLog> log, ProgramSource source,
                                                    const HardwareProfile& profile, bool quiet, int& exit_code);

// Whether --function or --define was given for a file that does not take it, or --chip for one that has no register
// words; says so.
[[nodiscard]] bool misuses_source_flags(const ProgramFlags& flags, std::string_view name, ProgramForm form);

// Prints what was skipped or assumed in a text, a line each: "ninebit: note: FILE:LINE:COLUMN: MESSAGE".
void say_notes(const std::vector<TextFault>& notes);

// Prints which constants of the program are not set and that 0 is assumed for them, as a note. `given`: columns that
// give constants.
void say_assumed_constants(const std::string& file, const Program& program, const std::vector<EvalColumn>& given);

// Prints every fault as "ninebit: error: FILE:LINE:COLUMN: MESSAGE", then the line of `text`, which has the faults,
// with a mark under the place, as compilers do. Without the text, only the first line. Returns kInvalidInput.
[[nodiscard]] int report(const std::vector<TextFault>& faults, std::string_view text = {});

}  // namespace ninebit::tools
