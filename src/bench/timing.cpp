#include "src/bench/timing.h"

#include <algorithm>
#include <barrier>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace ninebit::bench {

double shortest_together(int threads, double seconds, const std::function<void(std::size_t)>& work) {
  const auto count = static_cast<std::size_t>(threads);
  std::vector<Clock::time_point> begin(count), end(count);
  std::barrier gate(threads);
  bool over = false;
  const auto run = [&](std::size_t i) {
    gate.arrive_and_wait();
    if (over) return false;
    begin[i] = Clock::now();
    work(i);
    end[i] = Clock::now();
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
    run(0);
    const auto first = *std::min_element(begin.begin(), begin.end());
    const auto last = *std::max_element(end.begin(), end.end());
    shortest = std::min(shortest, std::chrono::duration<double>(last - first).count());
  }
  over = true;
  run(0);
  return shortest;
}

Spread spread_of(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  return {(samples[(n - 1) / 2] + samples[n / 2]) / 2.0, samples.front(), samples.back()};
}

namespace {

// The bytes in a line such as "VmRSS:     2048 kB" (proc_pid_status(5)).
std::uint64_t bytes_of(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::uint64_t kilobytes = 0;
    if (word == name && status >> kilobytes) return kilobytes * 1024;
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

}  // namespace

std::uint64_t resident_bytes() {
  return bytes_of("VmRSS:");
}

std::uint64_t peak_resident_bytes() {
  return bytes_of("VmHWM:");
}

void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;  // proc_pid_clear_refs(5)
}

}  // namespace ninebit::bench
