// The rate at which each combiner engine evaluates fragments.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"

namespace ninebit::bench {

enum class Engine : std::uint8_t {
  simd,         // the batch API, on the selected SIMD target
  reference,    // the library's constexpr reference, one fragment at a time
  scalar_float  // the rival (scalar_float.h)
};
inline constexpr std::array kEngines{Engine::simd, Engine::reference, Engine::scalar_float};
[[nodiscard]] std::string_view name_of(Engine engine);

// Million fragments per second of all threads together. Each thread has its own registers, which stay in its
// first-level caches and start from random codes. The result is the best of at least three short runs within `seconds`.
[[nodiscard]] double combiner_rate(const Program& program, Engine engine, int threads, double seconds);

// 10^9 bytes per second that one thread reads while it passes through `bytes` bytes of memory repeatedly: the best
// piece of 2 MiB. Memory larger than a cache is not read from that cache.
[[nodiscard]] double read_rate(std::size_t bytes, double seconds);

// The names of the compiled SIMD targets that this processor can run, best first.
[[nodiscard]] std::vector<std::string> simd_target_names();

// During its lifetime the batch API runs on the named target of simd_target_names(). No other thread may evaluate while
// it is created or destroyed.
class OnSimdTarget {
 public:
  explicit OnSimdTarget(const std::string& name);
  ~OnSimdTarget();
  OnSimdTarget(const OnSimdTarget&) = delete;
  OnSimdTarget& operator=(const OnSimdTarget&) = delete;
};

}  // namespace ninebit::bench
