// Random valid states: the oracle, the reference and the batch evaluator on every SIMD target give the same codes; the
// slow oracle for some fragments of each state. Each arithmetic has its own run with its own oracle, cut into shards
// that are tests of their own: shard s takes the cases s, s + kShards, s + 2 kShards, …
//
// One case again, alone: NINEBIT_DIFFERENTIAL_INDEX=12345 and the run's name in the filter, as a failure prints it
// (and NINEBIT_DIFFERENTIAL_SEED, if it was set). NINEBIT_DIFFERENTIAL_COUNT=1000000 gives another number of cases to
// every run, NINEBIT_DIFFERENTIAL_TABLE=1 prints how often each value of each field was seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "combiner_tests/combiner/coverage.h"
#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/environment.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/validate.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kProgramSeed = 0x6E696E65626974U;
constexpr std::uint64_t kShards = 8;

struct Run {
  std::string_view name;
  Arithmetic arithmetic;
  std::uint64_t cases;
  std::uint64_t sanitized_cases;
  std::size_t fragments;  // each: for vectors more than the longest has, and a rest; numbers without a limit take long
  std::size_t oracle_every;  // one in so many
};
constexpr Run kInteger{"integer", Arithmetic::integer, 50000, 4000, 40, 4};
constexpr Run kFloat{"float", Arithmetic::float32, 20000, 2000, 40, 4};
constexpr Run kExact{"exact", Arithmetic::exact, 8000, 160, 16, 1};

HardwareProfile profile_of(const Run& run, Random& random) {
  if (run.arithmetic == Arithmetic::integer) return random_profile(random);
  return random_real_profile(random, run.arithmetic == Arithmetic::exact ? profiles::ideal : profiles::float_shader);
}

// The outputs of a shard: a differential test of constant outputs would prove nothing.
struct StatesSeen {
  Coverage coverage;
  std::vector<Rgba9> colors;
  std::bitset<1024> codes;  // 512 + code
  std::uint64_t black = 0;
  std::uint64_t changed = 0;  // the general combiners left other registers than they got
  std::uint64_t negative = 0;

  void add(const RegisterFile& before, const Fragment& fragment) {
    colors.push_back(fragment.color);
    if (fragment.color[0] == 0 && fragment.color[1] == 0 && fragment.color[2] == 0) ++black;
    bool below_zero = false, any = false;
    for (std::size_t r = static_cast<std::size_t>(Register::primary); r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const s9 code = fragment.registers.value[r][c];
        if (before.value[r][c] == code) continue;
        any = true;
        below_zero |= code < 0;
        codes.set(static_cast<std::size_t>(512 + code));
      }
    }
    changed += any ? 1U : 0U;
    negative += below_zero ? 1U : 0U;
  }

  void expect_meaning() {
    const std::uint64_t fragments = colors.size();
    std::sort(colors.begin(), colors.end());
    colors.erase(std::unique(colors.begin(), colors.end()), colors.end());
    testing::Test::RecordProperty("fragments", static_cast<int>(fragments));
    testing::Test::RecordProperty("distinct_colors", static_cast<int>(colors.size()));
    EXPECT_LT(black * 2, fragments) << "more than half of all colours are black";
    EXPECT_GT(changed * 10, fragments * 8) << "most general combiners should write something new";
    EXPECT_GT(negative * 5, fragments) << "negative results are too rare";
    EXPECT_GT(colors.size() * 4, fragments) << "too few distinct colours";
  }
};

void run_case(const Run& run, std::uint64_t seed, std::uint64_t index, StatesSeen& seen) {
  Random random(seed, index);
  const HardwareProfile profile = profile_of(run, random);
  const CombinerState state = random_state(random, profile);
  const std::vector<StateDiagnostic> faults = validate(state, profile);
  ASSERT_TRUE(faults.empty()) << faults[0].message << '\n' << describe(state, profile);
  std::vector<RegisterFile> initial(run.fragments);
  for (RegisterFile& registers : initial) registers = random_registers(random, profile);
  const std::vector<Fragment> fragments = judged(state, profile, initial, run.oracle_every);
  for (std::size_t i = 0; i < run.fragments; ++i) seen.add(initial[i], fragments[i]);
  seen.coverage.add(state, profile);
}

class Differential : public testing::TestWithParam<std::tuple<Run, std::uint64_t>> {};

TEST_P(Differential, OracleReferenceAndEverySimdTargetAgree) {
  const auto& [run, shard] = GetParam();
  const std::uint64_t seed = number_from_environment("NINEBIT_DIFFERENTIAL_SEED", kProgramSeed);
  const std::uint64_t cases =
      number_from_environment("NINEBIT_DIFFERENTIAL_COUNT", kSlowBuild ? run.sanitized_cases : run.cases);
  const bool replay = std::getenv("NINEBIT_DIFFERENTIAL_INDEX") != nullptr;
  const std::uint64_t replayed = number_from_environment("NINEBIT_DIFFERENTIAL_INDEX", 0);
  if (replay && replayed % kShards != shard) GTEST_SKIP() << "the case belongs to another shard";

  StatesSeen seen;
  const std::uint64_t end = replay ? replayed + 1 : cases;
  for (std::uint64_t index = replay ? replayed : shard; index < end; index += kShards) {
    run_case(run, seed, index, seen);
    if (HasFailure()) {
      FAIL() << "case " << index << " of seed " << seed << "; again with NINEBIT_DIFFERENTIAL_SEED=" << seed
             << " NINEBIT_DIFFERENTIAL_INDEX=" << index << " and --gtest_filter='*Differential.Oracle*/" << run.name
             << "*'";
    }
  }
  std::string targets;
  for (const std::int64_t target : simd_targets()) targets.append(" ").append(simd_target_name(target));
  RecordProperty("simd_targets", targets);
  const std::vector<Coverage::Row> rows = seen.coverage.rows(run.arithmetic);
  if (std::getenv("NINEBIT_DIFFERENTIAL_TABLE") != nullptr) std::cout << Coverage::table(rows);
  if (replay) return;

  // A vacuous run fails. Few cases, as a sanitizer allows them, cannot meet every code and every value of every field.
  ASSERT_GE(cases, 20 * kShards);
  if (cases >= 200 * kShards) seen.expect_meaning();
  if (cases < 1000 * kShards) return;
  EXPECT_EQ(seen.codes.count(), run.arithmetic == Arithmetic::integer ? 512U : 511U)
      << "general combiners should have written every code";
  EXPECT_EQ(Coverage::rarer_than(5, rows), "") << "values that hardly ever occurred";
}

INSTANTIATE_TEST_SUITE_P(Shards, Differential,
                         testing::Combine(testing::Values(kInteger, kFloat, kExact),
                                          testing::Range(std::uint64_t{0}, kShards)),
                         [](const testing::TestParamInfo<Differential::ParamType>& run) {
                           return std::string(std::get<0>(run.param).name) + std::to_string(std::get<1>(run.param));
                         });

TEST(RandomCases, DependOnSeedAndIndexAlone) {
  Random first(kProgramSeed, 7), again(kProgramSeed, 7), other_index(kProgramSeed, 8), other_seed(kProgramSeed + 1, 7);
  const HardwareProfile& p = profiles::nv2a;
  const CombinerState state = random_state(first, p);
  EXPECT_EQ(state, random_state(again, p));
  EXPECT_NE(state, random_state(other_index, p));
  EXPECT_NE(state, random_state(other_seed, p));
}

}  // namespace
}  // namespace ninebit::test
