// Every input of the general combiners' arithmetic, by the reference, the oracle and independent formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"

namespace ninebit::test {
namespace {

constexpr std::array<std::pair<Scale, Bias>, 6> kScaleBias{{{Scale::none, Bias::none},
                                                            {Scale::by_two, Bias::none},
                                                            {Scale::by_four, Bias::none},
                                                            {Scale::by_one_half, Bias::none},
                                                            {Scale::none, Bias::by_negative_one_half},
                                                            {Scale::by_two, Bias::by_negative_one_half}}};

// The mapping table of the extension, in codes.
int mapped_by_table(const HardwareProfile& p, InputMapping mapping, int e) {
  const int positive = e < 0 ? 0 : e;
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return positive;
    case InputMapping::unsigned_invert:
      return p.one - positive;
    case InputMapping::expand_normal:
      return 2 * positive - p.expand_offset;
    case InputMapping::expand_negate:
      return -2 * positive + p.expand_offset;
    case InputMapping::half_bias_normal:
      return positive - p.half;
    case InputMapping::half_bias_negate:
      return -positive + p.half;
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      return -e;
  }
  return 0;
}

bool is_code(oracle::Fraction x, const HardwareProfile& p, int code) {
  return x.num * p.one == code * x.den;
}

// Bias, scale, narrowing and clamp in integer units of 1 / (2 one²), for profiles that narrow after scaling.
int output_by_integers(const HardwareProfile& p, Scale scale, Bias bias, int wide) {
  const int biased = wide - (bias == Bias::none ? 0 : p.half * p.one);
  const int scaled = biased * (scale == Scale::by_one_half ? 1
                               : scale == Scale::none      ? 2
                               : scale == Scale::by_two    ? 4
                                                           : 8);
  const int unit = 2 * p.one;
  const int cut = std::abs(scaled) / unit * (scaled < 0 ? -1 : 1);
  int code = cut;
  if (p.general_narrowing == Narrowing::nearest_halves_up) {
    const int remainder = scaled - cut * unit;
    if (2 * remainder >= unit) code = cut + 1;
    if (2 * remainder < -unit) code = cut - 1;
  }
  return std::clamp(code, p.lowest.value, p.one.value);
}

std::vector<HardwareProfile> profiles_and_rivals() {
  std::vector<HardwareProfile> all = integer_profiles();
  HardwareProfile rival = profiles::geforce2;
  rival.name = "geforce2, lowest -256, expand 2v - 256";
  rival.lowest.value = -256;
  rival.expand_offset.value = 256;
  all.push_back(rival);
  rival = profiles::geforce2_early_truncation;
  rival.name = "geforce2, early, to nearest";
  rival.general_narrowing.value = Narrowing::nearest_halves_up;
  all.push_back(rival);
  return all;
}

TEST(GeneralArithmetic, EveryMappingOfEveryRegisterValue) {
  int cases = 0;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const Datapath d = datapath_of(p);
    for (const InputMapping mapping : kInputMappings) {
      for (int e = p.lowest; e <= p.one; ++e, ++cases) {
        const int by_table = mapped_by_table(p, mapping, e);
        ASSERT_TRUE(is_code(oracle::mapped(p, mapping, oracle::real(p, e)), p, by_table)) << p.name << ' ' << e;
        ASSERT_EQ(reference::map_input(d, mapping, e), by_table) << p.name << ' ' << name_of(mapping) << ' ' << e;
      }
    }
  }
  EXPECT_EQ(cases, 8 * (4 * 511 + 255 + 512));
}

TEST(GeneralArithmetic, EveryMappingOfEveryRegisterValueInARunningProgram) {
  for (const HardwareProfile& p : integer_profiles()) {
    for (const InputMapping mapping : kInputMappings) {
      CombinerState state = silent_state(1);
      state.general[0].rgb.a = rgb_of(Register::primary, mapping);
      state.general[0].rgb.b = kOne;
      state.general[0].rgb.out.ab = Register::spare1;
      state.general[0].alpha.a = blue_of(Register::primary, mapping);
      state.general[0].alpha.b = kOneAlpha;
      state.general[0].alpha.out.ab = Register::spare1;
      for (int e = p.lowest; e <= p.one; ++e) {
        RegisterFile registers;
        registers[Register::primary] = codes(e, e, e, 7);
        const RegisterFile after = judged(state, p, registers).registers;
        const int expected = std::clamp(mapped_by_table(p, mapping, e), p.lowest.value, p.one.value);
        ASSERT_EQ(after[Register::spare1], codes(expected, expected, expected, expected)) << name_of(mapping) << e;
      }
    }
  }
}

TEST(GeneralArithmetic, EveryProductOfTwoRegisterValues) {
  std::int64_t cases = 0;
  for (const HardwareProfile& p : integer_profiles()) {
    const Datapath d = datapath_of(p);
    for (const auto& [scale, bias] : kScaleBias) {
      for (int a = p.lowest; a <= p.one; ++a) {
        for (int b = p.lowest; b <= p.one; ++b, ++cases) {
          const oracle::Fraction product = oracle::times(oracle::real(p, a), oracle::real(p, b));
          const int expected = oracle::general_output(p, scale, bias, product);
          const int actual = reference::combiner_output(d, scale, bias, reference::mul(a, b));
          ASSERT_EQ(actual, expected) << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << a << ' '
                                      << b;
          if (p.narrowing_point == NarrowingPoint::after_scale) {
            ASSERT_EQ(output_by_integers(p, scale, bias, a * b), expected) << p.name << ' ' << a << ' ' << b;
          }
        }
      }
    }
  }
  EXPECT_EQ(cases, 6 * (3 * 511 * 511 + 255 * 255));
}

TEST(GeneralArithmetic, EveryWideValueThatTwoDotProductsCanReach) {
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const Datapath d = datapath_of(p);
    const int most = 6 * p.lowest * p.lowest;
    for (const auto& [scale, bias] : kScaleBias) {
      for (int wide = -most; wide <= most; ++wide) {
        const int expected = oracle::general_output(p, scale, bias, {wide, p.one * p.one});
        ASSERT_EQ(reference::combiner_output(d, scale, bias, wide), expected)
            << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << wide;
      }
    }
  }
}

// Every wide value up to the point where all scales saturate, through the SIMD code: the dot product of (q, r, s) with
// (1, 1, 1 code) is 255 q + 255 r + s.
TEST(GeneralArithmetic, EveryUnsaturatedWideValueOnEverySimdTarget) {
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const HardwareProfile& p : profiles_and_rivals()) {
    for (const auto& [scale, bias] : kScaleBias) {
      CombinerState state = silent_state(1);
      Portion& rgb = state.general[0].rgb;
      rgb.a = rgb_of(Register::primary, InputMapping::signed_identity);
      rgb.b = rgb_of(Register::secondary, InputMapping::signed_identity);
      rgb.out.ab = Register::spare1;
      rgb.out.ab_dot_product = true;
      rgb.out.scale = scale;
      rgb.out.bias = bias;
      const Result<Program> program = compile(state, p);
      ASSERT_TRUE(program.ok());
      const int one = p.one;
      const int most = 2 * one * one + one - 1;
      std::vector<s9> expected(static_cast<std::size_t>(2 * most + 1));
      for (int wide = -most; wide <= most; ++wide) {
        expected[static_cast<std::size_t>(wide + most)] =
            static_cast<s9>(oracle::general_output(p, scale, bias, {wide, one * one}));
      }
      for (const std::int64_t target : simd_targets()) {
        const OnTarget on_target(target);
        for (int first = -most; first <= most; first += static_cast<int>(kBatchSize)) {
          const std::size_t count = std::min(kBatchSize, static_cast<std::size_t>(most - first + 1));
          for (std::size_t i = 0; i < count; ++i) {
            const int wide = first + static_cast<int>(i);
            const int q = std::clamp(wide / one, -one, one);
            const int r = std::clamp(wide / one - q, -one, one);
            const int s = wide - one * (q + r);
            const int values[3] = {q, r, s};
            for (int c = 0; c < 3; ++c) {
              (*batch)(Register::primary, c)[i] = static_cast<s9>(values[c]);
              (*batch)(Register::secondary, c)[i] = static_cast<s9>(c == 2 ? 1 : one);
            }
          }
          evaluate(*program, *batch, count, *out);
          for (int c = 0; c < 3; ++c) {
            const s9* const from = expected.data() + (first + most);
            const s9* const actual = (*batch)(Register::spare1, c);
            ASSERT_TRUE(std::equal(from, from + count, actual))
                << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << " near " << first << " on "
                << simd_target_name(target);
          }
        }
        ASSERT_TRUE(on_target.ran()) << simd_target_name(target);
      }
    }
  }
}

TEST(GeneralArithmetic, MuxOfEverySpare0Alpha) {
  for (const HardwareProfile& p : integer_profiles()) {
    CombinerState state = silent_state(1);
    Portion& rgb = state.general[0].rgb;
    rgb.a = rgb_of(Register::primary);
    rgb.b = rgb.d = kOne;
    rgb.c = rgb_of(Register::secondary);
    rgb.out.sum = Register::spare1;
    rgb.out.mux_sum = true;
    state.general[0].alpha = rgb;
    Portion& alpha = state.general[0].alpha;
    alpha.a.usage = alpha.b.usage = alpha.c.usage = alpha.d.usage = ComponentUsage::alpha;
    for (int select = p.lowest; select <= p.one; ++select) {
      RegisterFile registers;
      registers[Register::primary] = codes(1, 2, 3, 4);
      registers[Register::secondary] = codes(5, 6, 7, 8);
      registers[Register::spare0][kAlpha] = static_cast<s9>(select);
      const Rgba9 expected = registers[select >= p.half ? Register::secondary : Register::primary];
      ASSERT_EQ(judged(state, p, registers).registers[Register::spare1], expected) << p.name << ' ' << select;
    }
  }
}

TEST(GeneralArithmetic, TheReferenceRunsAtCompileTime) {
  constexpr auto result = [] {
    CombinerState state;
    state.general[0].rgb.a = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.general[0].rgb.b = {Register::primary, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.final_combiner.a = {};
    state.final_combiner.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.final_combiner.c = {};
    RegisterFile registers;
    registers[Register::texture0] = Rgba9{255, 128, 100, 0};
    registers[Register::primary] = Rgba9{77, 128, 100, 33};
    return evaluate(normalize(state, profiles::geforce2), registers);
  }();
  // 128 · 128 / 255 = 64.25 and 100 · 100 / 255 = 39.2.
  static_assert(result == Rgba9{77, 64, 39, 33});
  EXPECT_EQ(result, codes(77, 64, 39, 33));
}

}  // namespace
}  // namespace ninebit::test
