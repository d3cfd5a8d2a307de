// Hashes of the drawn planes, to compare two renderings to the bit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/shadow/technique.h"

namespace ninebit::tools {

// SHA-256 by name: color, stencil, index_map if there is one, then the maps in the order of their names.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> picture_hashes(const Rendering& rendering);

}  // namespace ninebit::tools
