#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/combiner/portion_walk.h>
#include <ninebit/numerics/hardware_profile.h>

// Which registers the red of a stage's result comes from: a value is a set of registers.
struct Sources {
  using Input = unsigned;
  using Wide = unsigned;
  using Output = unsigned;
  static unsigned bit(ninebit::Register r) { return 1U << static_cast<unsigned>(r); }
  static unsigned input(const ninebit::CombinerInput& in, int) { return bit(in.reg); }
  static unsigned product(unsigned x, unsigned y) { return x | y; }
  static unsigned sum(unsigned x, unsigned y) { return x | y; }
  static unsigned mux(unsigned ab, unsigned cd) { return ab | cd | bit(ninebit::Register::spare0); }
  static unsigned output(const ninebit::detail::Target&, unsigned wide) { return wide; }
  void write(ninebit::Register, int component, unsigned value) {
    if (component == ninebit::kRed) of_red = value;
  }
  unsigned of_red = 0;
};

TEST(Examples, PortionWalk) {
  Sources sources;
  ninebit::detail::StageSteps<Sources> steps;
  ninebit::detail::walk_stage(sources, ninebit::normalize({}, ninebit::profiles::geforce2).general[0], steps);
  EXPECT_EQ(sources.of_red, Sources::bit(ninebit::Register::primary) | Sources::bit(ninebit::Register::zero));
}
