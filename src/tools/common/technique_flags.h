// Which techniques read which flags.
#pragma once

#include <string>

#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

// Empty if the technique of the flags reads all flags that were given; else a sentence that names the first one that it
// does not read, and those of its own. Flags that are not in the table are read by all techniques.
[[nodiscard]] std::string unread_flag(const CLI::App& verb, const SceneFlags& flags);

}  // namespace ninebit::tools
