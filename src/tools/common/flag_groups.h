// The sections of the help of verbs that render.
#pragma once

#include <CLI/CLI.hpp>

namespace ninebit::tools {

// Puts the flags of a rendering into groups: picture, camera and light, one for each technique, checks. A group names
// the techniques that read its flags. Other flags stay where they are.
void group_scene_flags(CLI::App& verb);

}  // namespace ninebit::tools
