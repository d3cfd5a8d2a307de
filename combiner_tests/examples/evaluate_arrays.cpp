#include <gtest/gtest.h>
#include <ninebit/combiner/evaluate_arrays.h>
#include <ninebit/combiner/normalize.h>

#include <vector>

namespace {

void run(const ninebit::BatchProgram& program, const std::uint8_t* rgba, std::uint8_t* out, std::size_t pixels) {
  ninebit::FragmentArrays arrays{.count = pixels};
  arrays.otherwise[ninebit::Register::fog][ninebit::kAlpha] = 255;  // a register without an array is 0; no fog is 1.0
  arrays.read_rgba8(ninebit::Register::texture0, rgba);
  arrays.write_rgba8(out);                        // may be the same picture
  ninebit::evaluate(program, arrays, 0, pixels);  // or a range in each of your threads
}

}  // namespace

TEST(Examples, EvaluateArrays) {
  using namespace ninebit;
  CombinerState state;  // the final combiner passes spare0 on
  state.general[0].rgb.a.reg = Register::texture0;
  const BatchProgram program(normalize(state, profiles::geforce2), {}, {}, BatchInputs::not_negative);
  std::vector<std::uint8_t> picture(4 * 640 * 480, 77);
  run(program, picture.data(), picture.data(), 640 * 480);
  EXPECT_EQ(picture[0], 77);
  EXPECT_EQ(picture[4 * 640 * 480 - 4], 77);
}
