// A source file as tokens, its macros expanded and its conditional parts chosen.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/source_code.h"
#include "src/language/c_like/c_macros.h"
#include "src/language/source/source_faults.h"

namespace ninebit::code {

// A whole #if … #endif that sets combiners and has a condition that depends on a name without a value.
struct OpenCondition {
  std::uint32_t begin = 0, end = 0;  // of the whole
  std::uint32_t offset = 0;          // of the condition
  std::string name{};
};

struct File {
  std::string_view text;
  std::vector<Token> tokens{};  // the last is Token::Kind::end
  std::vector<std::uint32_t>
      closing{};  // of each bracket that opens, the index of the one that closes it; else its own
  Macros macros{};
  std::deque<std::string> included{};                       // texts of included files
  std::vector<std::uint32_t> calls{};                       // where the text names a combiner call, ascending
  std::set<std::string, std::less<>> used_by_conditions{};  // names that the caller defined
  std::vector<OpenCondition> open_conditions{};             // read as if their names were 0
  bool reads_stages = false;                                // calls of texture shaders set a part of the program

  // Whether the bytes [begin, end) name a combiner call.
  [[nodiscard]] bool calls_between(std::size_t begin, std::size_t end) const;
};

// The places of all names that mean calls of combiners or of nvparse and are called, and of the members of an Xbox's
// definition that are assigned to; with `reads_stages` also of calls that may set texture shaders.
[[nodiscard]] std::vector<std::uint32_t> calls_of(std::string_view text, bool reads_stages);

// Whether a text names the target of glTexEnv that sets texture shaders. Texts that do not have no calls of them.
[[nodiscard]] bool names_stages(std::string_view text);

// Reads a file. Names that neither the file nor the selection defines are not defined in #ifdef and 0 in #if, as in C,
// with these exceptions: names of OpenGL's extensions are defined; if just one branch sets combiners, that one is read,
// with a note; and a condition of #if that then depends on such a name is one of File::open_conditions. A skipped
// branch that sets combiners is noted, too.
// `file.reads_stages` is the caller's.
void read_file(File& file, const SourceText& source, const SourceSelection& selection, detail::SourceFaults& faults,
               detail::SourceFaults& notes);

}  // namespace ninebit::code
