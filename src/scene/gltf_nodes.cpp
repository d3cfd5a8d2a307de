#include "src/scene/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <numbers>

namespace ninebit {
namespace {

// Assimp walks nodes by recursion too: what nests deeper could use up its stack.
constexpr int kDeepest = 500;

Diagnostic fault_of(std::string message) {
  return {std::move(message), "", 0, Fault::invalid_input};
}

template <glm::length_t N>
glm::vec<N, double> vector_of(const JsonValue& value, glm::vec<N, double> fallback) {
  if (value.items.size() != static_cast<std::size_t>(N)) return fallback;
  for (glm::length_t i = 0; i < N; ++i) fallback[i] = value[static_cast<std::size_t>(i)].number_or(fallback[i]);
  return fallback;
}

glm::dmat4 local_transform(const JsonValue& node) {
  const JsonValue& matrix = node["matrix"];
  glm::dmat4 out(1.0);
  if (matrix.items.size() == 16) {
    for (glm::length_t i = 0; i < 16; ++i) out[i / 4][i % 4] = matrix[static_cast<std::size_t>(i)].number_or(0.0);
    return out;
  }
  const glm::dvec4 rotation = vector_of<4>(node["rotation"], {0.0, 0.0, 0.0, 1.0});
  const glm::dvec3 scale = vector_of<3>(node["scale"], glm::dvec3(1.0));
  out = glm::dmat4(glm::mat3_cast(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z)));
  for (glm::length_t i = 0; i < 3; ++i) out[i] *= scale[i];
  out[3] = glm::dvec4(vector_of<3>(node["translation"], glm::dvec3(0.0)), 1.0);
  return out;
}

class NodeWalk {
 public:
  explicit NodeWalk(const JsonValue& root) : root_(root), visited_(root["nodes"].items.size()) { facts_.triangles = 0; }

  Result<FileFacts> walk() {
    const JsonValue& scene = root_["scenes"][root_["scene"].index().value_or(0)];
    if (!scene.exists()) return fault_of("has no scene");
    for (const JsonValue& node : scene["nodes"].items) {
      if (auto fault = visit(node, glm::dmat4(1.0), 0)) return *fault;
    }
    return facts_;
  }

 private:
  std::optional<Diagnostic> visit(const JsonValue& reference, const glm::dmat4& parent, int depth) {
    const std::uint64_t index = reference.index().value_or(~0ULL);
    const JsonValue& node = root_["nodes"][index];
    if (!node.exists()) return fault_of("names a node that is not there");
    if (visited_[index]) return fault_of(fmt::format("node {} is reached twice: nodes must form a tree", index));
    if (depth > kDeepest) return fault_of(fmt::format("its nodes nest more than {} deep", kDeepest));
    visited_[index] = true;
    const glm::dmat4 world = parent * local_transform(node);
    if (node["mesh"].exists()) {
      if (auto fault = count_mesh(node["mesh"])) return fault;
    }
    if (node["camera"].exists()) {
      if (auto fault = add_camera(node["camera"], world)) return fault;
    }
    const JsonValue& light = node["extensions"]["KHR_lights_punctual"]["light"];
    if (light.exists()) {
      if (auto fault = add_light(node, light, world)) return fault;
    }
    for (const JsonValue& child : node["children"].items) {
      if (auto fault = visit(child, world, depth + 1)) return fault;
    }
    return std::nullopt;
  }

  const JsonValue& accessor(const JsonValue& reference) const {
    return root_["accessors"][reference.index().value_or(~0ULL)];
  }

  // An accessor in a role that asks for one type and certain components; packed ones have their data elsewhere.
  std::optional<Diagnostic> check_use(const JsonValue& reference, const char* type,
                                      std::initializer_list<std::uint64_t> components, bool packed) const {
    if (!reference.exists()) return std::nullopt;
    const JsonValue& used = accessor(reference);
    if (!used.exists()) return fault_of("names an accessor that is not there");
    const std::uint64_t component = used["componentType"].index().value_or(0);
    if (used["type"].text != type || std::find(components.begin(), components.end(), component) == components.end())
      return fault_of("uses an accessor of a type that does not fit its use");
    if (!packed && !used["bufferView"].exists()) return fault_of("uses an accessor that has no data");
    return std::nullopt;
  }

  std::optional<Diagnostic> count_mesh(const JsonValue& reference) {
    const JsonValue& mesh = root_["meshes"][reference.index().value_or(~0ULL)];
    if (!mesh.exists()) return fault_of("names a mesh that is not there");
    for (const JsonValue& primitive : mesh["primitives"].items) {
      const std::uint64_t mode = primitive["mode"].index().value_or(4);
      const JsonValue& positions = primitive["attributes"]["POSITION"];
      if (mode < 4 || !positions.exists()) continue;
      const JsonValue& indices = primitive["indices"];
      const bool packed = primitive["extensions"]["KHR_draco_mesh_compression"].exists();
      if (auto fault = check_use(positions, "VEC3", {5126}, packed)) return fault;
      if (auto fault = check_use(primitive["attributes"]["NORMAL"], "VEC3", {5126, 5120, 5122}, packed)) return fault;
      if (auto fault = check_use(indices, "SCALAR", {5121, 5123, 5125}, packed)) return fault;
      const JsonValue& counted = accessor(indices.exists() ? indices : positions);
      const std::uint64_t corners = counted["count"].index().value_or(0);
      *facts_.triangles += mode == 4 ? corners / 3 : std::max<std::uint64_t>(corners, 2) - 2;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> add_camera(const JsonValue& reference, const glm::dmat4& world) {
    const JsonValue& camera = root_["cameras"][reference.index().value_or(~0ULL)];
    if (!camera.exists()) return fault_of("names a camera that is not there");
    const double angle = camera["perspective"]["yfov"].number_or(0.0);
    if (camera["type"].text != "perspective") return std::nullopt;
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

  std::optional<Diagnostic> add_light(const JsonValue& node, const JsonValue& reference, const glm::dmat4& world) {
    const JsonValue& light = root_["extensions"]["KHR_lights_punctual"]["lights"][reference.index().value_or(~0ULL)];
    if (!light.exists()) return fault_of("names a light that is not there");
    if (light["type"].text != "point") return std::nullopt;
    PointLight out;
    out.name = light["name"].text.empty() ? node["name"].text : light["name"].text;
    out.position = glm::vec3(glm::dvec3(world[3]));
    out.color = glm::vec3(vector_of<3>(light["color"], glm::dvec3(1.0)));
    facts_.lights.push_back(out);
    return std::nullopt;
  }

  const JsonValue& root_;
  std::vector<bool> visited_;
  FileFacts facts_;
};

}  // namespace

Result<FileFacts> read_gltf_nodes(const JsonValue& root) {
  return NodeWalk(root).walk();
}

}  // namespace ninebit
