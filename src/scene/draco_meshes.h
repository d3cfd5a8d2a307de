// All Draco meshes of a file, decoded in one child process that can do no harm, or in this process.
#pragma once

#include <span>
#include <vector>

#include "ninebit/scene/scene_io.h"
#include "src/scene/draco_decoder.h"

namespace ninebit {

// Decodes one stream that was checked, or reports why not.
using DracoDecode = Result<DracoMesh> (*)(const DracoRequest& request);

// A mesh for each request, in their order: by `decode`, which is decode_draco() but in tests. Reports the first request
// that cannot be decoded, with its name. Where the options ask for isolation, `decode` runs in an isolated call
// (src/system/isolated_call.h) that may open no file; then a decoder that crashed, was over its limits or gave no mesh
// is reported, too. The call has 8 s and 1 GiB; for each byte of the streams 64 bytes and 1 µs more, where bytes that
// several streams share count once; and for each triangle that the requests may have 256 bytes and 1 µs more.
[[nodiscard]] Result<std::vector<DracoMesh>> decode_all(DracoDecode decode, std::span<const DracoRequest> requests,
                                                        const SceneReadOptions& options);

}  // namespace ninebit
