#include "src/bench/timing.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace ninebit::bench {

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
