// A scene with any number of triangles for benchmarks: a room with a light and six bumpy bodies around the light.
#pragma once

#include <cstdint>

#include "ninebit/scene/scene.h"

namespace ninebit::bench {

inline constexpr std::uint32_t kFewestTriangles = 100;
inline constexpr std::uint32_t kMostTriangles = 20'000'000;

// Has at most `triangles` triangles (kFewestTriangles to kMostTriangles), and only a few less: 1,920 for 2,000, 99,120
// for 100,000, 997,920 for a million. Three quarters belong to the bodies: bumpy spheres that shadow each other,
// themselves and the walls. The walls are divided into squares too. One camera in a corner of the room looks at its
// middle; one light is among the bodies. The scene has the same bits on every machine: it is computed with +, -, ·, /
// and square roots only.
[[nodiscard]] Scene generated_scene(std::uint32_t triangles);

}  // namespace ninebit::bench
