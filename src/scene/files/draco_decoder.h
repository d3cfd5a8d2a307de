// Draco-compressed meshes: the request for a stream, a check of the stream without Draco, and its decoding. Only
// draco_decoder.cpp includes Draco's headers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"

namespace ninebit {

// An attribute with three numbers per vertex, and their type in the file.
struct DracoAttribute {
  std::uint32_t id = 0;         // Draco's unique id of the attribute
  std::uint64_t component = 0;  // the glTF number of its type: 5126, 5122 or 5120
};

// A triangle mesh that is to be decoded.
struct DracoRequest {
  std::string_view stream;
  std::optional<DracoAttribute> positions;
  std::optional<DracoAttribute> normals;
  std::uint64_t most_triangles = 0;  // the triangles that the file declares
  std::string name;                  // for messages
};

// The arrays in the layout of an accessor with packed elements. Attributes that were not requested are empty.
struct DracoMesh {
  std::string indices;  // three of 32 bits for each triangle
  std::string positions;
  std::string normals;
};

// Returns nothing if the stream starts as a mesh of version 2.2 with at most `most_triangles` triangles and at most
// three vertices per triangle; otherwise the fault. Allocates no memory for the mesh.
[[nodiscard]] std::optional<std::string> check_draco(std::string_view stream, std::uint64_t most_triangles);

// Only after check_draco(). Diagnostics do not contain the request's name. May crash, since Draco is foreign code.
[[nodiscard]] Result<DracoMesh> decode_draco(const DracoRequest& request);

// Whether a mesh has exactly the requested arrays, with all indices in range. A decoder's output is not trusted.
[[nodiscard]] bool fits(const DracoMesh& mesh, const DracoRequest& request);

}  // namespace ninebit
