// The pictures that a scene's materials name, and what a rendering of the scene leaves out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// A scene that is ready to be drawn.
struct DrawnScene {
  Scene scene;
  std::vector<std::string> ignored{};  // what a rendering leaves out, one entry each kind
};

// load_scene, with the textures of the materials that triangles use, each picture once; none with settings.cartoon and
// without texture coordinates; prints nothing. Reports also, naming the scene's file and the picture, one that is
// missing, damaged, outside of the scene's folder (unless --allow-outside is given) or beyond the limits.
[[nodiscard]] Result<DrawnScene> load_drawn_scene(const SceneFlags& flags, const RenderSettings& settings);

// Parts of the scene's materials that a technique ignores, one entry each kind.
[[nodiscard]] std::vector<std::string> ignored_materials(const Scene& scene, const std::string& technique,
                                                         const RenderSettings& settings);

// Prints one warning that names what is ignored, if anything is.
void warn_of_ignored(const std::string& scene_file, const std::vector<std::string>& ignored);

// The flag --cookie: a light's cube map.

// Empty if the text names one file or six, else the reason.
[[nodiscard]] std::string check_cookie(const std::string& text);

// Reads the cube map that a checked text names: one file with six faces, or six files with one face each, in the order
// +X,-X,+Y,-Y,+Z,-Z. Reports what the readers of texture_io.h report, and a single file that is not a cube map; each
// names the file.
[[nodiscard]] Result<std::shared_ptr<const Texture>> read_cookie(const HardwareProfile& profile,
                                                                 const std::string& text);

}  // namespace ninebit::tools
