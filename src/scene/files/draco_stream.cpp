// Checks of a Draco stream and of a decoded mesh that do not use Draco.
#include <fmt/format.h>

#include <cstring>

#include "src/scene/files/draco_meshes.h"
#include "src/scene/files/gltf_storage.h"

namespace ninebit {
namespace {

constexpr std::uint64_t kHeaderBytes = 11;
constexpr int kDeepestMetadata = 32;

// Reads the parts of a stream in order. Past its end it returns zeros, and whole() is false.
class DracoScan {
 public:
  explicit DracoScan(std::string_view rest) : rest_(rest) {}

  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] bool too_deep() const { return too_deep_; }

  void skip(std::uint64_t bytes) {
    if (bytes > rest_.size()) whole_ = false;
    rest_.remove_prefix(whole_ ? bytes : rest_.size());
  }

  std::uint64_t byte() {
    const std::uint64_t value = rest_.empty() ? 0 : static_cast<unsigned char>(rest_.front());
    skip(1);
    return value;
  }

  // Seven bits per byte, the lowest first; the last byte has its highest bit clear.
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint64_t next = byte();
      value |= (next & 127U) << shift;
      if (next < 128) return value;
    }
    whole_ = false;
    return 0;
  }

  // Skips the metadata of all attributes, then of the mesh.
  void skip_all_metadata() {
    for (std::uint64_t left = number(); left > 0 && whole_; --left) {
      number();
      skip_metadata(0);
    }
    skip_metadata(0);
  }

 private:
  // Skips names with values, then names with metadata of their own.
  void skip_metadata(int depth) {
    too_deep_ = too_deep_ || depth > kDeepestMetadata;
    if (too_deep_) whole_ = false;
    for (std::uint64_t left = number(); left > 0 && whole_; --left) {
      skip(byte());
      skip(number());
    }
    for (std::uint64_t left = number(); left > 0 && whole_; --left) {
      skip(byte());
      skip_metadata(depth + 1);
    }
  }

  std::string_view rest_;
  bool whole_ = true;
  bool too_deep_ = false;
};

bool has_elements(const std::string& data, std::uint64_t count, const std::optional<DracoAttribute>& attribute) {
  const std::uint64_t bytes = attribute ? 3 * gltf_component_size(attribute->component) : 0;
  return data.size() == count * bytes;
}

}  // namespace

std::optional<std::string> check_draco(std::string_view stream, std::uint64_t most_triangles) {
  if (!stream.starts_with("DRACO")) return "is malformed: its compressed data does not start with 'DRACO'";
  if (stream.size() < kHeaderBytes) return "is malformed: its compressed data ends early";
  DracoScan scan(stream.substr(5));
  const std::uint64_t major = scan.byte();
  const std::uint64_t minor = scan.byte();
  if (major != 2 || minor != 2)
    return fmt::format("has compressed data of Draco version {}.{}; version 2.2 is read", major, minor);
  if (scan.byte() != 1) return "is malformed: its compressed data is not a triangle mesh";
  const std::uint64_t method = scan.byte();
  if (method > 1) return fmt::format("has compressed data of the unknown method {}", method);
  scan.skip(1);
  if ((scan.byte() & 128U) != 0) scan.skip_all_metadata();
  // Method 0 has triangles before vertices; method 1 has a byte for its kind, and vertices before triangles.
  if (method == 1) scan.skip(1);
  const std::uint64_t first = scan.number();
  const std::uint64_t second = scan.number();
  if (scan.too_deep()) return "is malformed: the metadata of its compressed data nests too deep";
  if (!scan.whole()) return "is malformed: its compressed data ends early";
  const std::uint64_t triangles = method == 1 ? second : first;
  const std::uint64_t vertices = method == 1 ? first : second;
  if (triangles > most_triangles)
    return fmt::format("has compressed data of {} triangles; expected at most the {} that its accessors declare",
                       triangles, most_triangles);
  if (vertices > 3 * triangles)
    return fmt::format("has compressed data of {} vertices for {} triangles; expected at most three for each", vertices,
                       triangles);
  return std::nullopt;
}

bool fits(const DracoMesh& mesh, const DracoRequest& request) {
  const std::uint64_t triangles = mesh.indices.size() / 12;
  if (mesh.indices.size() % 12 != 0 || triangles > request.most_triangles) return false;
  std::uint64_t vertices = 3 * triangles;
  if (request.positions) {
    vertices = mesh.positions.size() / 12;
  } else if (request.normals) {
    vertices = mesh.normals.size() / (3 * gltf_component_size(request.normals->component));
  }
  if (vertices > 3 * triangles) return false;
  if (!has_elements(mesh.positions, vertices, request.positions)) return false;
  if (!has_elements(mesh.normals, vertices, request.normals)) return false;
  if (!request.positions && !request.normals) return true;
  for (std::size_t at = 0; at < mesh.indices.size(); at += 4) {
    std::uint32_t index = 0;
    std::memcpy(&index, mesh.indices.data() + at, 4);
    if (index >= vertices) return false;
  }
  return true;
}

}  // namespace ninebit
