// The primitives of a glTF file that KHR_draco_mesh_compression compressed.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene_io.h"
#include "src/scene/draco_decoder.h"
#include "src/scene/gltf_storage.h"

namespace ninebit {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

class GltfDraco {
 public:
  GltfDraco(const Json& root, GltfStorage& storage) : root_(root), storage_(storage) {}

  // Whether a primitive is compressed, and the file does not have all of it uncompressed besides.
  [[nodiscard]] bool is_needed(const Json& primitive) const;

  // Adds a primitive that needs it, with the triangles that its indices declare; reports what is wrong with its
  // extension. `number` is its place among those that were added. `name` is for messages.
  [[nodiscard]] std::optional<std::string> add(const Json& primitive, std::uint64_t triangles, const std::string& name,
                                               std::size_t& number);

  // Decodes all that were added.
  [[nodiscard]] std::optional<Diagnostic> decode(const SceneReadOptions& options);

  // The arrays of one that is decoded; nothing where its extension does not name the attribute.
  [[nodiscard]] GltfNumbers indices(std::size_t number) const;
  [[nodiscard]] std::optional<GltfNumbers> positions(std::size_t number) const;
  [[nodiscard]] std::optional<GltfNumbers> normals(std::size_t number) const;

 private:
  [[nodiscard]] std::optional<std::string> find_attribute(const Json& primitive, const char* name,
                                                          std::initializer_list<std::uint64_t> components,
                                                          std::optional<DracoAttribute>& out) const;
  [[nodiscard]] bool has_data(const Json& accessor) const;

  const Json& root_;
  GltfStorage& storage_;
  std::vector<DracoRequest> requests_;
  std::vector<DracoMesh> meshes_;  // one for each request
};

}  // namespace ninebit
