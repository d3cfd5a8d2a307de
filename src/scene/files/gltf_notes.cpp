// Contents of a glTF file that the reader leaves out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "src/scene/files/gltf_materials.h"

namespace ninebit {
namespace {

constexpr std::array<std::string_view, 2> kExtensionsRead{"KHR_lights_punctual", "KHR_draco_mesh_compression"};

using Has = bool (*)(const JsonValue& item);

bool has(const JsonValue& value, const char* name) {
  return !item(value, name).is_null();
}

const JsonValue& metallic(const JsonValue& material) {
  return item(material, "pbrMetallicRoughness");
}

// Matte materials write a factor, too: the default of metallicFactor is 1.
bool shines(const JsonValue& m) {
  return has(metallic(m), "metallicRoughnessTexture") || number_or(item(metallic(m), "metallicFactor"), 0.0) > 0.0;
}

bool emits(const JsonValue& m) {
  if (has(m, "emissiveTexture")) return true;
  for (const JsonValue& value : list_of(item(m, "emissiveFactor"))) {
    if (number_or(value, 0.0) > 0.0) return true;
  }
  return false;
}

bool uses_other_coordinates(const JsonValue& m) {
  return index_of(item(metallic(m), "baseColorTexture", "texCoord")).value_or(0) != 0;
}

bool moves_texture(const JsonValue& m) {
  return !item(metallic(m), "baseColorTexture", "extensions", "KHR_texture_transform").is_null();
}

struct MaterialNote {
  Has has;
  const char* text;
};
constexpr std::array kMaterialParts{
    MaterialNote{[](const JsonValue& m) { return has(m, "normalTexture"); }, "normal maps"},
    MaterialNote{shines, "metalness and roughness"},
    MaterialNote{[](const JsonValue& m) { return has(m, "occlusionTexture"); }, "occlusion maps"},
    MaterialNote{emits, "emitted light"},
    MaterialNote{uses_other_coordinates, "base colour textures with other coordinates than TEXCOORD_0"},
    MaterialNote{moves_texture, "KHR_texture_transform"},
    MaterialNote{[](const JsonValue& m) { return text_of(item(m, "alphaMode")) == "BLEND"; }, "alpha blending"}};

template <class Test>
bool any_in(const JsonValue& list, const Test& test) {
  const JsonValue& all = list_of(list);
  return std::any_of(all.begin(), all.end(), test);
}

bool has_morph_targets(const JsonValue& mesh) {
  return any_in(item(mesh, "primitives"), [](const JsonValue& p) { return !list_of(item(p, "targets")).empty(); });
}

bool compresses_surface(const JsonValue& mesh) {
  return any_in(item(mesh, "primitives"), [](const JsonValue& p) {
    if (item(p, "extensions", "KHR_draco_mesh_compression").is_null()) return false;
    return !item(p, "attributes", "TEXCOORD_0").is_null() || !item(p, "attributes", "COLOR_0").is_null();
  });
}

std::string extensions_left_out(const JsonValue& root) {
  std::string names;
  for (const JsonValue& extension : list_of(item(root, "extensionsUsed"))) {
    const std::string& name = text_of(extension);
    if (name.empty() || name == "KHR_texture_transform") continue;  // noted where a material uses it
    if (std::find(kExtensionsRead.begin(), kExtensionsRead.end(), name) != kExtensionsRead.end()) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

}  // namespace

std::vector<std::string> gltf_notes(const JsonValue& root) {
  std::vector<std::string> notes;
  for (const MaterialNote& note : kMaterialParts) {
    if (any_in(item(root, "materials"), note.has)) notes.emplace_back(note.text);
  }
  if (any_in(item(root, "nodes"), [](const JsonValue& node) { return has(node, "skin"); })) notes.emplace_back("skins");
  if (any_in(item(root, "meshes"), has_morph_targets)) notes.emplace_back("morph targets");
  if (any_in(item(root, "meshes"), compresses_surface)) {
    notes.emplace_back("texture coordinates and colours of compressed meshes");
  }
  if (!list_of(item(root, "animations")).empty()) notes.emplace_back("animations");
  if (const std::string names = extensions_left_out(root); !names.empty()) {
    notes.push_back(fmt::format("extensions {}", names));
  }
  return notes;
}

}  // namespace ninebit
