#include "ninebit/effect/generated_meshes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string>

#include "src/effect/effect_words.h"

namespace ninebit {
namespace {

struct MeshVertexData {
  glm::vec3 position, normal;
};

// A grid of columns × rows squares over (s, t) in [0, 1]²; at(s, t) gives its points. Triangles face the side from
// which s grows to the right and t downwards.
template <class At>
void add_grid(Scene& scene, int columns, int rows, const At& at) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double s = static_cast<double>(column) / columns, t = static_cast<double>(row) / rows;
      const MeshVertexData vertex = at(s, t);
      scene.positions.push_back(vertex.position);
      scene.normals.push_back(vertex.normal);
      scene.texture_coordinates.emplace_back(static_cast<float>(s), static_cast<float>(t));
    }
  }
  const auto number = [&](int column, int row) {
    return first + static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = number(column, row), b = number(column + 1, row), c = number(column, row + 1),
                          d = number(column + 1, row + 1);
      scene.triangles.emplace_back(a, c, d);
      scene.triangles.emplace_back(a, d, b);
    }
  }
}

MeshVertexData sphere_at(double s, double t) {
  const double around = 2.0 * glm::pi<double>() * s, down = glm::pi<double>() * t;
  const glm::dvec3 p(std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around));
  return {glm::vec3(p), glm::vec3(p)};
}

MeshVertexData torus_at(double s, double t) {
  const double around = 2.0 * glm::pi<double>() * s, tube = -2.0 * glm::pi<double>() * t;
  const glm::dvec3 outward(std::cos(around), std::sin(around), 0.0);
  const glm::dvec3 normal = std::cos(tube) * outward + glm::dvec3(0.0, 0.0, std::sin(tube));
  return {glm::vec3(0.7 * outward + 0.3 * normal), glm::vec3(normal)};
}

MeshVertexData plane_at(double s, double t) {
  return {glm::vec3(2.0 * s - 1.0, 1.0 - 2.0 * t, 0.0), glm::vec3(0.0F, 0.0F, 1.0F)};
}

void add_cube(Scene& scene) {
  struct Face {
    glm::vec3 normal, right, up;
  };
  constexpr glm::vec3 x(1.0F, 0.0F, 0.0F), y(0.0F, 1.0F, 0.0F), z(0.0F, 0.0F, 1.0F);
  const std::array<Face, 6> faces{Face{x, -z, y}, Face{-x, z, y}, Face{y, x, -z},
                                  Face{-y, x, z}, Face{z, x, y},  Face{-z, -x, y}};
  for (const Face& face : faces) {
    add_grid(scene, 1, 1, [&](double s, double t) {
      const auto right = static_cast<float>(2.0 * s - 1.0), up = static_cast<float>(1.0 - 2.0 * t);
      return MeshVertexData{face.normal + right * face.right + up * face.up, face.normal};
    });
  }
}

// The word before the colon, and the number after it.
std::string_view shape_of(std::string_view text) {
  return text.substr(0, std::min(text.find(':'), text.size()));
}

std::optional<int> segments_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const char* const end = text.data() + text.size();
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, number);
  if (error != std::errc{} || stop != end || number < kMinMeshSegments || number > kMaxMeshSegments) {
    return std::nullopt;
  }
  return number;
}

}  // namespace

bool is_generated_mesh(std::string_view text) {
  if (text == "cube") return true;
  const std::string_view shape = shape_of(text);
  return shape.size() < text.size() && (shape == "sphere" || shape == "torus" || shape == "plane");
}

Result<Scene> generated_mesh(std::string_view text) {
  const std::string_view shape = shape_of(text);
  const std::optional<int> segments = segments_of(text);
  if (!is_generated_mesh(text) || (text != "cube" && !segments)) {
    return Diagnostic{.message = effect_detail::in_quotes(text) +
                                 " is not a generated mesh; expected sphere:N, torus:N or plane:N with N from " +
                                 std::to_string(kMinMeshSegments) + " to " + std::to_string(kMaxMeshSegments) +
                                 ", or cube"};
  }
  Scene scene;
  scene.name = text;
  if (shape == "sphere") {
    add_grid(scene, std::max(*segments, 3), std::max(*segments / 2, 2), &sphere_at);
  } else if (shape == "torus") {
    add_grid(scene, std::max(*segments, 3), std::max(*segments / 2, 3), &torus_at);
  } else if (shape == "plane") {
    add_grid(scene, *segments, *segments, &plane_at);
  } else {
    add_cube(scene);
  }
  const auto count = static_cast<std::uint32_t>(scene.triangles.size());
  scene.triangle_object.assign(count, 0);
  scene.triangle_material.assign(count, 0);
  scene.objects.push_back({std::string(shape), 0, count});
  scene.materials.push_back({"white", glm::vec3(1.0F)});
  return scene;
}

}  // namespace ninebit
