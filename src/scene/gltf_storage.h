// The buffers of a glTF file, and the numbers that its accessors give.
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
#include "src/scene/json_value.h"
#include "src/scene/named_files.h"

namespace ninebit {

// The parts of a .glb file: a header of 12 bytes, then chunks, each with its length and type before it.
struct GlbParts {
  std::string_view json;
  std::optional<std::string_view> binary;
};

[[nodiscard]] Result<GlbParts> split_glb(std::string_view content);

// The bytes of a base64 text with its padding; nothing if it is not one.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

// A URI with each %XX as the byte that it stands for.
[[nodiscard]] std::string decode_percent(std::string_view uri);

// The bytes of one number of an accessor's type, given by its glTF number; 0 for an unknown one.
[[nodiscard]] std::uint64_t gltf_component_size(std::uint64_t type);

// The elements of an accessor. All of them lie within the data.
struct GltfNumbers {
  std::string_view data;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::uint64_t component = 0;  // the glTF number of its type

  [[nodiscard]] std::uint32_t index(std::uint64_t at) const;  // of a SCALAR of unsigned whole numbers
  [[nodiscard]] glm::vec3 vector(std::uint64_t at) const;     // of a VEC3; signed whole numbers are normalized
};

// What is wrong with an accessor whose elements are to be of this type, with one of these types of numbers.
[[nodiscard]] std::optional<std::string> fault_of_use(const Json& accessor, const char* type,
                                                      std::initializer_list<std::uint64_t> components);

class GltfStorage {
 public:
  // `chunk`: the binary part of a .glb file.
  GltfStorage(const Json& root, const NamedFiles& beside, std::optional<std::string_view> chunk);

  // Checks every buffer, buffer view and accessor of the file against what is there, without reading buffers.
  [[nodiscard]] std::optional<Diagnostic> check();

  // What an accessor gives. Reads its buffer if nobody did yet. Only after check().
  [[nodiscard]] Result<GltfNumbers> numbers(const Json& accessor);

  // The bytes of a buffer view. Reads its buffer if nobody did yet. Only after check().
  [[nodiscard]] Result<std::string_view> view_bytes(const Json& view);

  // The lengths of all buffers together.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] std::optional<Diagnostic> check_buffer(const Json& buffer, std::size_t number);
  [[nodiscard]] Result<std::uint64_t> present_bytes(const Json& buffer, std::size_t number) const;
  [[nodiscard]] Result<std::string_view> load(std::size_t number);

  const Json& root_;
  const NamedFiles& beside_;
  std::optional<std::string_view> chunk_;
  std::uint64_t bytes_ = 0;
  std::uint64_t left_;                                            // bytes of files that may still be read
  std::vector<std::optional<std::string_view>> loaded_;           // of each buffer
  std::map<std::filesystem::path, std::string_view> from_files_;  // several buffers may be one file
  std::deque<std::string> contents_;
};

}  // namespace ninebit
