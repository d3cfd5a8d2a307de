// Imports the geometry of a file with Assimp. Only assimp_import.cpp includes Assimp's headers.
#pragma once

#include <filesystem>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "src/scene/files/named_files.h"

namespace ninebit {

struct Imported {
  Scene scene;                     // without cameras and lights; pictures have a name, and no file yet
  glm::dmat4 root_transform{1.0};  // of the root node: importers put their change of axes there
  bool has_viewpoints = false;     // the file has cameras or lights
  bool z_up = false;               // the file declares that z points up: FBX
};

// `content` is read instead of the file, so that the bytes that were checked are the bytes that are read. Diagnostics
// have no file name: the caller adds it.
[[nodiscard]] Result<Imported> import_geometry(const std::filesystem::path& file, std::string_view content);

// The pictures of files that Assimp reads.

// Finds the files of the scene's pictures, which have names only. Such files name pictures as they lay on their
// author's disk; a picture that is not at that place is looked for beside the scene's file. Materials lose a picture
// that is at neither place, which is noted.
void find_pictures(const NamedFiles& beside, Scene& scene);

}  // namespace ninebit
