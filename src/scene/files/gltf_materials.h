// The materials of a glTF file, and the pictures that they name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/scene/scene.h"
#include "src/scene/files/gltf_storage.h"
#include "src/scene/files/json_value.h"

namespace ninebit {

class GltfMaterials {
 public:
  GltfMaterials(const JsonValue& root, GltfStorage& storage, Scene& scene);

  // Appends a material to the scene's; null: the default material. A texture that cannot be found is a fault of the
  // scene's texture, which its users report.
  void add(const JsonValue& from);

 private:
  void add_texture(const JsonValue& info, Material& out);
  // The scene's texture of images[number]; several textures may share one.
  [[nodiscard]] std::uint32_t texture_of(std::uint64_t number);
  [[nodiscard]] SceneTexture read_image(const JsonValue& image, std::uint64_t number);

  const JsonValue& root_;
  GltfStorage& storage_;
  Scene& scene_;
  std::vector<std::optional<std::uint32_t>> of_image_;
  std::uint64_t left_;  // bytes of buffer views that may still become pictures: views may overlap
};

// Contents that the reader leaves out, one line each kind, such as "normal maps". In the order of the table in
// gltf_notes.cpp.
[[nodiscard]] std::vector<std::string> gltf_notes(const JsonValue& root);

}  // namespace ninebit
