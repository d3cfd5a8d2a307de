#include "src/bench/generated_scene.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "ninebit/raster/texture.h"

namespace ninebit::bench {
namespace {

struct Body {
  glm::vec3 center;
  float radius;
  glm::vec3 color;
};

constexpr std::array kBodies{
    Body{{-2.2F, 1.2F, -1.8F}, 0.9F, {0.80F, 0.35F, 0.30F}}, Body{{1.9F, 1.0F, -2.1F}, 0.8F, {0.35F, 0.70F, 0.40F}},
    Body{{2.4F, 2.6F, 0.9F}, 0.7F, {0.35F, 0.45F, 0.80F}},   Body{{-1.7F, 2.9F, 1.3F}, 0.6F, {0.80F, 0.70F, 0.30F}},
    Body{{0.2F, 0.9F, 1.6F}, 0.8F, {0.65F, 0.40F, 0.75F}},   Body{{0.3F, 3.2F, -1.2F}, 0.5F, {0.40F, 0.75F, 0.75F}}};

// The Chebyshev polynomial T5: five half waves between -1 and 1.
float waves(float x) {
  const float x2 = x * x;
  return ((16.0F * x2 - 20.0F) * x2 + 5.0F) * x;
}

// Adds the cells of one face of a body or wall, two triangles each. `point` maps positions on the cube [-1, 1]³ to the
// scene. The triangles are counter-clockwise seen from outside; with `inward`, seen from inside.
template <class PointOnCube>
void add_grid(Scene& scene, CubeFace face, std::uint32_t cells, bool inward, const PointOnCube& point) {
  const CubeFaceAxes& axes = cube_face_axes(face);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  const auto along = [&](std::uint32_t i) { return 2.0F * static_cast<float>(i) / static_cast<float>(cells) - 1.0F; };
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      glm::vec3 cube;
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        cube[c] = along(i) * static_cast<float>(axes.s[k]) + along(j) * static_cast<float>(axes.t[k]) +
                  static_cast<float>(axes.major[k]);
      }
      scene.positions.push_back(point(cube));
    }
  }
  // s cross t points towards the cube's centre.
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene.triangles.emplace_back(inward ? glm::uvec3(a, b, c) : glm::uvec3(a, c, b));
  };
  const std::uint32_t row = cells + 1;
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t corner = first + j * row + i;
      add(corner, corner + 1, corner + row + 1);
      add(corner, corner + row + 1, corner + row);
    }
  }
}

// Adds an object from the triangles that begin at number `first`.
void name_object(Scene& scene, std::string name, const glm::vec3& color, std::size_t first) {
  const std::size_t count = scene.triangles.size() - first;
  scene.triangle_object.resize(scene.triangles.size(), static_cast<std::uint32_t>(scene.objects.size()));
  scene.triangle_material.resize(scene.triangles.size(), static_cast<std::uint32_t>(scene.materials.size()));
  scene.objects.push_back({name, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  scene.materials.push_back({std::move(name), color});
}

// Each normal is the area-weighted mean over the triangles around the vertex.
void add_normals(Scene& scene) {
  scene.normals.assign(scene.positions.size(), glm::vec3(0.0F));
  for (const glm::uvec3& t : scene.triangles) {
    const glm::vec3& a = scene.positions[t.x];
    const glm::vec3 normal = glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a);
    for (int corner = 0; corner < 3; ++corner) scene.normals[t[corner]] += normal;
  }
  for (glm::vec3& normal : scene.normals) {
    const float length = std::sqrt(glm::dot(normal, normal));
    if (length > 0.0F) normal = normal / length;
  }
}

// The largest number of cells per side such that `grids` grids have at most `triangles` triangles; at least 1.
std::uint32_t cells_a_side(std::uint32_t triangles, std::uint32_t grids) {
  std::uint32_t cells = 1;
  while (2 * grids * (cells + 1) * (cells + 1) <= triangles) ++cells;
  return cells;
}

}  // namespace

Scene generated_scene(std::uint32_t triangles) {
  constexpr auto kGrids = static_cast<std::uint32_t>(6 * kBodies.size());
  const std::uint32_t body_cells = cells_a_side(triangles / 4 * 3, kGrids);
  const std::uint32_t wall_cells = cells_a_side(triangles - 2 * kGrids * body_cells * body_cells, 6);
  Scene scene;
  scene.name = "generated";
  for (const Body& body : kBodies) {
    const std::size_t first = scene.triangles.size();
    for (const CubeFace face : kCubeFaces) {
      add_grid(scene, face, body_cells, false, [&](const glm::vec3& cube) {
        const glm::vec3 d = cube / std::sqrt(glm::dot(cube, cube));
        const float bump = waves(d.x) * waves(d.y) + waves(d.y) * waves(d.z) + waves(d.z) * waves(d.x);
        return body.center + d * (body.radius * (1.0F + 0.06F * bump));
      });
    }
    name_object(scene, "body " + std::to_string(scene.objects.size() + 1), body.color, first);
  }
  const std::size_t first = scene.triangles.size();
  for (const CubeFace face : kCubeFaces) {
    add_grid(scene, face, wall_cells, true,
             [](const glm::vec3& cube) { return glm::vec3(4.0F * cube.x, 2.25F * cube.y + 2.25F, 4.0F * cube.z); });
  }
  name_object(scene, "room", {0.75F, 0.73F, 0.70F}, first);
  add_normals(scene);
  scene.lights.push_back({.name = "light", .position = {0.1F, 2.3F, 0.2F}, .color = {1.0F, 1.0F, 1.0F}});
  scene.cameras.push_back(
      {.position = {3.6F, 3.4F, 3.7F}, .look_at = {-0.3F, 1.7F, -0.3F}, .vertical_fov_degrees = 70.0F});
  return scene;
}

}  // namespace ninebit::bench
