#include "src/bench/memset_rate.h"

#include <algorithm>
#include <barrier>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include "src/bench/timing.h"

namespace ninebit::bench {

double memset_rate(std::size_t bytes, int threads, double seconds) {
  // One run fills everything so often that the threads' meeting does not count.
  constexpr int kFills = 8;
  const auto count = static_cast<std::size_t>(threads);
  const std::size_t piece = bytes / count;
  std::vector<std::uint8_t> memory(count * piece);
  std::barrier gate(threads);
  bool over = false;
  const auto run = [&](std::size_t i) {
    gate.arrive_and_wait();
    if (over) return false;
    for (int fill = 0; fill < kFills; ++fill) std::memset(memory.data() + i * piece, fill, piece);
    gate.arrive_and_wait();
    return true;
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < count; ++i) {
    others.emplace_back([&run, i] {
      while (run(i)) continue;
    });
  }
  double shortest = 1e9;
  const auto start = Clock::now();
  for (int runs = 0; runs < 3 || seconds_since(start) < seconds; ++runs) {
    shortest = std::min(shortest, seconds_of([&] { run(0); }));
  }
  over = true;
  run(0);
  return static_cast<double>(memory.size()) * kFills / shortest / 1e9;
}

}  // namespace ninebit::bench
