#include "src/shadow/shadow_volume/volume_mesh.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

namespace {

auto ordered(const glm::vec3& p) {
  return std::tie(p.x, p.y, p.z);
}

// The scene's vertices that an object uses, grouped by position.
std::vector<std::uint32_t> vertices_of(const Scene& scene, const SceneObject& object) {
  std::vector<std::uint32_t> used;
  used.reserve(std::size_t{3} * object.triangle_count);
  for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
    const glm::uvec3& t = scene.triangles[object.first_triangle + i];
    used.insert(used.end(), {t.x, t.y, t.z});
  }
  parallel_sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  parallel_sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3 &p = scene.positions[a], &q = scene.positions[b];
    return p == q ? a < b : ordered(p) < ordered(q);
  });
  return used;
}

void add_uses(const glm::uvec3& t, std::uint32_t number, std::vector<EdgeUse>& uses) {
  if (has_corner_twice(t)) return;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t a = t[i], b = t[(i + 1) % 3];
    uses.push_back({std::min(a, b), std::max(a, b), number, a < b});
  }
}

SurfaceFaults faults_of(const std::vector<EdgeUse>& uses, std::size_t first) {
  SurfaceFaults faults;
  for (std::size_t end = 0; first < uses.size(); first = end) {
    end = end_of_edge(uses, first);
    if (end - first == 1) {
      ++faults.open_edges;
    } else if (end - first > 2 || uses[first].rises == uses[first + 1].rises) {
      ++faults.nonmanifold_edges;
    }
  }
  return faults;
}

}  // namespace

std::size_t end_of_edge(const std::vector<EdgeUse>& uses, std::size_t first) {
  std::size_t end = first + 1;
  while (end < uses.size() && uses[end].low == uses[first].low && uses[end].high == uses[first].high) ++end;
  return end;
}

VolumeMesh volume_mesh(const Scene& scene) {
  VolumeMesh mesh;
  mesh.triangles.resize(scene.triangles.size());
  mesh.uses.reserve(3 * scene.triangles.size());
  std::vector<std::uint32_t> joined(scene.positions.size());
  for (const SceneObject& object : scene.objects) {
    const std::size_t first_position = mesh.positions.size(), first_use = mesh.uses.size();
    for (const std::uint32_t v : vertices_of(scene, object)) {
      const glm::vec3& p = scene.positions[v];
      if (mesh.positions.size() == first_position || mesh.positions.back() != p) mesh.positions.push_back(p);
      joined[v] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
      const std::uint32_t number = object.first_triangle + i;
      const glm::uvec3& t = scene.triangles[number];
      mesh.triangles[number] = {joined[t.x], joined[t.y], joined[t.z]};
      add_uses(mesh.triangles[number], number, mesh.uses);
    }
    parallel_sort(mesh.uses.begin() + static_cast<std::ptrdiff_t>(first_use), mesh.uses.end(),
                  [](const EdgeUse& a, const EdgeUse& b) {
                    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
                  });
    mesh.faults.push_back(faults_of(mesh.uses, first_use));
  }
  return mesh;
}

glm::dvec4 homogeneous_light(const Light& light) {
  if (light.kind == LightKind::directional) return {-glm::dvec3(light.direction), 0.0};
  return {glm::dvec3(light.position), 1.0};
}

std::vector<std::int8_t> facing_of(const VolumeMesh& mesh, const glm::dvec4& light) {
  std::vector<std::int8_t> facing(mesh.triangles.size());
  const glm::dvec3 l(light);
  for (std::size_t t = 0; t < facing.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    if (has_corner_twice(corners)) continue;
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    // The volume of the tetrahedron on the triangle with its tip at the light: 0 if a corner is the light itself.
    const double volume =
        light.w == 0.0 ? glm::dot(glm::cross(b - a, c - a), l) : -glm::dot(a - l, glm::cross(b - l, c - l));
    facing[t] = static_cast<std::int8_t>(volume > 0.0 ? 1 : volume < 0.0 ? -1 : 0);
  }
  return facing;
}

std::vector<std::int8_t> casters_of(const Scene& scene, const VolumeMesh& mesh, std::span<const std::int8_t> facing,
                                    CullFace cull) {
  const bool no_fronts = cull == CullFace::front || cull == CullFace::front_and_back;
  const bool no_backs = cull == CullFace::back || cull == CullFace::front_and_back;
  std::vector<std::int8_t> casters(facing.begin(), facing.end());
  for (std::size_t t = 0; t < casters.size(); ++t) {
    const bool is_closed = mesh.faults[scene.triangle_object[t]].none();
    if (no_fronts && casters[t] > 0) casters[t] = 0;
    if ((no_backs || (is_closed && !no_fronts)) && casters[t] < 0) casters[t] = 0;
  }
  return casters;
}

namespace {

// Makes the quad from an edge to infinity. Both orientations are cut along the same diagonal, so two quads of opposite
// orientation cancel at every pixel.
class SideMaker {
 public:
  SideMaker(ShadowVolumes& to, std::uint32_t vertices, bool is_directional)
      : to_(&to), vertices_(vertices), is_directional_(is_directional) {}

  void add(std::uint32_t low, std::uint32_t high, bool rises, std::uint32_t caster) const {
    if (is_directional_) return add_turned({high, low, vertices_}, rises, caster);
    add_turned({high, low, vertices_ + high}, rises, caster);
    add_turned({low, vertices_ + low, vertices_ + high}, rises, caster);
  }

 private:
  void add_turned(glm::uvec3 t, bool rises, std::uint32_t caster) const {
    if (!rises) std::swap(t.x, t.y);
    to_->outward.add(t, caster);
  }

  ShadowVolumes* to_;
  std::uint32_t vertices_;
  bool is_directional_;
};

void add_sides(const VolumeMesh& mesh, std::span<const std::int8_t> casters, const SideMaker& sides,
               ShadowVolumes& to) {
  for (std::size_t first = 0, end = 0; first < mesh.uses.size(); first = end) {
    end = end_of_edge(mesh.uses, first);
    const auto direction = [&](const EdgeUse& use) {
      return use.rises ? casters[use.triangle] : -casters[use.triangle];
    };
    int surplus = 0;
    for (std::size_t i = first; i < end; ++i) surplus += direction(mesh.uses[i]);
    if (surplus == 0) continue;
    ++to.silhouette_edges;
    const bool rises = surplus > 0;
    for (std::size_t i = first; i < end && surplus != 0; ++i) {
      const int one = direction(mesh.uses[i]);
      if (one == 0 || (one > 0) != rises) continue;
      sides.add(mesh.uses[i].low, mesh.uses[i].high, rises, mesh.uses[i].triangle);
      surplus -= one;
    }
  }
}

}  // namespace

ShadowVolumes extrude(const VolumeMesh& mesh, std::span<const std::int8_t> casters, const glm::dvec4& light,
                      const VolumeCaps& caps) {
  ShadowVolumes volumes;
  const bool is_directional = light.w == 0.0;
  for (const glm::vec3& p : mesh.positions) volumes.positions.emplace_back(p, 1.0F);
  if (is_directional) {
    volumes.positions.emplace_back(-glm::vec3(light), 0.0F);
  } else {
    for (const glm::vec3& p : mesh.positions) volumes.positions.emplace_back(p - glm::vec3(light), 0.0F);
  }
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t t = 0; t < casters.size(); ++t) {
    if (casters[t] == 0) continue;
    const auto caster = static_cast<std::uint32_t>(t);
    const glm::uvec3& corners = mesh.triangles[t];
    if (caps.front) (casters[t] > 0 ? volumes.outward : volumes.inward).add(corners, caster);
    if (!caps.back || is_directional) continue;
    glm::uvec3 back = corners + vertices;
    if (casters[t] > 0) std::swap(back.y, back.z);
    volumes.outward.add(back, caster);
  }
  add_sides(mesh, casters, SideMaker(volumes, vertices, is_directional), volumes);
  return volumes;
}

LightPyramid light_pyramid(const glm::mat4& clip_from_world, const Light& light) {
  const auto row = [&](int i) {
    return glm::dvec3(clip_from_world[0][i], clip_from_world[1][i], clip_from_world[2][i]);
  };
  const glm::dvec3 x = row(0), y = row(1), w = row(3);
  LightPyramid pyramid;
  pyramid.positions.emplace_back(light.position, 1.0F);
  // Along an edge of the pyramid x is w or -w, and so is y.
  constexpr std::array<std::array<double, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [sx, sy] : kCorners) {
    glm::dvec3 edge = glm::cross(x - sx * w, y - sy * w);
    if (glm::dot(edge, w) < 0.0) edge = -edge;
    pyramid.positions.emplace_back(glm::vec3(edge), 0.0F);
  }
  // Seen from the light, with x to the right and y up, the corners run counter-clockwise.
  pyramid.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}};
  return pyramid;
}

}  // namespace ninebit
