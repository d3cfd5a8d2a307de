// The number of inputs for each wide value.
#pragma once

#include <cstdint>
#include <vector>

namespace ninebit {

// Counts for the wide values -limit … limit: count[limit + w] inputs give w.
struct WideCounts {
  int limit = 0;
  std::vector<std::uint64_t> count;
  [[nodiscard]] std::uint64_t of(int wide) const { return count[static_cast<std::size_t>(limit + wide)]; }
};

// Counts of the products of two mapped inputs, each from -one to one.
[[nodiscard]] WideCounts product_counts(int one);

// Counts of the sums of all pairs of a value of `first` and a value of `second`. Counts must stay below 2^63.
[[nodiscard]] WideCounts sum_counts(const WideCounts& first, const WideCounts& second);

}  // namespace ninebit
