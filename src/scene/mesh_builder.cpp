#include "src/scene/mesh_builder.h"

#include <bit>
#include <cmath>

namespace ninebit {
namespace {

// Adding +0 makes -0 into +0: the two are one place.
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0F);
}

glm::vec3 unit_or_zero(const glm::dvec3& vector) {
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : glm::vec3(0.0F);
}

bool is_zero(const glm::vec3& vector) {
  return vector.x == 0.0F && vector.y == 0.0F && vector.z == 0.0F;
}

}  // namespace

std::size_t MeshBuilder::KeyHash::operator()(const Key& key) const {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const std::uint32_t word : key) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  }
  return static_cast<std::size_t>(hash);
}

void MeshBuilder::begin_object(const std::string& name) {
  scene_.objects.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
  first_vertex_ = scene_.positions.size();
  shared_.clear();
}

std::uint32_t MeshBuilder::vertex(const glm::vec3& position, const glm::vec3& normal) {
  const glm::vec3 unit = unit_or_zero(glm::dvec3(normal));
  const Key key{bits(position.x), bits(position.y), bits(position.z), bits(unit.x), bits(unit.y), bits(unit.z)};
  const auto [place, added] = shared_.try_emplace(key, static_cast<std::uint32_t>(scene_.positions.size()));
  if (added) {
    scene_.positions.push_back(position + 0.0F);
    scene_.normals.push_back(unit);
  }
  return place->second;
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
}

void MeshBuilder::fill_normals() {
  std::unordered_map<Key, glm::dvec3, KeyHash> sums;
  const auto key_of = [this](std::size_t vertex) {
    const glm::vec3& at = scene_.positions[vertex];
    return Key{bits(at.x), bits(at.y), bits(at.z), 0, 0, 0};
  };
  for (std::size_t i = first_vertex_; i < scene_.positions.size(); ++i) {
    if (is_zero(scene_.normals[i])) sums.try_emplace(key_of(i), 0.0);
  }
  if (sums.empty()) return;
  for (std::size_t i = scene_.objects.back().first_triangle; i < scene_.triangles.size(); ++i) {
    const glm::uvec3& corners = scene_.triangles[i];
    const glm::dvec3 origin(scene_.positions[corners.x]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(scene_.positions[corners.y]) - origin, glm::dvec3(scene_.positions[corners.z]) - origin);
    for (glm::length_t k = 0; k < 3; ++k) {
      const auto sum = sums.find(key_of(corners[k]));
      if (sum != sums.end()) sum->second += area;
    }
  }
  for (std::size_t i = first_vertex_; i < scene_.positions.size(); ++i) {
    if (is_zero(scene_.normals[i])) scene_.normals[i] = unit_or_zero(sums[key_of(i)]);
  }
}

}  // namespace ninebit
