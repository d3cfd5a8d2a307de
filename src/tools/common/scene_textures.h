// The pictures that a scene's materials name, and what a rendering of the scene leaves out.
#pragma once

#include <string>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/scene/scene.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// A scene that is ready to be drawn.
struct DrawnScene {
  Scene scene;
  std::vector<std::string> ignored{};  // what a rendering leaves out, one entry each kind
};

// load_scene, with the textures of the materials that triangles use, each picture once; none with settings.cartoon and
// without texture coordinates. Unless quiet, prints one warning that names what is ignored. Reports also, naming the
// scene's file and the picture, one that is missing, damaged, outside of the scene's folder (unless --allow-outside is
// given) or beyond the limits.
[[nodiscard]] Result<DrawnScene> load_drawn_scene(const SceneFlags& flags, const RenderSettings& settings, bool quiet);

// Parts of the scene's materials that a technique ignores, one entry each kind.
[[nodiscard]] std::vector<std::string> ignored_materials(const Scene& scene, const std::string& technique,
                                                         const RenderSettings& settings);

// One warning that names what is ignored; prints nothing if that is empty or `quiet`.
void warn_of_ignored(const std::string& scene_file, const std::vector<std::string>& ignored, bool quiet);

}  // namespace ninebit::tools
