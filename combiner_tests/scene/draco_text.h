// Small glTF files whose mesh Draco compressed.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <array>
#include <memory>
#include <string>

#include "combiner_tests/scene/gltf_text.h"

namespace ninebit::scene_tests {

// A square in the plane z = 0 with `side` times `side` quads, each of two triangles, and normals +z.
struct DracoGrid {
  std::uint32_t side = 2;
  int method = draco::MESH_EDGEBREAKER_ENCODING;
  draco::DataType normals = draco::DT_FLOAT32;
  bool metadata = false;
  int position_bits = 0;  // 0: positions as they are

  [[nodiscard]] std::uint32_t triangles() const { return 2 * side * side; }
  [[nodiscard]] std::uint32_t vertices() const { return (side + 1) * (side + 1); }
};

inline int add_vectors(draco::Mesh& mesh, draco::GeometryAttribute::Type what, draco::DataType type) {
  draco::GeometryAttribute attribute;
  attribute.Init(what, nullptr, 3, type, type != draco::DT_FLOAT32, 3 * draco::DataTypeLength(type), 0);
  return mesh.AddAttribute(attribute, true, mesh.num_points());
}

// Its positions have Draco's id 0, its normals 1.
inline std::string draco_stream(const DracoGrid& grid) {
  draco::Mesh mesh;
  mesh.set_num_points(grid.vertices());
  const int positions = add_vectors(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32);
  const int normals = add_vectors(mesh, draco::GeometryAttribute::NORMAL, grid.normals);
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const draco::AttributeValueIndex at(i);
    const std::array position{static_cast<float>(i % (grid.side + 1)), static_cast<float>(i / (grid.side + 1)), 0.F};
    mesh.attribute(positions)->SetAttributeValue(at, position.data());
    const std::array up{0.F, 0.F, 1.F};
    const std::array<std::int8_t, 3> up_bytes{0, 0, 127};
    if (grid.normals == draco::DT_FLOAT32) mesh.attribute(normals)->SetAttributeValue(at, up.data());
    if (grid.normals == draco::DT_INT8) mesh.attribute(normals)->SetAttributeValue(at, up_bytes.data());
  }
  for (std::uint32_t y = 0; y < grid.side; ++y) {
    for (std::uint32_t x = 0; x < grid.side; ++x) {
      const draco::PointIndex low(y * (grid.side + 1) + x), high((y + 1) * (grid.side + 1) + x);
      mesh.AddFace({{low, low + 1, high}});
      mesh.AddFace({{low + 1, high + 1, high}});
    }
  }
  if (grid.metadata) {
    auto about = std::make_unique<draco::GeometryMetadata>();
    auto inner = std::make_unique<draco::Metadata>();
    inner->AddEntryString("a", "b");
    about->AddSubMetadata("inner", std::move(inner));
    about->AddEntryInt("number", 7);
    auto of_positions = std::make_unique<draco::AttributeMetadata>();
    of_positions->AddEntryString("name", "place");
    mesh.AddMetadata(std::move(about));
    mesh.AddAttributeMetadata(positions, std::move(of_positions));
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(grid.method);
  if (grid.position_bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, grid.position_bits);
  draco::EncoderBuffer out;
  if (!encoder.EncodeMeshToBuffer(mesh, &out).ok()) return {};
  return {out.data(), out.size()};
}

// A file's description of its compressed mesh; the words are JSON.
struct DracoFile {
  std::string stream;
  std::uint32_t vertices = 9;
  std::uint64_t indices = 24;
  std::string mode = "4";
  std::string view = "0";
  std::string attributes = R"({"POSITION": 0, "NORMAL": 1})";
  std::string normal_component = "5126";
  std::string extension;  // in place of the view and the attributes
};

inline DracoFile draco_file(const DracoGrid& grid) {
  DracoFile file;
  file.stream = draco_stream(grid);
  file.vertices = grid.vertices();
  file.indices = 3 * std::uint64_t{grid.triangles()};
  if (grid.normals == draco::DT_INT8) file.normal_component = "5120";
  return file;
}

inline std::string draco_gltf(const DracoFile& file) {
  const std::string count = std::to_string(file.vertices);
  const std::string extension = file.extension.empty()
                                    ? R"({"bufferView": )" + file.view + R"(, "attributes": )" + file.attributes + "}"
                                    : file.extension;
  const std::string primitive = R"({"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "mode": )" + file.mode +
                                R"(, "extensions": {"KHR_draco_mesh_compression": )" + extension + "}}";
  return R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"], "nodes": [{"mesh": 0}],
  "scenes": [{"nodes": [0]}], "meshes": [{"primitives": [)" +
         primitive + R"(]}],
  "accessors": [{"componentType": 5126, "count": )" +
         count + R"(, "type": "VEC3"}, {"componentType": )" + file.normal_component + R"(, "count": )" + count +
         R"(, "type": "VEC3"}, {"componentType": 5125, "count": )" + std::to_string(file.indices) +
         R"(, "type": "SCALAR"}],
  "bufferViews": [{"buffer": 0, "byteLength": )" +
         std::to_string(file.stream.size()) + R"(}], "buffers": [{"byteLength": )" +
         std::to_string(file.stream.size()) + R"(, "uri": "data:application/octet-stream;base64,)" +
         base64(file.stream) + "\"}]}";
}

}  // namespace ninebit::scene_tests
