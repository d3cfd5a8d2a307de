// oneTBB as the thread sanitizer sees it: what ninebit uses of it, in threads of the standard library.
//
// The distribution's oneTBB is compiled without the sanitizer, which therefore misses how that library's threads wait
// for each other, and takes every result handed from one to another for a race. Suppressions cannot help: each of our
// loops has frames of oneTBB below it. Here a loop starts its threads and joins them, so the only order between two of
// its pieces is the one that our own code makes, and whatever else they share is a race that will be told.
//
// What this cannot show: a waiting thread of oneTBB may begin another task meanwhile, and keeps its thread_local memory
// from loop to loop. That these give the same bits, the tests of the other builds show.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

// More than the machine may have: threads that take turns race as well.
inline std::atomic<std::size_t> most_threads{4};

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t most) : before_(most_threads) { most_threads = most; }
  ~global_control() { most_threads = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

 private:
  std::size_t before_;
};

class task_arena {
 public:
  explicit task_arena(int) {}  // who makes one here has set the same number by global_control
  template <class Function>
  auto execute(Function&& run) {
    return run();
  }
};

namespace this_task_arena {
inline int max_concurrency() {
  return static_cast<int>(most_threads);
}
}  // namespace this_task_arena

struct simple_partitioner {};

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  [[nodiscard]] Index begin() const { return begin_; }
  [[nodiscard]] Index end() const { return end_; }
  [[nodiscard]] bool empty() const { return !(begin_ < end_); }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }

  // The number of pieces that are worth their threads, and the p-th piece.
  [[nodiscard]] std::size_t pieces() const {
    return empty() ? 0 : std::min((size() + grain_ - 1) / grain_, 8 * most_threads);
  }
  [[nodiscard]] blocked_range piece(std::size_t p, std::size_t pieces) const {
    const auto at = [&](std::size_t i) { return static_cast<Index>(begin_ + static_cast<Index>(size() * i / pieces)); };
    return {at(p), at(p + 1), grain_};
  }

 private:
  Index begin_;
  Index end_;
  std::size_t grain_;
};

// Calls run(i) for each i < count, in the caller and so many threads as there may be; what one throws, the caller gets.
// Each thread has its share from the start: were they to take the next one each, a thread that starts late would find
// none left, and the race be missed.
template <class Function>
void in_threads(std::size_t count, const Function& run) {
  const std::size_t threads = std::min<std::size_t>(count, most_threads);
  std::exception_ptr thrown;
  std::mutex throwing;
  const auto work = [&](std::size_t first) {
    try {
      for (std::size_t i = first; i < count; i += threads) run(i);
    } catch (...) {
      const std::lock_guard lock(throwing);
      thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
  }
  if (thrown) std::rethrow_exception(thrown);
}

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body, simple_partitioner = {}) {
  const std::size_t pieces = range.pieces();
  in_threads(pieces, [&](std::size_t p) { body(range.piece(p, pieces)); });
}

}  // namespace tbb
