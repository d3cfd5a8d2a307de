#include "src/scene/files/gltf_draco.h"

#include <fmt/format.h>

#include "src/scene/files/draco_meshes.h"

namespace ninebit {
namespace {

const JsonValue& extension_of(const JsonValue& primitive) {
  return item(primitive, "extensions", kDracoExtension);
}

std::string invalid_member(const std::string& member, const char* expected) {
  return fmt::format("has no valid extensions.{}{}; expected {}", kDracoExtension, member, expected);
}

GltfNumbers packed(std::string_view data, std::uint64_t numbers, std::uint64_t component) {
  const std::uint64_t element = numbers * gltf_component_size(component);
  return {data, data.size() / element, element, component};
}

}  // namespace

bool GltfDraco::has_data(const JsonValue& accessor) const {
  return accessor.is_null() || !item(target_of(item(root_, "accessors"), accessor), "bufferView").is_null();
}

bool GltfDraco::is_needed(const JsonValue& primitive) const {
  if (extension_of(primitive).is_null()) return false;
  return !has_data(item(primitive, "attributes", "POSITION")) || !has_data(item(primitive, "attributes", "NORMAL")) ||
         !has_data(item(primitive, "indices"));
}

std::optional<std::string> GltfDraco::add(const JsonValue& primitive, std::uint64_t triangles, const std::string& name,
                                          std::size_t& number) {
  const JsonValue& extension = extension_of(primitive);
  if (!extension.is_object()) return invalid_member("", "an object");
  const JsonValue& view = target_of(item(root_, "bufferViews"), item(extension, "bufferView"));
  if (view.is_null()) return invalid_member(".bufferView", "the index of a buffer view");
  if (!item(extension, "attributes").is_object()) return invalid_member(".attributes", "an object");
  DracoRequest request;
  request.most_triangles = triangles;
  request.name = name;
  if (auto fault = find_attribute(primitive, "POSITION", {5126}, request.positions)) return fault;
  if (auto fault = find_attribute(primitive, "NORMAL", {5126, 5120, 5122}, request.normals)) return fault;
  const Result<std::string_view> stream = storage_.view_bytes(view);
  if (!stream) return "cannot be read: " + stream.error().message;
  request.stream = *stream;
  number = requests_.size();
  requests_.push_back(std::move(request));
  return std::nullopt;
}

std::optional<std::string> GltfDraco::find_attribute(const JsonValue& primitive, const char* name,
                                                     std::initializer_list<std::uint64_t> components,
                                                     std::optional<DracoAttribute>& out) const {
  const JsonValue& reference = item(primitive, "attributes", name);
  const JsonValue& stated = item(extension_of(primitive), "attributes", name);
  if (reference.is_null() || stated.is_null()) return std::nullopt;
  const std::uint64_t id = index_of(stated).value_or(~0ULL);
  if (id > 0xFFFFFFFFU)
    return invalid_member(fmt::format(".attributes.{}", name), "the id of an attribute of the compressed data");
  const JsonValue& accessor = target_of(item(root_, "accessors"), reference);
  if (auto fault = fault_of_use(accessor, "VEC3", components)) return fault;
  out = {static_cast<std::uint32_t>(id), index_of(item(accessor, "componentType")).value_or(0)};
  return std::nullopt;
}

std::optional<Diagnostic> GltfDraco::decode(const SceneReadOptions& options) {
  if (requests_.empty()) return std::nullopt;
  Result<std::vector<DracoMesh>> meshes = decode_all(&decode_draco, requests_, options);
  if (!meshes) return meshes.error();
  meshes_ = std::move(meshes).value();
  return std::nullopt;
}

GltfNumbers GltfDraco::indices(std::size_t number) const {
  return packed(meshes_[number].indices, 1, 5125);
}

std::optional<GltfNumbers> GltfDraco::positions(std::size_t number) const {
  const std::optional<DracoAttribute>& wanted = requests_[number].positions;
  if (!wanted) return std::nullopt;
  return packed(meshes_[number].positions, 3, wanted->component);
}

std::optional<GltfNumbers> GltfDraco::normals(std::size_t number) const {
  const std::optional<DracoAttribute>& wanted = requests_[number].normals;
  if (!wanted) return std::nullopt;
  return packed(meshes_[number].normals, 3, wanted->component);
}

}  // namespace ninebit
