// How much memory this process holds, as Linux counts it.
#pragma once

#include <cstdint>

namespace ninebit::bench {

// Bytes of pages in memory, the program's own included; 0 where the system does not tell.
[[nodiscard]] std::uint64_t resident_bytes();

// The most that there have been since the process began or forget_peak() was called.
[[nodiscard]] std::uint64_t peak_resident_bytes();
void forget_peak();

}  // namespace ninebit::bench
