// Fragments a second that the engines of the combiners evaluate.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"

namespace ninebit::bench {

enum class Engine : std::uint8_t {
  simd,         // the batch API, on the SIMD target of the day
  reference,    // the library's constexpr reference, a fragment at a time
  scalar_float  // the rival (scalar_float.h)
};
inline constexpr std::array kEngines{Engine::simd, Engine::reference, Engine::scalar_float};
[[nodiscard]] std::string_view name_of(Engine engine);

// Million fragments a second of so many threads together, each with registers of its own, which stay in its first
// caches: the best of the short runs that fit into `seconds`, of at least three. Registers start from random codes.
[[nodiscard]] double combiner_rate(const Program& program, Engine engine, int threads, double seconds);

// 10^9 bytes a second that one thread reads when it goes through so much memory again and again: the best piece of
// 2 MiB. What is larger than a cache is not read from it.
[[nodiscard]] double read_rate(std::size_t bytes, double seconds);

// The names of the SIMD targets that were compiled and that this processor can run, best first.
[[nodiscard]] std::vector<std::string> simd_target_names();

// While it lives, the batch API runs on that target of simd_target_names(). Not while other threads evaluate.
class OnSimdTarget {
 public:
  explicit OnSimdTarget(const std::string& name);
  ~OnSimdTarget();
  OnSimdTarget(const OnSimdTarget&) = delete;
  OnSimdTarget& operator=(const OnSimdTarget&) = delete;
};

}  // namespace ninebit::bench
