#include "src/scene/gltf_geometry.h"

#include <fmt/format.h>

#include <initializer_list>

namespace ninebit {
namespace {

void print_string(const std::string& text, std::string& out) {
  out.push_back('"');
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    if (static_cast<unsigned char>(c) < 32) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out.push_back(c);
    }
  }
  out.push_back('"');
}

void print(const JsonValue& value, std::string& out) {
  switch (value.type) {
    case JsonValue::Type::null:
      out += "null";
      return;
    case JsonValue::Type::boolean:
      out += value.number != 0.0 ? "true" : "false";
      return;
    case JsonValue::Type::number:
      out += fmt::format("{}", value.number);  // the shortest text that reads as the same number
      // Assimp takes "3.0" for no index.
      if (out.ends_with(".0")) out.resize(out.size() - 2);
      return;
    case JsonValue::Type::string:
      print_string(value.text, out);
      return;
    case JsonValue::Type::array:
    case JsonValue::Type::object:
      break;
  }
  const bool object = value.type == JsonValue::Type::object;
  out.push_back(object ? '{' : '[');
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (i > 0) out.push_back(',');
    if (object) {
      print_string(value.names[i], out);
      out.push_back(':');
    }
    print(value.items[i], out);
  }
  out.push_back(object ? '}' : ']');
}

JsonValue empty(JsonValue::Type type) {
  JsonValue value;
  value.type = type;
  return value;
}

void put(JsonValue& object, const char* name, JsonValue value) {
  object.names.emplace_back(name);
  object.items.push_back(std::move(value));
}

JsonValue only(const JsonValue& object, std::initializer_list<const char*> names) {
  JsonValue out = empty(JsonValue::Type::object);
  for (const char* name : names) {
    if (object[name].exists()) put(out, name, object[name]);
  }
  return out;
}

JsonValue each(const JsonValue& array, JsonValue (*reduce)(const JsonValue&)) {
  JsonValue out = empty(JsonValue::Type::array);
  for (const JsonValue& item : array.items) out.items.push_back(reduce(item));
  return out;
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

JsonValue primitive(const JsonValue& from) {
  JsonValue out = only(from, {"indices", "material", "mode"});
  put(out, "attributes", only(from["attributes"], {"POSITION", "NORMAL"}));
  const JsonValue& draco = from["extensions"][kDraco];
  if (draco.exists()) {
    JsonValue reduced = only(draco, {"bufferView"});
    put(reduced, "attributes", only(draco["attributes"], {"POSITION", "NORMAL"}));
    JsonValue extensions = empty(JsonValue::Type::object);
    put(extensions, kDraco, std::move(reduced));
    put(out, "extensions", std::move(extensions));
  }
  return out;
}

JsonValue mesh(const JsonValue& from) {
  JsonValue out = only(from, {"name"});
  put(out, "primitives", each(from["primitives"], primitive));
  return out;
}

JsonValue material(const JsonValue& from) {
  JsonValue out = only(from, {"name"});
  put(out, "pbrMetallicRoughness", only(from["pbrMetallicRoughness"], {"baseColorFactor"}));
  return out;
}

JsonValue node(const JsonValue& from) {
  return only(from, {"name", "children", "mesh", "matrix", "translation", "rotation", "scale"});
}

JsonValue scene(const JsonValue& from) {
  return only(from, {"name", "nodes"});
}

}  // namespace

std::string gltf_geometry(const JsonValue& root) {
  JsonValue out = only(root, {"asset", "scene", "accessors", "bufferViews", "buffers"});
  put(out, "scenes", each(root["scenes"], scene));
  put(out, "nodes", each(root["nodes"], node));
  put(out, "meshes", each(root["meshes"], mesh));
  put(out, "materials", each(root["materials"], material));
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    JsonValue kept = empty(JsonValue::Type::array);
    for (const JsonValue& name : root[list].items) {
      if (name.text == kDraco) kept.items.push_back(name);
    }
    if (!kept.items.empty()) put(out, list, std::move(kept));
  }
  std::string text;
  print(out, text);
  return text;
}

}  // namespace ninebit
