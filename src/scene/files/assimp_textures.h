// The pictures of files that Assimp reads.
#pragma once

#include "src/scene/files/named_files.h"

namespace ninebit {

// Finds the files of the scene's pictures, which have names only. Such files name pictures as they lay on their
// author's disk; a picture that is not at that place is looked for beside the scene's file. Materials lose a picture
// that is at neither place, which is noted.
void find_pictures(const NamedFiles& beside, Scene& scene);

}  // namespace ninebit
