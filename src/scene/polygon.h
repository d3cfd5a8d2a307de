// Cutting a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace ninebit {

// Concave polygons with more corners than this are refused: cutting them takes time in the square of the corners.
inline constexpr std::size_t kMostConcaveCorners = 4096;

// The squares of the corners of a scene's concave polygons, all told; those with few corners do not count.
inline constexpr std::uint64_t kMostConcaveEffort = std::uint64_t{1} << 27U;
inline constexpr std::size_t kSmallPolygon = 16;

// Appends the n - 2 triangles of a polygon with n >= 3 corners, each as three indices into corners, in the polygon's
// winding. Convex polygons become a fan around their first corner. A polygon that has no ear left (it crosses itself
// or has no area) is finished as a fan, so that the count is always n - 2. False, with nothing appended, for a concave
// polygon beyond kMostConcaveCorners. `effort` grows by the square of a concave polygon's corners, which is what
// cutting it takes.
[[nodiscard]] bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                               std::uint64_t* effort = nullptr);

}  // namespace ninebit
