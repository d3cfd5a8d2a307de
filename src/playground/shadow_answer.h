// Index cube shadows in the playground.
#pragma once

#include <cstdint>
#include <vector>

#include "src/playground/request.h"

namespace ninebit::playground {

// {"do": "shadow", …}: the picture, then the index cube unfolded, as RGBA in `bytes`.
[[nodiscard]] Reply shadow_answer(Request& request, std::vector<std::uint8_t>& bytes);

}  // namespace ninebit::playground
