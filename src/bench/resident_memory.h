// The resident memory of this process, as counted by Linux.
#pragma once

#include <cstdint>

namespace ninebit::bench {

// Bytes of resident pages, including the program's own; 0 if the system does not report them.
[[nodiscard]] std::uint64_t resident_bytes();

// The maximum of resident_bytes() since the process began or since the last forget_peak().
[[nodiscard]] std::uint64_t peak_resident_bytes();
void forget_peak();

}  // namespace ninebit::bench
