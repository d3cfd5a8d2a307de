#include "src/scene/files/mesh_builder.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <initializer_list>

#include "src/scene/files/polygon.h"
#include "src/scene/files/read_limits.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

// The texture coordinates of corners without them.
constexpr glm::vec2 kNoTextureCoordinate(0.0F);
constexpr glm::vec4 kNoTangent(0.0F);
constexpr glm::vec4 kNoColor(1.0F);

// Adding +0 turns -0 into +0: both are the same position.
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0F);
}

template <glm::length_t N>
bool same_bits(const glm::vec<N, float>& a, const glm::vec<N, float>& b) {
  for (glm::length_t i = 0; i < N; ++i) {
    if (bits(a[i]) != bits(b[i])) return false;
  }
  return true;
}

template <glm::length_t N>
std::uint64_t mix(std::uint64_t hash, const glm::vec<N, float>& value) {
  for (glm::length_t i = 0; i < N; ++i) {
    hash = (hash ^ bits(value[i])) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  }
  return hash;
}

std::size_t place_hash(const glm::vec3& position) {
  return static_cast<std::size_t>(mix(0xCBF29CE484222325U, position));
}

glm::vec3 unit_or_zero(const glm::dvec3& vector) {
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : glm::vec3(0.0F);
}

bool is_zero(const glm::vec3& vector) {
  return vector.x == 0.0F && vector.y == 0.0F && vector.z == 0.0F;
}

}  // namespace

MeshPlace MeshPlace::of(const glm::dmat4& world) {
  const glm::dvec3 x(world[0]);
  const glm::dvec3 y(world[1]);
  const glm::dvec3 z(world[2]);
  // The cofactors are the inverse transpose times the determinant; they exist for singular matrices, too.
  const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
  return {world, mirrored ? -cofactors : cofactors, mirrored};
}

void VertexTable::clear() {
  // A table of the usual size is emptied. A larger one is freed, because clearing it would slow down every small object
  // that follows.
  constexpr std::size_t kUsual = 64;
  if (slots_.size() > kUsual) {
    slots_ = {};
  } else {
    slots_.assign(slots_.size(), kFree);
  }
  count = 0;
}

template <class HashOf>
void VertexTable::reserve_one(HashOf hash_of) {
  if (2 * (count + 1) <= slots_.size()) return;
  std::vector<std::uint32_t> larger(std::max<std::size_t>(64, 2 * slots_.size()), kFree);
  const std::size_t mask = larger.size() - 1;
  for (const std::uint32_t vertex : slots_) {
    if (vertex == kFree) continue;
    std::size_t at = hash_of(vertex) & mask;
    while (larger[at] != kFree) at = (at + 1) & mask;
    larger[at] = vertex;
  }
  slots_ = std::move(larger);
}

template <class Matches>
std::uint32_t& VertexTable::slot(std::size_t hash, Matches matches) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at] != kFree && !matches(slots_[at])) at = (at + 1) & mask;
  return slots_[at];
}

void MeshBuilder::begin_object(const std::string& name) {
  scene_.objects.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
  first_vertex_ = scene_.positions.size();
  shared_.clear();
}

MeshBuilder::Stored MeshBuilder::stored(std::uint32_t vertex) const {
  return {.position = scene_.positions[vertex],
          .normal = scene_.normals[vertex],
          .texture_coordinate =
              scene_.texture_coordinates.empty() ? kNoTextureCoordinate : scene_.texture_coordinates[vertex],
          .tangent = scene_.tangents.empty() ? kNoTangent : scene_.tangents[vertex],
          .color = scene_.colors.empty() ? kNoColor : scene_.colors[vertex]};
}

bool MeshBuilder::equal(const Stored& a, const Stored& b) {
  return same_bits(a.position, b.position) && same_bits(a.normal, b.normal) &&
         same_bits(a.texture_coordinate, b.texture_coordinate) && same_bits(a.tangent, b.tangent) &&
         same_bits(a.color, b.color);
}

std::size_t MeshBuilder::hash(const Stored& vertex) {
  std::uint64_t hash = mix(mix(0xCBF29CE484222325U, vertex.position), vertex.normal);
  // Most vertices of most files have none of these.
  if (!same_bits(vertex.texture_coordinate, kNoTextureCoordinate)) hash = mix(hash, vertex.texture_coordinate);
  if (!same_bits(vertex.tangent, kNoTangent)) hash = mix(hash, vertex.tangent);
  if (!same_bits(vertex.color, kNoColor)) hash = mix(hash, vertex.color);
  return static_cast<std::size_t>(hash);
}

std::uint32_t MeshBuilder::vertex(const MeshVertex& corner) {
  const Stored own{.position = corner.position + 0.0F,
                   .normal = unit_or_zero(glm::dvec3(corner.normal)),
                   .texture_coordinate = corner.texture_coordinate.value_or(kNoTextureCoordinate),
                   .tangent = corner.tangent.value_or(kNoTangent),
                   .color = corner.color.value_or(kNoColor)};
  shared_.reserve_one([this](std::uint32_t i) { return hash(stored(i)); });
  std::uint32_t& slot = shared_.slot(hash(own), [&](std::uint32_t i) { return equal(stored(i), own); });
  if (slot != VertexTable::kFree) return slot;
  slot = static_cast<std::uint32_t>(scene_.positions.size());
  ++shared_.count;
  if (corner.texture_coordinate) scene_.texture_coordinates.resize(slot, kNoTextureCoordinate);
  if (corner.tangent) scene_.tangents.resize(slot, kNoTangent);
  if (corner.color) scene_.colors.resize(slot, kNoColor);
  scene_.positions.push_back(own.position);
  scene_.normals.push_back(own.normal);
  if (corner.texture_coordinate || !scene_.texture_coordinates.empty()) {
    scene_.texture_coordinates.push_back(own.texture_coordinate);
  }
  if (corner.tangent || !scene_.tangents.empty()) scene_.tangents.push_back(own.tangent);
  if (corner.color || !scene_.colors.empty()) scene_.colors.push_back(own.color);
  return slot;
}

void MeshBuilder::triangle(const glm::uvec3& corners, std::uint32_t material) {
  scene_.triangles.push_back(corners);
  scene_.triangle_object.push_back(static_cast<std::uint32_t>(scene_.objects.size() - 1));
  scene_.triangle_material.push_back(material);
  ++scene_.objects.back().triangle_count;
}

void MeshBuilder::end_object() {
  if (scene_.objects.back().triangle_count > 0) {
    fill_normals();
    return;
  }
  scene_.objects.pop_back();
  scene_.positions.resize(first_vertex_);
  scene_.normals.resize(first_vertex_);
  if (!scene_.texture_coordinates.empty()) scene_.texture_coordinates.resize(first_vertex_);
  if (!scene_.tangents.empty()) scene_.tangents.resize(first_vertex_);
  if (!scene_.colors.empty()) scene_.colors.resize(first_vertex_);
}

std::optional<std::string> MeshBuilder::vertex_at(const MeshPlace& place, MeshVertex corner, std::uint32_t& vertex) {
  corner.position = glm::vec3(glm::dvec3(place.world * glm::dvec4(glm::dvec3(corner.position), 1.0)));
  if (!is_finite(corner.position)) return "the position of a vertex is not finite";
  corner.normal = unit_or_zero(place.normals * glm::dvec3(corner.normal));
  if (corner.tangent) {
    const glm::vec4 given = *corner.tangent;
    const glm::vec3 turned = unit_or_zero(glm::dmat3(place.world) * glm::dvec3(glm::vec3(given)));
    // The normal of a mirrored mesh still points outwards, so the bitangent changes sides.
    const bool reversed = (given.w < 0.0F) != place.mirrored;
    corner.tangent = is_zero(turned) ? kNoTangent : glm::vec4(turned, reversed ? -1.0F : 1.0F);
  }
  vertex = this->vertex(corner);
  return std::nullopt;
}

std::optional<std::string> MeshBuilder::polygon(std::span<const std::uint32_t> corners, std::uint32_t material,
                                                bool mirrored) {
  if (scene_.triangles.size() + corners.size() - 2 > kMostTriangles)
    return fmt::format("has more than {} triangles; that is the limit", kMostTriangles);
  pieces_.clear();
  if (corners.size() == 3) {
    pieces_.push_back({0, 1, 2});
  } else {
    outline_.clear();
    for (const std::uint32_t corner : corners) outline_.push_back(scene_.positions[corner]);
    if (!triangulate(outline_, pieces_, &effort_))
      return fmt::format("has a concave polygon with more than {} corners", kMostConcaveCorners);
  }
  if (effort_ > kMostConcaveEffort)
    return fmt::format("has too many large concave polygons: the sum of the squares of their corner counts is above {}",
                       kMostConcaveEffort);
  for (const auto& [a, b, c] : pieces_) {
    const std::uint32_t second = mirrored ? c : b;
    const std::uint32_t third = mirrored ? b : c;
    triangle({corners[a], corners[second], corners[third]}, material);
  }
  return std::nullopt;
}

void MeshBuilder::fill_normals() {
  const std::vector<glm::vec3>& positions = scene_.positions;
  VertexTable places;  // positions of vertices without a normal, each as the first such vertex
  const auto place_of = [&](std::uint32_t vertex) -> std::uint32_t& {
    return places.slot(place_hash(positions[vertex]),
                       [&](std::uint32_t i) { return same_bits(positions[i], positions[vertex]); });
  };
  for (std::size_t i = first_vertex_; i < positions.size(); ++i) {
    if (!is_zero(scene_.normals[i])) continue;
    places.reserve_one([&](std::uint32_t vertex) { return place_hash(positions[vertex]); });
    std::uint32_t& slot = place_of(static_cast<std::uint32_t>(i));
    if (slot != VertexTable::kFree) continue;
    slot = static_cast<std::uint32_t>(i);
    ++places.count;
  }
  if (places.count == 0) return;
  std::vector<glm::dvec3> sums(positions.size() - first_vertex_, glm::dvec3(0.0));
  for (std::size_t i = scene_.objects.back().first_triangle; i < scene_.triangles.size(); ++i) {
    const glm::uvec3& corners = scene_.triangles[i];
    const glm::dvec3 origin(positions[corners.x]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(positions[corners.y]) - origin, glm::dvec3(positions[corners.z]) - origin);
    for (glm::length_t k = 0; k < 3; ++k) {
      const std::uint32_t place = place_of(corners[k]);
      if (place != VertexTable::kFree) sums[place - first_vertex_] += area;
    }
  }
  std::vector<glm::vec3> means(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) means[i] = unit_or_zero(sums[i]);
  for (std::size_t i = first_vertex_; i < positions.size(); ++i) {
    if (is_zero(scene_.normals[i])) scene_.normals[i] = means[place_of(static_cast<std::uint32_t>(i)) - first_vertex_];
  }
}

}  // namespace ninebit
