// Decodes all Draco meshes of a file, in one isolated child process or in this process.
#pragma once

#include <span>
#include <vector>

#include "ninebit/scene/scene_io.h"
#include "src/scene/files/draco_decoder.h"

namespace ninebit {

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
