// Decodes all Draco meshes of a file, in one isolated child process or in this process.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene_io.h"

namespace ninebit {

// Draco-compressed meshes: the request for a stream, a check of the stream without Draco, and its decoding. Only
// draco_meshes.cpp includes Draco's headers.

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

// Decodes one checked stream, or reports why it cannot.
using DracoDecode = Result<DracoMesh> (*)(const DracoRequest& request);

// Returns a mesh for each request, in their order, made by `decode`: decode_draco(), except in tests. Reports the first
// request that cannot be decoded, with its name. With options.isolated, `decode` runs in an isolated call
// (src/system/isolated_call.h) that may open no file; a decoder that crashes, exceeds its limits or returns no valid
// mesh is reported, too. The call has 8 s and 1 GiB; for each byte of the streams 64 bytes and 1 µs more, where bytes
// that several streams share count once; and for each triangle that the requests may have 256 bytes and 1 µs more.
[[nodiscard]] Result<std::vector<DracoMesh>> decode_all(DracoDecode decode, std::span<const DracoRequest> requests,
                                                        const SceneReadOptions& options);

}  // namespace ninebit
