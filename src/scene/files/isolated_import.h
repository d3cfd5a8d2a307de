// Imports the geometry of a file with Assimp, in an isolated child process.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "src/scene/files/assimp_import.h"

namespace ninebit {

// Imports a file, or reports why it cannot.
using GeometryImport = Result<Imported> (*)(const std::filesystem::path& file, std::string_view content);

// Runs `import` (import_geometry(), except in tests) in an isolated call (src/system/isolated_call.h) that may open no
// file. Reports the import's faults, and an importer that crashes, exceeds its limits or returns an invalid scene. The
// limits are 8 s and 1 GiB, and for each byte of the content 64 bytes and 1 µs more. `go_on`: as in SceneReadOptions.
[[nodiscard]] Result<Imported> import_isolated(GeometryImport import, const std::filesystem::path& file,
                                               std::string_view content, const std::function<bool()>& go_on);

}  // namespace ninebit
