// A trace: its codes against the evaluator, its steps against the equations, its ideal column against evaluate_real,
// and the article's fragment number by number.
#include "ninebit/combiner/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kTraceSeed = 0x72AC;
constexpr std::uint64_t kTraceCases = kSlowBuild ? 400 : 3000;

// The events of a run, so that one in which nothing happens fails.
struct TracesSeen {
  std::uint64_t outputs = 0, dropped = 0, cut = 0, final_dropped = 0, final_cut = 0, muxes = 0, differing_muxes = 0;
  std::uint64_t dots = 0, dead_portions = 0, early = 0, halves = 0;
};

double scale_of(Scale scale) {
  return scale == Scale::by_one_half ? 0.5 : scale == Scale::none ? 1 : scale == Scale::by_two ? 2 : 4;
}

// In integers, whatever the scale: doubled.
std::int64_t twice(double units) {
  const auto result = static_cast<std::int64_t>(2 * units);
  EXPECT_EQ(static_cast<double>(result), 2 * units) << "neither a whole number nor a half";
  return result;
}

void check_output(const Datapath& d, const PortionOutput& state, const TracedWide& wide, const TracedOutput& out,
                  TracesSeen& seen) {
  const std::int64_t one = d.one;
  ASSERT_EQ(out.wide.units, wide.units);
  ASSERT_EQ(out.wide.ideal, wide.ideal);
  ASSERT_EQ(out.biased.units, wide.units - (state.bias == Bias::none ? 0 : d.half * d.one));
  ASSERT_EQ(out.scaled.units, out.biased.units * scale_of(state.scale));
  ASSERT_EQ(out.early.has_value(), d.narrowing_point == NarrowingPoint::before_scale);
  // written = scaled - dropped - cut, exactly.
  ASSERT_EQ(twice(out.scaled.units), twice(out.dropped.units) + 2 * one * out.narrowed.code);
  ASSERT_EQ(out.narrowed.code, out.cut.code + out.written.code);
  if (out.early) {
    ASSERT_LT(std::abs(out.biased.units - out.early->code * static_cast<double>(one)), static_cast<double>(one));
  } else {
    ASSERT_LT(std::abs(out.dropped.units), static_cast<double>(one));
    const bool toward_zero = d.general_narrowing == Narrowing::toward_zero;
    if (toward_zero) {
      ASSERT_GE(out.dropped.units * out.scaled.units, 0);
    } else {
      ASSERT_LE(std::abs(out.dropped.units), (d.one + 1) / 2.0);
    }
  }
  const bool in_range = out.narrowed.code >= d.lowest_output && out.narrowed.code <= d.one;
  ASSERT_EQ(out.cut.code == 0, in_range);
  ASSERT_EQ(out.written.real, out.written.code / static_cast<double>(one));
  ASSERT_EQ(out.scaled.real, out.scaled.units / static_cast<double>(one * one));
  ++seen.outputs;
  seen.dropped += out.dropped.units != 0 ? 1U : 0U;
  seen.cut += out.cut.code != 0 ? 1U : 0U;
  seen.early += out.early ? 1U : 0U;
  seen.halves += twice(out.scaled.units) % 2 != 0 ? 1U : 0U;
}

// The steps of one portion of a program of integer arithmetic, from its mapped inputs on.
void check_portion(const Datapath& d, const TracedStage& stage, const TracedPortion& portion, TracesSeen& seen) {
  const PortionOutput& out = portion.state.out;
  ASSERT_EQ(portion.channel.empty(), !is_live(out));
  double dot_ab = 0, dot_cd = 0;
  for (const TracedChannel& channel : portion.channel) {
    const auto& in = channel.input;
    ASSERT_EQ(channel.ab_product.units, in[0].mapped.code * in[1].mapped.code);
    ASSERT_EQ(channel.cd_product.units, in[2].mapped.code * in[3].mapped.code);
    dot_ab += channel.ab_product.units;
    dot_cd += channel.cd_product.units;
  }
  for (const TracedChannel& channel : portion.channel) {
    ASSERT_EQ(channel.ab.units, out.ab_dot_product ? dot_ab : channel.ab_product.units);
    ASSERT_EQ(channel.cd.units, out.cd_dot_product ? dot_cd : channel.cd_product.units);
    if (channel.ab_output) check_output(d, out, channel.ab, *channel.ab_output, seen);
    if (channel.cd_output) check_output(d, out, channel.cd, *channel.cd_output, seen);
    ASSERT_EQ(channel.third_output.has_value(), out.sum != Register::discard);
    if (!channel.third_output) continue;
    const double third = !out.mux_sum     ? channel.ab.units + channel.cd.units
                         : stage.takes_cd ? channel.cd.units
                                          : channel.ab.units;
    ASSERT_EQ(channel.third.units, third);
    check_output(d, out, channel.third, *channel.third_output, seen);
  }
  seen.dead_portions += portion.channel.empty() ? 1U : 0U;
  seen.dots += out.ab_dot_product || out.cd_dot_product ? 1U : 0U;
  if (!out.mux_sum) return;
  ++seen.muxes;
  seen.differing_muxes += stage.takes_cd != stage.ideal_takes_cd ? 1U : 0U;
}

void check_final(const Program& program, const Trace& t, TracesSeen& seen) {
  const Datapath& d = program.datapath;
  const RegisterFile& registers = t.registers().codes;
  for (std::size_t c = 0; c < 3; ++c) {
    const TracedFinalChannel& f = t.final_combiner.rgb[c];
    const auto in = [&](std::size_t v) { return f.input[v].mapped.code; };
    ASSERT_EQ(f.e_times_f_product.units, in(4) * in(5));
    ASSERT_EQ(f.e_times_f_product.units, f.e_times_f_dropped.units + f.e_times_f.code * d.one);
    const auto part = [&](Register r, bool inverted) {
      const int positive = std::max<int>(registers[r][c], 0);
      return inverted ? d.one - positive : positive;
    };
    ASSERT_EQ(f.color_sum_unclamped.code, part(Register::spare0, program.color_sum_invert_spare0) +
                                              part(Register::secondary, program.color_sum_invert_secondary));
    ASSERT_EQ(f.color_sum.code,
              program.color_sum_clamp ? std::min(f.color_sum_unclamped.code, d.one) : f.color_sum_unclamped.code);
    ASSERT_EQ(f.a_times_b.units, in(0) * in(1));
    ASSERT_EQ(f.one_minus_a_times_c.units, (d.one - in(0)) * in(2));
    ASSERT_EQ(f.mix.units, f.a_times_b.units + f.one_minus_a_times_c.units);
    ASSERT_EQ(f.mix.units, f.dropped.units + f.narrowed.code * d.one);
    ASSERT_LT(std::abs(f.dropped.units), d.one);
    ASSERT_EQ(f.sum.code, f.narrowed.code + in(3));
    ASSERT_EQ(f.sum.code, f.cut.code + f.written.code);
    ASSERT_EQ(f.written.code, std::clamp(f.sum.code, 0, d.one));
    ASSERT_EQ(f.written.code, t.color[c]);
    seen.final_dropped += f.dropped.units != 0 || f.e_times_f_dropped.units != 0 ? 1U : 0U;
    seen.final_cut += f.cut.code != 0 ? 1U : 0U;
  }
  const TracedFinal& f = t.final_combiner;
  ASSERT_EQ(f.g.mapped.code, f.alpha_cut.code + f.alpha.code);
  ASSERT_EQ(f.alpha.code, t.color[kAlpha]);
}

// Codes after each stage and the colour are the evaluator's; the ideal column is evaluate_real's, and so is the real
// one where the arithmetic is not integer.
void check_against_evaluators(const Program& program, const HardwareProfile& profile, const RegisterFile& initial,
                              const Trace& t) {
  const RealEvaluation ideal = evaluate_real(program, initial);
  const Arithmetic arithmetic = program.datapath.arithmetic;
  const RealEvaluation real = evaluate_real(program, initial, arithmetic);
  ASSERT_EQ(t.before.codes, initial);
  ASSERT_EQ(t.stage.size(), static_cast<std::size_t>(program.num_general_combiners));
  for (std::size_t i = 0; i < t.stage.size(); ++i) {
    Program first_stages = program;
    first_stages.num_general_combiners = static_cast<int>(i) + 1;
    ASSERT_EQ(t.stage[i].after.codes, evaluate_fragment(first_stages, initial).registers) << "stage " << i;
    ASSERT_EQ(t.stage[i].after.ideal.value, ideal.stage[i].after.value);
    if (arithmetic != Arithmetic::integer) {
      ASSERT_EQ(t.stage[i].after.real.value, real.stage[i].after.value);
    }
  }
  ASSERT_EQ(t.color, evaluate_fragment(program, initial).color);
  for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(t.bytes[c], to_byte(profile, t.color[c]));
  for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(t.final_combiner.rgb[c].written.ideal, ideal.color[c]);
  ASSERT_EQ(t.final_combiner.alpha.ideal, ideal.color[kAlpha]);
}

TEST(Trace, EveryStepOfRandomProgramsOfCodes) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  TracesSeen seen;
  for (std::uint64_t index = 0; index < kTraceCases; ++index) {
    Random random(kTraceSeed, index);
    const auto profiles = integer_profiles();
    const HardwareProfile profile = index % 2 == 0 ? profiles[index / 2 % profiles.size()] : random_profile(random);
    const CombinerState state = random_state(random, profile);
    const Program program = normalize(state, profile);
    const RegisterFile initial = random_registers(random, profile);
    const Trace t = trace(program, profile, initial);
    check_against_evaluators(program, profile, initial, t);
    for (const TracedStage& stage : t.stage) {
      check_portion(program.datapath, stage, stage.rgb, seen);
      check_portion(program.datapath, stage, stage.alpha, seen);
    }
    check_final(program, t, seen);
    ASSERT_FALSE(HasFailure()) << "case " << index << '\n' << describe(state, profile) << describe(initial);
  }
  EXPECT_GT(seen.outputs, 10 * kTraceCases);
  EXPECT_GT(seen.dropped, seen.outputs / 8);
  EXPECT_GT(seen.cut, seen.outputs / 20);
  for (const std::uint64_t count :
       {seen.final_dropped, seen.final_cut, seen.muxes, seen.dots, seen.dead_portions, seen.early, seen.halves}) {
    EXPECT_GT(count, kTraceCases / 10);
  }
  EXPECT_TRUE(seen.differing_muxes > 0 || kSlowBuild) << "rare, so that it is not asked of a small run";
}

// A product of two floats, or a sum, is rounded once.
TEST(Trace, EveryStepOfRandomProgramsOfNumbers) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (std::uint64_t index = 0; index < kTraceCases / 6; ++index) {
    Random random(kTraceSeed + 1, index);
    const HardwareProfile& profile = index % 2 == 0 ? profiles::ideal : profiles::float_shader;
    const CombinerState state = random_state(random, profile);
    const Program program = normalize(state, profile);
    const RegisterFile initial = random_registers(random, profile);
    const Trace t = trace(program, profile, initial);
    check_against_evaluators(program, profile, initial, t);
    const RealEvaluation real = evaluate_real(program, initial, profile.arithmetic.value);
    const auto near = [&](double traced, double expected) {
      // Exactly rounded doubles of exact numbers, multiplied or added, may be off by a last bit or two.
      if (profile.arithmetic.value == Arithmetic::float32) {
        ASSERT_EQ(traced, expected);
      }
      ASSERT_NEAR(traced, expected, 1e-14);
    };
    for (std::size_t i = 0; i < t.stage.size(); ++i) {
      ASSERT_EQ(t.stage[i].takes_cd, real.stage[i].takes_cd);
      for (std::size_t c = 0; c < t.stage[i].rgb.channel.size(); ++c) {
        const TracedChannel& channel = t.stage[i].rgb.channel[c];
        const RealChannel& expected = real.stage[i].rgb[c];
        for (std::size_t v = 0; v < 4; ++v) ASSERT_EQ(channel.input[v].mapped.real, expected.input[v]);
        ASSERT_EQ(channel.ab.real, expected.ab.wide);
        if (!t.stage[i].rgb.state.out.ab_dot_product) near(channel.ab_product.real, expected.ab.wide);
        if (!channel.third_output) continue;
        const TracedOutput& out = *channel.third_output;
        ASSERT_EQ(out.scaled.real, expected.third.scaled);
        ASSERT_EQ(out.written.real, expected.third.written);
        ASSERT_EQ(out.cut.real, out.scaled.real - out.written.real);
        ASSERT_EQ(out.dropped.real, 0);
        ASSERT_EQ(out.dropped.units, 0);
        near(out.biased.real * scale_of(t.stage[i].rgb.state.out.scale), out.scaled.real);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const TracedFinalChannel& f = t.final_combiner.rgb[c];
      near(f.e_times_f_product.real, real.final_combiner.e_times_f[c]);
      if (profile.arithmetic.value == Arithmetic::float32) {
        ASSERT_EQ(static_cast<float>(f.mix.real + f.input[3].mapped.real),
                  static_cast<float>(real.final_combiner.unclamped[c]));
      }
      near(f.sum.real, real.final_combiner.unclamped[c]);
      if (program.color_sum_clamp) continue;
      near(f.color_sum_unclamped.real, real.final_combiner.color_sum[c]);
    }
    ASSERT_FALSE(HasFailure()) << "case " << index << '\n' << describe(state, profile) << describe(initial);
  }
}

Trace article_trace(int primary, int texture, const HardwareProfile& profile = profiles::geforce2) {
  RegisterFile registers;
  registers[Register::primary] = codes(primary, 0, 0, 0);
  registers[Register::texture0] = codes(texture, 0, 0, 255);
  return trace(normalize(index_comparison(), profile), profile, registers);
}

TEST(Trace, TheArticlesDifferenceOfTwoSurvives) {
  const Trace t = article_trace(102, 100);
  const TracedOutput& difference = *t.stage[0].rgb.channel[kRed].third_output;
  EXPECT_EQ(difference.wide.units, 2 * 255);
  EXPECT_EQ(difference.scaled.units, 2040);
  EXPECT_EQ(difference.dropped.units, 0);
  EXPECT_EQ(difference.written.code, 8);
  EXPECT_EQ(difference.written.ideal, 8 / 255.0);
  const TracedOutput& square = *t.stage[1].rgb.channel[kBlue].ab_output;
  EXPECT_EQ(t.stage[1].rgb.channel[kRed].ab_product.units, 64);
  EXPECT_EQ(t.stage[1].rgb.channel[kBlue].ab_product.units, 0);
  EXPECT_EQ(square.wide.units, 64);
  EXPECT_EQ(square.scaled.units, 256);
  EXPECT_EQ(square.narrowed.code, 1);
  EXPECT_EQ(square.dropped.units, 1);
  EXPECT_EQ(square.cut.code, 0);
  EXPECT_EQ(square.written.real, 1 / 255.0);
  EXPECT_EQ(square.written.ideal, 256 / 65025.0);
  EXPECT_EQ(t.bytes[kAlpha], 1);
}

TEST(Trace, TheArticlesDifferenceOfOneIsTruncated) {
  const Trace t = article_trace(101, 100);
  EXPECT_EQ(t.stage[0].rgb.channel[kRed].third_output->written.code, 4);
  const TracedOutput& square = *t.stage[1].rgb.channel[kBlue].ab_output;
  EXPECT_EQ(square.wide.units, 16);
  EXPECT_EQ(square.scaled.units, 64);
  EXPECT_EQ(square.dropped.units, 64);
  EXPECT_EQ(square.dropped.real, 64 / 65025.0);
  EXPECT_EQ(square.written.code, 0);
  EXPECT_EQ(square.written.ideal, 64 / 65025.0);
  EXPECT_EQ(t.bytes[kAlpha], 0);
}

// The rival of rule 7 loses the difference of two before it is scaled.
TEST(Trace, EarlyTruncationShowsWhereItDrops) {
  const Trace t = article_trace(102, 100, profiles::geforce2_early_truncation);
  const TracedOutput& square = *t.stage[1].rgb.channel[kBlue].ab_output;
  ASSERT_TRUE(square.early.has_value());
  EXPECT_EQ(square.early->code, 0);
  EXPECT_EQ(square.scaled.units, 256);
  EXPECT_EQ(square.dropped.units, 256);
  EXPECT_EQ(square.written.code, 0);
}

TEST(Trace, SaysWhatTakesNoPart) {
  const Trace t = article_trace(10, 12);
  EXPECT_TRUE(t.stage[0].alpha.channel.empty());
  EXPECT_TRUE(t.stage[0].rgb.uses_ab && t.stage[0].rgb.uses_cd);
  EXPECT_TRUE(t.stage[1].rgb.uses_ab);
  EXPECT_FALSE(t.stage[1].rgb.uses_cd);
  EXPECT_FALSE(t.stage[1].rgb.channel[0].cd_output || t.stage[1].rgb.channel[0].third_output);
  EXPECT_FALSE(t.final_combiner.uses_e_times_f || t.final_combiner.uses_color_sum);
}

// The mux of NVIDIA's depth comparison: half of a code decides, which real numbers decide otherwise.
TEST(Trace, AMuxSeesOtherAlphaThanTheIdeal) {
  CombinerState state = silent_state(2);
  state.general[0].alpha = {alpha_of(Register::texture1), kOneAlpha,
                            alpha_of(Register::texture0, InputMapping::unsigned_invert), kOneAlpha,
                            sum_to(Register::spare0, Scale::none, Bias::by_negative_one_half)};
  state.general[1].alpha = {kOneAlpha, kOneAlpha, kZeroAlpha, kZeroAlpha, mux_to(Register::spare1)};
  RegisterFile registers;
  registers[Register::texture0] = registers[Register::texture1] = codes(0, 0, 0, 77);
  const Trace t = trace(normalize(state, profiles::geforce2), profiles::geforce2, registers);
  EXPECT_EQ(t.stage[1].spare0_alpha.code, 127);
  EXPECT_EQ(t.stage[1].spare0_alpha.ideal, 0.5);
  EXPECT_FALSE(t.stage[1].takes_cd);
  EXPECT_TRUE(t.stage[1].ideal_takes_cd);
  EXPECT_EQ(t.stage[1].alpha.channel.at(0).third_output->written.code, 255);
  EXPECT_EQ(t.stage[1].alpha.channel.at(0).third_output->written.ideal, 0.0);
}

TEST(Trace, AMuxByTheLowestBitIsToldSo) {
  CombinerState state = silent_state(1);
  state.mux_by_lowest_bit = true;
  state.general[0].alpha = {alpha_of(Register::primary), kOneAlpha, alpha_of(Register::secondary), kOneAlpha,
                            mux_to(Register::spare1)};
  for (const HardwareProfile& profile : {profiles::nv2a, profiles::ideal, profiles::float_shader}) {
    for (const int select : {-3, 0, 1, 128, 129, 255}) {
      RegisterFile registers;
      registers[Register::primary] = codes(0, 0, 0, 10);
      registers[Register::secondary] = codes(0, 0, 0, 20);
      registers[Register::spare0][kAlpha] = static_cast<s9>(select);
      const Trace t = trace(normalize(state, profile), profile, registers);
      const bool odd = select > 0 && select % 2 == 1;
      EXPECT_TRUE(t.stage[0].mux_by_lowest_bit);
      EXPECT_EQ(t.stage[0].takes_cd, odd) << profile.name << select;
      EXPECT_EQ(t.stage[0].ideal_takes_cd, odd) << profile.name << select;
      EXPECT_EQ(t.stage[0].alpha.channel.at(0).third_output->written.code, odd ? 20 : 10) << profile.name << select;
    }
  }
}

TEST(Trace, BlueGoesToAlphaInTheRegistersAfterTheStage) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary), kOne, kZero, kZero, ab_to(Register::spare1, Scale::by_two)});
  state.general[0].rgb.out.ab_blue_to_alpha = true;
  RegisterFile registers;
  registers[Register::primary] = codes(10, 20, 30, 40);
  for (const HardwareProfile& profile : {profiles::nv2a, profiles::ideal, profiles::float_shader}) {
    const Trace t = trace(normalize(state, profile), profile, registers);
    EXPECT_TRUE(t.stage[0].rgb.state.out.ab_blue_to_alpha);
    EXPECT_EQ(t.stage[0].after.codes[Register::spare1], codes(20, 40, 60, 60)) << profile.name;
    EXPECT_NEAR(t.stage[0].after.real[Register::spare1][kAlpha], 60 / 255.0, 1e-7) << profile.name;
    EXPECT_EQ(t.stage[0].after.ideal[Register::spare1][kAlpha], 60 / 255.0) << profile.name;
  }
}

}  // namespace
}  // namespace ninebit::test
