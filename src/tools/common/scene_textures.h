// The pictures that a scene's materials name, and what a rendering of the scene leaves out.
#pragma once

#include <string>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/shadow/settings.h"

namespace ninebit::tools {

// Reads the textures of the materials that triangles use, each picture once; none with settings.cartoon and without
// texture coordinates. Reports, naming the scene's file and the picture, one that is missing, damaged, outside of the
// scene's folder (unless the scene was read with allow_outside) or beyond the limits. Notes pictures that were resampled.
[[nodiscard]] Status read_textures(const std::string& scene_file, const RenderSettings& settings, Scene& scene);

// What a rendering of this scene leaves out, one entry each kind: the scene's notes, and what the technique does not
// draw. Empty: nothing.
[[nodiscard]] std::vector<std::string> ignored_parts(const Scene& scene, const std::string& technique,
                                                     const RenderSettings& settings);

// One warning that names what is ignored; prints nothing if that is empty or `quiet`.
void warn_of_ignored(const std::string& scene_file, const std::vector<std::string>& ignored, bool quiet);

}  // namespace ninebit::tools
