#include "src/system/parallel/parallel_loop.h"

#if NINEBIT_THREADS

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

namespace ninebit {

void parallel_ranges(std::size_t count, std::size_t grain, RangeBody body) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto run = [&](const Range& range) { body(range.begin(), range.end()); };
  // Few items are few because each is long: each becomes a task. Otherwise oneTBB divides ranges as threads ask for
  // more.
  if (count <= max_threads() * grain) {
    tbb::parallel_for(Range(0, count, grain), run, tbb::simple_partitioner());
  } else {
    tbb::parallel_for(Range(0, count, grain), run);
  }
}

std::size_t max_threads() {
  return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

struct ScopedThreadLimit::Control : tbb::global_control {
  using global_control::global_control;
};

ScopedThreadLimit::ScopedThreadLimit(std::size_t threads)
    : control_(std::make_unique<Control>(tbb::global_control::max_allowed_parallelism, threads)) {}

}  // namespace ninebit

#else

namespace ninebit {

void parallel_ranges(std::size_t count, std::size_t, RangeBody body) {
  if (count > 0) body(0, count);
}

std::size_t max_threads() {
  return 1;
}

struct ScopedThreadLimit::Control {};

ScopedThreadLimit::ScopedThreadLimit(std::size_t) {}

}  // namespace ninebit

#endif

namespace ninebit {

ScopedThreadLimit::~ScopedThreadLimit() = default;

}  // namespace ninebit
