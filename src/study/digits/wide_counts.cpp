#include "src/study/digits/wide_counts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

WideCounts product_counts(int one) {
  WideCounts out{one * one, std::vector<std::uint64_t>(static_cast<std::size_t>(2 * one * one + 1))};
  for (int a = -one; a <= one; ++a) {
    for (int b = -one; b <= one; ++b) ++out.count[static_cast<std::size_t>(out.limit + a * b)];
  }
  return out;
}

WideCounts sum_counts(const WideCounts& first, const WideCounts& second) {
  const int limit = first.limit + second.limit;
  WideCounts out{limit, std::vector<std::uint64_t>(static_cast<std::size_t>(2 * limit + 1))};
  // The values of `second` that occur: most numbers are not products.
  std::vector<std::pair<std::ptrdiff_t, std::uint64_t>> terms;
  for (int w = -second.limit; w <= second.limit; ++w) {
    if (second.of(w) != 0) terms.emplace_back(w, second.of(w));
  }
  // One block of results at a time, so that it stays in the first-level caches while all terms are added to it.
  constexpr std::ptrdiff_t kBlock = 2048;
  const auto size = static_cast<std::ptrdiff_t>(out.count.size());
  const auto first_size = static_cast<std::ptrdiff_t>(first.count.size());
  parallel_for(static_cast<std::size_t>((size + kBlock - 1) / kBlock), [&](std::size_t block) {
    const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(block) * kBlock, end = std::min(begin + kBlock, size);
    for (const auto& [term, count] : terms) {
      const std::ptrdiff_t shift = term + second.limit;  // result i adds value i - shift of `first`
      const std::ptrdiff_t from = std::max(begin, shift), to = std::min(end, first_size + shift);
      for (std::ptrdiff_t i = from; i < to; ++i) {
        out.count[static_cast<std::size_t>(i)] += first.count[static_cast<std::size_t>(i - shift)] * count;
      }
    }
  });
  return out;
}

}  // namespace ninebit
