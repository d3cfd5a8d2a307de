// Which files a file may name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit::posix {

// Checks a name that was read from a file in `folder` (empty: the working folder). The name must be relative, without
// "..", not an address such as "http://…", and once links are followed it must lead to a regular file below `folder`.
// '\' separates folders as '/' does, because some readers take it for that. A name below the folder that leads to
// nothing is accepted: whoever opens it reports that. Never opens the file, so a FIFO does not block.
//
// Returns nothing if the name is accepted; otherwise what is wrong, as "'../a.bin' leaves the folder of the file that
// names it; expected …", with '?' for control characters.
[[nodiscard]] std::optional<std::string> why_outside(const std::filesystem::path& folder, std::string_view name);

}  // namespace ninebit::posix
