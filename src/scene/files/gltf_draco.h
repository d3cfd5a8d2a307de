// The primitives of a glTF file that are compressed with KHR_draco_mesh_compression.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene_io.h"
#include "src/scene/files/draco_meshes.h"
#include "src/scene/files/gltf_storage.h"

namespace ninebit {

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

}  // namespace ninebit
