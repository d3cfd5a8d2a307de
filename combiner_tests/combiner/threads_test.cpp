// One program in several threads at once, first of all the first of the process, which chooses the SIMD target.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

constexpr int kThreads = 4;

void fill(Random& random, const HardwareProfile& profile, RegisterBatch& batch) {
  for (auto& reg : batch.plane) {
    for (auto& component : reg) {
      for (auto& value : component) value = static_cast<s9>(random_code(random, profile));
    }
  }
}

TEST(ProgramThreads, OneProgramRunsInSeveralAtOnce) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random(20260101, i);
    const BatchProgram program(normalize(random_state(random, profile), profile));
    std::vector<Lanes> runs(kThreads);
    fill(random, profile, *runs[0].registers);
    for (Lanes& run : runs) *run.registers = *runs[0].registers;
    {
      std::vector<std::jthread> threads;
      for (Lanes& run : runs) {
        threads.emplace_back([&program, &run] {
          // Shares what it is made of; each thread has its own.
          // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
          const BatchProgram copy = program;
          copy.run(*run.registers, kBatchSize, *run.out);
        });
      }
    }
    const auto alone = std::make_unique<OutputBatch>();
    program.run(*runs[0].registers, kBatchSize, *alone);
    for (const Lanes& run : runs) {
      ASSERT_EQ(std::memcmp(run.out.get(), alone.get(), sizeof(OutputBatch)), 0) << "case " << i;
    }
  }
}

}  // namespace
}  // namespace ninebit::test
