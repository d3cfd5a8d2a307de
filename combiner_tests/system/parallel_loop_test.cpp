// The loops of the house: every item once, whatever the number of threads.
#include "src/system/parallel/parallel_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <stdexcept>
#include <vector>

#include "combiner_tests/support/slow_build.h"

namespace {

using ninebit::max_threads;
using ninebit::parallel_for;
using ninebit::parallel_ranges;
using ninebit::parallel_reduce;
using ninebit::parallel_sort;
using ninebit::ScopedThreadLimit;

// Limits that leave one thread, two, and as many as there are.
std::vector<std::size_t> thread_limits() {
  return {1, 2, 1000};
}

TEST(ParallelLoop, VisitsEachItemOnce) {
  for (const std::size_t threads : thread_limits()) {
    const ScopedThreadLimit limit(threads);
    for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 2, 3, 63, 1000, 100000}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, [&](std::size_t i) { ++visits[i]; });
      EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; })) << count;
    }
  }
}

TEST(ParallelLoop, RangesAreDisjointAndCoverAll) {
  for (const std::size_t grain : std::initializer_list<std::size_t>{1, 7, 4096, 1000000}) {
    std::vector<std::atomic<int>> visits(12345);
    std::atomic<std::size_t> ranges = 0;
    parallel_ranges(visits.size(), grain, [&](std::size_t begin, std::size_t end) {
      ASSERT_LT(begin, end);
      ASSERT_LE(end, visits.size());
      ++ranges;
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; })) << grain;
    if (grain >= visits.size()) {
      EXPECT_EQ(ranges, 1U);
    }
  }
}

TEST(ParallelLoop, ALimitLeavesSoManyThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  EXPECT_GE(max_threads(), 1U);
  const std::size_t before = max_threads();
  {
    const ScopedThreadLimit limit(1);
    std::atomic<int> inside = 0, most = 0;
    parallel_for(1000, [&](std::size_t) {
      most = std::max<int>(most, ++inside);
      --inside;
    });
    EXPECT_EQ(most, 1);
  }
  EXPECT_EQ(max_threads(), before);
}

TEST(ParallelLoop, AnExceptionReachesTheCaller) {
  EXPECT_THROW(parallel_for(1000,
                            [](std::size_t i) {
                              if (i == 777) throw std::runtime_error("stop");
                            }),
               std::runtime_error);
}

TEST(ParallelReduce, JoinsAllParts) {
  for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 5, 100000}) {
    const std::uint64_t sum = parallel_reduce(
        count, 64, std::uint64_t{0},
        [](std::size_t begin, std::size_t end) {
          std::uint64_t part = 0;
          for (std::size_t i = begin; i < end; ++i) part += i;
          return part;
        },
        [](std::uint64_t a, std::uint64_t b) { return a + b; });
    EXPECT_EQ(sum, count == 0 ? 0 : std::uint64_t{count} * (count - 1) / 2);
  }
}

TEST(ParallelSort, SortsAsTheStandardLibraryDoes) {
  std::mt19937 random(5);
  for (const std::size_t threads : thread_limits()) {
    const ScopedThreadLimit limit(threads);
    for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 2, 8191, 8192, 16384, 16385, 200003}) {
      std::vector<std::uint32_t> values(count);
      for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random() % 5000);
      std::vector<std::uint32_t> expected = values;
      std::sort(expected.begin(), expected.end());
      parallel_sort(values.begin(), values.end());
      EXPECT_EQ(values, expected) << count;
      const auto descending = [](std::uint32_t a, std::uint32_t b) { return a > b; };
      std::reverse(expected.begin(), expected.end());
      parallel_sort(values.begin(), values.end(), descending);
      EXPECT_EQ(values, expected) << count;
    }
  }
}

}  // namespace
