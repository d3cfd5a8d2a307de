// Timing on a machine that is not idle: many short runs, of which the shortest or the median is used.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace ninebit::bench {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The duration of one call of `work` in seconds.
template <class Work>
[[nodiscard]] double seconds_of(const Work& work) {
  const auto start = Clock::now();
  work();
  return seconds_since(start);
}

// Runs of several threads that begin together, work(i) in thread i, and last until the last one is done: how many
// seconds the shortest takes of those that fit into `seconds`, three at least.
[[nodiscard]] double shortest_together(int threads, double seconds, const std::function<void(std::size_t)>& work);

struct Spread {
  double median = 0.0;
  double min = 0.0;
  double max = 0.0;
};

// Takes at least one sample. For an even number of samples, the median is the mean of the two in the middle.
[[nodiscard]] Spread spread_of(std::vector<double> samples);

// The resident memory of this process, as counted by Linux.

// Bytes of resident pages, including the program's own; 0 if the system does not report them.
[[nodiscard]] std::uint64_t resident_bytes();

// The maximum of resident_bytes() since the process began or since the last forget_peak().
[[nodiscard]] std::uint64_t peak_resident_bytes();
void forget_peak();

}  // namespace ninebit::bench
