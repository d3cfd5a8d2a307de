// Draws in so many threads.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace ninebit::test {

// Calls run() where oneTBB has `threads` threads.
template <class Function>
void with_threads(int threads, Function run) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(run);
}

}  // namespace ninebit::test
