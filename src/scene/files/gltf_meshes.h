// The meshes of a glTF file, and their triangles as nodes place them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene_io.h"
#include "src/scene/files/draco_meshes.h"
#include "src/scene/files/gltf_nodes.h"
#include "src/scene/files/gltf_storage.h"
#include "src/scene/files/mesh_builder.h"

namespace ninebit {

// The primitives of a glTF file that are compressed with KHR_draco_mesh_compression.

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

class GltfDraco {
 public:
  GltfDraco(const JsonValue& root, GltfStorage& storage) : root_(root), storage_(storage) {}

  // Whether a primitive has to be decompressed: the file does not contain all of it uncompressed as well.
  [[nodiscard]] bool is_needed(const JsonValue& primitive) const;

  // Adds a primitive for which is_needed() is true, with the number of triangles that its indices declare. Returns a
  // fault of its extension. `number` is set to its position among the added primitives. `name` is for messages.
  [[nodiscard]] std::optional<std::string> add(const JsonValue& primitive, std::uint64_t triangles,
                                               const std::string& name, std::size_t& number);

  // Decodes all added primitives.
  [[nodiscard]] std::optional<Diagnostic> decode(const SceneReadOptions& options);

  // The arrays of a decoded primitive; empty if its extension does not name the attribute.
  [[nodiscard]] GltfNumbers indices(std::size_t number) const;
  [[nodiscard]] std::optional<GltfNumbers> positions(std::size_t number) const;
  [[nodiscard]] std::optional<GltfNumbers> normals(std::size_t number) const;

 private:
  [[nodiscard]] std::optional<std::string> find_attribute(const JsonValue& primitive, const char* name,
                                                          std::initializer_list<std::uint64_t> components,
                                                          std::optional<DracoAttribute>& out) const;
  [[nodiscard]] bool has_data(const JsonValue& accessor) const;

  const JsonValue& root_;
  GltfStorage& storage_;
  std::vector<DracoRequest> requests_;
  std::vector<DracoMesh> meshes_;  // one per request
};

// A primitive of a mesh that consists of triangles.
struct GltfPrimitive {
  GltfNumbers positions;
  std::optional<GltfNumbers> normals;
  std::optional<GltfNumbers> texture_coordinates;  // TEXCOORD_0
  std::optional<GltfNumbers> tangents;             // TANGENT
  std::optional<GltfNumbers> colors;               // COLOR_0
  bool has_alpha = false;                          // of the colours
  std::optional<GltfNumbers> indices;
  std::uint32_t material = 0;  // index into the scene's materials
  std::uint64_t mode = 4;      // 4: triangles, 5: a strip, 6: a fan
  std::uint64_t triangles = 0;
  // Its number in GltfDraco. Until it is decoded, `triangles` is the declared number.
  std::optional<std::size_t> compressed;
};

class GltfMeshes {
 public:
  // Adds the file's materials to the scene, and one more for primitives without a material.
  GltfMeshes(const JsonValue& root, GltfStorage& storage, Scene& scene);

  // Checks each placed mesh, reports too many triangles, and decodes compressed primitives. `file_bytes`: all bytes of
  // the file and its buffers.
  [[nodiscard]] std::optional<Diagnostic> prepare(const std::vector<GltfPlacement>& placements,
                                                  std::uint64_t file_bytes, const SceneReadOptions& options);

  // Adds a node's mesh as an object. Only after prepare().
  [[nodiscard]] std::optional<Diagnostic> place(const GltfPlacement& placement);

 private:
  struct Mesh {
    bool known = false;
    std::uint64_t triangles = 0;
    std::vector<GltfPrimitive> primitives;
  };

  [[nodiscard]] std::optional<Diagnostic> resolve(std::uint64_t number);
  [[nodiscard]] std::optional<std::string> resolve_primitive(const JsonValue& from, const std::string& name,
                                                             GltfPrimitive& out);
  [[nodiscard]] std::optional<std::string> resolve_compressed(const JsonValue& from, const std::string& name,
                                                              GltfPrimitive& out);
  [[nodiscard]] std::optional<std::string> resolve_surface(const JsonValue& attributes, GltfPrimitive& out);
  [[nodiscard]] std::optional<Diagnostic> decode_compressed(const SceneReadOptions& options);
  void take_decoded(GltfPrimitive& primitive) const;
  [[nodiscard]] std::optional<std::string> resolve_numbers(const JsonValue& reference, const char* type,
                                                           std::initializer_list<std::uint64_t> components,
                                                           std::optional<GltfNumbers>& out);
  [[nodiscard]] std::optional<std::string> material_of(const JsonValue& reference, std::uint32_t& material);
  [[nodiscard]] std::optional<std::string> place_primitive(const GltfPrimitive& primitive, const MeshPlace& place);
  [[nodiscard]] std::optional<std::string> place_corner(const GltfPrimitive& primitive, const MeshPlace& place,
                                                        std::uint64_t corner, std::uint32_t& vertex);

  const JsonValue& root_;
  GltfStorage& storage_;
  Scene& scene_;
  MeshBuilder builder_;
  GltfDraco draco_;
  std::vector<Mesh> meshes_;
  std::vector<std::uint32_t> vertices_;  // the scene's vertex for each of a primitive's; not always used
};

}  // namespace ninebit
