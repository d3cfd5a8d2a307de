// Checks file names that were read from a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit::posix {

// Checks a name that was read from a file in `folder` (empty: the working folder). The name must be relative, without
// "..", not an address such as "http://…", and must lead to a regular file below `folder` after links are followed. '\'
// separates folders like '/', because some readers treat it that way. The name of a missing file below the folder is
// accepted: opening it reports the error. Never opens the file, so a FIFO does not block. A name such as "a.log#2", the
// second set-up of a log, is checked with and without its end.
//
// Returns nothing if the name is accepted; otherwise the reason, such as "'../a.bin' leaves the folder of the file that
// names it; expected …, or --allow-outside", with '?' for control characters.
[[nodiscard]] std::optional<std::string> why_outside(const std::filesystem::path& folder, std::string_view name);

// The name without "#N" at its end, whatever files there are.
[[nodiscard]] std::string_view without_setup(std::string_view name);

}  // namespace ninebit::posix
