// Index cube shadows in the playground.
#pragma once

#include <cstdint>
#include <vector>

#include "src/playground/engine.h"

namespace ninebit::playground {

// {"do": "shadow", …}: the picture, then the index cube unfolded, as RGBA in `bytes`.
[[nodiscard]] Reply shadow_answer(Request& request, const Shelf& shelf, std::vector<std::uint8_t>& bytes);

}  // namespace ninebit::playground
