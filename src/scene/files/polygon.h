// Triangulation of polygons.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace ninebit {

// Concave polygons with more corners are rejected: the time to cut them is quadratic in the corners.
inline constexpr std::size_t kMostConcaveCorners = 4096;

// The largest sum, over a scene's concave polygons, of the squares of their corner counts; polygons with few corners do
// not count.
inline constexpr std::uint64_t kMostConcaveEffort = std::uint64_t{1} << 27U;
inline constexpr std::size_t kSmallPolygon = 16;

// Appends the n - 2 triangles of a polygon with n >= 3 corners, each as three indices into corners, in the polygon's
// winding. Convex polygons become a fan around their first corner. If no ear is left (the polygon crosses itself or has
// no area), the rest becomes a fan, so that the count is always n - 2. Returns false, with nothing appended, for a
// concave polygon beyond kMostConcaveCorners. `effort` grows by the square of a concave polygon's corners, which is
// proportional to the time to cut it.
[[nodiscard]] bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                               std::uint64_t* effort = nullptr);

}  // namespace ninebit
