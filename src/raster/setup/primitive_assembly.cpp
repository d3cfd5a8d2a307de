#include "src/raster/setup/primitive_assembly.h"

namespace ninebit {

PrimitiveAssembly::PrimitiveAssembly(const VertexArrays& arrays)
    : type_(arrays.type),
      indices_(arrays.indices),
      count_(arrays.indices.empty() ? arrays.vertex_count() : arrays.indices.size()) {
  const auto beyond = [this](std::size_t first) { return count_ > first ? count_ - first : 0; };
  switch (type_) {
    case PrimitiveType::points:
      primitives_ = count_;
      break;
    case PrimitiveType::lines:
      primitives_ = count_ / 2;
      break;
    case PrimitiveType::line_strip:
      primitives_ = beyond(1);
      break;
    case PrimitiveType::line_loop:
      primitives_ = count_ >= 2 ? count_ : 0;
      break;
    case PrimitiveType::triangles:
      primitives_ = count_ / 3;
      break;
    case PrimitiveType::triangle_strip:
    case PrimitiveType::triangle_fan:
      primitives_ = beyond(2);
      break;
    case PrimitiveType::quads:
      primitives_ = count_ / 4;
      triangles_each_ = 2;
      break;
    case PrimitiveType::quad_strip:
      primitives_ = beyond(2) / 2;
      triangles_each_ = 2;
      break;
    case PrimitiveType::polygon:
      primitives_ = count_ >= 3 ? 1 : 0;
      triangles_each_ = beyond(2);
      break;
  }
}

std::uint32_t PrimitiveAssembly::provoking_vertex(std::size_t i) const {
  switch (type_) {
    case PrimitiveType::points:
      return vertex(i);
    case PrimitiveType::lines:
      return vertex(2 * i + 1);
    case PrimitiveType::line_strip:
      return vertex(i + 1);
    case PrimitiveType::line_loop:
      return vertex((i + 1) % count_);
    case PrimitiveType::triangles:
      return vertex(3 * i + 2);
    case PrimitiveType::triangle_strip:
    case PrimitiveType::triangle_fan:
      return vertex(i + 2);
    case PrimitiveType::quads:
      return vertex(4 * i + 3);
    case PrimitiveType::quad_strip:
      return vertex(2 * i + 3);
    case PrimitiveType::polygon:
      break;
  }
  return vertex(0);
}

std::array<std::uint32_t, 2> PrimitiveAssembly::line(std::size_t i) const {
  if (type_ == PrimitiveType::lines) return {vertex(2 * i), vertex(2 * i + 1)};
  return {vertex(i), vertex((i + 1) % count_)};
}

std::array<std::uint32_t, 3> PrimitiveAssembly::triangle(std::size_t i) const {
  if (type_ == PrimitiveType::triangles) return {vertex(3 * i), vertex(3 * i + 1), vertex(3 * i + 2)};
  if (type_ == PrimitiveType::triangle_fan) return {vertex(0), vertex(i + 1), vertex(i + 2)};
  return strip_triangle(i);
}

std::array<std::uint32_t, 3> PrimitiveAssembly::strip_triangle(std::size_t i) const {
  return {vertex(i + i % 2), vertex(i + 1 - i % 2), vertex(i + 2)};
}

// Rule 32.
std::array<std::uint32_t, 3> PrimitiveAssembly::triangle_of(std::size_t i, std::size_t cut) const {
  switch (type_) {
    case PrimitiveType::quads:
      return {vertex(4 * i), vertex(4 * i + 1 + cut), vertex(4 * i + 2 + cut)};
    case PrimitiveType::quad_strip:
      return strip_triangle(2 * i + cut);
    case PrimitiveType::polygon:
      return {vertex(0), vertex(cut + 1), vertex(cut + 2)};
    default:
      return triangle(i);
  }
}

std::array<bool, 3> PrimitiveAssembly::boundary_of(std::size_t cut) const {
  if (type_ == PrimitiveType::quad_strip) return {cut == 0, cut == 1, true};
  return {cut == 0, true, cut + 1 == triangles_each_};
}

}  // namespace ninebit
