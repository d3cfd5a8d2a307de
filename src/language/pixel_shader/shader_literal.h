// Pixel shaders in string literals, as they stand in sources.
#pragma once

#include <cstddef>
#include <string_view>

namespace ninebit::detail {

// The quote of the first string literal of C whose content begins with a shader's header; npos: there is none.
[[nodiscard]] std::size_t find_shader_literal(std::string_view text);

}  // namespace ninebit::detail
