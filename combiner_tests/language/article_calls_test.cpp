// The calls of "Index Cube Shadow Mapping in OpenGL using nVidia Register Combiners", as a GL program would make them.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "combiner_tests/language/index_comparison.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/fixed9.h"

using namespace ninebit::gl;  // NOLINT(google-build-using-namespace): how GL code is meant to meet these names

namespace {

// GL code as it stands in the article: no ninebit name in it.
void set_up_index_comparison() {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);

  // clang-format off
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_ZERO,             GL_UNSIGNED_INVERT_NV,   GL_RGB);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB,     GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO,             GL_EXPAND_NORMAL_NV,     GL_RGB);
  glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB,
                     GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV,
                     GL_SCALE_BY_FOUR_NV, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
  glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA,
                     GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV,
                     GL_NONE, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);

  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV,   GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV,   GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_C_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB,
                     GL_SPARE1_NV, GL_DISCARD_NV, GL_DISCARD_NV,
                     GL_SCALE_BY_FOUR_NV, GL_NONE, GL_TRUE, GL_FALSE, GL_FALSE);
  glCombinerOutputNV(GL_COMBINER1_NV, GL_ALPHA,
                     GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV,
                     GL_NONE, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);

  glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO,      GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE1_NV, GL_UNSIGNED_IDENTITY_NV, GL_BLUE);
  // clang-format on

  glEnable(GL_REGISTER_COMBINERS_NV);
}

using ninebit::CombinerState;
using ninebit::HardwareProfile;
using ninebit::Program;
using ninebit::Register;
using ninebit::RegisterFile;
using ninebit::Rgba9;
using ninebit::Scale;
namespace profiles = ninebit::profiles;

constexpr int shadow_alpha(const Program& program, const HardwareProfile& profile,
                           const std::array<std::uint8_t, 3>& polygon, const std::array<std::uint8_t, 3>& map) {
  RegisterFile registers;
  for (std::size_t c = 0; c < 3; ++c) {
    registers[Register::primary][c] = from_byte(profile, polygon[c]);
    registers[Register::texture0][c] = from_byte(profile, map[c]);
  }
  return evaluate(program, registers)[ninebit::kAlpha];
}

constexpr Program kProgram = normalize(ninebit::test::index_comparison(), profiles::geforce2);

// A difference of 2 becomes 8, squared and times four 256/255: just enough. One of 1 stays below: 64/255.
constexpr bool seen(std::array<std::uint8_t, 3> polygon, std::array<std::uint8_t, 3> map) {
  return shadow_alpha(kProgram, profiles::geforce2, polygon, map) > 0;
}
static_assert(!seen({10, 20, 30}, {10, 20, 30}));
static_assert(!seen({10, 20, 30}, {11, 20, 30}) && !seen({11, 20, 30}, {10, 20, 30}));
static_assert(!seen({10, 20, 30}, {10, 21, 30}) && !seen({10, 21, 30}, {10, 20, 30}));
static_assert(!seen({10, 20, 30}, {10, 20, 31}) && !seen({10, 20, 31}, {10, 20, 30}));
static_assert(seen({10, 20, 30}, {12, 20, 30}) && seen({12, 20, 30}, {10, 20, 30}));
static_assert(seen({10, 20, 30}, {10, 22, 30}) && seen({10, 22, 30}, {10, 20, 30}));
static_assert(seen({10, 20, 30}, {10, 20, 32}) && seen({10, 20, 32}, {10, 20, 30}));
static_assert(shadow_alpha(kProgram, profiles::geforce2, {0, 0, 2}, {0, 0, 0}) == 1);
static_assert(!seen({1, 1, 1}, {0, 0, 0}), "three differences of 1 give 192/255");

class ArticleCalls : public ::testing::Test {
 protected:
  ArticleCalls() : current_(context_) { set_up_index_comparison(); }

  const CombinerState& state() const { return context_.state(); }

  Context context_;

 private:
  CurrentContext current_;
};

TEST_F(ArticleCalls, RaiseNoErrorAndEnableTheCombiners) {
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
  EXPECT_TRUE(context_.register_combiners_enabled());
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_TRUE);
}

TEST_F(ArticleCalls, SetEveryField) {
  EXPECT_EQ(state(), ninebit::test::index_comparison());
}

TEST_F(ArticleCalls, CompileToTheProgramKnownAtCompileTime) {
  const auto program = compile(state(), context_.profile());
  ASSERT_TRUE(program.ok()) << program.error().message;
  EXPECT_TRUE(*program == kProgram);
}

TEST_F(ArticleCalls, ShadowADifferenceOfTwoInAnyChannelAndMissOneOfOne) {
  const auto program = compile(state(), context_.profile());
  ASSERT_TRUE(program.ok());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (int low = 0; low <= 253; ++low) {
      std::array<std::uint8_t, 3> a{100, 100, 100}, b = a, c = a;
      a[channel] = static_cast<std::uint8_t>(low);
      b[channel] = static_cast<std::uint8_t>(low + 1);
      c[channel] = static_cast<std::uint8_t>(low + 2);
      EXPECT_EQ(shadow_alpha(*program, context_.profile(), a, b), 0);
      EXPECT_EQ(shadow_alpha(*program, context_.profile(), b, a), 0);
      EXPECT_EQ(shadow_alpha(*program, context_.profile(), a, c), 1);
      EXPECT_EQ(shadow_alpha(*program, context_.profile(), c, a), 1);
      EXPECT_EQ(shadow_alpha(*program, context_.profile(), c, c), 0);
    }
  }
}

// How many ordered pairs of different indices, all multiples of the step, come out lit.
int false_matches(const CombinerState& state, const HardwareProfile& profile, int step) {
  const auto program = compile(state, profile);
  if (!program.ok()) {
    ADD_FAILURE() << program.error().message;
    return -1;
  }
  int count = 0;
  for (int a = 0; a < 256; a += step) {
    for (int b = 0; b < 256; b += step) {
      if (a == b) continue;
      const auto polygon = static_cast<std::uint8_t>(a), map = static_cast<std::uint8_t>(b);
      count += shadow_alpha(*program, profile, {polygon, 0, 0}, {map, 0, 0}) == 0 ? 1 : 0;
    }
  }
  return count;
}

constexpr std::array kSteps{1, 2, 3, 4, 8, 16};
using Ladder = std::array<int, kSteps.size()>;

Ladder ladder(const CombinerState& state, const HardwareProfile& profile) {
  Ladder counts{};
  for (std::size_t i = 0; i < kSteps.size(); ++i) counts[i] = false_matches(state, profile, kSteps[i]);
  return counts;
}

TEST_F(ArticleCalls, GiveTheLadderOfTheGeForce2) {
  EXPECT_EQ(ladder(state(), profiles::geforce2), (Ladder{510, 0, 0, 0, 0, 0}));
}

TEST_F(ArticleCalls, GiveTheLadderOfEarlyNarrowingToNearest) {
  HardwareProfile profile = profiles::geforce2_early_truncation;
  profile.general_narrowing.value = ninebit::Narrowing::nearest_halves_up;
  EXPECT_EQ(ladder(state(), profile), (Ladder{1018, 254, 0, 0, 0, 0}));
}

TEST_F(ArticleCalls, GiveTheLadderOfEarlyTruncation) {
  EXPECT_EQ(ladder(state(), profiles::geforce2_early_truncation), (Ladder{1524, 254, 170, 0, 0, 0}));
}

TEST_F(ArticleCalls, GiveTheLadderOfAnEightBitCard) {
  EXPECT_EQ(ladder(state(), profiles::geforce256_8bit), (Ladder{1272, 254, 86, 0, 0, 0}));
}

TEST_F(ArticleCalls, NeedBothScalings) {
  CombinerState unscaled = state();
  unscaled.general[0].rgb.out.scale = Scale::none;
  unscaled.general[1].rgb.out.scale = Scale::none;
  EXPECT_EQ(ladder(unscaled, profiles::geforce2), (Ladder{7440, 1736, 830, 372, 62, 0}));
}

}  // namespace
