#include "src/scene/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <numbers>

#include "src/scene/fault_of.h"

namespace ninebit {
namespace {

// Assimp walks nodes by recursion too: what nests deeper could use up its stack.
constexpr int kDeepestNode = 500;
constexpr float kWidestFileSpot = 179.0F;  // degrees: the file may say 180, which no map can show

template <glm::length_t N>
glm::vec<N, double> vector_of(const Json& value, glm::vec<N, double> fallback) {
  if (list_of(value).size() != static_cast<std::size_t>(N)) return fallback;
  for (glm::length_t i = 0; i < N; ++i)
    fallback[i] = number_or(item(value, static_cast<std::uint64_t>(i)), fallback[i]);
  return fallback;
}

glm::dmat4 local_transform(const Json& node) {
  const Json& matrix = item(node, "matrix");
  glm::dmat4 out(1.0);
  if (list_of(matrix).size() == 16) {
    for (glm::length_t i = 0; i < 16; ++i)
      out[i / 4][i % 4] = number_or(item(matrix, static_cast<std::uint64_t>(i)), 0.0);
    return out;
  }
  const glm::dvec4 rotation = vector_of<4>(item(node, "rotation"), {0.0, 0.0, 0.0, 1.0});
  const glm::dvec3 scale = vector_of<3>(item(node, "scale"), glm::dvec3(1.0));
  out = glm::dmat4(glm::mat3_cast(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z)));
  for (glm::length_t i = 0; i < 3; ++i) out[i] *= scale[i];
  out[3] = glm::dvec4(vector_of<3>(item(node, "translation"), glm::dvec3(0.0)), 1.0);
  return out;
}

struct MeshSize {
  std::uint64_t triangles = 0;
  std::uint64_t primitives = 0;
};

class NodeWalk {
 public:
  explicit NodeWalk(const Json& root)
      : root_(root), visited_(list_of(item(root, "nodes")).size()), sizes_(list_of(item(root, "meshes")).size()) {
    facts_.triangles = 0;
  }

  Result<FileFacts> walk() {
    const Json& scene = item(root_, "scenes", index_of(item(root_, "scene")).value_or(0));
    if (scene.is_null()) return fault_of("has no scene");
    for (const Json& node : list_of(item(scene, "nodes"))) {
      if (auto fault = visit(node, glm::dmat4(1.0), 0)) return *fault;
    }
    return facts_;
  }

 private:
  std::optional<Diagnostic> visit(const Json& reference, const glm::dmat4& parent, int depth) {
    const std::uint64_t index = index_of(reference).value_or(~0ULL);
    const Json& node = item(root_, "nodes", index);
    if (node.is_null()) return fault_of("names a node that is not there");
    if (visited_[index]) return fault_of(fmt::format("node {} is reached twice: nodes must form a tree", index));
    if (depth > kDeepestNode) return fault_of(fmt::format("its nodes nest more than {} deep", kDeepestNode));
    visited_[index] = true;
    const glm::dmat4 world = parent * local_transform(node);
    if (!item(node, "mesh").is_null()) {
      if (auto fault = place_mesh(item(node, "mesh"))) return fault;
    }
    if (!item(node, "camera").is_null()) {
      if (auto fault = add_camera(item(node, "camera"), world)) return fault;
    }
    const Json& light = item(node, "extensions", "KHR_lights_punctual", "light");
    if (!light.is_null()) {
      if (auto fault = add_light(node, light, world)) return fault;
    }
    for (const Json& child : list_of(item(node, "children"))) {
      if (auto fault = visit(child, world, depth + 1)) return fault;
    }
    return std::nullopt;
  }

  const Json& accessor(const Json& reference) const { return target_of(item(root_, "accessors"), reference); }

  // An accessor in a role that asks for one type and certain components; packed ones have their data elsewhere.
  std::optional<Diagnostic> check_use(const Json& reference, const char* type,
                                      std::initializer_list<std::uint64_t> components, bool packed) const {
    if (reference.is_null()) return std::nullopt;
    const Json& used = accessor(reference);
    if (used.is_null()) return fault_of("names an accessor that is not there");
    const std::uint64_t component = index_of(item(used, "componentType")).value_or(0);
    if (text_of(item(used, "type")) != type ||
        std::find(components.begin(), components.end(), component) == components.end())
      return fault_of("uses an accessor of a type that does not fit its use");
    if (!packed && item(used, "bufferView").is_null()) return fault_of("uses an accessor that has no data");
    return std::nullopt;
  }

  // A mesh is looked at once, however many nodes place it.
  std::optional<Diagnostic> place_mesh(const Json& reference) {
    const std::uint64_t index = index_of(reference).value_or(~0ULL);
    const Json& mesh = item(root_, "meshes", index);
    if (mesh.is_null()) return fault_of("names a mesh that is not there");
    std::optional<MeshSize>& size = sizes_[index];
    if (!size) {
      size.emplace();
      if (auto fault = measure(mesh, *size)) return fault;
    }
    *facts_.triangles += size->triangles;
    placed_ += std::max(size->triangles, size->primitives);
    return placed_ > kMostTriangles ? too_many() : std::nullopt;
  }

  static std::optional<Diagnostic> too_many() {
    return fault_of(fmt::format("its nodes place more than {} triangles", kMostTriangles));
  }

  std::optional<Diagnostic> measure(const Json& mesh, MeshSize& size) const {
    for (const Json& primitive : list_of(item(mesh, "primitives"))) {
      ++size.primitives;
      const std::uint64_t mode = index_of(item(primitive, "mode")).value_or(4);
      const Json& positions = item(primitive, "attributes", "POSITION");
      if (mode < 4 || positions.is_null()) continue;
      const Json& indices = item(primitive, "indices");
      const bool packed = !item(primitive, "extensions", "KHR_draco_mesh_compression").is_null();
      if (auto fault = check_use(positions, "VEC3", {5126}, packed)) return fault;
      if (auto fault = check_use(item(primitive, "attributes", "NORMAL"), "VEC3", {5126, 5120, 5122}, packed))
        return fault;
      if (auto fault = check_use(indices, "SCALAR", {5121, 5123, 5125}, packed)) return fault;
      const Json& counted = accessor(indices.is_null() ? positions : indices);
      const std::uint64_t corners = index_of(item(counted, "count")).value_or(0);
      size.triangles += mode == 4 ? corners / 3 : std::max<std::uint64_t>(corners, 2) - 2;
      if (size.triangles > kMostTriangles) return too_many();
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> add_camera(const Json& reference, const glm::dmat4& world) {
    const Json& camera = target_of(item(root_, "cameras"), reference);
    if (camera.is_null()) return fault_of("names a camera that is not there");
    const double angle = number_or(item(camera, "perspective", "yfov"), 0.0);
    if (text_of(item(camera, "type")) != "perspective") return std::nullopt;
    if (angle <= 0.0 || angle >= std::numbers::pi) return fault_of("a camera's yfov is not between 0 and pi");
    Camera out;
    const glm::dvec3 ahead = -glm::dvec3(world[2]);
    out.position = glm::vec3(glm::dvec3(world[3]));
    out.look_at = glm::vec3(glm::dvec3(world[3]) + ahead / std::max(glm::length(ahead), 1e-300));
    out.up = glm::vec3(glm::dvec3(world[1]));
    out.vertical_fov_degrees = static_cast<float>(angle * 180.0 / std::numbers::pi);
    facts_.cameras.push_back(out);
    return std::nullopt;
  }

  std::optional<Diagnostic> add_light(const Json& node, const Json& reference, const glm::dmat4& world) {
    const Json& light = target_of(item(root_, "extensions", "KHR_lights_punctual", "lights"), reference);
    if (light.is_null()) return fault_of("names a light that is not there");
    const std::string type = text_of(item(light, "type"));
    Light out;
    if (type == "spot") {
      const double half = number_or(item(light, "spot", "outerConeAngle"), std::numbers::pi / 4);
      if (half <= 0.0 || half > std::numbers::pi / 2)
        return fault_of("a spot light's outerConeAngle is not between 0 and pi/2");
      out.kind = LightKind::spot;
      out.spot_degrees = std::min(static_cast<float>(half * 360.0 / std::numbers::pi), kWidestFileSpot);
    } else if (type == "directional") {
      out.kind = LightKind::directional;
    } else if (type != "point") {
      return std::nullopt;
    }
    out.direction = glm::vec3(-glm::dvec3(world[2]));
    out.name = text_of(item(light, "name")).empty() ? text_of(item(node, "name")) : text_of(item(light, "name"));
    out.position = glm::vec3(glm::dvec3(world[3]));
    out.color = glm::vec3(vector_of<3>(item(light, "color"), glm::dvec3(1.0)));
    facts_.lights.push_back(out);
    return std::nullopt;
  }

  const Json& root_;
  std::vector<bool> visited_;
  std::vector<std::optional<MeshSize>> sizes_;  // of the meshes that were placed
  std::uint64_t placed_ = 0;                    // triangles, or primitives where those are more
  FileFacts facts_;
};

}  // namespace

Result<FileFacts> read_gltf_nodes(const Json& root) {
  return NodeWalk(root).walk();
}

}  // namespace ninebit
