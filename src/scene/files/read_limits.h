// The limits of a scene; docs/internals/limits.md lists them.
#pragma once

#include <cstdint>

namespace ninebit {

// The bytes of a scene file, and of each file that it names: the lines can be counted in an int.
inline constexpr std::uint64_t kMostSceneBytes = (std::uint64_t{1} << 31U) - 1;

// The triangles of a scene. A few nodes can place a large mesh many times, and many primitives can share their data, so
// a scene has at most kMostPlacedAgain triangles more than its files have bytes.
inline constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;
inline constexpr std::uint64_t kMostPlacedAgain = std::uint64_t{1} << 23U;

// The most buffers of a glTF file, and the most material libraries of an OBJ file.
inline constexpr std::uint64_t kMostBuffers = 4096;
inline constexpr std::uint64_t kMostLibraries = 256;

}  // namespace ninebit
