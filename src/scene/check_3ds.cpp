#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "src/scene/fault_of.h"
#include "src/scene/file_check.h"

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
  kLight = 0x4600,
  kSpotLight = 0x4610,
  kLightOff = 0x4620,
  kCamera = 0x4700,
  kMain = 0x4D4D,
  kKeyframes = 0xB000,
  kFirstTrack = 0xB020,  // of position; then rotation, scale, angle and roll
  kLastTrack = 0xB024
};

std::uint32_t little(std::string_view data, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(data[at + i]);
  return value;
}

float real(std::string_view data, std::size_t at) {
  return std::bit_cast<float>(little(data, at, 4));
}

glm::vec3 point(std::string_view data, std::size_t at) {
  return {real(data, at), real(data, at + 4), real(data, at + 8)};
}

struct Chunk {
  std::uint32_t id = 0;
  std::string_view body;
};

// Takes the next chunk off data; nothing at its end or where a chunk is longer than what holds it.
std::optional<Chunk> next_chunk(std::string_view& data, bool& broken) {
  if (data.size() < 6) {
    broken = broken || !data.empty();
    return std::nullopt;
  }
  const std::uint32_t length = little(data, 2, 4);
  if (length < 6 || length > data.size()) {
    broken = true;
    return std::nullopt;
  }
  const Chunk chunk{little(data, 0, 2), data.substr(6, length - 6)};
  data.remove_prefix(length);
  return chunk;
}

constexpr const char* kBrokenChunk = "is malformed: a chunk is longer than what holds it";
constexpr const char* kShortChunk = "is malformed: a chunk is shorter than its content";

std::optional<Diagnostic> check_mesh(std::string_view data, const std::string& name, FileFacts& facts) {
  std::uint32_t vertices = 0;
  std::uint32_t highest = 0;
  std::uint32_t faces = 0;
  bool broken = false;
  while (const std::optional<Chunk> chunk = next_chunk(data, broken)) {
    if (chunk->id != kVertices && chunk->id != kFaces) continue;
    if (chunk->body.size() < 2) return fault_of(kShortChunk);
    const std::uint32_t count = little(chunk->body, 0, 2);
    const std::size_t row = chunk->id == kVertices ? 12 : 8;
    if (chunk->body.size() < 2 + count * row) return fault_of(kShortChunk);
    if (chunk->id == kVertices) {
      vertices = count;
      continue;
    }
    faces = count;
    for (std::uint32_t face = 0; face < count; ++face) {
      for (std::size_t corner = 0; corner < 3; ++corner)
        highest = std::max(highest, little(chunk->body, 2 + face * row + corner * 2, 2));
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  if (faces > 0 && highest >= vertices)
    return fault_of(fmt::format("vertex index {} of object '{}' is out of range: it has {}, counted from 0", highest,
                                name, vertices));
  *facts.triangles += faces;
  return std::nullopt;
}

std::optional<Diagnostic> read_light(std::string_view data, const std::string& name, FileFacts& facts) {
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
        light.color[i] = static_cast<float>(little(chunk->body, static_cast<std::size_t>(i), 1)) / 255.0F;
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  if (shines_everywhere) facts.lights.push_back(light);
  return std::nullopt;
}

std::optional<Diagnostic> read_camera(std::string_view data, FileFacts& facts) {
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
  facts.cameras.push_back(camera);
  return std::nullopt;
}

std::optional<Diagnostic> check_object(std::string_view data, FileFacts& facts) {
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

// Assimp makes room for as many keys as a track declares before it reads them.
std::optional<Diagnostic> check_keyframes(std::string_view data) {
  constexpr std::size_t kHead = 14;
  constexpr std::size_t kSmallestKey = 10;
  bool broken = false;
  while (const std::optional<Chunk> node = next_chunk(data, broken)) {
    std::string_view tracks = node->body;
    // What is no list of chunks holds no track: such data ends this walk, not the reading.
    bool other = false;
    while (const std::optional<Chunk> track = next_chunk(tracks, other)) {
      if (track->id < kFirstTrack || track->id > kLastTrack) continue;
      if (track->body.size() < kHead) return fault_of(kShortChunk);
      if (little(track->body, kHead - 4, 4) > (track->body.size() - kHead) / kSmallestKey) return fault_of(kShortChunk);
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  return std::nullopt;
}

}  // namespace

Result<FileFacts> check_3ds(std::string_view content) {
  if (content.size() < 6 || little(content, 0, 2) != kMain)
    return fault_of("is not a 3DS file: it does not start with the main chunk");
  if (little(content, 2, 4) > content.size())
    return fault_of(fmt::format("ends early: it declares {} bytes and has {}", little(content, 2, 4), content.size()));
  FileFacts facts;
  facts.triangles = 0;
  facts.at_least = true;
  facts.in_root_space = true;
  bool broken = false;
  std::string_view main = next_chunk(content, broken).value_or(Chunk{}).body;
  while (const std::optional<Chunk> section = next_chunk(main, broken)) {
    if (section->id == kKeyframes) {
      if (auto fault = check_keyframes(section->body)) return *fault;
    }
    if (section->id != kEditor) continue;
    std::string_view editor = section->body;
    while (const std::optional<Chunk> chunk = next_chunk(editor, broken)) {
      if (chunk->id != kObject) continue;
      if (auto fault = check_object(chunk->body, facts)) return *fault;
    }
  }
  if (broken) return fault_of(kBrokenChunk);
  return facts;
}

}  // namespace ninebit
