// Pixel shaders as they stand in sources.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/pixel_shader.h"

namespace ninebit::detail {

// The quote of the first string literal of C whose content begins with a shader's header; npos: there is none.
[[nodiscard]] std::size_t find_shader_literal(std::string_view text);

// As parse_pixel_shader, but without notes about definitions that were not needed: adds to `used` the names of the
// others.
[[nodiscard]] Parsed<CombinerState> parse_defined_shader(const SourceText& source,
                                                         const std::vector<Definition>& definitions,
                                                         const HardwareProfile& profile, std::set<std::string>& used);

}  // namespace ninebit::detail
