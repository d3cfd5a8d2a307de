// Small glTF and 3DS files made in memory.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::scene_tests {

inline void put(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 255U));
}

inline void put(std::string& out, float value) {
  put(out, std::bit_cast<std::uint32_t>(value), 4);
}

inline std::string base64(std::string_view data) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t at = 0; at < data.size(); at += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = (bits << 8U) | (at + i < data.size() ? static_cast<unsigned char>(data[at + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      out.push_back(at + i > data.size() ? '=' : kDigits[(bits >> (18U - 6U * i)) & 63U]);
  }
  return out;
}

// The three corners (0,0,0), (1,0,0), (0,1,0), front toward +z, with normals +z; indices as given.
inline std::string triangle_bytes(std::initializer_list<std::uint32_t> indices = {0, 1, 2}) {
  std::string data;
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(data, value);
  for (int i = 0; i < 3; ++i) {
    put(data, 0.F);
    put(data, 0.F);
    put(data, 1.F);
  }
  for (const std::uint32_t index : indices) put(data, index, 2);
  return data;
}

// A file with that triangle as mesh 0 and what the caller adds: its nodes (the array's inside), and more members.
inline std::string triangle_gltf(const std::string& nodes, const std::string& scene_nodes, const std::string& more = "",
                                 const std::string& data = triangle_bytes()) {
  const std::size_t index_bytes = data.size() > 72 ? data.size() - 72 : 0;
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + scene_nodes + R"(]}], "nodes": [)" +
         nodes + R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2,
  "material": 0}]}], "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1]}}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5123, "count": )" +
         std::to_string(index_bytes / 2) + R"(, "type": "SCALAR"}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
    {"buffer": 0, "byteOffset": 72, "byteLength": )" +
         std::to_string(index_bytes) + R"(}],
  "buffers": [{"byteLength": )" +
         std::to_string(data.size()) + R"(, "uri": "data:application/octet-stream;base64,)" + base64(data) + "\"}]" +
         more + "}";
}

// A file whose vertices of that triangle have more: `primitives` and further members of the root as given. Texture
// coordinates as bytes are accessor 3; `accessors` adds others, on buffer view 4, which holds `last`.
inline std::string vertex_data_gltf(const std::string& primitives, const std::string& accessors,
                                    const std::string& last, const std::string& more = "") {
  std::string data = triangle_bytes({0, 1, 2});
  data.resize(80, '\0');
  for (const unsigned value : {0U, 0U, 255U, 51U, 0U, 255U}) put(data, value, 1);
  data.resize(88, '\0');
  data += last;
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [)" +
         primitives + R"(]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"},
    {"bufferView": 3, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC2"})" +
         accessors + R"(],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
    {"buffer": 0, "byteOffset": 72, "byteLength": 6}, {"buffer": 0, "byteOffset": 80, "byteLength": 6},
    {"buffer": 0, "byteOffset": 88, "byteLength": )" +
         std::to_string(last.size()) + R"(}],
  "buffers": [{"byteLength": )" +
         std::to_string(data.size()) + R"(, "uri": "data:application/octet-stream;base64,)" + base64(data) + "\"}]" +
         more + "}";
}

inline std::string chunk_3ds(std::uint32_t id, const std::string& body) {
  std::string out;
  put(out, id, 2);
  put(out, static_cast<std::uint32_t>(body.size() + 6), 4);
  return out + body;
}

// A 3DS file with one object of three vertices and one face, and further objects as the caller adds them.
inline std::string triangle_3ds(std::uint32_t last_index, const std::string& more_objects = "") {
  std::string vertices;
  put(vertices, 3, 2);
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(vertices, value);
  std::string faces;
  put(faces, 1, 2);
  for (const std::uint32_t value : {0U, 1U, last_index, 7U}) put(faces, value, 2);
  const std::string mesh = chunk_3ds(0x4100, chunk_3ds(0x4110, vertices) + chunk_3ds(0x4120, faces));
  const std::string object = chunk_3ds(0x4000, std::string("shape") + '\0' + mesh);
  return chunk_3ds(0x4D4D, chunk_3ds(0x3D3D, object + more_objects));
}

}  // namespace ninebit::scene_tests
