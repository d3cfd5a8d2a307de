// Loops on all threads. This is the only header that the rooms need for them: oneTBB stays behind it, and a build with
// NINEBIT_THREADS=OFF runs the same loops on one thread, with the same results.
//
// Bodies must not depend on the order or on the number of the ranges that they are given. An exception of a body
// reaches the caller.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <utility>

namespace ninebit {

// A reference to a callable body(begin, end), which must outlive it.
class RangeBody {
 public:
  template <class Body>
  RangeBody(const Body& body)  // NOLINT(google-explicit-constructor): stands for its argument
      : body_(&body),
        call_([](const void* of, std::size_t begin, std::size_t end) { (*static_cast<const Body*>(of))(begin, end); }) {
  }
  void operator()(std::size_t begin, std::size_t end) const { call_(body_, begin, end); }

 private:
  const void* body_;
  void (*call_)(const void*, std::size_t, std::size_t);
};

// Calls body(begin, end) for disjoint ranges that cover 0 <= i < count, on several threads. `grain` is the number of
// items that are worth a task of their own; no range that can be divided in two such parts has to stay whole.
void parallel_ranges(std::size_t count, std::size_t grain, RangeBody body);

// The number of threads that a loop may use here, the caller's included; at least 1.
[[nodiscard]] std::size_t max_threads();

// Limits all loops of the program to `threads` threads, at least 1, while it lives; the smallest limit counts.
class ScopedThreadLimit {
 public:
  explicit ScopedThreadLimit(std::size_t threads);
  ~ScopedThreadLimit();
  ScopedThreadLimit(const ScopedThreadLimit&) = delete;
  ScopedThreadLimit& operator=(const ScopedThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

// The grain of loops whose items take a few nanoseconds each: vertices, pixels, texels.
constexpr std::size_t kGrainOfCheapItems = 16384;

// Calls body(i) for 0 <= i < count, on several threads.
template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  parallel_for(count, 1, body);
}

// Joins `identity` and body(begin, end) of disjoint ranges that cover 0 <= i < count. `join` must be associative and
// commutative to the bit, because ranges finish in any order.
template <class Value, class Body, class Join>
[[nodiscard]] Value parallel_reduce(std::size_t count, std::size_t grain, Value identity, const Body& body,
                                    const Join& join) {
  std::mutex joining;
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    const Value part = body(begin, end);
    const std::lock_guard lock(joining);
    identity = join(identity, part);
  });
  return identity;
}

// Sorts as std::sort does: pieces in parallel, then pairs of sorted neighbours are merged.
template <class Iterator, class Less = std::less<>>
void parallel_sort(Iterator begin, Iterator end, const Less& less = {}) {
  constexpr std::size_t kWorthATask = 8192;
  const auto size = static_cast<std::size_t>(end - begin);
  const std::size_t pieces = std::bit_ceil(std::min(max_threads(), size / kWorthATask + 1));
  if (pieces == 1) return std::sort(begin, end, less);
  const auto at = [&](std::size_t piece) {
    return begin + static_cast<typename std::iterator_traits<Iterator>::difference_type>(size * piece / pieces);
  };
  parallel_for(pieces, [&](std::size_t p) { std::sort(at(p), at(p + 1), less); });
  for (std::size_t width = 1; width < pieces; width *= 2) {
    parallel_for(pieces / (2 * width), [&](std::size_t pair) {
      const std::size_t first = 2 * width * pair;
      std::inplace_merge(at(first), at(first + width), at(first + 2 * width), less);
    });
  }
}

}  // namespace ninebit
