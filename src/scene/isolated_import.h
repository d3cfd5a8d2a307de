// The geometry of a file by way of Assimp, in a child process that can do no harm.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "src/scene/assimp_import.h"

namespace ninebit {

// Imports a file, or reports why not.
using GeometryImport = Result<Imported> (*)(const std::filesystem::path& file, std::string_view content);

// `import`, which is import_geometry() but in tests, in an isolated call (src/system/isolated_call.h) that may open no
// file. Reports what it reports, and an importer that crashed, was over its limits or gave a senseless scene. It has 8
// s and 1 GiB, and for each byte of the content 64 bytes and 1 µs more. `go_on`: as in SceneReadOptions.
[[nodiscard]] Result<Imported> import_isolated(GeometryImport import, const std::filesystem::path& file,
                                               std::string_view content, const std::function<bool()>& go_on);

}  // namespace ninebit
