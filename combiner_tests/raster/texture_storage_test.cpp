// Textures as objects: what is refused, what is incomplete, who owns the samples, mip-maps by a box filter.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "combiner_tests/raster/texture_support.h"

namespace ninebit::test {
namespace {

Texture rgb_texture(int width, int height, TextureTarget target = TextureTarget::texture_2d, bool levels = false) {
  Random random(81);
  return random_texture(random, target, InternalFormat::rgb8, width, height, levels);
}

std::string complaint(const Texture& texture) {
  const Status status = check_texture(texture);
  return status ? "" : status.error().text();
}

TEST(TextureCheck, RefusesWhatGlWouldHaveRefused) {
  const Texture good = rgb_texture(4, 8, TextureTarget::texture_2d, true);
  EXPECT_EQ(complaint(good), "");
  for (const int side : {0, -4, 3, 6, 100, 32768}) {
    Texture bad = good;
    bad.faces[0][1].width = side;
    EXPECT_EQ(complaint(bad),
              "level 1 is " + std::to_string(side) + " x 4; each side must be a power of two from 1 to 16384");
  }
  Texture bad = good;
  bad.faces[1] = bad.faces[0];
  EXPECT_EQ(complaint(bad), "a 2D texture has more than one face");
  bad = good;
  std::get<0>(bad.faces[0][0].planes)[2] = {};
  EXPECT_EQ(complaint(bad), "level 0 is missing a plane that its format needs");
  bad = good;
  bad.format = InternalFormat::depth24;
  EXPECT_EQ(complaint(bad), "level 0 has samples of the wrong type for its format");
  for (const std::ptrdiff_t step : {-1, 0, 4097}) {
    bad = good;
    std::get<0>(bad.faces[0][0].planes)[1].step = step;
    EXPECT_EQ(complaint(bad),
              "level 0 has a step of " + std::to_string(step) + " samples between texels; expected 1 to 4096");
  }
  bad = good;
  bad.faces[0].resize(16, bad.faces[0][0]);
  EXPECT_EQ(complaint(bad), "a texture has 16 levels; there can be 15");
  bad = rgb_texture(4, 4, TextureTarget::cube_map);
  EXPECT_EQ(complaint(bad), "");
  bad.faces[5][0].height = 2;
  EXPECT_EQ(complaint(bad), "level 0 of cube-map face 5 is 4 x 2; the faces of a cube map must be square");
  bad.format = InternalFormat::depth16;
  EXPECT_EQ(complaint(bad), "a cube map has a depth format; expected a 1D, 2D or rectangle texture");
}

// The same texels, interleaved, have the same mip-maps.
TEST(TextureStorage, MipmapsOfInterleavedTexels) {
  Random random(58);
  const Texture apart = random_texture(random, TextureTarget::texture_2d, InternalFormat::rgb8, 16, 8, false);
  std::vector<std::uint8_t> words(std::size_t{4} * 16 * 8);
  std::array<Plane<const std::uint8_t>, 4> planes{};
  const auto& from = std::get<0>(apart.faces[0][0].planes);
  for (std::size_t k = 0; k < 3; ++k) {
    planes[k] = {words.data() + k, 4 * 16, 4};
    for (int i = 0; i < 16 * 8; ++i) words[static_cast<std::size_t>(4 * i) + k] = from[k].at(i % 16, i / 16);
  }
  const Texture together = texture_view(InternalFormat::rgb8, std::vector<TextureImage>{{16, 8, planes}});
  const Texture expected = with_mipmaps(apart).value(), actual = with_mipmaps(together).value();
  ASSERT_EQ(actual.faces[0].size(), 5U);
  for (std::size_t level = 0; level < 5; ++level) {
    const TextureImage &a = actual.faces[0][level], &e = expected.faces[0][level];
    for (int y = 0; y < e.height; ++y) {
      for (int x = 0; x < e.width; ++x) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(std::get<0>(a.planes)[k].at(x, y), std::get<0>(e.planes)[k].at(x, y)) << level;
        }
      }
    }
  }
}

TEST(TextureCheck, CompletenessIsThatOfTheSpecification) {
  EXPECT_FALSE(is_complete(Texture{}, false));
  Texture texture = rgb_texture(8, 2);
  EXPECT_TRUE(is_complete(texture, false));
  EXPECT_FALSE(is_complete(texture, true));
  texture = with_mipmaps(texture).value();
  EXPECT_TRUE(is_complete(texture, true));
  texture.faces[0].pop_back();
  EXPECT_FALSE(is_complete(texture, true));
  Texture cube = with_mipmaps(rgb_texture(8, 8, TextureTarget::cube_map)).value();
  EXPECT_TRUE(is_complete(cube, true));
  Texture broken = cube;
  broken.faces[3].clear();
  EXPECT_FALSE(is_complete(broken, false));
  broken = cube;
  broken.faces[5].erase(broken.faces[5].begin());  // all its levels are one too small
  EXPECT_FALSE(is_complete(broken, false));
  broken = cube;
  std::swap(broken.faces[2][1], broken.faces[2][2]);
  EXPECT_TRUE(is_complete(broken, false));
  EXPECT_FALSE(is_complete(broken, true));
  EXPECT_FALSE(TextureSampler::make(profiles::geforce2, broken, Sampler{}).has_value());
  EXPECT_TRUE(TextureSampler::make(profiles::geforce2, broken, kNearestSampler).has_value());
}

TEST(TextureStorage, CountsSamplesAndDepthCodes) {
  const auto make = [](InternalFormat format, TextureSamples image) {
    const auto made = make_texture(TextureTarget::texture_2d, format, {{std::move(image)}});
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(make(InternalFormat::rgb8, {2, 2, std::vector<std::uint8_t>(11)}),
            "a texture image has 11 samples where its size and format need 12");
  EXPECT_EQ(make(InternalFormat::rgb8, {2, 3, std::vector<std::uint8_t>(18)}),
            "level 0 is 2 x 3; each side must be a power of two from 1 to 16384");
  EXPECT_EQ(make(InternalFormat::rgb8, {1, 1, std::vector<float>(3)}),
            "level 0 has samples of the wrong type for its format");
  EXPECT_EQ(make(InternalFormat::depth16, {1, 1, std::vector<std::uint32_t>{65536}}),
            "a depth texture has the code 65536; the largest is 65535");
  EXPECT_EQ(make(InternalFormat::depth24, {1, 1, std::vector<std::uint32_t>{0xFFFFFF}}), "");
  EXPECT_FALSE(make_texture(TextureTarget::cube_map, InternalFormat::rgb8, {{}, {}}).ok());
  EXPECT_EQ(make(InternalFormat::rgb8, {1 << 30, 1 << 30, std::vector<std::uint8_t>(3)}).substr(0, 26),
            "a texture image is 1073741");
  // What a side may be depends on the target.
  const auto sides = [](TextureTarget target, TextureSamples image) {
    const auto made = make_texture(target, InternalFormat::alpha8, {{std::move(image)}});
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(sides(TextureTarget::rectangle, {0, 3, std::vector<std::uint8_t>(1)}),
            "a texture image is 0 x 3; each side must be from 1 to 16384");
  EXPECT_EQ(sides(TextureTarget::texture_3d, {1024, 1, std::vector<std::uint8_t>(2048), 2}),
            "a texture image is 1024 x 1 x 2; each side must be a power of two from 1 to 512");
}

// Planes of a surface with padded rows, and of depth, are textures as they are.
TEST(TextureView, ViewsPlanesThatSomebodyElseDraws) {
  std::vector<std::uint8_t> bytes(3 * 40, 9);
  TextureImage image{2, 4};
  std::array<Plane<const std::uint8_t>, 4> planes{};
  for (std::size_t k = 0; k < 3; ++k) planes[k] = {bytes.data() + 40 * k, 10};
  image.planes = planes;
  const std::vector<TextureImage> faces{image};
  const Texture texture = texture_view(InternalFormat::rgb8, faces);
  ASSERT_EQ(complaint(texture), "");
  const auto made = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
  EXPECT_EQ(texel_at(*made, {0.75F, 0.6F, 0}).value[1], 9);
  bytes[40 + 2 * 10 + 1] = 77;  // no copy was made
  EXPECT_EQ(texel_at(*made, {0.75F, 0.6F, 0}).value[1], 77);
  EXPECT_EQ(texture_view(InternalFormat::rgb8, std::vector<TextureImage>(6, image)).target, TextureTarget::cube_map);
  EXPECT_FALSE(is_complete(texture_view(InternalFormat::rgb8, std::vector<TextureImage>(5, image)), false));
}

// The mean of the two by two, judged in doubles.
template <class T>
double sample_of(const Texture& texture, std::size_t level, std::size_t k, int x, int y) {
  const auto& planes = std::get<std::array<Plane<const T>, 4>>(texture.faces[0][level].planes);
  if constexpr (std::is_same_v<T, Half>) {
    return static_cast<double>(float_of(planes[k].at(x, y)));
  } else {
    return static_cast<double>(planes[k].at(x, y));
  }
}

template <class T>
void expect_means(const Texture& texture, double tolerance) {
  const auto& levels = texture.faces[0];
  const std::array<bool, 4> stored = stored_components(texture.format);
  for (std::size_t level = 1; level < levels.size(); ++level) {
    const int right = levels[level - 1].width > 1 ? 1 : 0, down = levels[level - 1].height > 1 ? 1 : 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!stored[k]) continue;
      for (int y = 0; y < levels[level].height; ++y) {
        for (int x = 0; x < levels[level].width; ++x) {
          const int fx = right == 1 ? 2 * x : x, fy = down == 1 ? 2 * y : y;
          double mean = 0;
          for (int i = 0; i < 4; ++i) {
            mean += sample_of<T>(texture, level - 1, k, fx + (i % 2) * right, fy + (i / 2) * down) / 4;
          }
          const double actual = sample_of<T>(texture, level, k, x, y);
          if (tolerance == 0) {
            ASSERT_EQ(actual, std::floor(mean + 0.5)) << level << ' ' << x << ' ' << y;
          } else {
            ASSERT_NEAR(actual, mean, tolerance * (1 + std::fabs(mean))) << level << ' ' << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(TextureMipmaps, AreMeansRoundedToNearest) {
  Random random(82);
  for (const InternalFormat format : kInternalFormats) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{16, 16}, std::pair{32, 2}, std::pair{1, 64}}) {
      std::vector<float> reals(static_cast<std::size_t>(4 * width * height));
      for (float& real : reals) real = random.real_f(0, 1);
      Texture base = random_texture(random, TextureTarget::texture_2d, format, width, height, false);
      if (is_real(format)) {
        TextureSamples image{width, height};
        std::vector<Half> halves;
        for (const float real : reals) halves.push_back(half_of(real));
        if (format == InternalFormat::rgba16f) image.samples = halves;
        if (format == InternalFormat::rgba32f) image.samples = reals;
        base = make_texture(TextureTarget::texture_2d, format, {{image}}).value();
      }
      const Texture whole = with_mipmaps(base).value();
      ASSERT_TRUE(is_complete(whole, true));
      base = {};  // level 0 lives on
      switch (format) {
        case InternalFormat::depth16:
        case InternalFormat::depth24:
          expect_means<std::uint32_t>(whole, 0);
          break;
        case InternalFormat::rgba16f:
          expect_means<Half>(whole, 0x1p-11);
          break;
        case InternalFormat::rgba32f:
          expect_means<float>(whole, 0x1p-23);
          break;
        default:
          expect_means<std::uint8_t>(whole, 0);
      }
    }
  }
  EXPECT_FALSE(with_mipmaps(Texture{}).ok());
}

// Means of bytes in two's complement, halves up: -128 and 127 have -0.5, which becomes 0, not 127.
TEST(TextureStorage, MipMapsOfSignedBytes) {
  const auto make = [](InternalFormat format, std::vector<std::uint8_t> bytes) {
    TextureSamples samples{.width = 2, .height = 1};
    samples.samples = std::move(bytes);
    return make_texture(TextureTarget::texture_2d, format, {{samples}}).value();
  };
  const auto mean = [](const Texture& texture, std::size_t component) {
    const auto& planes = std::get<std::array<Plane<const std::uint8_t>, 4>>(texture.faces[0].at(1).planes);
    return int{static_cast<std::int8_t>(planes[component].at(0, 0))};
  };
  const Texture offsets = with_mipmaps(make(InternalFormat::dsdt8, {0x80, 0x7F, 0xFE, 0x02})).value();
  EXPECT_EQ(mean(offsets, 1), 0) << "of -128 and 127";
  EXPECT_EQ(mean(offsets, 2), 0) << "of -2 and 2";
  const Texture normals = make(InternalFormat::rgb8, {0xFF, 0xFF, 0x80, 0x7F, 0x80, 0x80});
  const Texture by_sign = with_mipmaps(normals, {true, true, false, false}).value();
  EXPECT_EQ(mean(by_sign, 0), -1);
  EXPECT_EQ(mean(by_sign, 1), 0);
  EXPECT_EQ(mean(by_sign, 2), -128) << "128 without a sign";
}

// Means of whole words, not of their bytes: of 0x00FF and 0x0100, and of 0xFFFE and 0x0004, which may be -2 and 4.
TEST(TextureStorage, MipMapsOfWords) {
  TextureSamples samples{.width = 2, .height = 1};
  // Red and alpha have the first words, blue and green the second.
  samples.samples = std::vector<std::uint8_t>{0xFF, 0x00, 0xFF, 0x00, 0xFE, 0x04, 0x00, 0x01};
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::hilo16, {{samples}}).value();
  for (const bool is_signed : {false, true}) {
    const Texture whole = with_mipmaps(texture, {false, is_signed, false, is_signed}).value();
    const auto& planes = std::get<std::array<Plane<const std::uint8_t>, 4>>(whole.faces[0].at(1).planes);
    const auto byte = [&](std::size_t k) { return int{planes[k].at(0, 0)}; };
    EXPECT_EQ(256 * byte(3) + byte(0), 0x0100) << "halves go up";
    EXPECT_EQ(256 * byte(1) + byte(2), is_signed ? 1 : 0x8001);
  }
}

// Each texel of a 3D texture's next level is the mean of eight, of four where one layer is left, or of two.
TEST(TextureStorage, MipMapsOf3dTextures) {
  TextureSamples samples{.width = 4, .height = 2, .depth = 4};
  std::vector<std::uint8_t> bytes(32);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(8 * i);
  samples.samples = bytes;
  const Texture whole =
      with_mipmaps(make_texture(TextureTarget::texture_3d, InternalFormat::luminance8, {{samples}}).value()).value();
  ASSERT_EQ(whole.faces[0].size(), 3U);
  EXPECT_TRUE(is_complete(whole, true));
  const TextureImage& first = whole.faces[0][1];
  EXPECT_EQ((std::array{first.width, first.height, first.depth}), (std::array{2, 1, 2}));
  const auto value = [&](std::size_t level, int x, int z) {
    return int{std::get<std::array<Plane<const std::uint8_t>, 4>>(whole.faces[0][level].planes)[0].at(x, z)};
  };
  // Texel (x, y, z) is 8 (x + 4 y + 8 z): means of x = 2 x' + 1/2, y = 1/2, z = 2 z' + 1/2.
  for (int z = 0; z < 2; ++z) {
    for (int x = 0; x < 2; ++x) EXPECT_EQ(value(1, x, z), 16 * x + 4 + 16 + 128 * z + 32);
  }
  EXPECT_EQ(value(2, 0, 0), (52 + 68 + 180 + 196) / 4);
}

}  // namespace
}  // namespace ninebit::test
