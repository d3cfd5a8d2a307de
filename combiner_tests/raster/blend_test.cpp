// Blending in bytes: the measured pair over all inputs (rule 19), all factors and equations, the target's part in it.
#include "src/raster/fragment/blend.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/fragment_support.h"

namespace ninebit::test {
namespace {

constexpr Blend kOver{true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};

// By hand, a·s + (255 − a)·d over 255: 100.392 and 100.608 lie on both sides of a half.
TEST(Blend, RoundsTheSumOnceToNearest) {
  struct Row {
    std::uint8_t source, destination, alpha, result;
  };
  for (const Row& row : {Row{255, 0, 128, 128}, Row{0, 255, 128, 127}, Row{100, 200, 255, 100}, Row{100, 200, 0, 200},
                         Row{1, 0, 127, 0}, Row{1, 0, 128, 1}, Row{3, 1, 63, 1}, Row{3, 1, 64, 2},
                         // Two products rounded apart would give 1 + 1 and 0 + 0.
                         Row{1, 1, 128, 1}, Row{1, 1, 127, 1}, Row{200, 100, 1, 100}, Row{255, 100, 1, 101}}) {
    const ColorBytes result = blend(kOver, {row.source, row.source, row.source, row.alpha},
                                    {row.destination, row.destination, row.destination, 9});
    EXPECT_EQ(result[0], row.result) << int{row.source} << ' ' << int{row.destination} << ' ' << int{row.alpha};
    EXPECT_EQ(result[1], row.result);
    EXPECT_EQ(result[2], row.result);
  }
}

// All 2^24 triples of source, destination and alpha: the byte that lies within half a step of the sum.
TEST(Blend, EverySourceDestinationAndAlpha) {
  const int step = kSlowBuild ? 5 : 1;
  std::uint64_t wrong = 0;
  for (int alpha = 0; alpha < 256; alpha += step) {
    for (int s = 0; s < 256; s += step) {
      for (int d = 0; d < 256; d += step) {
        const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
        const ColorBytes result =
            blend(kOver, {byte(s), byte(d), byte(255 - s), byte(alpha)}, {byte(d), byte(s), byte(d), byte(s)});
        const auto is_near = [&](std::uint8_t value, int source, int destination) {
          return std::abs(255 * value - (alpha * source + (255 - alpha) * destination)) <= 127;
        };
        const bool right = is_near(result[0], s, d) && is_near(result[1], d, s) && is_near(result[2], 255 - s, d) &&
                           is_near(result[3], alpha, s);
        wrong += right ? 0U : 1U;
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
}

// All pairs of factors, all equations, bytes at the edges.
TEST(Blend, EveryFactorAndEquation) {
  constexpr std::uint8_t kBytes[] = {0, 1, 127, 128, 254, 255};
  std::uint64_t wrong = 0, count = 0, saturated = 0, floored = 0;
  for (int factors = 0; factors < 15 * 14; ++factors) {
    for (int equation = 0; equation < 7; ++equation) {
      Blend state{true, static_cast<BlendFactor>(factors % 15), static_cast<BlendFactor>(factors / 15),
                  static_cast<BlendEquation>(equation)};
      // Each base-6 digit of i is one byte of the two colours; the other components follow from them.
      for (std::size_t i = 0; i < 6 * 6 * 6 * 6; ++i) {
        const std::uint8_t s = kBytes[i % 6], d = kBytes[i / 6 % 6], sa = kBytes[i / 36 % 6], da = kBytes[i / 216];
        const ColorBytes source{s, d, static_cast<std::uint8_t>(s ^ 0x55), sa};
        const ColorBytes destination{d, s, static_cast<std::uint8_t>(d + 31), da};
        state.color = {static_cast<std::uint8_t>(i * 37), kBytes[(i + 3) % 6], kBytes[i / 7 % 6], kBytes[i / 5 % 6]};
        const ColorBytes result = blend(state, source, destination);
        wrong += result != oracle::blended(state, source, destination) ? 1U : 0U;
        ++count;
        saturated += result[0] == 255 ? 1U : 0U;
        floored += result[0] == 0 ? 1U : 0U;
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GE(count, 1000000U);
  EXPECT_GE(saturated, 50000U);
  EXPECT_LE(saturated + floored, count * 3 / 4);
}

// AARRGGBB in hexadecimal digits.
ColorBytes argb_of(const std::string& digits) {
  const auto word = static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
  const auto byte = [word](unsigned shift) { return static_cast<std::uint8_t>(word >> shift); };
  return {byte(16), byte(8), byte(0), byte(24)};
}

// Every factor and equation on an NV2A, each result blended once more over a background.
TEST(Blend, IsThatOfTheNv2a) {
  using F = BlendFactor;
  using E = BlendEquation;
  const std::map<std::string, F> factors{{"0", F::zero},
                                         {"1", F::one},
                                         {"srcRGB", F::src_color},
                                         {"1-srcRGB", F::one_minus_src_color},
                                         {"dstRGB", F::dst_color},
                                         {"1-dstRGB", F::one_minus_dst_color},
                                         {"srcA", F::src_alpha},
                                         {"1-srcA", F::one_minus_src_alpha},
                                         {"dstA", F::dst_alpha},
                                         {"1-dstA", F::one_minus_dst_alpha},
                                         {"cRGB", F::constant_color},
                                         {"1-cRGB", F::one_minus_constant_color},
                                         {"cA", F::constant_alpha},
                                         {"1-cA", F::one_minus_constant_alpha},
                                         {"srcAsat", F::src_alpha_saturate}};
  const std::map<std::string, E> equations{
      {"ADD", E::add}, {"SUB", E::subtract},    {"REVSUB", E::reverse_subtract},        {"MIN", E::min},
      {"MAX", E::max}, {"SADD", E::add_signed}, {"SREVSUB", E::reverse_subtract_signed}};
  std::size_t rows = 0;
  for (const auto& row : read_hardware_table("nv2a_blend")) {
    ASSERT_EQ(row.at("match"), "1");
    const Blend state{true,
                      factors.at(row.at("sfactor")),
                      factors.at(row.at("dfactor")),
                      equations.at(row.at("equation")),
                      {0x55, 0x55, 0x55, 0x55}};
    const ColorBytes shown = blend(kOver, blend(state, argb_of(row.at("s")), argb_of(row.at("d"))), {32, 32, 32, 255});
    const auto drawn = [&](const char* column) { return static_cast<std::uint8_t>(std::stoi(row.at(column))); };
    ASSERT_EQ(shown, (ColorBytes{drawn("hw_R"), drawn("hw_G"), drawn("hw_B"), drawn("hw_A")}))
        << row.at("equation") << ' ' << row.at("sfactor") << ' ' << row.at("dfactor") << ' ' << row.at("s") << ' '
        << row.at("d");
    ++rows;
  }
  EXPECT_EQ(rows, 1256U);
}

TEST(Blend, FactorsByHand) {
  const ColorBytes source{100, 150, 200, 60}, destination{50, 250, 10, 220}, constant{255, 128, 0, 51};
  const auto result = [&](BlendFactor s, BlendFactor d, BlendEquation e = BlendEquation::add) {
    return blend({true, s, d, e, constant}, source, destination);
  };
  using F = BlendFactor;
  EXPECT_EQ(result(F::one, F::one), (ColorBytes{150, 255, 210, 255}));
  EXPECT_EQ(result(F::zero, F::src_color), (ColorBytes{20, 147, 8, 52}));  // 19.6, 147.06, 7.8, 51.8
  EXPECT_EQ(result(F::dst_color, F::src_color), (ColorBytes{39, 255, 16, 104}));
  EXPECT_EQ(result(F::constant_color, F::zero), (ColorBytes{100, 75, 0, 12}));
  EXPECT_EQ(result(F::constant_alpha, F::zero), (ColorBytes{20, 30, 40, 12}));
  EXPECT_EQ(result(F::src_alpha_saturate, F::zero), (ColorBytes{14, 21, 27, 60}));  // 35/255 for colours
  EXPECT_EQ(result(F::one, F::one, BlendEquation::subtract), (ColorBytes{50, 0, 190, 0}));
  EXPECT_EQ(result(F::one, F::one, BlendEquation::reverse_subtract), (ColorBytes{0, 100, 0, 160}));
  EXPECT_EQ(result(F::zero, F::zero, BlendEquation::min), (ColorBytes{50, 150, 10, 60}));
  EXPECT_EQ(result(F::zero, F::zero, BlendEquation::max), (ColorBytes{100, 250, 200, 220}));
  // 150 and 200 are -106 and -56.
  EXPECT_EQ(result(F::zero, F::zero, BlendEquation::add_signed), (ColorBytes{150, 144, 0, 255}));
  EXPECT_EQ(result(F::zero, F::zero, BlendEquation::reverse_subtract_signed), (ColorBytes{0, 255, 66, 160}));
}

// The planes that a target lacks, or a mask protects, take part as they are: a missing alpha plane reads 255.
TEST(Blend, ReadsWhatIsThere) {
  PipelineState state;
  state.blend = {.enabled = true, .source = BlendFactor::dst_alpha, .destination = BlendFactor::zero};
  oracle::Picture start = empty_picture(1, 1);
  start.color[0] = {10, 20, 30, 51};
  const auto drawn = [&] {
    PicturePlanes planes(start);
    EXPECT_TRUE(FragmentOperations(state, planes.target).apply({}, {100, 200, 50, 255}));
    return planes.picture().color[0];
  };
  EXPECT_EQ(drawn(), (oracle::Bytes{20, 40, 10, 51}));
  state.color_mask = {true, false, true, false};
  EXPECT_EQ(drawn(), (oracle::Bytes{20, 20, 10, 51}));
  start.has_alpha = false;
  EXPECT_EQ(drawn(), (oracle::Bytes{100, 20, 50, 51}));
  // Disabled: the fragment's own colour, whatever the factors.
  state.blend.enabled = false;
  EXPECT_EQ(drawn(), (oracle::Bytes{100, 20, 50, 51}));
}

// Light upon light, in the order of drawing.
TEST(Blend, AccumulatesInOrder) {
  PipelineState state;
  state.blend = {.enabled = true, .source = BlendFactor::one, .destination = BlendFactor::one};
  PicturePlanes planes(empty_picture(1, 1));
  const FragmentOperations operations(state, planes.target);
  for (int i = 0; i < 3; ++i) operations.apply({}, {10, 100, 60, 255});
  EXPECT_EQ(planes.picture().color[0], (oracle::Bytes{30, 255, 180, 255}));
}

}  // namespace
}  // namespace ninebit::test
