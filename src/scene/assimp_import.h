// The geometry of a file by way of Assimp, the only place that knows it.
#pragma once

#include <filesystem>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

struct Imported {
  Scene scene;                     // without cameras and lights
  glm::dmat4 root_transform{1.0};  // of the root node: importers put their change of axes there
};

// content stands for the file itself, so that what was checked is what is read. Diagnostics come without a file name:
// the caller adds it.
[[nodiscard]] Result<Imported> import_geometry(const std::filesystem::path& file, std::string_view content);

}  // namespace ninebit
