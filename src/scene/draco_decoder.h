// Meshes that Draco compressed: what is asked of a stream, our own check of it, and its decoding, which is the only
// place that knows Draco.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"

namespace ninebit {

// Three numbers for each vertex, and how the file says that they are stored.
struct DracoAttribute {
  std::uint32_t id = 0;         // Draco's unique id of it
  std::uint64_t component = 0;  // the glTF number of its type: 5126, 5122 or 5120
};

// A triangle mesh that is to be decoded.
struct DracoRequest {
  std::string_view stream;
  std::optional<DracoAttribute> positions;
  std::optional<DracoAttribute> normals;
  std::uint64_t most_triangles = 0;  // what the file declares of them
  std::string name;                  // for messages
};

// The arrays as an accessor of packed elements would have them. Those that nobody asked for are empty.
struct DracoMesh {
  std::string indices;  // three of 32 bits for each triangle
  std::string positions;
  std::string normals;
};

// Nothing if the stream begins as a mesh of version 2.2 with at most so many triangles, and at most three vertices for
// each; otherwise why not. Takes no memory.
[[nodiscard]] std::optional<std::string> check_draco(std::string_view stream, std::uint64_t most_triangles);

// Only after check_draco(). Diagnostics come without the request's name. May crash, as foreign code does.
[[nodiscard]] Result<DracoMesh> decode_draco(const DracoRequest& request);

// Whether a mesh has what was asked for and no more, with all indices in range. Nobody has to believe a decoder.
[[nodiscard]] bool fits(const DracoMesh& mesh, const DracoRequest& request);

}  // namespace ninebit
