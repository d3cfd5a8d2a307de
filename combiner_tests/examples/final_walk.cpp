#include <gtest/gtest.h>
#include <ninebit/combiner/final_walk.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/numerics/hardware_profile.h>

// Which registers the final combiner's red comes from: a value is a set of registers.
struct FinalSources {
  using Input = unsigned;
  using Code = unsigned;
  static constexpr bool kEveryStep = false;
  static unsigned bit(ninebit::Register r) { return 1U << static_cast<unsigned>(r); }
  static unsigned input(const ninebit::CombinerInput& in, int) { return bit(in.reg); }
  static unsigned map(ninebit::InputMapping, unsigned code) { return code; }
  static unsigned product(unsigned e, unsigned f) { return e | f; }
  static unsigned sum_part(bool, ninebit::Register r, int) { return bit(r); }
  static unsigned sum(bool, unsigned spare0, unsigned secondary) { return spare0 | secondary; }
  static unsigned rgb(int, unsigned a, unsigned b, unsigned c, unsigned d) { return a | b | c | d; }
  static unsigned alpha(unsigned g) { return g; }
};

TEST(Examples, FinalWalk) {
  using ninebit::Register;
  FinalSources sources;
  ninebit::detail::FinalSteps<FinalSources> steps;
  ninebit::detail::walk_final(sources, ninebit::normalize({}, ninebit::profiles::geforce2), steps);
  EXPECT_EQ(steps.color[ninebit::kAlpha], FinalSources::bit(Register::spare0));
  EXPECT_NE(steps.color[ninebit::kRed] & FinalSources::bit(Register::secondary), 0U);
}
