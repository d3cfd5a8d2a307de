#include "src/scene/files/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

// Nodes are visited recursively: deeper nesting could overflow the stack.
constexpr int kDeepestNode = 500;
constexpr float kWidestFileSpot = 179.0F;  // degrees: a file may have 180, which no map can cover

template <glm::length_t N>
glm::vec<N, double> vector_of(const JsonValue& value, glm::vec<N, double> fallback) {
  if (list_of(value).size() != static_cast<std::size_t>(N)) return fallback;
  for (glm::length_t i = 0; i < N; ++i)
    fallback[i] = number_or(item(value, static_cast<std::uint64_t>(i)), fallback[i]);
  return fallback;
}

// The transform for cameras and lights, in double precision.
glm::dmat4 local_transform(const JsonValue& node) {
  const JsonValue& matrix = item(node, "matrix");
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

// The transform for meshes: single precision, step by step in this order. All pictures of glTF files depend on these
// roundings.
glm::dmat4 rounded_transform(const JsonValue& node) {
  if (list_of(item(node, "matrix")).size() == 16) return glm::dmat4(glm::mat4(local_transform(node)));
  const glm::vec4 q(vector_of<4>(item(node, "rotation"), {0.0, 0.0, 0.0, 1.0}));
  const glm::vec3 scale(vector_of<3>(item(node, "scale"), glm::dvec3(1.0)));
  const glm::vec3 move(vector_of<3>(item(node, "translation"), glm::dvec3(0.0)));
  glm::mat3 turn(1.0F);
  turn[0] = {1.0F - 2.0F * (q.y * q.y + q.z * q.z), 2.0F * (q.x * q.y + q.z * q.w), 2.0F * (q.x * q.z - q.y * q.w)};
  turn[1] = {2.0F * (q.x * q.y - q.z * q.w), 1.0F - 2.0F * (q.x * q.x + q.z * q.z), 2.0F * (q.y * q.z + q.x * q.w)};
  turn[2] = {2.0F * (q.x * q.z + q.y * q.w), 2.0F * (q.y * q.z - q.x * q.w), 1.0F - 2.0F * (q.x * q.x + q.y * q.y)};
  glm::dmat4 out(1.0);
  for (glm::length_t i = 0; i < 3; ++i) out[i] = glm::dvec4(glm::dvec3(turn[i] * scale[i]), 0.0);
  out[3] = glm::dvec4(glm::dvec3(move), 1.0);
  return out;
}

// A node's transforms: for meshes, and for cameras and lights.
struct NodePlace {
  glm::dmat4 rounded{1.0};
  glm::dmat4 exact{1.0};
};

class NodeWalk {
 public:
  explicit NodeWalk(const JsonValue& root) : root_(root), visited_(list_of(item(root, "nodes")).size()) {}

  Result<GltfNodes> walk() {
    const JsonValue& scene = item(root_, "scenes", index_of(item(root_, "scene")).value_or(0));
    if (scene.is_null()) return fault_of("has no scene");
    for (const JsonValue& node : list_of(item(scene, "nodes"))) {
      if (auto fault = visit(node, {}, 0)) return *fault;
    }
    return std::move(out_);
  }

 private:
  std::optional<Diagnostic> visit(const JsonValue& reference, const NodePlace& parent, int depth) {
    const std::uint64_t index = index_of(reference).value_or(~0ULL);
    const JsonValue& node = item(root_, "nodes", index);
    if (node.is_null()) return fault_of("names a node that does not exist");
    if (visited_[index]) return fault_of(fmt::format("node {} is reached twice: nodes must form a tree", index));
    if (depth > kDeepestNode) return fault_of(fmt::format("its nodes nest more than {} deep", kDeepestNode));
    visited_[index] = true;
    const NodePlace place{parent.rounded * rounded_transform(node), parent.exact * local_transform(node)};
    const JsonValue& mesh = item(node, "mesh");
    if (!mesh.is_null()) {
      const std::uint64_t number = index_of(mesh).value_or(~0ULL);
      if (item(root_, "meshes", number).is_null()) return fault_of("names a mesh that does not exist");
      out_.placements.push_back({index, number, place.rounded});
    }
    if (!item(node, "camera").is_null()) {
      if (auto fault = add_camera(item(node, "camera"), place.exact)) return fault;
    }
    const JsonValue& light = item(node, "extensions", "KHR_lights_punctual", "light");
    if (!light.is_null()) {
      if (auto fault = add_light(node, light, place.exact)) return fault;
    }
    for (const JsonValue& child : list_of(item(node, "children"))) {
      if (auto fault = visit(child, place, depth + 1)) return fault;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> add_camera(const JsonValue& reference, const glm::dmat4& world) {
    const JsonValue& camera = target_of(item(root_, "cameras"), reference);
    if (camera.is_null()) return fault_of("names a camera that does not exist");
    const double angle = number_or(item(camera, "perspective", "yfov"), 0.0);
    if (text_of(item(camera, "type")) != "perspective") return std::nullopt;
    if (angle <= 0.0 || angle >= std::numbers::pi) return fault_of("a camera's yfov is not between 0 and pi");
    Camera out;
    const glm::dvec3 ahead = -glm::dvec3(world[2]);
    out.position = glm::vec3(glm::dvec3(world[3]));
    out.look_at = glm::vec3(glm::dvec3(world[3]) + ahead / std::max(glm::length(ahead), 1e-300));
    out.up = glm::vec3(glm::dvec3(world[1]));
    out.vertical_fov_degrees = static_cast<float>(angle * 180.0 / std::numbers::pi);
    out_.viewpoints.cameras.push_back(out);
    return std::nullopt;
  }

  std::optional<Diagnostic> add_light(const JsonValue& node, const JsonValue& reference, const glm::dmat4& world) {
    const JsonValue& light = target_of(item(root_, "extensions", "KHR_lights_punctual", "lights"), reference);
    if (light.is_null()) return fault_of("names a light that does not exist");
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
    out_.viewpoints.lights.push_back(out);
    return std::nullopt;
  }

  const JsonValue& root_;
  std::vector<bool> visited_;
  GltfNodes out_;
};

}  // namespace

Result<GltfNodes> read_gltf_nodes(const JsonValue& root) {
  return NodeWalk(root).walk();
}

}  // namespace ninebit
