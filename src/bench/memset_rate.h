// How fast memory is written, as a measure for filled pixels.
#pragma once

#include <cstddef>

namespace ninebit::bench {

// GB/s at which `threads` threads together fill `bytes` with memset, in the shortest run of those that fit into
// `seconds`.
[[nodiscard]] double memset_rate(std::size_t bytes, int threads, double seconds);

}  // namespace ninebit::bench
