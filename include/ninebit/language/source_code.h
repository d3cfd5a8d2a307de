// Combiner programs in source files: the calls are found and executed, function by function.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// A function of a source that sets combiners.
struct SourceFunction {
  std::string name{};      // with its class, if the source gives one: "Water::setup"; "" for code outside of functions
  int line = 0;            // where its body begins, from 1
  bool is_helper = false;  // its calls depend on its parameters, and another function calls it
  int calls_read = 0;      // combiner calls whose arguments are known; also assignments to an Xbox's definition
  int calls_not_read = 0;  // the others, and those that are never reached
  int calls_refused = 0;   // calls read that GL refuses, or whose arguments or programs are faulty
  std::vector<TextFault> faults{};   // what is wrong: GL errors, misspelled names, wrong arguments, faulty programs
  std::vector<std::string> needs{};  // names of values that are not known, for Definition::name
};

// The part of a source to read.
struct SourceSelection {
  // Executed in this order on one context, by name or NAME:LINE; empty: the only one.
  std::vector<std::string> functions{};
  // Values that the source does not give.
  std::vector<Definition> definitions{};
  // Reads files that the source includes; without it, none is read.
  SourceInclude include{};
  // The program to take of a function that draws between its set-ups, from 1; 0: the only one.
  std::size_t program = 0;
};

// The functions of a source that set combiners, in the order of the text; each is executed by itself with the profile.
// Reads C and C++, and of Java what is alike; docs/languages.md says what is followed, and what makes a value unknown.
[[nodiscard]] std::vector<SourceFunction> find_source_functions(const SourceText& source,
                                                                const std::vector<Definition>& definitions,
                                                                const HardwareProfile& profile,
                                                                const SourceInclude& include = {});

// Executes functions of a source on a new context of the profile, and gives its state at the end. A call whose
// arguments are not known, or of which it is not known whether it is reached, is a fault; one fault lists all names
// that must be defined. Notes say what was skipped and what was assumed. Without a selection, a source with several
// functions that set combiners is a fault that lists them; so is a function that draws between its set-ups, which has
// several programs.
// Functions may fill a D3DPIXELSHADERDEF instead (xbox_pixel_shader.h): the program is then that of its words, and
// `other_words` receives those that combiners do not read. Calls of texture shaders (glTexEnv with
// GL_TEXTURE_SHADER_NV, glActiveTexture, !!TS1.0) are read if the profile has texture shaders; `texture_shader`
// receives the stages if they are enabled at the end.
[[nodiscard]] Parsed<CombinerState> parse_source_code(const SourceText& source, const SourceSelection& selection,
                                                      const HardwareProfile& profile,
                                                      std::vector<RegisterWord>* other_words = nullptr,
                                                      TextureShaderState* texture_shader = nullptr);

// Whether a text looks like a source file or a part of one: it has functions, control flow or preprocessor lines, and
// names calls of the combiners.
[[nodiscard]] bool is_source_code(std::string_view text);

// Whether a text looks like source code for OpenGL that need not name a call of the combiners: it has functions, and
// calls some of GL's.
[[nodiscard]] bool is_gl_source_code(std::string_view text);

}  // namespace ninebit
