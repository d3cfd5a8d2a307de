#include "src/bench/timing.h"

#include <algorithm>

namespace ninebit::bench {

Spread spread_of(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  return {(samples[(n - 1) / 2] + samples[n / 2]) / 2.0, samples.front(), samples.back()};
}

}  // namespace ninebit::bench
