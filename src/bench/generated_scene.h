// A scene of any number of triangles, for measuring: a room with a light inside and six bumpy bodies around it.
#pragma once

#include <cstdint>

#include "ninebit/scene/scene.h"

namespace ninebit::bench {

inline constexpr std::uint32_t kFewestTriangles = 100;
inline constexpr std::uint32_t kMostTriangles = 20'000'000;

// At most `triangles` triangles (kFewestTriangles to kMostTriangles) and few less: 1,920 of 2,000, 99,120 of 100,000,
// 997,920 of a million. Three quarters of them are the bodies': spheres with bumps that shadow each other, themselves
// and the walls, which are cut into squares, too. One camera, in a corner of the room and looking at its middle, one
// light among the bodies. The same bits on every machine: nothing but +, -, ·, / and square roots.
[[nodiscard]] Scene generated_scene(std::uint32_t triangles);

}  // namespace ninebit::bench
