// The flags of the table of technique settings.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/frame/technique_settings.h"
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// Adds a flag for each setting of techniques.
void add_technique_flags(CLI::App& verb, SceneFlags& flags);

// Empty if the technique of the flags reads all flags that were given; else a sentence that names the first one that it
// does not read, and those of its own. Flags that are not in the table are read by all techniques.
[[nodiscard]] std::string unread_flag(const CLI::App& verb, const SceneFlags& flags);

// Whether the technique of the flags reads this flag. Flags that are not in the table are read by all techniques.
[[nodiscard]] bool reads_flag(const SceneFlags& flags, std::string_view flag);

// The settings that a rendering reads, by their keys; null where the technique chooses.
[[nodiscard]] Json settings_json(std::string_view technique, const RenderSettings& settings);

// Puts the flags of a rendering into groups: picture, camera and light, one for each technique, checks. Other flags
// stay where they are.
void group_scene_flags(CLI::App& verb);

}  // namespace ninebit::tools
