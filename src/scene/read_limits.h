// What a scene may hold; docs/limits.md lists it.
#pragma once

#include <cstdint>

namespace ninebit {

// A scene's file, and each file that it names, in bytes: its lines can be counted in an int.
inline constexpr std::uint64_t kMostSceneBytes = (std::uint64_t{1} << 31U) - 1;

// The triangles of a scene. A few nodes can place a large mesh again and again, and many primitives can share what they
// draw: so a scene has at most kMostPlacedAgain triangles more than its files have bytes.
inline constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;
inline constexpr std::uint64_t kMostPlacedAgain = std::uint64_t{1} << 23U;

// The buffers that a glTF file may have, and the material libraries that an OBJ file may name.
inline constexpr std::uint64_t kMostBuffers = 4096;
inline constexpr std::uint64_t kMostLibraries = 256;

}  // namespace ninebit
