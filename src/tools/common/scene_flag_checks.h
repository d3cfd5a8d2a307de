// Checks of the scene flags. Each returns an empty string for a valid value, else the reason and what is expected.
#pragma once

#include <string>

namespace ninebit::tools {

// WIDTHxHEIGHT, each from 1 to kMaxSurfaceSize.
[[nodiscard]] std::string check_size(const std::string& text);
// X,Y,Z, each from -kMostDistance to kMostDistance.
[[nodiscard]] std::string check_point(const std::string& text);
// auto, none or a height.
[[nodiscard]] std::string check_floor(const std::string& text);
// Degrees from 0.01 to 170.
[[nodiscard]] std::string check_fov(const std::string& text);
// Degrees from 1 to 170.
[[nodiscard]] std::string check_spot_angle(const std::string& text);
// Any text that is not empty.
[[nodiscard]] std::string check_file_name(const std::string& text);

}  // namespace ninebit::tools
