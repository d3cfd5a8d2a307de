// A flag that names a pixel as X,Y, counted from the top left of the picture.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "ninebit/frame/settings.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

CLI::Option* add_pixel_flag(CLI::App& verb, const std::string& flag, std::string& text, const std::string& help);

// The pixel in window coordinates, y up. The text was checked while the flag was parsed; reports a pixel outside of the
// picture.
[[nodiscard]] Result<glm::ivec2> window_pixel(const std::string& flag, const std::string& text,
                                              const RenderSettings& settings);

}  // namespace ninebit::tools
