#include "src/scene/gltf_geometry.h"

#include <initializer_list>

namespace ninebit {
namespace {

Json only(const Json& object, std::initializer_list<const char*> names) {
  Json out = Json::object();
  for (const char* name : names) {
    const Json& member = item(object, name);
    if (!member.is_null()) out[name] = member;
  }
  return out;
}

Json each(const Json& array, Json (*reduce)(const Json&)) {
  Json out = Json::array();
  for (const Json& one : list_of(array)) out.push_back(reduce(one));
  return out;
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

Json primitive(const Json& from) {
  Json out = only(from, {"indices", "material", "mode"});
  out["attributes"] = only(item(from, "attributes"), {"POSITION", "NORMAL"});
  const Json& draco = item(from, "extensions", kDraco);
  if (!draco.is_null()) {
    Json& reduced = out["extensions"][kDraco];
    reduced = only(draco, {"bufferView"});
    reduced["attributes"] = only(item(draco, "attributes"), {"POSITION", "NORMAL"});
  }
  return out;
}

Json mesh(const Json& from) {
  Json out = only(from, {"name"});
  out["primitives"] = each(item(from, "primitives"), primitive);
  return out;
}

Json material(const Json& from) {
  Json out = only(from, {"name"});
  out["pbrMetallicRoughness"] = only(item(from, "pbrMetallicRoughness"), {"baseColorFactor"});
  return out;
}

Json node(const Json& from) {
  return only(from, {"name", "children", "mesh", "matrix", "translation", "rotation", "scale"});
}

Json scene(const Json& from) {
  return only(from, {"name", "nodes"});
}

// Assimp takes "3.0" for no index, and 2^53 and more for one: each number must be to it what it is to our checks.
void settle_numbers(Json& value) {
  if (value.is_structured()) {
    for (Json& one : value) settle_numbers(one);
  } else if (const auto index = index_of(value)) {
    value = *index;
  } else if (value.is_number()) {
    value = value.get<double>();
  }
}

}  // namespace

std::string gltf_geometry(const Json& root) {
  Json out = only(root, {"asset", "scene", "accessors", "bufferViews", "buffers"});
  out["scenes"] = each(item(root, "scenes"), scene);
  out["nodes"] = each(item(root, "nodes"), node);
  out["meshes"] = each(item(root, "meshes"), mesh);
  out["materials"] = each(item(root, "materials"), material);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    for (const Json& name : list_of(item(root, list))) {
      if (text_of(name) == kDraco) out[list].push_back(name);
    }
  }
  settle_numbers(out);
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ninebit
