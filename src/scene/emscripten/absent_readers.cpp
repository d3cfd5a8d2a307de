// Stand-ins for the functions that scene/files takes from Draco and Assimp, for a build without them.
#include "src/scene/files/draco_meshes.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {

Result<DracoMesh> decode_draco(const DracoRequest& request) {
  return fault_of(request.name + " is compressed with Draco, which is not read here");
}

Result<std::vector<DracoMesh>> decode_all(DracoDecode decode, std::span<const DracoRequest> requests,
                                          const SceneReadOptions&) {
  std::vector<DracoMesh> meshes;
  for (const DracoRequest& request : requests) {
    auto mesh = decode(request);
    if (!mesh) return mesh.error();
    meshes.push_back(std::move(*mesh));
  }
  return meshes;
}

Result<Scene> read_gltf1(const SceneFile&, JsonValue, std::string_view, const SceneReadOptions&) {
  return fault_of("is of glTF version 1.0; version 2.0 is read here");
}

}  // namespace ninebit
