// Pixel shaders in assembly: from tokens to instructions.
#pragma once

#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/pixel_shader/shader_macros.h"

namespace ninebit::detail {

// Reads all instructions. Reports faults of the syntax, unknown words, and instructions, modifiers and registers that
// the version does not have. Instructions with faults are left out.
[[nodiscard]] ShaderText parse_shader(const ShaderTokens& tokens, SourceFaults& faults, SourceFaults& notes);

// Reports what Direct3D's rules for the version do not allow, although each instruction for itself is right.
void check_shader_rules(const ShaderText& text, SourceFaults& faults);

}  // namespace ninebit::detail
