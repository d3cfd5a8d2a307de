// The ZIP archives with effects that are read, and so those that are written.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ninebit {

// The most bytes of an archive, and of what is in it.
inline constexpr std::uint64_t kMostArchiveBytes = std::uint64_t{1} << 30U;
// The most files of an archive.
inline constexpr std::size_t kMostArchiveFiles = 4096;

}  // namespace ninebit
