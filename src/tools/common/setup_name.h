// LOG#N: the set-up N of the log of register writes in the file LOG.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace ninebit::tools {

// A name of a program as it is given: the file, and the set-up in it.
struct SetupName {
  std::string file;                    // "-": standard input
  std::optional<std::size_t> setup{};  // the number behind #, which may be 0; empty: there is none
};

// Takes "#N" from the end of a name, unless there is a file of the whole name.
[[nodiscard]] SetupName setup_name(const std::string& name);

}  // namespace ninebit::tools
