#include "src/shadow/shadow_volume/volume_mesh.h"

#include <algorithm>
#include <tuple>

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

}  // namespace ninebit
