// What is read back from the driver equals what the library computes, for random programs and fragments.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/gl_layer/fragments.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kSeed = 20000401;

// How many programs for each profile. NINEBIT_GL_PROGRAMS asks for more; each takes a driver some 20 ms to compile.
int number_of_programs() {
  const char* const text = std::getenv("NINEBIT_GL_PROGRAMS");
  return text != nullptr ? std::atoi(text) : 60;
}

class LayerBits : public ::testing::TestWithParam<HardwareProfile> {};

TEST_P(LayerBits, RandomProgramsAreTheLibrarys) {
  const HardwareProfile& profile = GetParam();
  NINEBIT_GL_CONTEXT(context, profile);
  const int programs = number_of_programs();
  std::set<std::array<std::uint8_t, 4>> colors;
  for (int i = 0; i < programs; ++i) {
    Random random(kSeed, static_cast<std::uint64_t>(i));
    const CombinerState state = random_gl_state(random, profile);
    const auto program = compile(state, profile);
    ASSERT_TRUE(program) << program.error().message;
    const Fragments fragments = random_fragments(random, profile);
    set_combiners(state, profile);
    const auto drawn = draw(fragments, profile);
    const auto expected = compute(*program, profile, fragments);
    ASSERT_EQ(glGetError(), kNoError) << "program " << i;
    for (std::size_t k = 0; k < kFragments; ++k) {
      ASSERT_EQ(drawn[k], expected[k]) << profile.name << ", program " << i << ", fragment " << k;
    }
    colors.insert(drawn.begin(), drawn.end());
  }
  EXPECT_GT(colors.size(), 1000U);
}

INSTANTIATE_TEST_SUITE_P(Profiles, LayerBits, ::testing::ValuesIn(integer_profiles()), name_of_case);

}  // namespace
}  // namespace ninebit::test
