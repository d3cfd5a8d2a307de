// Direct3D 8's pixel shaders in assembly, ps.1.0 to ps.1.4, and the Xbox's dialect of them, xps.1.1.
// docs/languages.md documents what combiners can express, and the sources.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// Whether a text begins with the header of such a shader, after blanks, comments and lines of the preprocessor.
[[nodiscard]] bool is_pixel_shader(std::string_view text);

// Translates a shader as drivers of the GeForce3 and the Xbox's assembler did: an arithmetic instruction, or a pair of
// them, becomes one general combiner, and the final combiner outputs r0. Texture instructions run before the combiners:
// `texture_shader` receives them as stages, which are enabled if there is one but tex and texld; without it, a note
// names them. Notes name what the application sets: matrices, eye vectors, kinds of textures. Reports all faults: of
// the syntax, of Direct3D's rules for the version, and what register combiners cannot express. A shader with more
// instructions than the profile has general combiners is GL_INVALID_VALUE. `definitions` are macros that replace the
// text's own of the same name. An #if that depends on a name that neither defines is a fault; #ifdef of such a name is
// false. `include` reads the files that the text includes by names in quotation marks; faults in them have the place of
// the line that includes the file, but for a comment that does not end, which has its own. Without it, a note names
// each file, which is skipped.
[[nodiscard]] Parsed<CombinerState> parse_pixel_shader(const SourceText& source, const HardwareProfile& profile,
                                                       const std::vector<Definition>& definitions = {},
                                                       const SourceInclude& include = {},
                                                       TextureShaderState* texture_shader = nullptr);

// The state as a ps.1.1 text, or a Diagnostic that names what the language cannot express. parse_pixel_shader of the
// text returns a state that computes the same for every fragment; if this one came from a ps.1.x text, it normalizes to
// the same program, unless its final combiner outputs other registers than spare0, as for a dot product that is alpha
// alone: then the text has one more instruction. If `texture_shader` is enabled, its operations are printed; matrices
// and the kinds of textures but two-dimensional ones are not in the language.
[[nodiscard]] Result<std::string> print_pixel_shader(const CombinerState& state, const HardwareProfile& profile,
                                                     const TextureShaderState& texture_shader = {});

// Whether a text begins with the tokens of a shader that Direct3D's assembler or compiler made: bytes of a file,
// numbers, or a C array of words or bytes, "const DWORD ps[] = { 0xffff0101, …". Vertex shaders and later versions
// count, too.
[[nodiscard]] bool is_shader_tokens(std::string_view text);

// Translates the tokens of an assembled ps.1.0 to ps.1.4, as parse_pixel_shader() translates its text. Reports other
// shaders by name, and text after the last token.
[[nodiscard]] Parsed<CombinerState> parse_shader_tokens(const SourceText& source, const HardwareProfile& profile,
                                                        TextureShaderState* texture_shader = nullptr);

// The text of print_pixel_shader(), assembled: a C array of words.
[[nodiscard]] Result<std::string> print_shader_tokens(const CombinerState& state, const HardwareProfile& profile,
                                                      const TextureShaderState& texture_shader = {});

}  // namespace ninebit
