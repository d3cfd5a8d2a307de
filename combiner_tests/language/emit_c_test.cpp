// Programs emitted as C, compiled by the machine's C compiler, against the reference.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "combiner_tests/language/compiled_c.h"
#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/c_source.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kCSeed = 0x632D736F75726365U;
constexpr int kCCases = 300;
constexpr std::size_t kCFragments = 128;

void compare(const std::vector<EmitCase>& cases, std::size_t fragments, Outputs& outputs) {
  std::string source;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Result<std::string> text = emit_c(cases[i].program, "program" + std::to_string(i));
    ASSERT_TRUE(text.ok()) << cases[i].name << ": " << text.error().text();
    source += *text;
  }
  const CompiledC compiled(source, CompiledC::Runs::seldom);
  ASSERT_FALSE(::testing::Test::HasFailure());
  compare(
      compiled, cases, kCSeed, fragments, [](const Program& p) { return emit_c(p).value(); }, outputs);
}

TEST(EmitC, RandomProgramsGiveTheBitsOfTheReference) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Outputs outputs;
  compare(random_cases(kCSeed, kCCases), kCFragments, outputs);
  if (!HasFailure()) outputs.expect_meaning(kCCases * kCFragments);
}

TEST(EmitC, KnownProgramsAndEveryMappingScaleAndBiasGiveTheBitsOfTheReference) {
  Outputs outputs;
  compare(known_cases(), 512, outputs);
  compare(row_cases(), 256, outputs);
  outputs.expect_distinct(10000);
}

}  // namespace
}  // namespace ninebit::test
