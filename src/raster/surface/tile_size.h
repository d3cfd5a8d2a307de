// How targets are cut into tiles.
#pragma once

namespace ninebit {

inline constexpr int kTileSize = 64;  // pixels, a power of two

}  // namespace ninebit
