#include "src/scene/files/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/scene/files/draco_meshes.h"
#include "src/scene/files/gltf_materials.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

// The corners of a primitive's triangle, as positions in its list of indices.
std::array<std::uint64_t, 3> corners_of(std::uint64_t mode, std::uint64_t triangle) {
  if (mode == 4) return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
  if (mode == 6) return {0, triangle + 1, triangle + 2};
  // Every second triangle of a strip has reversed winding.
  if (triangle % 2 == 1) return {triangle + 1, triangle, triangle + 2};
  return {triangle, triangle + 1, triangle + 2};
}

std::uint64_t triangles_along(std::uint64_t mode, std::uint64_t corners) {
  return mode == 4 ? corners / 3 : std::max<std::uint64_t>(corners, 2) - 2;
}

}  // namespace

GltfMeshes::GltfMeshes(const JsonValue& root, GltfStorage& storage, Scene& scene)
    : root_(root),
      storage_(storage),
      scene_(scene),
      builder_(scene),
      draco_(root, storage),
      meshes_(list_of(item(root, "meshes")).size()) {
  GltfMaterials materials(root, storage, scene);
  for (const JsonValue& material : list_of(item(root, "materials"))) materials.add(material);
  materials.add(JsonValue());
}

std::optional<Diagnostic> GltfMeshes::prepare(const std::vector<GltfPlacement>& placements, std::uint64_t file_bytes,
                                              const SceneReadOptions& options) {
  const std::uint64_t most = std::min({kMostTriangles, options.most_triangles, file_bytes + kMostPlacedAgain});
  std::uint64_t placed = 0;
  for (const GltfPlacement& placement : placements) {
    Mesh& mesh = meshes_[placement.mesh];
    if (!mesh.known) {
      if (auto fault = resolve(placement.mesh)) return fault;
    }
    placed += mesh.triangles;
    if (placed > most) return fault_of(fmt::format("its nodes place more than {} triangles", most));
  }
  if (auto fault = decode_compressed(options)) return fault;
  placed = 0;
  for (const GltfPlacement& placement : placements) placed += meshes_[placement.mesh].triangles;
  scene_.triangles.reserve(placed);
  scene_.triangle_object.reserve(placed);
  scene_.triangle_material.reserve(placed);
  return std::nullopt;
}

std::optional<Diagnostic> GltfMeshes::resolve(std::uint64_t number) {
  Mesh& mesh = meshes_[number];
  mesh.known = true;
  const JsonValue& primitives = list_of(item(root_, "meshes", number, "primitives"));
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    GltfPrimitive primitive;
    const std::string name = fmt::format("primitive {} of mesh {}", i, number);
    if (auto fault = resolve_primitive(primitives[i], name, primitive))
      return fault_of(fmt::format("{} {}", name, *fault));
    if (primitive.triangles == 0) continue;
    mesh.triangles += primitive.triangles;
    mesh.primitives.push_back(std::move(primitive));
  }
  return std::nullopt;
}

std::optional<std::string> GltfMeshes::resolve_primitive(const JsonValue& from, const std::string& name,
                                                         GltfPrimitive& out) {
  out.mode = index_of(item(from, "mode")).value_or(4);
  const JsonValue& attributes = item(from, "attributes");
  if (out.mode < 4 || item(attributes, "POSITION").is_null()) return std::nullopt;  // points and lines have no surface
  if (out.mode > 6) return fmt::format("is of the unknown mode {}", out.mode);
  if (draco_.is_needed(from)) return resolve_compressed(from, name, out);
  std::optional<GltfNumbers> positions;
  if (auto fault = resolve_numbers(item(attributes, "POSITION"), "VEC3", {5126}, positions)) return fault;
  if (auto fault = resolve_numbers(item(attributes, "NORMAL"), "VEC3", {5126, 5120, 5122}, out.normals)) return fault;
  if (auto fault = resolve_numbers(item(from, "indices"), "SCALAR", {5121, 5123, 5125}, out.indices)) return fault;
  out.positions = *positions;
  if (out.normals && out.normals->count != out.positions.count) out.normals.reset();
  if (auto fault = resolve_surface(attributes, out)) return fault;
  const std::uint64_t corners = out.indices ? out.indices->count : out.positions.count;
  out.triangles = triangles_along(out.mode, corners);
  return material_of(item(from, "material"), out.material);
}

std::optional<std::string> GltfMeshes::resolve_surface(const JsonValue& attributes, GltfPrimitive& out) {
  const JsonValue& coordinates = item(attributes, "TEXCOORD_0");
  if (auto fault = resolve_numbers(coordinates, "VEC2", {5126, 5121, 5123}, out.texture_coordinates)) return fault;
  if (auto fault = resolve_numbers(item(attributes, "TANGENT"), "VEC4", {5126}, out.tangents)) return fault;
  const JsonValue& color = item(attributes, "COLOR_0");
  const JsonValue& accessor = target_of(item(root_, "accessors"), color);
  out.has_alpha = text_of(item(accessor, "type")) == "VEC4";
  if (auto fault = resolve_numbers(color, out.has_alpha ? "VEC4" : "VEC3", {5126, 5121, 5123}, out.colors))
    return fault;
  for (auto* numbers : {&out.texture_coordinates, &out.tangents, &out.colors}) {
    if (*numbers && (*numbers)->count != out.positions.count) numbers->reset();
  }
  return std::nullopt;
}

// Attributes that the extension does not name are in accessors as usual.
std::optional<std::string> GltfMeshes::resolve_compressed(const JsonValue& from, const std::string& name,
                                                          GltfPrimitive& out) {
  if (out.mode == 6) return "is compressed and of mode 6; expected mode 4 or 5";
  const JsonValue& accessor = target_of(item(root_, "accessors"), item(from, "indices"));
  if (auto fault = fault_of_use(accessor, "SCALAR", {5121, 5123, 5125})) return fault;
  out.triangles = triangles_along(out.mode, index_of(item(accessor, "count")).value_or(0));
  if (out.triangles > kMostTriangles)
    return fmt::format("declares {} triangles; at most {} are read", out.triangles, kMostTriangles);
  if (out.triangles == 0) return std::nullopt;
  if (auto fault = draco_.add(from, out.triangles, name, out.compressed.emplace())) return fault;
  const JsonValue& attributes = item(from, "attributes");
  const JsonValue& compressed = item(from, "extensions", kDracoExtension, "attributes");
  if (item(compressed, "POSITION").is_null()) {
    std::optional<GltfNumbers> positions;
    if (auto fault = resolve_numbers(item(attributes, "POSITION"), "VEC3", {5126}, positions)) return fault;
    out.positions = *positions;
  }
  if (item(compressed, "NORMAL").is_null()) {
    if (auto fault = resolve_numbers(item(attributes, "NORMAL"), "VEC3", {5126, 5120, 5122}, out.normals)) return fault;
  }
  return material_of(item(from, "material"), out.material);
}

std::optional<Diagnostic> GltfMeshes::decode_compressed(const SceneReadOptions& options) {
  if (auto fault = draco_.decode(options)) return fault;
  for (Mesh& mesh : meshes_) {
    for (GltfPrimitive& primitive : mesh.primitives) {
      if (!primitive.compressed) continue;
      mesh.triangles -= primitive.triangles;
      take_decoded(primitive);
      mesh.triangles += primitive.triangles;
    }
  }
  return std::nullopt;
}

void GltfMeshes::take_decoded(GltfPrimitive& primitive) const {
  const std::size_t number = *primitive.compressed;
  primitive.indices = draco_.indices(number);
  primitive.mode = 4;  // Draco decodes a strip to separate triangles
  primitive.triangles = primitive.indices->count / 3;
  if (const auto positions = draco_.positions(number)) primitive.positions = *positions;
  if (const auto normals = draco_.normals(number)) primitive.normals = *normals;
  if (primitive.normals && primitive.normals->count != primitive.positions.count) primitive.normals.reset();
}

std::optional<std::string> GltfMeshes::resolve_numbers(const JsonValue& reference, const char* type,
                                                       std::initializer_list<std::uint64_t> components,
                                                       std::optional<GltfNumbers>& out) {
  if (reference.is_null()) return std::nullopt;
  const JsonValue& accessor = target_of(item(root_, "accessors"), reference);
  if (auto fault = fault_of_use(accessor, type, components)) return fault;
  if (item(accessor, "bufferView").is_null()) return "uses an accessor that has no data";
  const Result<GltfNumbers> numbers = storage_.numbers(accessor);
  if (!numbers) return "cannot be read: " + numbers.error().message;
  out = *numbers;
  return std::nullopt;
}

std::optional<std::string> GltfMeshes::material_of(const JsonValue& reference, std::uint32_t& material) {
  const auto none = static_cast<std::uint32_t>(scene_.materials.size() - 1);
  material = none;
  if (reference.is_null()) return std::nullopt;
  const std::uint64_t index = index_of(reference).value_or(~0ULL);
  if (index >= none) return "names a material that does not exist";
  material = static_cast<std::uint32_t>(index);
  return std::nullopt;
}

std::optional<Diagnostic> GltfMeshes::place(const GltfPlacement& placement) {
  const Mesh& mesh = meshes_[placement.mesh];
  if (mesh.triangles == 0) return std::nullopt;
  const std::string& name = text_of(item(root_, "nodes", placement.node, "name"));
  builder_.begin_object(name.empty() ? fmt::format("nodes[{}]", placement.node) : name);
  const MeshPlace place = MeshPlace::of(placement.world);
  for (const GltfPrimitive& primitive : mesh.primitives) {
    if (auto fault = place_primitive(primitive, place))
      return fault_of(fmt::format("node {}, mesh {}: {}", placement.node, placement.mesh, *fault));
  }
  builder_.end_object();
  return std::nullopt;
}

std::optional<std::string> GltfMeshes::place_primitive(const GltfPrimitive& primitive, const MeshPlace& place) {
  // Many primitives may share a large vertex array and use few of its vertices each, so a table of placed vertices is
  // made only if it is small relative to the primitive's triangles.
  const bool table = primitive.positions.count <= 4 * primitive.triangles + 64;
  vertices_.assign(table ? primitive.positions.count : 0, VertexTable::kFree);
  for (std::uint64_t i = 0; i < primitive.triangles; ++i) {
    std::array<std::uint32_t, 3> corners{};
    const std::array<std::uint64_t, 3> along = corners_of(primitive.mode, i);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t corner = primitive.indices ? primitive.indices->index(along[k]) : along[k];
      if (corner >= primitive.positions.count)
        return fmt::format("a vertex index is out of range: the primitive has {} vertices, counted from 0",
                           primitive.positions.count);
      if (table && vertices_[corner] != VertexTable::kFree) {
        corners[k] = vertices_[corner];
        continue;
      }
      if (auto fault = place_corner(primitive, place, corner, corners[k])) return fault;
      if (table) vertices_[corner] = corners[k];
    }
    if (auto fault = builder_.polygon(corners, primitive.material, place.mirrored)) return fault;
  }
  return std::nullopt;
}

std::optional<std::string> GltfMeshes::place_corner(const GltfPrimitive& primitive, const MeshPlace& place,
                                                    std::uint64_t corner, std::uint32_t& vertex) {
  MeshVertex own{.position = primitive.positions.vector<3>(corner)};
  if (primitive.normals) own.normal = primitive.normals->vector<3>(corner);
  if (primitive.texture_coordinates) {
    const glm::vec2 at = primitive.texture_coordinates->vector<2>(corner);
    own.texture_coordinate = is_finite(glm::vec3(at, 0.0F)) ? at : glm::vec2(0.0F);
  }
  if (primitive.tangents) own.tangent = primitive.tangents->vector<4>(corner);
  if (primitive.colors) {
    const glm::vec4 color = primitive.has_alpha ? primitive.colors->vector<4>(corner)
                                                : glm::vec4(primitive.colors->vector<3>(corner), 1.0F);
    // A comparison with NaN is false.
    own.color.emplace();
    for (glm::length_t i = 0; i < 4; ++i) (*own.color)[i] = color[i] > 0.0F ? std::min(color[i], 1.0F) : 0.0F;
  }
  return builder_.vertex_at(place, own, vertex);
}

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
