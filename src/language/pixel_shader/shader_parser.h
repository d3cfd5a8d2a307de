// Pixel shaders in assembly, step by step: from tokens to instructions, and from instructions to a program.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/pixel_shader.h"
#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/pixel_shader/shader_macros.h"

namespace ninebit::detail {

// Reads all instructions. Reports faults of the syntax, unknown words, and instructions, modifiers and registers that
// the version does not have. Instructions with faults are left out.
[[nodiscard]] ShaderText parse_shader(const ShaderTokens& tokens, SourceFaults& faults);

// Reports what Direct3D's rules for the version do not allow, although each instruction for itself is right.
void check_shader_rules(const ShaderText& text, SourceFaults& faults);

// The state of a shader. Reports what register combiners cannot express; the state is of use only without faults.
[[nodiscard]] CombinerState translate_shader(const ShaderText& text, const HardwareProfile& profile,
                                             SourceFaults& faults, SourceFaults& notes);

// The texture-shader stages of a shader's texture instructions; not enabled if all are tex or texld. Reports what
// Direct3D's rules and the stages do not allow; notes name what the application sets.
[[nodiscard]] TextureShaderState translate_textures(const ShaderText& text, const HardwareProfile& profile,
                                                    SourceFaults& faults, SourceFaults& notes);
// The instructions of stages for a ps.1.1 text, a line each, or a Diagnostic. `eye`: the constant that has the eye
// vector.
[[nodiscard]] Result<std::string> print_textures(const TextureShaderState& state, const std::string& eye);

// The program of a shader that was read: checks the rules, translates, and notes what the text leaves to others.
[[nodiscard]] Parsed<CombinerState> program_of_shader(const ShaderText& text, const HardwareProfile& profile,
                                                      SourceFaults& faults, SourceFaults& notes,
                                                      TextureShaderState* texture_shader);

// As parse_pixel_shader, but without notes about definitions that were not needed: adds to `used` the names of the
// others.
[[nodiscard]] Parsed<CombinerState> parse_defined_shader(const SourceText& source,
                                                         const std::vector<Definition>& definitions,
                                                         const HardwareProfile& profile, std::set<std::string>& used,
                                                         const SourceInclude& include = {},
                                                         TextureShaderState* texture_shader = nullptr);

// The quote of the first string literal of C whose content begins with a shader's header; npos: there is none.
[[nodiscard]] std::size_t find_shader_literal(std::string_view text);

}  // namespace ninebit::detail
