// Vertices from object space to the window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/raster/rasterizer.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

// Positions in clip coordinates, computed on demand, in floats in a fixed order.
class ClipPositions {
 public:
  // The arrays have been checked.
  ClipPositions(const glm::mat4& clip_from_object, const VertexArrays& arrays)
      : matrix_(clip_from_object), points_(arrays.positions), homogeneous_(arrays.homogeneous_positions) {}

  [[nodiscard]] const glm::mat4& matrix() const { return matrix_; }
  [[nodiscard]] std::size_t size() const { return points_.empty() ? homogeneous_.size() : points_.size(); }
  // One of them is empty.
  [[nodiscard]] std::span<const glm::vec3> points() const { return points_; }
  [[nodiscard]] std::span<const glm::vec4> homogeneous() const { return homogeneous_; }
  [[nodiscard]] glm::vec4 operator[](std::size_t vertex) const {
    const glm::vec4 p = points_.empty() ? homogeneous_[vertex] : glm::vec4(points_[vertex], 1.0F);
    glm::vec4 clip;
    for (int i = 0; i < 4; ++i) {
      clip[i] = ((matrix_[0][i] * p.x + matrix_[1][i] * p.y) + matrix_[2][i] * p.z) + matrix_[3][i] * p.w;
    }
    return clip;
  }

 private:
  glm::mat4 matrix_;
  std::span<const glm::vec3> points_;
  std::span<const glm::vec4> homogeneous_;
};

// A vertex as the setup of several triangles at a time reads it. If kNeedsCare is set, only the code is valid.
struct PackedVertex {
  std::int32_t x_q4_and_code;  // x_q4 << kCodeBits | code
  std::int32_t y_q4;
  std::int32_t z24;
  std::int32_t inv_w_bits;  // of a float
};

// A set of bits. A polygon all of whose vertices are beyond one plane or side cannot be seen (crossed_planes says so,
// too); one of whose vertices none needs care crosses no plane and has usable w. All others clip.h has to look at: the
// guard band is taken a little too narrow here, to need no doubles.
inline constexpr int kCodeBits = 8;
inline constexpr std::int32_t kBeyondNear = 1;
inline constexpr std::int32_t kBeyondFar = 2;
inline constexpr std::int32_t kBeyondLeft = 4;
inline constexpr std::int32_t kBeyondRight = 8;
inline constexpr std::int32_t kBeyondBottom = 16;
inline constexpr std::int32_t kBeyondTop = 32;
inline constexpr std::int32_t kBeyondAny = 63;
inline constexpr std::int32_t kNeedsCare = 64;  // also: not finite, no usable w

// Transforms all positions, in parallel where there are many. `out` has room for as many.
void transform_vertices(const ClipPositions& positions, const WindowTransform& window, PackedVertex* out);

}  // namespace ninebit
