// The flag --cookie: a light's cube map.
#pragma once

#include <memory>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/texture.h"

namespace ninebit::tools {

// Empty, or why the text names neither one file nor six.
[[nodiscard]] std::string check_cookie(const std::string& text);

// The cube map that a checked text names: one file of six faces, or six of one, +X,-X,+Y,-Y,+Z,-Z. Reports, naming the
// file, what the readers of texture_io.h report, and a file of one face alone.
[[nodiscard]] Result<std::shared_ptr<const Texture>> read_cookie(const HardwareProfile& profile,
                                                                 const std::string& text);

}  // namespace ninebit::tools
