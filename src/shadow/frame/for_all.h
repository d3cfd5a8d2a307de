// Parallel loops over vertices, pixels and texels.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace ninebit {

// Calls work(i) for each i below `count`, on all threads, with a grain size of 16,384.
template <class Work>
void for_all(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) work(i);
  });
}

}  // namespace ninebit
