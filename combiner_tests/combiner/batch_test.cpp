// Batches: sizes, lanes past the count, and the SIMD targets themselves.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

TEST(Batch, EveryTargetOfThisProcessorIsDispatchedTo) {
  ASSERT_FALSE(simd_targets().empty());
  const BatchProgram program(normalize(CombinerState{}, profiles::geforce2));
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::set<std::string> ran;
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    EXPECT_TRUE(!chosen_at_run_time() || !on_target.ran()) << "nothing was dispatched yet";
    program.run(*batch, 1, *out);
    for (const std::int64_t other : simd_targets()) {
      EXPECT_EQ(on_target.ran_on(other), other == target) << simd_target_name(other);
    }
    ran.insert(simd_target_name(target));
  }
  EXPECT_EQ(ran.size(), simd_targets().size());
  std::string names;
  for (const std::string& name : ran) names.append(" ").append(name);
  RecordProperty("simd_targets", names);
#if defined(__x86_64__)
  // A build for one target, as with sanitizers, has no others to dispatch to; the first step of .ci/run has.
  if (chosen_at_run_time()) {
    EXPECT_GE(ran.size(), 2U) << "an x86-64 processor of today has more than the baseline:" << names;
  }
#endif
}

// A batch of `count` gives each lane what the lane alone gives, whatever stands in the lanes past it.
TEST(Batch, SizesAndLanesPastTheCount) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Lanes lanes;
  RegisterBatch& batch = *lanes.registers;
  const auto start = std::make_unique<RegisterBatch>();
  int checked = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    Random random(0xBA7C4, index);
    const HardwareProfile profile = random_profile(random);
    const Program program = normalize(random_state(random, profile), profile);
    const BatchProgram compiled(program, {.registers = true});
    std::vector<EvaluatedFragment> expected;
    for (std::size_t lane = 0; lane < kBatchSize; ++lane) {
      const RegisterFile registers = random_registers(random, profile);
      put(*start, lane, registers);
      expected.push_back(evaluate_fragment(program, registers));
    }
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      for (const std::size_t count : {1U, 2U, 3U, 7U, 8U, 9U, 15U, 16U, 17U, 31U, 33U, 255U, 256U, 257U, 511U, 512U}) {
        batch = *start;
        for (auto& reg : batch.plane) {
          for (auto& plane : reg) {
            for (std::size_t lane = count; lane < kBatchSize; ++lane) {
              plane[lane] = static_cast<s9>(static_cast<std::uint16_t>(random.next()));
            }
          }
        }
        compiled.run(batch, count, *lanes.out);
        for (std::size_t lane = 0; lane < count; ++lane, ++checked) {
          ASSERT_TRUE(lane_of(batch, lane) == expected[lane].registers &&
                      lane_of(*lanes.out, lane) == expected[lane].color)
              << simd_target_name(target) << ' ' << count << ' ' << lane;
        }
      }
    }
  }
  EXPECT_GT(checked, 40 * 600);
}

TEST(Batch, NothingIsWrittenOutsideTheBatch) {
  struct Guarded {
    std::array<std::uint8_t, 4096> before;
    RegisterBatch registers;
    std::array<std::uint8_t, 4096> between;
    OutputBatch out;
    std::array<std::uint8_t, 4096> after;
  };
  const auto guarded = std::make_unique<Guarded>();
  Random random(0x6A7D);
  for (const std::size_t count : {0U, 1U, 255U, 511U, 512U}) {
    const HardwareProfile& profile = profiles::nv2a;
    const BatchProgram program(normalize(random_state(random, profile), profile), {.registers = true});
    std::memset(static_cast<void*>(guarded.get()), 0x5A, sizeof(Guarded));
    for (std::size_t lane = 0; lane < kBatchSize; ++lane) {
      put(guarded->registers, lane, random_registers(random, profile));
    }
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      program.run(guarded->registers, count, guarded->out);
      for (const auto* guard : {&guarded->before, &guarded->between, &guarded->after}) {
        for (const std::uint8_t byte : *guard) ASSERT_EQ(byte, 0x5A) << simd_target_name(target) << ' ' << count;
      }
    }
  }
}

TEST(Batch, AnEmptyBatchChangesNothing) {
  const BatchProgram program(normalize(CombinerState{}, profiles::geforce2), {.registers = true});
  const auto batch = std::make_unique<RegisterBatch>();
  const auto copy = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::memset(static_cast<void*>(batch.get()), 0x11, sizeof(RegisterBatch));
  std::memset(static_cast<void*>(copy.get()), 0x11, sizeof(RegisterBatch));
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    program.run(*batch, 0, *out);
    EXPECT_EQ(batch->plane, copy->plane);
  }
}

// The places of zero and the constants in a register file are not read.
TEST(Batch, ZeroAndConstantsInTheRegisterFileAreNotRead) {
  CombinerState state = rgb_stage({rgb_of(Register::constant0),
                                   kOne,
                                   rgb_of(Register::zero),
                                   kOne,
                                   {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard}});
  state.constant0 = color_of(10, 20, 30, 40);
  state.constant1 = color_of(50, 60, 70, 80);
  state.general[0].alpha = {alpha_of(Register::constant1), kOneAlpha, kZeroAlpha, kZeroAlpha, ab_to(Register::spare0)};
  RegisterFile registers;
  for (const Register r : {Register::zero, Register::constant0, Register::constant1}) {
    registers[r] = codes(99, -99, 255, -255);
  }
  const RegisterFile after = judged(state, profiles::geforce2, registers).registers;
  EXPECT_EQ(after[Register::spare0], codes(10, 20, 30, 80));
  EXPECT_EQ(after[Register::spare1], codes(0, 0, 0, 0));
  EXPECT_EQ(after[Register::zero], codes(99, -99, 255, -255));
}

}  // namespace
}  // namespace ninebit::test
