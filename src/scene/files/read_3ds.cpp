#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "src/scene/files/assimp_import.h"
#include "src/scene/files/isolated_import.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/files/text_scan.h"
#include "src/scene/framing.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

enum ChunkId : std::uint32_t {
  kColorFloat = 0x0010,
  kColorBytes = 0x0011,
  kLinearColorBytes = 0x0012,
  kLinearColorFloat = 0x0013,
  kEditor = 0x3D3D,
  kObject = 0x4000,
  kMesh = 0x4100,
  kVertices = 0x4110,
  kFaces = 0x4120,
  kFaceMaterial = 0x4130,
  kLight = 0x4600,
  kSpotLight = 0x4610,
  kLightOff = 0x4620,
  kCamera = 0x4700,
  kMain = 0x4D4D,
  kMaterial = 0xAFFF,
  kKeyframes = 0xB000,
  kNodeName = 0xB010,
  kDummyName = 0xB011,
  kPivot = 0xB013,
  kFirstTrack = 0xB020,  // of position; then rotation, scale, angle and roll
  kLastTrack = 0xB024
};

float real(std::string_view data, std::size_t at) {
  return std::bit_cast<float>(little_endian(data, at, 4));
}

glm::vec3 point(std::string_view data, std::size_t at) {
  return {real(data, at), real(data, at + 4), real(data, at + 8)};
}

// The contents that a file declares.
struct ThreeDsFacts {
  std::uint64_t triangles = 0;
  std::uint64_t meshes = 0;
  std::uint64_t materials = 0;
  std::uint64_t material_lists = 0;                             // lists of faces with a material
  std::unordered_map<std::string, std::uint64_t> triangles_of;  // of all meshes of a name
  std::uint64_t nodes = 0;
  std::uint64_t placed = 0;  // triangles, by nodes
  Viewpoints viewpoints;
};

// Assimp compares each node with all nodes before it and with each piece of a mesh, searches all materials for each
// list of faces and each mesh, and visits nodes recursively.
constexpr std::uint64_t kMostNodes = 4096;
constexpr std::uint64_t kMostComparisons = std::uint64_t{1} << 26U;

struct Chunk {
  std::uint32_t id = 0;
  std::string_view body;
};

// Takes the next chunk off data; nothing at its end, or if a chunk is longer than its parent.
std::optional<Chunk> next_chunk(std::string_view& data, bool& broken) {
  if (data.size() < 6) {
    broken = broken || !data.empty();
    return std::nullopt;
  }
  const std::uint32_t length = little_endian(data, 2, 4);
  if (length < 6 || length > data.size()) {
    broken = true;
    return std::nullopt;
  }
  const Chunk chunk{little_endian(data, 0, 2), data.substr(6, length - 6)};
  data.remove_prefix(length);
  return chunk;
}

constexpr const char* kBrokenChunk = "is malformed: a chunk is longer than its parent";
constexpr const char* kShortChunk = "is malformed: a chunk is shorter than its content";

std::optional<Diagnostic> check_mesh(std::string_view data, const std::string& name, ThreeDsFacts& facts) {
  std::uint32_t vertices = 0;
  std::uint32_t highest = 0;
  std::uint32_t faces = 0;
  bool broken = false;
  while (const std::optional<Chunk> chunk = next_chunk(data, broken)) {
    if (chunk->id != kVertices && chunk->id != kFaces) continue;
    if (chunk->body.size() < 2) return fault_of(kShortChunk);
    const std::uint32_t count = little_endian(chunk->body, 0, 2);
    const std::size_t row = chunk->id == kVertices ? 12 : 8;
    if (chunk->body.size() < 2 + count * row) return fault_of(kShortChunk);
    if (chunk->id == kVertices) {
      vertices = count;
      continue;
    }
    faces = count;
    std::string_view lists = chunk->body.substr(2 + count * row);
    while (const std::optional<Chunk> list = next_chunk(lists, broken))
      facts.material_lists += list->id == kFaceMaterial;
    for (std::uint32_t face = 0; face < count; ++face) {
      for (std::size_t corner = 0; corner < 3; ++corner)
        highest = std::max(highest, little_endian(chunk->body, 2 + face * row + corner * 2, 2));
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  if (faces > 0 && highest >= vertices)
    return fault_of(fmt::format("vertex index {} of object '{}' is out of range: it has {}, counted from 0", highest,
                                name, vertices));
  facts.triangles += faces;
  ++facts.meshes;
  facts.triangles_of[name] += faces;
  return std::nullopt;
}

std::optional<Diagnostic> read_light(std::string_view data, const std::string& name, ThreeDsFacts& facts) {
  if (data.size() < 12) return fault_of(kShortChunk);
  Light light{.name = name, .position = point(data, 0)};
  data.remove_prefix(12);
  bool broken = false;
  bool shines_everywhere = true;
  while (const std::optional<Chunk> chunk = next_chunk(data, broken)) {
    const bool floats = chunk->id == kColorFloat || chunk->id == kLinearColorFloat;
    const bool bytes = chunk->id == kColorBytes || chunk->id == kLinearColorBytes;
    if (chunk->id == kSpotLight || chunk->id == kLightOff) shines_everywhere = false;
    if (floats && chunk->body.size() >= 12) light.color = point(chunk->body, 0);
    if (bytes && chunk->body.size() >= 3) {
      for (glm::length_t i = 0; i < 3; ++i)
        light.color[i] = static_cast<float>(little_endian(chunk->body, static_cast<std::size_t>(i), 1)) / 255.0F;
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  if (shines_everywhere) facts.viewpoints.lights.push_back(light);
  return std::nullopt;
}

std::optional<Diagnostic> read_camera(std::string_view data, ThreeDsFacts& facts) {
  if (data.size() < 32) return fault_of(kShortChunk);
  Camera camera;
  camera.position = point(data, 0);
  camera.look_at = point(data, 12);
  camera.up = {0.0F, 0.0F, 1.0F};
  const float bank = real(data, 24);
  // The file gives a focal length in millimetres for which the horizontal angle in degrees is 2400 / length, as seen on
  // the format's 4:3 screen; 3D Studio's own 45 degrees are stored as 53.33.
  const double horizontal = 2400.0 / static_cast<double>(real(data, 28));
  if (horizontal > 0.0 && horizontal < 179.0) {
    const double half = horizontal * 0.5 * std::numbers::pi / 180.0;
    camera.vertical_fov_degrees = static_cast<float>(2.0 * std::atan(std::tan(half) * 0.75) * 180.0 / std::numbers::pi);
  }
  const glm::vec3 ahead = camera.look_at - camera.position;
  const float side_length = glm::length(glm::cross(ahead, camera.up));
  if (std::isfinite(bank) && side_length > 1e-6F * glm::length(ahead)) {
    const glm::vec3 side = glm::cross(ahead, camera.up) / side_length;
    const glm::vec3 upright = glm::normalize(glm::cross(side, ahead));
    const float angle = glm::radians(bank);
    camera.up = upright * std::cos(angle) + side * std::sin(angle);
  }
  facts.viewpoints.cameras.push_back(camera);
  return std::nullopt;
}

std::optional<Diagnostic> check_object(std::string_view data, ThreeDsFacts& facts) {
  const std::size_t end = data.find('\0');
  if (end == std::string_view::npos) return fault_of("is malformed: an object's name does not end");
  const std::string name(data.substr(0, end));
  data.remove_prefix(end + 1);
  bool broken = false;
  while (const std::optional<Chunk> chunk = next_chunk(data, broken)) {
    std::optional<Diagnostic> fault;
    if (chunk->id == kMesh) fault = check_mesh(chunk->body, name, facts);
    if (chunk->id == kLight) fault = read_light(chunk->body, name, facts);
    if (chunk->id == kCamera) fault = read_camera(chunk->body, facts);
    if (fault) return fault;
  }
  if (broken) return fault_of(kBrokenChunk);
  return std::nullopt;
}

// Assimp allocates the declared number of keys before it reads them.
std::optional<Diagnostic> check_track(std::string_view data) {
  constexpr std::size_t kHead = 14;
  constexpr std::size_t kSmallestKey = 10;
  if (data.size() < kHead || little_endian(data, kHead - 4, 4) > (data.size() - kHead) / kSmallestKey)
    return fault_of(kShortChunk);
  return std::nullopt;
}

// A node places all meshes of its name.
std::optional<Diagnostic> add_node(std::string_view data, ThreeDsFacts& facts) {
  const std::size_t end = data.find('\0');
  if (end == std::string_view::npos) return fault_of("is malformed: a node's name does not end");
  const auto meshes = facts.triangles_of.find(std::string(data.substr(0, end)));
  if (meshes != facts.triangles_of.end()) facts.placed += meshes->second;
  if (++facts.nodes > kMostNodes) return fault_of(fmt::format("has more than {} nodes", kMostNodes));
  return std::nullopt;
}

std::optional<Diagnostic> check_keyframes(std::string_view data, ThreeDsFacts& facts) {
  bool broken = false;
  while (const std::optional<Chunk> node = next_chunk(data, broken)) {
    std::string_view tracks = node->body;
    // Data that is not a list of chunks contains no track: it ends this loop without a fault.
    bool other = false;
    while (const std::optional<Chunk> track = next_chunk(tracks, other)) {
      std::optional<Diagnostic> fault;
      const bool has_keys = track->id >= kFirstTrack && track->id <= kLastTrack;
      if (track->id == kNodeName || track->id == kDummyName) fault = add_node(track->body, facts);
      if (has_keys) fault = check_track(track->body);
      if (fault) return fault;
      if (facts.nodes == 0 && (has_keys || track->id == kPivot))
        return fault_of("is malformed: keys come before the name of their node");
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  return std::nullopt;
}

std::optional<Diagnostic> check_editor(std::string_view data, ThreeDsFacts& facts) {
  bool broken = false;
  while (const std::optional<Chunk> chunk = next_chunk(data, broken)) {
    facts.materials += chunk->id == kMaterial;
    if (chunk->id != kObject) continue;
    if (auto fault = check_object(chunk->body, facts)) return fault;
  }
  if (broken) return fault_of(kBrokenChunk);
  return std::nullopt;
}

// Reports amounts for which Assimp would take time quadratic in the file's size.
std::optional<Diagnostic> check_amounts(const ThreeDsFacts& facts, std::uint64_t bytes) {
  const std::uint64_t most = std::min(kMostTriangles, bytes + kMostPlacedAgain);
  if (facts.triangles > most || facts.placed > most)
    return fault_of(fmt::format("its nodes place more than {} triangles", most));
  const std::uint64_t pieces = std::min(facts.triangles, facts.meshes * (facts.materials + 1)) + facts.meshes;
  if (facts.nodes * pieces > kMostComparisons ||
      (facts.meshes + facts.material_lists) * facts.materials > kMostComparisons)
    return fault_of(fmt::format("has too many parts: {} nodes, {} meshes and {} materials with {} lists of faces",
                                facts.nodes, facts.meshes, facts.materials, facts.material_lists));
  return std::nullopt;
}

Result<ThreeDsFacts> check_3ds(std::string_view content) {
  if (content.size() < 6 || little_endian(content, 0, 2) != kMain)
    return fault_of("is not a 3DS file: it does not start with the main chunk");
  if (little_endian(content, 2, 4) > content.size())
    return fault_of(
        fmt::format("ends early: it declares {} bytes and has {}", little_endian(content, 2, 4), content.size()));
  ThreeDsFacts facts;
  bool broken = false;
  const std::string_view main = next_chunk(content, broken).value_or(Chunk{}).body;
  // Nodes refer to meshes and may come before them.
  for (const ChunkId wanted : {kEditor, kKeyframes}) {
    std::string_view sections = main;
    while (const std::optional<Chunk> section = next_chunk(sections, broken)) {
      if (section->id != wanted) continue;
      auto fault = wanted == kEditor ? check_editor(section->body, facts) : check_keyframes(section->body, facts);
      if (fault) return *std::move(fault);
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  if (auto fault = check_amounts(facts, content.size())) return *std::move(fault);
  return facts;
}

}  // namespace

Result<Scene> read_3ds(const SceneFile& from, std::string_view content, const SceneReadOptions& options) {
  const Result<ThreeDsFacts> facts = check_3ds(content);
  if (!facts) return facts.error();
  if (facts->triangles == 0) return fault_of("has no triangles");
  Result<Imported> imported = options.isolated ? import_isolated(&import_geometry, from.file, content, options.go_on)
                                               : import_geometry(from.file, content);
  if (!imported) return imported.error();
  Scene& scene = imported->scene;
  if (scene.triangles.size() < facts->triangles)
    return fault_of(
        fmt::format("is malformed: it declares {} triangles, but {} could be read; an index out of range or missing "
                    "data is the usual cause",
                    facts->triangles, scene.triangles.size()));
  find_pictures(from.beside, scene);
  scene.up = UpAxis::z;
  // Assimp stores its change of axes in the root node.
  if (auto fault = add_viewpoints(facts->viewpoints, imported->root_transform, scene)) return *std::move(fault);
  return std::move(scene);
}

}  // namespace ninebit
