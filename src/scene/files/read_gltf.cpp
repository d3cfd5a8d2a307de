#include <fmt/format.h>

#include "src/scene/files/gltf_materials.h"
#include "src/scene/files/gltf_meshes.h"
#include "src/scene/files/gltf_nodes.h"
#include "src/scene/files/gltf_storage.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {

Result<Scene> read_gltf(const SceneFile& from, std::string_view content, bool binary, const SceneReadOptions& options) {
  GlbParts parts{content, std::nullopt};
  if (binary) {
    Result<GlbParts> split = split_glb(content);
    if (!split) return split.error();
    parts = *split;
  }
  const Result<JsonValue> root = parse_json(parts.json);
  if (!root) return root.error();
  const std::string& version = text_of(item(*root, "asset", "version"));
  // Early files of version 1.0 do not name it. Their lists are objects.
  if (version.starts_with("1.") || (version.empty() && item(*root, "accessors").is_object())) {
    return read_gltf1(from, *root, parts.binary.value_or(std::string_view()), options);
  }
  if (version.empty()) return fault_of("is not a glTF file: it has no asset.version");
  if (!version.starts_with("2."))
    return fault_of(fmt::format("is of glTF version {}; versions 1.0 and 2.0 are read", version));
  GltfStorage storage(*root, from.beside, parts.binary);
  if (auto fault = storage.check()) return *fault;
  const Result<GltfNodes> nodes = read_gltf_nodes(*root);
  if (!nodes) return nodes.error();
  Scene out;
  GltfMeshes meshes(*root, storage, out);
  if (auto fault = meshes.prepare(nodes->placements, content.size() + storage.bytes(), options)) return *fault;
  for (const GltfPlacement& placement : nodes->placements) {
    if (auto fault = meshes.place(placement)) return *fault;
  }
  if (auto fault = add_viewpoints(nodes->viewpoints, glm::dmat4(1.0), out)) return *fault;
  move_look_at_points(out);
  out.notes = gltf_notes(*root);
  return out;
}

}  // namespace ninebit
