// errno as an error code.
#pragma once

#include <sys/types.h>

#include <cerrno>
#include <system_error>

namespace ninebit::posix {

inline constexpr mode_t kNewFileMode = 0666;  // before the user's umask is applied

inline std::error_code last_error() noexcept {
  return {errno, std::generic_category()};
}

}  // namespace ninebit::posix
