// The flag --cookie: a light's cube map.
#pragma once

#include <memory>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/texture.h"

namespace ninebit::tools {

// Empty if the text names one file or six, else the reason.
[[nodiscard]] std::string check_cookie(const std::string& text);

// Reads the cube map that a checked text names: one file with six faces, or six files with one face each, in the order
// +X,-X,+Y,-Y,+Z,-Z. Reports what the readers of texture_io.h report, and a single file that is not a cube map; each
// names the file.
[[nodiscard]] Result<std::shared_ptr<const Texture>> read_cookie(const HardwareProfile& profile,
                                                                 const std::string& text);

}  // namespace ninebit::tools
