// Which techniques read which flags.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// Empty if the technique of the flags reads all flags that were given; else a sentence that names the first one that it
// does not read, and those of its own. Flags that are not in the table are read by all techniques.
[[nodiscard]] std::string unread_flag(const CLI::App& verb, const SceneFlags& flags);

// The flags that only some techniques read: "--map-size", ….
[[nodiscard]] std::vector<std::string> technique_flags();

// Whether the technique of the flags reads this flag. Flags that are not in the table are read by all techniques.
[[nodiscard]] bool reads_flag(const SceneFlags& flags, std::string_view flag);

}  // namespace ninebit::tools
