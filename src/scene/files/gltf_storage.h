// The buffers of a glTF file, and the numbers of its accessors.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/named_files.h"

namespace ninebit {

// The parts of a .glb file: a header of 12 bytes, then chunks, each with its length and type before it. In version 1
// the header has the length and format of the JSON text, and the binary part is the rest.
struct GlbParts {
  std::string_view json;
  std::optional<std::string_view> binary;
};

[[nodiscard]] Result<GlbParts> split_glb(std::string_view content);

// The bytes of a base64 text with padding; nothing if it is not valid base64.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

// A URI with each %XX replaced by its byte.
[[nodiscard]] std::string decode_percent(std::string_view uri);

// The size in bytes of a component type, given by its glTF number; 0 if it is unknown.
[[nodiscard]] std::uint64_t gltf_component_size(std::uint64_t type);

// The elements of an accessor. All of them lie within the data.
struct GltfNumbers {
  std::string_view data;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::uint64_t component = 0;  // the glTF number of its type

  [[nodiscard]] std::uint32_t index(std::uint64_t at) const;  // of a SCALAR of unsigned integers
  // The first N components of a VEC2, VEC3 or VEC4; integers are normalized.
  template <glm::length_t N>
  [[nodiscard]] glm::vec<N, float> vector(std::uint64_t at) const {
    glm::vec<N, float> out;
    for (glm::length_t i = 0; i < N; ++i) out[i] = component_at(at, static_cast<std::uint64_t>(i));
    return out;
  }

 private:
  [[nodiscard]] float component_at(std::uint64_t at, std::uint64_t i) const;
};

// The fault of an accessor that must have this element type and one of these component types; nothing if it fits.
[[nodiscard]] std::optional<std::string> fault_of_use(const JsonValue& accessor, const char* type,
                                                      std::initializer_list<std::uint64_t> components);

class GltfStorage {
 public:
  // `chunk`: the binary part of a .glb file.
  GltfStorage(const JsonValue& root, const NamedFiles& beside, std::optional<std::string_view> chunk);

  // Checks every buffer, buffer view and accessor of the file against the existing bytes, without reading buffers.
  [[nodiscard]] std::optional<Diagnostic> check();

  // An accessor's elements. Reads its buffer if it is not loaded yet. Only after check().
  [[nodiscard]] Result<GltfNumbers> numbers(const JsonValue& accessor);

  // The bytes of a buffer view. Reads its buffer if it is not loaded yet. Only after check().
  [[nodiscard]] Result<std::string_view> view_bytes(const JsonValue& view);

  // Sets the file of a picture with this name, or the fault of a name that may not be read.
  void name_file(const std::string& name, SceneTexture& out) const { name_picture(beside_, name, out); }

  // The total length of all buffers.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] std::optional<Diagnostic> check_buffer(const JsonValue& buffer, std::size_t number);
  [[nodiscard]] Result<std::uint64_t> present_bytes(const JsonValue& buffer, std::size_t number) const;
  [[nodiscard]] Result<std::string_view> load(std::size_t number);

  const JsonValue& root_;
  const NamedFiles& beside_;
  std::optional<std::string_view> chunk_;
  std::uint64_t bytes_ = 0;
  std::uint64_t left_;                                            // bytes of files that may still be read
  std::vector<std::optional<std::string_view>> loaded_;           // one per buffer
  std::map<std::filesystem::path, std::string_view> from_files_;  // several buffers may be one file
  std::deque<std::string> contents_;
};

}  // namespace ninebit
