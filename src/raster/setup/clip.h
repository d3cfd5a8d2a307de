// Clipping against the near and far planes and the guard band, in clip coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

namespace ninebit {

// How far the guard band reaches beyond the view volume's sides: |x| <= x w, |y| <= y w.
struct GuardBand {
  float x = 1.0F;
  float y = 1.0F;
};

// In doubles: their differences and products cannot overflow, and near the eye an error is magnified by 1 / w.
struct ClipVertex {
  glm::dvec4 position;
  glm::dvec3 weight;  // barycentric coordinates in the primitive before clipping
  bool boundary;      // whether the edge from here to the next vertex is on the polygon's boundary
};

// Clipping a triangle against six planes leaves nine corners at most, as long as the polygon stays convex. Rounding can
// bend a degenerate one; a plane then still adds no more than one corner for every two.
inline constexpr std::size_t kMaxCorners = 28;  // 3, 4, 6, 9, 13, 19, 28

struct ClipPolygon {
  std::array<ClipVertex, kMaxCorners> vertex;
  int count = 0;
};

// Below it the corners' weights, edge function / w, would no longer be finite. Only clip_from_object matrices that are
// not projections give such a w inside the clip volume; primitives there are not drawn.
inline constexpr float kSmallestW = 0x1p-80F;

// Which planes have a vertex outside, a bit each; empty: the primitive is not visible, because a coordinate is
// not finite or because all vertices are outside one plane or beyond one side of the view volume.
[[nodiscard]] std::optional<unsigned> crossed_planes(const std::array<glm::vec4, 3>& clip, const GuardBand& guard);
[[nodiscard]] std::optional<unsigned> crossed_planes(const std::array<glm::vec4, 2>& clip, const GuardBand& guard);

// Clips a triangle against the crossed planes; no vertices: nothing remains. `boundary` says which of the edges 0-1,
// 1-2, 2-0 are on the boundary; the edges that clipping adds are (OpenGL 1.3, 2.11).
[[nodiscard]] ClipPolygon clip_triangle(const std::array<glm::vec4, 3>& clip, const std::array<bool, 3>& boundary,
                                        unsigned crossed, const GuardBand& guard);

// Clips a line, from its first end to its second: none or two vertices.
[[nodiscard]] ClipPolygon clip_line(const std::array<glm::vec4, 2>& clip, unsigned crossed, const GuardBand& guard);

// Whether a point lies in the view volume (OpenGL 1.3, 2.11), or at least between its sides.
[[nodiscard]] bool is_in_view_volume(const glm::vec4& clip);
[[nodiscard]] bool is_between_sides(const glm::vec4& clip);

// Whether both ends of a line lie beyond one side of the view volume.
[[nodiscard]] bool is_beyond_a_side(const std::array<glm::vec4, 2>& clip);

}  // namespace ninebit
