// Random valid states: the oracle, the reference and the batch evaluator on every SIMD target give the same codes.
//
// One case again, alone: NINEBIT_DIFFERENTIAL_INDEX=12345 (and NINEBIT_DIFFERENTIAL_SEED, if it was set).
// More cases: NINEBIT_DIFFERENTIAL_COUNT=1000000.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/sanitized.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "ninebit/combiner/validate.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kSeed = 0x6E696E65626974U;
constexpr std::size_t kFragments = 64;
constexpr std::uint64_t kCases = kSanitized ? 2000 : 24000;

std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 0);
}

// What the run has seen: a differential test of constant outputs would prove nothing.
struct Seen {
  std::set<Rgba9> colors;
  std::set<s9> codes;
  std::uint64_t fragments = 0;
  std::uint64_t black = 0;
  std::uint64_t changed = 0;  // the general combiners left other registers than they got
  std::uint64_t negative = 0;

  void add(const RegisterFile& before, const Fragment& fragment) {
    ++fragments;
    colors.insert(fragment.color);
    if (fragment.color[0] == 0 && fragment.color[1] == 0 && fragment.color[2] == 0) ++black;
    if (before != fragment.registers) ++changed;
    bool below_zero = false;
    for (std::size_t r = static_cast<std::size_t>(Register::primary); r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (before.value[r][c] == fragment.registers.value[r][c]) continue;
        codes.insert(fragment.registers.value[r][c]);
        below_zero |= fragment.registers.value[r][c] < 0;
      }
    }
    if (below_zero) ++negative;
  }
};

void run_case(std::uint64_t seed, std::uint64_t index, Seen& seen) {
  Random random(seed, index);
  const HardwareProfile profile = random_profile(random);
  const CombinerState state = random_state(random, profile);
  const std::vector<StateDiagnostic> faults = validate(state, profile);
  ASSERT_TRUE(faults.empty()) << faults[0].message << '\n' << describe(state, profile);
  std::vector<RegisterFile> initial(kFragments);
  for (RegisterFile& registers : initial) registers = random_registers(random, profile);
  const std::vector<Fragment> fragments = judged(state, profile, initial);
  for (std::size_t i = 0; i < kFragments; ++i) seen.add(initial[i], fragments[i]);
}

TEST(Differential, OracleReferenceAndEverySimdTargetAgree) {
  const std::uint64_t seed = number_from_environment("NINEBIT_DIFFERENTIAL_SEED", kSeed);
  const std::uint64_t count = number_from_environment("NINEBIT_DIFFERENTIAL_COUNT", kCases);
  const bool replay = std::getenv("NINEBIT_DIFFERENTIAL_INDEX") != nullptr;
  const std::uint64_t first = number_from_environment("NINEBIT_DIFFERENTIAL_INDEX", 0);
  const std::uint64_t end = replay ? first + 1 : count;

  Seen seen;
  for (std::uint64_t index = first; index < end; ++index) {
    run_case(seed, index, seen);
    if (HasFailure()) {
      FAIL() << "case " << index << " of seed " << seed << "; again with NINEBIT_DIFFERENTIAL_SEED=" << seed
             << " NINEBIT_DIFFERENTIAL_INDEX=" << index;
    }
  }
  std::string targets;
  for (const std::int64_t target : simd_targets()) targets.append(" ").append(simd_target_name(target));
  RecordProperty("simd_targets", targets);
  RecordProperty("fragments", static_cast<int>(seen.fragments));
  RecordProperty("distinct_colors", static_cast<int>(seen.colors.size()));
  if (replay) return;

  // A vacuous run fails.
  EXPECT_GE(count, 1000U);
  EXPECT_LT(seen.black * 2, seen.fragments) << "more than half of all colours are black";
  EXPECT_GT(seen.changed * 10, seen.fragments * 8) << "most general combiners should write something new";
  EXPECT_GT(seen.negative * 5, seen.fragments) << "negative results are too rare";
  EXPECT_GT(seen.colors.size() * 4, seen.fragments) << "too few distinct colours";
  EXPECT_EQ(seen.codes.size(), 512U) << "general combiners should have written every code from -256 to 255";
}

TEST(Differential, CasesDependOnSeedAndIndexAlone) {
  Random first(kSeed, 7), again(kSeed, 7), other_index(kSeed, 8), other_seed(kSeed + 1, 7);
  const HardwareProfile& p = profiles::nv2a;
  const CombinerState state = random_state(first, p);
  EXPECT_EQ(state, random_state(again, p));
  EXPECT_NE(state, random_state(other_index, p));
  EXPECT_NE(state, random_state(other_seed, p));
}

}  // namespace
}  // namespace ninebit::test
