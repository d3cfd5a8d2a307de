// Hashes of what was drawn, by which two renderings are compared to the bit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/shadow/technique.h"

namespace ninebit::tools {

// SHA-256 of the planes of each name: color, stencil, index_map where there is one, then the maps by their names.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> picture_hashes(const Rendering& rendering);

}  // namespace ninebit::tools
