// The geometry of a file by way of Assimp, the only place that knows it.
#pragma once

#include <filesystem>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

struct Imported {
  Scene scene;                     // without cameras and lights
  glm::dmat4 root_transform{1.0};  // of the root node: importers put their change of axes there
};

// Diagnostics come without a file name: the caller adds it.
[[nodiscard]] Result<Imported> import_geometry(const std::filesystem::path& file);

}  // namespace ninebit
