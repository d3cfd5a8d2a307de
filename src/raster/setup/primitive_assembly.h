// Which vertices make which primitive (OpenGL 1.3, 2.6.1 and 2.13.7).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// The primitives of a draw call. Primitives, and places in the list of vertices, are counted from 0.
class PrimitiveAssembly {
 public:
  explicit PrimitiveAssembly(const VertexArrays& arrays);

  [[nodiscard]] PrimitiveType type() const { return type_; }
  // Points, lines, triangles, quads or polygons; vertices left over make none.
  [[nodiscard]] std::size_t primitives() const { return primitives_; }
  // The triangles that a quad or polygon is cut into: a fan around its first vertex, or for a quad strip the triangles
  // of the triangle strip (rule 32); 1 for all others.
  [[nodiscard]] std::size_t triangles_each() const { return triangles_each_; }

  // The list of vertex numbers; empty: all, in their order.
  [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }
  // The vertex number at a place of the list.
  [[nodiscard]] std::uint32_t vertex(std::size_t place) const {
    return indices_.empty() ? static_cast<std::uint32_t>(place) : indices_[place];
  }
  // The vertex of primitive i whose colours flat shading takes.
  [[nodiscard]] std::uint32_t provoking_vertex(std::size_t i) const;

  [[nodiscard]] std::array<std::uint32_t, 2> line(std::size_t i) const;
  // Vertices in the order in which the primitive counts as counter-clockwise or not.
  [[nodiscard]] std::array<std::uint32_t, 3> triangle(std::size_t i) const;
  // Triangle `cut` of a quad or polygon, from 0 to triangles_each() - 1.
  [[nodiscard]] std::array<std::uint32_t, 3> triangle_of(std::size_t i, std::size_t cut) const;
  // Which of its edges 0-1, 1-2, 2-0 are edges of the quad or polygon.
  [[nodiscard]] std::array<bool, 3> boundary_of(std::size_t cut) const;

 private:
  // Triangle i of the vertices as a triangle strip.
  [[nodiscard]] std::array<std::uint32_t, 3> strip_triangle(std::size_t i) const;

  PrimitiveType type_;
  std::span<const std::uint32_t> indices_;
  std::size_t count_;  // of places in the list
  std::size_t primitives_ = 0;
  std::size_t triangles_each_ = 1;
};

// The sizes of points and lines in whole numbers.

// A size in pixels that is a multiple of 1/8.
[[nodiscard]] inline int eighths_of(float size) {
  return static_cast<int>(8.0F * size);
}

// OpenGL's sizes (1.3, 3.3 and 3.4.2): rounded to whole pixels, halves up, at least one.
[[nodiscard]] inline int whole_pixels(int eighths) {
  return std::max(1, (eighths + 4) / 8);
}

}  // namespace ninebit
