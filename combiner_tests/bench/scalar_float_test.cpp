// The rival is a fair one: it computes the same program as the library does in float.
#include "src/bench/scalar_float.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "combiner_tests/bench/support.h"
#include "ninebit/combiner/normalize.h"
#include "src/bench/programs.h"

namespace bench_test {
namespace {

using namespace ninebit;

TEST(ScalarFloat, AgreesWithFloatShaderWithinOneStep) {
  const std::vector<RegisterFile> fragments = random_fragments(5000);
  std::vector<Rgba9> colors(fragments.size());
  const auto programs = bench::measured_programs(profiles::float_shader);
  for (const bench::MeasuredProgram& p : *programs) {
    const Program program = normalize(p.state, p.profile);
    bench::evaluate_scalar_float(program, fragments, colors.data());
    std::set<Rgba9> different;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const Rgba9 expected = evaluate(program, fragments[i]);
      different.insert(expected);
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_LE(std::abs(colors[i][c] - expected[c]), 1) << p.name << ", fragment " << i << ", component " << c;
      }
    }
    EXPECT_GT(different.size(), p.name == "index" ? 20U : 1000U) << p.name;
  }
}

}  // namespace
}  // namespace bench_test
