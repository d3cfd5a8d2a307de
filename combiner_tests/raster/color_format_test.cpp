// Formats of colour surfaces (rules 43 and 44): what is stored of every byte, words in memory, and what tests and
// blends read.
#include "ninebit/raster/color_format.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

TEST(ColorFormats, TheTableIsInTheOrderOfTheEnumeration) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kColorFormats.size(); ++i) {
    const ColorFormatFacts& facts = kColorFormats[i];
    EXPECT_EQ(facts.format, static_cast<ColorFormat>(i));
    names.insert(facts.name);
    EXPECT_TRUE(facts.word_bits() == 8 || facts.word_bits() == 16 || facts.word_bits() == 32) << facts.name;
  }
  EXPECT_EQ(names.size(), kColorFormats.size());
}

TEST(ColorFormats, EveryByteIsCutAndItsBitsAreRepeated) {
  for (const ColorFormatFacts& facts : kColorFormats) {
    for (int byte = 0; byte < 256; ++byte) {
      const auto b = static_cast<std::uint8_t>(byte);
      const ColorBytes color{b, static_cast<std::uint8_t>(b ^ 0xFF), static_cast<std::uint8_t>(b * 7), b};
      const ColorBytes stored = stored_color(facts.format, color);
      ASSERT_EQ(stored, oracle::kept(facts.format, color)) << facts.name << ' ' << byte;
      ASSERT_EQ(stored_color(facts.format, stored), stored) << facts.name << ' ' << byte;
    }
  }
}

TEST(ColorFormats, WordsByHand) {
  const auto word = [](ColorFormat format, const ColorBytes& color) {
    return color_word(format, stored_color(format, color));
  };
  const ColorBytes color{0x87, 0x46, 0xF9, 0x31};
  EXPECT_EQ(word(ColorFormat::a8r8g8b8, color), 0x318746F9U);
  EXPECT_EQ(word(ColorFormat::x8r8g8b8_z, color), 0x008746F9U);
  EXPECT_EQ(word(ColorFormat::x8r8g8b8_o, color), 0xFF8746F9U);
  EXPECT_EQ(word(ColorFormat::x1a7r8g8b8_z, color), 0x188746F9U);
  EXPECT_EQ(word(ColorFormat::x1a7r8g8b8_o, color), 0x988746F9U);
  EXPECT_EQ(word(ColorFormat::r5g6b5, color), (0x10U << 11) | (0x11U << 5) | 0x1FU);
  EXPECT_EQ(word(ColorFormat::x1r5g5b5_z, color), (0x10U << 10) | (0x08U << 5) | 0x1FU);
  EXPECT_EQ(word(ColorFormat::x1r5g5b5_o, color), 0x8000U | (0x10U << 10) | (0x08U << 5) | 0x1FU);
  EXPECT_EQ(word(ColorFormat::g8b8, color), 0x46F9U);
  EXPECT_EQ(word(ColorFormat::b8, color), 0xF9U);
}

TEST(ColorFormats, ChipsDoNotBlendIntoSurfacesWithoutRed) {
  for (const ColorFormatFacts& facts : kColorFormats) {
    Surface surface = Surface::make(2, 2, {.color = facts.format}).value();
    EXPECT_EQ(surface.color_format(), facts.format);
    RenderTarget target = surface.target();
    PipelineState state;
    state.blend.enabled = true;
    const Status drawn = rasterize(state, kIdentity, {.positions = kWholeTarget}, {}, target);
    const bool refused = facts.format == ColorFormat::b8 || facts.format == ColorFormat::g8b8;
    ASSERT_EQ(drawn.ok(), !refused) << facts.name;
    if (!refused) continue;
    EXPECT_EQ(drawn.error().message, "the chip does not blend into surfaces of format " + std::string(facts.name) +
                                         "; disable blending, or choose a format with red");
  }
}

// The test comes before the cut: with vectors and without, of one colour and of gathered fragments.
TEST(ColorFormats, TheAlphaTestReadsTheWholeAlpha) {
  for (const ColorFormat format : {ColorFormat::x1a7r8g8b8_z, ColorFormat::x1r5g5b5_o}) {
    for (const bool with_program : {false, true}) {
      for (const bool with_outputs : {false, true}) {
        Surface surface = Surface::make(40, 9, {.with_primitive = with_outputs, .color = format}).value();
        RenderTarget target = surface.target();
        PipelineState state;
        if (with_program) state.program = pass_through(Register::primary, Register::primary);
        state.alpha_test = {true, CompareFunction::equal, 0x51};
        for (const std::uint8_t alpha : std::array<std::uint8_t, 3>{0x50, 0x51, 0x52}) {
          const std::array<ColorBytes, 3> colors{{{alpha, 9, 9, alpha}, {alpha, 9, 9, alpha}, {alpha, 9, 9, alpha}}};
          ASSERT_TRUE(
              rasterize(state, kIdentity, {.positions = kWholeTarget, .vertex_colors = colors}, {}, target).ok());
        }
        const ColorBytes expected = oracle::kept(format, {0x51, 9, 9, 0x51});
        for (std::size_t k = 0; k < 4; ++k) {
          EXPECT_EQ(surface.color(static_cast<int>(k)), PlaneSamples<std::uint8_t>(40 * 9, expected[k])) << k;
        }
      }
    }
  }
}

TEST(ColorFormats, SurfacesStartAndAreClearedWithColorsOfTheFormat) {
  for (const ColorFormatFacts& facts : kColorFormats) {
    Surface surface = Surface::make(3, 2, {.color = facts.format}).value();
    const ColorBytes value{0x87, 0x46, 0xF9, 0x31};
    const auto holds = [&](const ColorBytes& color) {
      const ColorBytes kept = oracle::kept(facts.format, color);
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(surface.color(k), PlaneSamples<std::uint8_t>(6, kept[static_cast<std::size_t>(k)])) << facts.name;
      }
    };
    holds({});
    RenderTarget target = surface.target();
    ASSERT_TRUE(clear({}, {}, {.color = value}, target).ok());
    holds(value);
    surface.fill({});
    holds({});
    surface.fill({.color = value});
    holds(value);
  }
}

// A grey of 25 under a half of 200 in 16 bits: 200 and 25 lose their low bits first.
TEST(ColorFormats, BlendingReadsZerosOrWhatTheProfileSays) {
  for (const bool zeros : {true, false}) {
    Surface surface = Surface::make(1, 1, {.color = ColorFormat::r5g6b5}).value();
    surface.fill({.color = {25, 25, 132, 0}});
    RenderTarget target = surface.target();
    PipelineState state;
    state.profile.surface_blend.value = zeros ? SurfaceBlend::zeros : SurfaceBlend::bytes;
    state.blend = {true, BlendFactor::one, BlendFactor::dst_alpha};
    const std::array<ColorBytes, 3> colors{{{15, 10, 15, 1}, {15, 10, 15, 1}, {15, 10, 15, 1}}};
    ASSERT_TRUE(rasterize(state, kIdentity, {.positions = kWholeTarget, .vertex_colors = colors}, {}, target).ok());
    // 8 + 24 = 32, 8 + 24 = 32; or 15 + 24 + 0 = 39 and 10 + (24 + 0) = 34, which are cut to 32.
    EXPECT_EQ(surface.color(kRed)[0],
              oracle::kept(ColorFormat::r5g6b5, {static_cast<std::uint8_t>(zeros ? 32 : 39), 0, 0, 0})[0]);
    EXPECT_EQ(surface.color(kGreen)[0],
              oracle::kept(ColorFormat::r5g6b5, {0, static_cast<std::uint8_t>(zeros ? 32 : 34), 0, 0})[1]);
    // Code 16 of blue is 128, or 132 with its bits repeated: 8 + 128 = 136 of code 17, or 15 + 132 = 147 of code 18.
    EXPECT_EQ(surface.color(kBlue)[0], zeros ? 140 : 148);
  }
}

}  // namespace
}  // namespace ninebit::test
