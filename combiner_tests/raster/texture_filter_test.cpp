// Filters, levels of detail and depth comparisons whose answers can be told by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

Texture luminance(int width, int height, std::vector<std::uint8_t> bytes) {
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{{width, height, std::move(bytes)}}})
      .value();
}

int red(const Texture& texture, const Sampler& sampler, const std::array<float, 3>& at, float change = 0.0F) {
  const auto made = TextureSampler::make(profiles::geforce2, texture, sampler);
  return made ? int{texel_at(*made, at, {change, 0, 0}).value[0]} : -1;
}

// The red byte of four texels A, B, C, D with weights in 1/256.
int blended(const HardwareRow& row, const std::string& suffix) {
  const auto number = [&](const char* column) { return std::stoi(row.at(column + suffix)); };
  const auto byte = [&](const char* column) { return static_cast<std::uint8_t>(number(column)); };
  Sampler sampler = kNearestSampler;
  sampler.min_filter = MinFilter::linear;
  sampler.mag_filter = MagFilter::linear;
  const auto place = [](int weight) { return (0.5F + static_cast<float>(weight) / 256.0F) / 2.0F; };
  return red(luminance(2, 2, {byte("A"), byte("B"), byte("C"), byte("D")}), sampler,
             {place(number("fu")), place(number("fv")), 0});
}

TEST(TextureFilter, RoundsEachBlendAsTheNv2a) {
  int differs_from_one_rounding = 0;
  for (const auto& row : read_hardware_table("nv2a_filter")) {
    ASSERT_EQ(row.at("match"), "1");
    const int f = std::stoi(row.at("f"));
    int drawn = blended(row, "");
    if (f != 0) {
      const auto level = static_cast<std::uint8_t>(drawn), next = static_cast<std::uint8_t>(blended(row, "2"));
      Sampler sampler{.min_filter = MinFilter::linear_mipmap_linear};
      sampler.lod_bias = static_cast<float>(f) / 256.0F;
      drawn = red(texture_of_levels(2, {level, next}), sampler, {0.5F, 0.5F, 0}, 0.5F);  // lambda is the bias
    }
    ASSERT_EQ(drawn, std::stoi(row.at("hw")));
    const auto at = [&](const char* column) { return std::stod(row.at(column)); };
    const double u = at("fu") / 256, v = at("fv") / 256;
    const double exact = (at("A") * (1 - u) + at("B") * u) * (1 - v) + (at("C") * (1 - u) + at("D") * u) * v;
    differs_from_one_rounding += f == 0 && drawn != static_cast<int>(exact + 0.5) ? 1 : 0;
  }
  RecordProperty("rows_that_differ_from_one_rounding", differs_from_one_rounding);
}

TEST(TextureFilter, LinearWeighsFourTexels) {
  const Texture texture = luminance(2, 2, {0, 255, 100, 7});
  Sampler sampler = kNearestSampler;
  sampler.min_filter = MinFilter::linear;
  sampler.mag_filter = MagFilter::linear;
  EXPECT_EQ(red(texture, sampler, {0.25F, 0.25F, 0}), 0);
  EXPECT_EQ(red(texture, sampler, {0.75F, 0.25F, 0}), 255);
  EXPECT_EQ(red(texture, sampler, {0.5F, 0.25F, 0}), 128);   // 127.5 goes up
  EXPECT_EQ(red(texture, sampler, {0.5F, 0.5F, 0}), 91);     // 362 / 4 = 90.5
  EXPECT_EQ(red(texture, sampler, {0.375F, 0.25F, 0}), 64);  // 255 / 4 = 63.75
  EXPECT_EQ(red(texture, sampler, {-5.0F, 9.0F, 0}), 100);
  EXPECT_EQ(red(texture, sampler, {kNan, kInfinity, 0}), 100);
}

TEST(TextureFilter, ClampMixesTheBorderInAndEdgeDoesNot) {
  const Texture texture = luminance(1, 1, {200});
  Sampler sampler{.min_filter = MinFilter::linear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  sampler.border_color = {40.0F / 255.0F, 1, 1, 1};
  EXPECT_EQ(red(texture, sampler, {0.5F, 0.5F, 0}), 200);
  EXPECT_EQ(red(texture, sampler, {0.0F, 0.5F, 0}), 120);
  EXPECT_EQ(red(texture, sampler, {7.0F, 0.5F, 0}), 120);
  EXPECT_EQ(red(texture, sampler, {0.0F, 1.0F, 0}), 80);  // one quarter of the texel
  EXPECT_EQ(red(texture, kNearestSampler, {0.0F, 1.0F, 0}), 200);
  sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
  EXPECT_EQ(red(texture, sampler, {0.0F, 1.0F, 0}), 200);
}

TEST(TextureFilter, RepeatAndMirrorGoOnForEver) {
  const Texture texture = luminance(4, 1, {10, 20, 30, 40});
  Sampler sampler = kNearestSampler;
  const auto row = [&](float from) {
    std::vector<int> values;
    for (int i = 0; i < 8; ++i) values.push_back(red(texture, sampler, {from + 0.25F * static_cast<float>(i), 0, 0}));
    return values;
  };
  sampler.wrap_s = Wrap::repeat;
  EXPECT_EQ(row(0.0F), (std::vector<int>{10, 20, 30, 40, 10, 20, 30, 40}));
  EXPECT_EQ(row(-3.0F), row(0.0F));
  sampler.wrap_s = Wrap::mirrored_repeat;
  EXPECT_EQ(row(0.125F), (std::vector<int>{10, 20, 30, 40, 40, 30, 20, 10}));
  EXPECT_EQ(row(-1.875F), row(0.125F));
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat}) {
    sampler.wrap_s = wrap;
    for (const float far : {3e38F, -3e38F, kInfinity, -kInfinity, 16777216.0F}) {
      EXPECT_EQ(red(texture, sampler, {far, 0, 0}), 10) << far;
    }
  }
  EXPECT_EQ(red(texture, sampler, {16777215.0F, 0, 0}), 40);  // odd: the mirrored end
}

TEST(TextureFilter, NearestMipmapsSwitchHalfwayAndHalvesGoToTheFinerLevel) {
  const Texture texture = texture_of_levels(8, {10, 20, 30, 40});
  Sampler sampler{.min_filter = MinFilter::nearest_mipmap_nearest, .mag_filter = MagFilter::nearest};
  const auto level_at = [&](double texels) {
    return red(texture, sampler, {0.5F, 0.5F, 0}, static_cast<float>(texels / 8)) / 10 - 1;
  };
  EXPECT_EQ(level_at(0), 0);
  EXPECT_EQ(level_at(1.41), 0);
  EXPECT_EQ(level_at(1.424), 1);  // lambda = 0.51
  EXPECT_EQ(level_at(2), 1);
  EXPECT_EQ(level_at(2.82), 1);
  EXPECT_EQ(level_at(2.848), 2);
  EXPECT_EQ(level_at(8), 3);
  EXPECT_EQ(level_at(1e30), 3);
  EXPECT_EQ(level_at(static_cast<double>(kInfinity)), 3);
  EXPECT_EQ(level_at(static_cast<double>(kNan)), 0);
  sampler.lod_bias = 1.0F;
  EXPECT_EQ(level_at(1), 1);
  sampler.lod_bias = -100.0F;
  EXPECT_EQ(level_at(8), 0);
}

// OpenGL 1.3, 3.8.9: the switch point is 1/2 where magnification is LINEAR and minification takes nearest texels.
TEST(TextureFilter, TheSwitchPointIsOneHalfForSharpMinification) {
  std::vector<TextureSamples> levels;
  levels.push_back({2, 2, std::vector<std::uint8_t>{0, 200, 0, 200}});
  levels.push_back({1, 1, std::vector<std::uint8_t>{77}});
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {levels}).value();
  Sampler sampler{.mag_filter = MagFilter::linear};
  const auto value = [&](MinFilter filter, double lambda) {
    sampler.min_filter = filter;
    return red(texture, sampler, {0.5F, 0.5F, 0}, static_cast<float>(std::exp2(lambda) / 2));
  };
  EXPECT_EQ(value(MinFilter::nearest_mipmap_nearest, 0.4), 100);  // still magnified
  EXPECT_EQ(value(MinFilter::nearest_mipmap_nearest, 0.6), 77);
  EXPECT_EQ(value(MinFilter::nearest_mipmap_linear, 0.4), 100);
  EXPECT_EQ(value(MinFilter::nearest, -0.1), 100);
  EXPECT_EQ(value(MinFilter::nearest, 0.1), 200);              // at s = 1/2 the second texel
  EXPECT_EQ(value(MinFilter::linear_mipmap_linear, 0.4), 91);  // 100 and 77, 102 : 154
  sampler.mag_filter = MagFilter::nearest;
  EXPECT_EQ(value(MinFilter::nearest_mipmap_nearest, 0.4), 200);
  EXPECT_EQ(value(MinFilter::nearest_mipmap_nearest, -0.4), 200);
}

// Levels of 0 and 255 make the weight between them visible.
TEST(TextureFilter, LinearMipmapsWeighLevelsByTheLogarithm) {
  const Texture texture = texture_of_levels(4, {0, 255, 255});
  Random random(71);
  const Sampler sampler{.min_filter = MinFilter::linear_mipmap_linear};
  for (int i = 0; i < 20000; ++i) {
    const float change = random.real_f(0.2501, 0.4999);
    const double lambda = std::log2(4.0 * static_cast<double>(change));
    EXPECT_NEAR(red(texture, sampler, {0.3F, 0.7F, 0}, change), 255 * lambda, 0.51 + 255.0 / 256) << change;
  }
  EXPECT_EQ(red(texture, sampler, {0, 0, 0}, 0.25F), 0);
  EXPECT_EQ(red(texture, sampler, {0, 0, 0}, 0.5F), 255);
}

TEST(TextureFilter, TheLargerOfBothDirectionsCounts) {
  const Texture texture = texture_of_levels(4, {10, 20, 30});
  const auto made =
      TextureSampler::make(profiles::geforce2, texture, {.min_filter = MinFilter::nearest_mipmap_nearest});
  EXPECT_EQ(texel_at(*made, {}, {0.25F, 0, 0}, {0, 1, 0}).value[0], 30);
  EXPECT_EQ(texel_at(*made, {}, {0, -0.5F, 0}, {0.1F, 0.1F, 0}).value[0], 20);
  EXPECT_EQ(texel_at(*made, {}, {0.4F, 0.3F, 9}, {0, 0, 9}).value[0], 20);  // 4 × 0.5 = 2 texels; r does not count
  EXPECT_EQ(texel_at(*made, {}, {kNan, 0, 0}, {0, 0.5F, 0}).value[0], 20);
}

// On a face, s grows by half as much as a direction of length 1 turns.
TEST(TextureFilter, CubeMapsMeasureOnTheFace) {
  Random random(72);
  const Texture texture = random_texture(random, TextureTarget::cube_map, InternalFormat::rgb8, 16, 16, true);
  const Sampler sampler{.min_filter = MinFilter::nearest_mipmap_nearest,
                        .mag_filter = MagFilter::nearest,
                        .wrap_s = Wrap::clamp_to_edge,
                        .wrap_t = Wrap::clamp_to_edge};
  const auto made = TextureSampler::make(profiles::geforce2, texture, sampler);
  for (int level = 0; level <= 4; ++level) {
    for (const float distance : {0.001F, 1.0F, 3000.0F}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
          std::array<float, 3> direction{}, change{};
          direction[axis] = sign * distance;
          change[(axis + 1) % 3] = distance * std::ldexp(1.0F, level) / 8;
          const std::size_t face = 2 * axis + (sign < 0 ? 1 : 0);
          const auto& planes = std::get<0>(texture.faces[face][static_cast<std::size_t>(level)].planes);
          const int middle = 16 >> level >> 1;
          const Texel texel = texel_at(*made, direction, change);
          for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(texel.value[k], planes[k].at(middle, middle)) << face << level;
          // Away along the axis nothing changes on the face.
          std::array<float, 3> away{};
          away[axis] = 100 * distance;
          EXPECT_EQ(texel_at(*made, direction, away).value[0], std::get<0>(texture.faces[face][0].planes)[0].at(8, 8));
        }
      }
    }
  }
}

TEST(TextureFilter, DepthComparesBeforeItFilters) {
  const std::vector<std::uint32_t> codes{0, 0x8000, 0x8001, 0xFFFF};
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::depth16, {{{2, 2, codes}}}).value();
  Sampler sampler = kNearestSampler;
  const auto at = [&](float s, float t, float r) { return red(texture, sampler, {s, t, r}); };
  const float middle = static_cast<float>(0x8000 / 65535.0);
  sampler.comparison = DepthComparison::lequal;
  EXPECT_EQ(at(0.75F, 0.25F, middle), 255);
  EXPECT_EQ(at(0.75F, 0.25F, middle + 1e-5F), 0);
  EXPECT_EQ(at(0.25F, 0.25F, 0.0F), 255);
  EXPECT_EQ(at(0.25F, 0.25F, -7.0F), 255);  // r is clamped
  EXPECT_EQ(at(0.75F, 0.75F, 7.0F), 255);
  EXPECT_EQ(at(0.75F, 0.75F, kInfinity), 255);
  EXPECT_EQ(at(0.25F, 0.25F, kNan), 255);
  sampler.comparison = DepthComparison::gequal;
  EXPECT_EQ(at(0.75F, 0.25F, middle), 255);
  EXPECT_EQ(at(0.25F, 0.75F, middle), 0);
  EXPECT_EQ(at(0.75F, 0.75F, 7.0F), 255);
  sampler.min_filter = MinFilter::linear;
  sampler.mag_filter = MagFilter::linear;
  EXPECT_EQ(at(0.5F, 0.5F, middle), 128);  // two of four
  EXPECT_EQ(at(0.5F, 0.5F, 1.0F), 255);
  sampler.comparison = DepthComparison::lequal;
  EXPECT_EQ(at(0.5F, 0.5F, middle), 192);  // three of four: 255 and 128 (127.5), then 191.5
  sampler.comparison = DepthComparison::none;
  EXPECT_EQ(at(0.5F, 0.25F, 0.0F), 64);  // (0 + 0x8000) / 2 = 16384 of 65535: 63.75
  const auto made = TextureSampler::make(profiles::geforce2, texture, sampler);
  EXPECT_EQ(made->format(), TextureFormat::depth);
  EXPECT_FALSE(made->needs_r());
}

// Of every decision that pictures of an NV2A show; the stage mode of 2D textures compares 0 in place of r.
TEST(TextureFilter, DepthComparesAsTheNv2a) {
  const std::map<std::string, DepthComparison> functions{
      {"N", DepthComparison::never},   {"LT", DepthComparison::less},    {"EQ", DepthComparison::equal},
      {"LE", DepthComparison::lequal}, {"GT", DepthComparison::greater}, {"NE", DepthComparison::notequal},
      {"GE", DepthComparison::gequal}, {"A", DepthComparison::always}};
  std::map<std::string, int> seen;
  for (const auto& row : read_hardware_table("nv2a_shadow_compare")) {
    const bool is_16 = row.at("bits") == "16";
    const std::vector<std::uint32_t> stored{static_cast<std::uint32_t>(std::stoul(row.at("t")))};
    const Texture texture = make_texture(TextureTarget::texture_2d,
                                         is_16 ? InternalFormat::depth16 : InternalFormat::depth24, {{{1, 1, stored}}})
                                .value();
    Sampler sampler = kNearestSampler;
    sampler.comparison = functions.at(row.at("func"));
    const double r = row.at("mode") == "2D" ? 0.0 : std::stod(row.at("r")) / (is_16 ? 65535.0 : 16777215.0);
    EXPECT_EQ(red(texture, sampler, {0.5F, 0.5F, static_cast<float>(r)}), row.at("hw") == "1" ? 255 : 0)
        << row.at("picture") << ' ' << row.at("t");
    ++seen[row.at("func")];
  }
  EXPECT_EQ(seen.size(), 8U);
  for (const auto& [function, rows] : seen) EXPECT_EQ(rows, 42) << function;
}

// The bias is cut to 1/256 on the NV2A: a level of detail of half a level keeps the finer one.
TEST(TextureFilter, TheBiasIsCut) {
  const Texture texture = texture_of_levels(8, {10, 20, 30, 40});
  Sampler sampler{.min_filter = MinFilter::nearest_mipmap_nearest, .mag_filter = MagFilter::nearest};
  HardwareProfile nearest = profiles::nv2a;
  nearest.texture_bias_narrowing.value = Narrowing::nearest_halves_up;
  const auto levels = [&](float bias) {
    sampler.lod_bias = bias;
    std::array<int, 2> read{};
    const std::array<float, 3> at{0.5F, 0.5F, 0}, change{0.125F, 0, 0};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto made = TextureSampler::make(i == 0 ? profiles::nv2a : nearest, texture, sampler);
      read[i] = texel_at(*made, at, change).value[0];
    }
    return read;
  };
  EXPECT_EQ(levels(128.0F / 256), (std::array{10, 10}));
  EXPECT_EQ(levels(128.25F / 256), (std::array{10, 10}));
  EXPECT_EQ(levels(128.75F / 256), (std::array{10, 20}));
  EXPECT_EQ(levels(129.0F / 256), (std::array{20, 20}));
  EXPECT_EQ(levels(-0.75F / 256), (std::array{10, 10}));
}

TEST(TextureFilter, EveryDepthOf16BitsBecomesTheNearestByte) {
  std::vector<std::uint32_t> codes(65536);
  for (std::uint32_t i = 0; i < 65536; ++i) codes[i] = i;
  const Texture texture =
      make_texture(TextureTarget::texture_2d, InternalFormat::depth16, {{{256, 256, codes}}}).value();
  const auto made = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
  for (int i = 0; i < 65536; ++i) {
    const int x = i % 256, y = i / 256;
    const float s = (static_cast<float>(x) + 0.5F) / 256, t = (static_cast<float>(y) + 0.5F) / 256;
    ASSERT_EQ(texel_at(*made, {s, t, 0}).value[0], std::lround(i * 255 / 65535.0)) << i;
  }
}

// Beyond the hardware: floats reach a register clamped and rounded to a byte, but color() gives them whole.
TEST(TextureFilter, FloatsAreClampedForRegistersAlone) {
  const std::vector<float> reals{2.5F, -1.0F, 0.5F, kNan};
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::rgba32f, {{{1, 1, reals}}}).value();
  const auto made = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
  CoordinateArrays one;
  one.push({0.5F, 0.5F, 0});
  EXPECT_EQ(made->texel(one.view(), 0).value, (Bytes4{255, 0, 128, 0}));
  const std::array<float, 4> color = made->color(one.view(), 0);
  EXPECT_EQ(color[0], 2.5F);
  EXPECT_EQ(color[1], -1.0F);
  EXPECT_EQ(color[2], 0.5F);
  EXPECT_TRUE(std::isnan(color[3]));
}

// Components that a format does not store read as texel_codes says.
TEST(TextureFilter, ColorsInFloatsFollowTheRegisterTable) {
  Random random(73);
  for (const InternalFormat format : kInternalFormats) {
    const Texture texture = random_texture(random, TextureTarget::texture_2d, format, 4, 4, false);
    const auto made = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
    CoordinateArrays one;
    one.push({0.3F, 0.6F, 0});
    const Rgba9 codes = texel_codes(profiles::geforce2, made->texel(one.view(), 0));
    const std::array<float, 4> color = made->color(one.view(), 0);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(byte_of_color(color[k]), codes[k]) << static_cast<int>(format);
  }
}

}  // namespace
}  // namespace ninebit::test
