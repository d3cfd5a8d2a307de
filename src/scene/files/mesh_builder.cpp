#include "src/scene/files/mesh_builder.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

// The texture coordinates of corners without them.
constexpr glm::vec2 kNoTextureCoordinate(0.0F);
constexpr glm::vec4 kNoTangent(0.0F);
constexpr glm::vec4 kNoColor(1.0F);
constexpr glm::vec4 kNoSecondaryColor(0.0F, 0.0F, 0.0F, 1.0F);
constexpr float kNoFog = 1.0F;

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
          .color = scene_.colors.empty() ? kNoColor : scene_.colors[vertex],
          .secondary_color = scene_.secondary_colors.empty() ? kNoSecondaryColor : scene_.secondary_colors[vertex],
          .fog_factor = scene_.fog_factors.empty() ? kNoFog : scene_.fog_factors[vertex]};
}

bool MeshBuilder::equal(const Stored& a, const Stored& b) {
  return same_bits(a.position, b.position) && same_bits(a.normal, b.normal) &&
         same_bits(a.texture_coordinate, b.texture_coordinate) && same_bits(a.tangent, b.tangent) &&
         same_bits(a.color, b.color) && same_bits(a.secondary_color, b.secondary_color) &&
         bits(a.fog_factor) == bits(b.fog_factor);
}

std::size_t MeshBuilder::hash(const Stored& vertex) {
  std::uint64_t hash = mix(mix(0xCBF29CE484222325U, vertex.position), vertex.normal);
  // Most vertices of most files have none of these.
  if (!same_bits(vertex.texture_coordinate, kNoTextureCoordinate)) hash = mix(hash, vertex.texture_coordinate);
  if (!same_bits(vertex.tangent, kNoTangent)) hash = mix(hash, vertex.tangent);
  if (!same_bits(vertex.color, kNoColor)) hash = mix(hash, vertex.color);
  if (!same_bits(vertex.secondary_color, kNoSecondaryColor)) hash = mix(hash, vertex.secondary_color);
  if (vertex.fog_factor != kNoFog) hash = mix(hash, glm::vec2(vertex.fog_factor, 0.0F));
  return static_cast<std::size_t>(hash);
}

std::uint32_t MeshBuilder::vertex(const MeshVertex& corner) {
  const Stored own{.position = corner.position + 0.0F,
                   .normal = unit_or_zero(glm::dvec3(corner.normal)),
                   .texture_coordinate = corner.texture_coordinate.value_or(kNoTextureCoordinate),
                   .tangent = corner.tangent.value_or(kNoTangent),
                   .color = corner.color.value_or(kNoColor),
                   .secondary_color = corner.secondary_color.value_or(kNoSecondaryColor),
                   .fog_factor = corner.fog_factor.value_or(kNoFog)};
  shared_.reserve_one([this](std::uint32_t i) { return hash(stored(i)); });
  std::uint32_t& slot = shared_.slot(hash(own), [&](std::uint32_t i) { return equal(stored(i), own); });
  if (slot != VertexTable::kFree) return slot;
  slot = static_cast<std::uint32_t>(scene_.positions.size());
  ++shared_.count;
  if (corner.texture_coordinate) scene_.texture_coordinates.resize(slot, kNoTextureCoordinate);
  if (corner.tangent) scene_.tangents.resize(slot, kNoTangent);
  if (corner.color) scene_.colors.resize(slot, kNoColor);
  if (corner.secondary_color) scene_.secondary_colors.resize(slot, kNoSecondaryColor);
  if (corner.fog_factor) scene_.fog_factors.resize(slot, kNoFog);
  scene_.positions.push_back(own.position);
  scene_.normals.push_back(own.normal);
  if (corner.texture_coordinate || !scene_.texture_coordinates.empty()) {
    scene_.texture_coordinates.push_back(own.texture_coordinate);
  }
  if (corner.tangent || !scene_.tangents.empty()) scene_.tangents.push_back(own.tangent);
  if (corner.color || !scene_.colors.empty()) scene_.colors.push_back(own.color);
  if (corner.secondary_color || !scene_.secondary_colors.empty())
    scene_.secondary_colors.push_back(own.secondary_color);
  if (corner.fog_factor || !scene_.fog_factors.empty()) scene_.fog_factors.push_back(own.fog_factor);
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
  if (!scene_.secondary_colors.empty()) scene_.secondary_colors.resize(first_vertex_);
  if (!scene_.fog_factors.empty()) scene_.fog_factors.resize(first_vertex_);
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

namespace {

// Twice the signed area of a triangle in the plane of projection.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Projects along the largest axis of the polygon's normal, so that its winding becomes counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
  glm::dvec3 normal(0.0);
  const glm::dvec3 origin(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
  const glm::dvec3 size = glm::abs(normal);
  const glm::length_t drop = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
  const glm::length_t u = (drop + 1) % 3;
  const glm::length_t v = (drop + 2) % 3;
  const double turn = normal[drop] < 0.0 ? -1.0 : 1.0;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners) {
    const glm::dvec3 relative = glm::dvec3(corner) - origin;
    flat.emplace_back(relative[u], relative[v] * turn);
  }
  return flat;
}

// Whether the fan's triangles all have areas of the same sign.
bool fan_is_valid(const std::vector<glm::dvec2>& flat) {
  for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
    if (area2(flat[0], flat[i], flat[i + 1]) < 0.0) return false;
  }
  return true;
}

// Finds ears of a polygon. A corner that is not an ear cannot become one as long as it has the same neighbours and the
// corner in its triangle is still there, so it is tested again only after one of these changes.
class EarSearch {
 public:
  explicit EarSearch(const std::vector<glm::dvec2>& flat) : flat_(flat), refusals_(flat.size()), gone_(flat.size()) {}

  // Whether the corner left[at] is an ear.
  bool is_ear(const std::vector<std::uint32_t>& left, std::size_t at) {
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count];
    const std::uint32_t after = left[(at + 1) % count];
    Refusal& refusal = refusals_[left[at]];
    if (refusal.known && refusal.before == before && refusal.after == after && !gone_[refusal.witness]) return false;
    const std::optional<std::uint32_t> witness = in_the_way(left, at);
    if (witness) refusal = {true, before, after, *witness};
    return !witness;
  }

  void remove(std::uint32_t corner) { gone_[corner] = true; }

 private:
  struct Refusal {
    bool known = false;
    std::uint32_t before = 0, after = 0;  // its neighbours when it was tested
    std::uint32_t witness = 0;            // the reason: a corner within its triangle, or itself
  };

  // The reason why a corner is not an ear: a corner within its triangle, or itself if the triangle has no area.
  [[nodiscard]] std::optional<std::uint32_t> in_the_way(const std::vector<std::uint32_t>& left, std::size_t at) const {
    const std::size_t count = left.size();
    const glm::dvec2& a = flat_[left[(at + count - 1) % count]];
    const glm::dvec2& b = flat_[left[at]];
    const glm::dvec2& c = flat_[left[(at + 1) % count]];
    if (area2(a, b, c) <= 0.0) return left[at];
    const glm::dvec2 low = glm::min(glm::min(a, b), c);
    const glm::dvec2 high = glm::max(glm::max(a, b), c);
    for (const std::uint32_t corner : left) {
      const glm::dvec2& p = flat_[corner];
      if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
      if (p == a || p == b || p == c) continue;
      if (area2(a, b, p) >= 0.0 && area2(b, c, p) >= 0.0 && area2(c, a, p) >= 0.0) return corner;
    }
    return std::nullopt;
  }

  const std::vector<glm::dvec2>& flat_;
  std::vector<Refusal> refusals_;
  std::vector<bool> gone_;
};

// Cuts ears until three corners are left, or none of them is an ear.
void cut_ears(const std::vector<glm::dvec2>& flat, std::vector<std::uint32_t>& left,
              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  EarSearch ears(flat);
  // The search continues from the last ear instead of the start: a typical polygon then needs one pass of tests per
  // ear.
  std::size_t at = 1;
  std::size_t refused = 0;
  while (left.size() > 3 && refused < left.size()) {
    at %= left.size();
    if (!ears.is_ear(left, at)) {
      ++at;
      ++refused;
      continue;
    }
    const std::size_t size = left.size();
    triangles.push_back({left[(at + size - 1) % size], left[at], left[(at + 1) % size]});
    ears.remove(left[at]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    refused = 0;
  }
}

}  // namespace

bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 std::uint64_t* effort) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  std::vector<std::uint32_t> left(count);
  for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
  if (count > 3) {
    const std::vector<glm::dvec2> flat = project(corners);
    if (!fan_is_valid(flat)) {
      if (count > kMostConcaveCorners) return false;
      if (effort != nullptr && count > kSmallPolygon) *effort += std::uint64_t{count} * count;
      cut_ears(flat, left, triangles);
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) triangles.push_back({left[0], left[i], left[i + 1]});
  return true;
}

}  // namespace ninebit
