// The lit pass, over all colours and texels, against the formula in real numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/shadow/light_cookie.h"

namespace {

using namespace ninebit;

Program program_of(const HardwareProfile& profile) {
  return normalize(*light_cookie_state(profile), profile);
}

Rgba9 lit(const Program& program, int primary, int texel, int secondary) {
  RegisterFile registers;
  const auto code = [](int c) { return static_cast<s9>(c); };
  for (std::size_t c = 0; c < 3; ++c) {
    registers[Register::primary][c] = code(primary);
    registers[Register::texture0][c] = code(texel);
    registers[Register::secondary][c] = code(secondary);
  }
  return evaluate(program, registers);
}

// The largest and the mean difference to min(one, 6 · primary · texel), over all products that do not reach one.
struct Errors {
  double least = 0.0, largest = 0.0, mean_size = 0.0;
};
Errors errors_of(const HardwareProfile& profile) {
  const Program program = program_of(profile);
  const int one = profile.one.value;
  Errors errors;
  int count = 0;
  for (int p = 0; p <= one; ++p) {
    for (int t = 0; t <= one; ++t) {
      const double exact = static_cast<double>(kCookieScale * p * t) / one;
      const Rgba9 out = lit(program, p, t, 0);
      EXPECT_EQ(out[0], out[1]);
      EXPECT_EQ(out[0], out[2]);
      EXPECT_EQ(out[kAlpha], one);
      if (exact >= one + 1) {
        EXPECT_EQ(out[0], one) << p << ' ' << t;
        continue;
      }
      const double error = out[0] - std::min(exact, static_cast<double>(one));
      errors.least = std::min(errors.least, error);
      errors.largest = std::max(errors.largest, error);
      errors.mean_size += std::fabs(error);
      ++count;
    }
  }
  errors.mean_size /= count;
  return errors;
}

TEST(LightCookieCombiners, SixTimesTheProductWithinOneCode) {
  for (const HardwareProfile& profile : {profiles::geforce2, *find_profile("nv2a")}) {
    SCOPED_TRACE(profile.name);
    const Errors errors = errors_of(profile);
    EXPECT_GT(errors.least, -1.0);
    EXPECT_LT(errors.largest, 1.0);
    // Rounding to codes alone would give 1/4.
    EXPECT_LT(errors.mean_size, 0.3);
  }
}

// Seven bits and a sign: still within two of their codes.
TEST(LightCookieCombiners, FewerBitsLoseMore) {
  const Errors errors = errors_of(*find_profile("geforce256-8bit"));
  EXPECT_GT(errors.least, -2.0);
  EXPECT_LT(errors.largest, 2.0);
}

TEST(LightCookieCombiners, DarkTexelsStayDark) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    const Program program = program_of(profile);
    for (int p = 0; p <= profile.one.value; ++p) {
      if (profile.arithmetic.value != Arithmetic::integer) break;
      ASSERT_EQ(lit(program, p, 0, 0)[0], 0) << profile.name << ' ' << p;
      ASSERT_EQ(lit(program, 0, p, 0)[0], 0) << profile.name << ' ' << p;
    }
  }
}

TEST(LightCookieCombiners, AmbientLightIsAddedAndTheSumCut) {
  const Program program = program_of(profiles::geforce2);
  for (int p = 0; p <= 255; p += 5) {
    for (int t = 0; t <= 255; t += 3) {
      const int alone = lit(program, p, t, 0)[0];
      for (const int secondary : {1, 56, 200, 255}) {
        ASSERT_EQ(lit(program, p, t, secondary)[0], std::min(alone + secondary, 255)) << p << ' ' << t;
      }
    }
  }
}

TEST(LightCookieCombiners, TheLitPassIsTheFramesWithThisProgram) {
  const auto pass = light_cookie_pass({});
  ASSERT_TRUE(pass.ok());
  ASSERT_TRUE(pass->program.has_value());
  EXPECT_EQ(*pass->program, program_of(profiles::geforce2));
  EXPECT_EQ(pass->program->num_general_combiners, 2);
  EXPECT_EQ(pass->shade_model, ShadeModel::smooth);
  EXPECT_EQ(pass->depth_test.function, CompareFunction::equal);
  EXPECT_FALSE(pass->depth_test.write);
  EXPECT_TRUE(pass->stencil_test.enabled);
  EXPECT_EQ(pass->stencil_test.front.function, CompareFunction::equal);
  EXPECT_EQ(pass->stencil_test.front.reference, 0);
  EXPECT_FALSE(pass->alpha_test.enabled);
}

TEST(LightCookie, IsReadByLinearWithoutMipMaps) {
  EXPECT_EQ(kCookieSampler.min_filter, MinFilter::linear);
  EXPECT_EQ(kCookieSampler.mag_filter, MagFilter::linear);
  EXPECT_EQ(kCookieSampler.wrap_s, Wrap::clamp_to_edge);
  EXPECT_EQ(kCookieSampler.wrap_t, Wrap::clamp_to_edge);
}

}  // namespace
