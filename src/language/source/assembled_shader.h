// Shaders of Direct3D that an assembler or a compiler made: tokens of 32 bits, of which the first has the version.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit {

// For the first token of such a shader: the message that names it, "these are the tokens of an assembled pixel shader
// (ps.1.1), …". Empty: no shader begins with this token.
[[nodiscard]] std::string assembled_shader(std::uint32_t first_token);

struct AssembledShader {
  std::size_t offset = 0;  // of the first token
  std::string message{};
};
// The shader in the C array, of words or bytes, that a text begins with: "const DWORD ps[] = { 0xffff0101, …". Empty:
// there is none.
[[nodiscard]] std::optional<AssembledShader> assembled_shader_in(std::string_view text);

}  // namespace ninebit
