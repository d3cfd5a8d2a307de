// Each register that combiners read, alone.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/gl_layer/fragments.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// A program whose colour is a register's, and whose alpha is the register's alpha.
CombinerState shows(Register reg) {
  CombinerState state;
  FinalCombiner& f = state.final_combiner;
  f.a = f.b = f.c = CombinerInput{};
  f.d = {reg, InputMapping::unsigned_identity, ComponentUsage::rgb};
  f.g = {reg, InputMapping::unsigned_identity, ComponentUsage::alpha};
  state.general[0].rgb.out.sum = state.general[0].alpha.out.sum = Register::discard;
  return state;
}

class LayerInputs : public ::testing::TestWithParam<HardwareProfile> {};

TEST_P(LayerInputs, EveryRegister) {
  const HardwareProfile& profile = GetParam();
  NINEBIT_GL_CONTEXT(context, profile);
  for (const Register reg :
       {Register::primary, Register::secondary, Register::fog, Register::texture0, Register::texture1,
        Register::texture2, Register::texture3, Register::spare0, Register::spare1}) {
    const auto unit = static_cast<int>(reg) - static_cast<int>(Register::texture0);
    if (unit >= profile.texture_units && reg <= Register::texture3) continue;
    for (std::uint64_t round = 0; round < 8; ++round) {
      Random random(static_cast<std::uint64_t>(reg), round);
      const Fragments fragments = random_fragments(random, profile);
      const CombinerState state = shows(reg);
      set_combiners(state, profile);
      const auto drawn = draw(fragments, profile);
      const auto expected = compute(normalize(state, profile), profile, fragments);
      for (std::size_t k = 0; k < kFragments; ++k) {
        ASSERT_EQ(drawn[k], expected[k]) << "register " << static_cast<int>(reg) << ", round " << round << ", fragment "
                                         << k << ", fog " << fragments.fog << ", units " << fragments.units;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, LayerInputs, ::testing::ValuesIn(integer_profiles()), name_of_case);

}  // namespace
}  // namespace ninebit::test
