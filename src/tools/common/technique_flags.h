// The flags of the table of technique settings.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/frame/technique_settings.h"
#include "ninebit/shadow/technique.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/program.h"

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

// The order of indices in the words of the program: warnings, the summary, JSON.

// Prints a warning to stderr if a rendering with --index-order neighbour used the order of the file.
void warn_of_unused_order(const RenderSettings& settings, const IndexOrderReport& report);

// "index order: 40 patches, 60 borders, 3 broken (5.0 % of their length), 0 false neighbours", with a line break; empty
// for the order of the file.
[[nodiscard]] std::string order_text(const IndexOrderReport& report);

// Adds `order` to the object and, for IndexOrder::neighbour, the counts of the report.
void add_order(Json& index, const IndexOrderReport& report);

}  // namespace ninebit::tools
