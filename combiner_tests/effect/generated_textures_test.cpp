// Textures of our own making, against their formulas.
#include "ninebit/effect/generated_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace {

using namespace ninebit;

std::uint8_t texel(const Texture& texture, std::size_t face, std::size_t component, int x, int y) {
  const auto& planes = std::get<std::array<Plane<const std::uint8_t>, 4>>(texture.faces[face].at(0).planes);
  return planes[component].at(x, y);
}

glm::dvec3 expanded(const Texture& texture, std::size_t face, int x, int y) {
  glm::dvec3 v(0.0);
  for (std::size_t c = 0; c < 3; ++c) v[static_cast<glm::length_t>(c)] = texel(texture, face, c, x, y) / 127.5 - 1.0;
  return v;
}

TEST(GeneratedTextures, RangeCompressionRoundsAndClamps) {
  EXPECT_EQ(range_compressed(-1.0), 0);
  EXPECT_EQ(range_compressed(0.0), 128);
  EXPECT_EQ(range_compressed(1.0), 255);
  EXPECT_EQ(range_compressed(7.0), 255);
  EXPECT_EQ(range_compressed(-7.0), 0);
  EXPECT_EQ(range_compressed(std::numeric_limits<double>::quiet_NaN()), 0);
  for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(range_compressed(byte / 127.5 - 1.0), byte);
}

// Every texel is a vector of length one, within half a code per component, that looks up the texel itself.
TEST(GeneratedTextures, TheNormalizationCubeMapNormalizes) {
  for (const int size : {1, 2, 32}) {
    const auto cube = normalization_cube_map(size);
    ASSERT_TRUE(cube.ok());
    ASSERT_TRUE(is_complete(*cube, false));
    for (std::size_t face = 0; face < 6; ++face) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const glm::dvec3 v = expanded(*cube, face, x, y);
          ASSERT_NEAR(glm::length(v), 1.0, std::sqrt(3.0) / 255.0);
          const CubeCoordinate found =
              cube_coordinate(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
          ASSERT_EQ(static_cast<std::size_t>(found.face), face);
          ASSERT_NEAR(static_cast<double>(found.s) * size, x + 0.5, size / 64.0 + 0.01);
          ASSERT_NEAR(static_cast<double>(found.t) * size, y + 0.5, size / 64.0 + 0.01);
        }
      }
    }
  }
}

TEST(GeneratedTextures, CheckerboardGradientAndAttenuation) {
  const auto board = checkerboard(64);
  ASSERT_TRUE(board.ok());
  EXPECT_EQ(texel(*board, 0, 0, 0, 0), 255);
  EXPECT_EQ(texel(*board, 0, 1, 8, 0), 51);
  EXPECT_EQ(texel(*board, 0, 2, 8, 8), 255);
  EXPECT_EQ(texel(*board, 0, 2, 63, 0), 51);
  const auto ramp = gradient();
  ASSERT_TRUE(ramp.ok());
  for (int i = 0; i < 256; ++i) EXPECT_EQ(texel(*ramp, 0, 0, i, 0), i);
  const auto light = attenuation();
  ASSERT_TRUE(light.ok());
  EXPECT_EQ(texel(*light, 0, 0, 64, 63), 255);
  EXPECT_EQ(texel(*light, 0, 0, 0, 0), 0);
  EXPECT_EQ(texel(*light, 0, 0, 127, 64), std::lround(255.0 * (1.0 - 127.0 * 127.0 / 16384.0 - 1.0 / 16384.0)));
}

TEST(GeneratedTextures, NormalsStandOnTheirHeights) {
  const auto flat = normal_map(*checkerboard(1), 3.0);
  ASSERT_TRUE(flat.ok());
  EXPECT_EQ(texel(*flat, 0, 0, 0, 0), 128);
  EXPECT_EQ(texel(*flat, 0, 2, 0, 0), 255);
  const auto ramp = normal_map(*gradient(), 255.0);
  ASSERT_TRUE(ramp.ok());
  const glm::dvec3 slope = expanded(*ramp, 0, 100, 0), down = expanded(*ramp, 0, 0, 0);
  EXPECT_NEAR(slope.x, -std::sqrt(0.5), 0.005) << "a rise of one per texel";
  EXPECT_NEAR(slope.y, 0.0, 0.005);
  EXPECT_NEAR(slope.z, std::sqrt(0.5), 0.005);
  EXPECT_GT(down.x, 0.9) << "the border falls back to the start";
}

TEST(GeneratedTextures, BadSizesAndHeights) {
  for (const int size : {0, -4, 3, 32768}) {
    EXPECT_FALSE(normalization_cube_map(size).ok()) << size;
    EXPECT_FALSE(checkerboard(size).ok()) << size;
  }
  EXPECT_FALSE(normal_map(*normalization_cube_map(2), 1.0).ok());
  EXPECT_FALSE(normal_map(*gradient(), 0.0).ok());
  EXPECT_FALSE(normal_map(*gradient(), std::numeric_limits<double>::infinity()).ok());
  EXPECT_FALSE(normal_map(Texture{}, 1.0).ok());
}

// A height map of 4 x 2 texels whose slopes are known: 51 higher to the right of a texel than to the left of it.
Texture ramp_heights() {
  TextureSamples samples{.width = 4, .height = 2};
  samples.samples = std::vector<std::uint8_t>{0, 51, 102, 153, 0, 51, 102, 153};
  return make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{samples}}).value();
}

TEST(GeneratedTextures, SignedNormalsAndOffsetsAreSlopes) {
  const Texture heights = ramp_heights();
  // At the second texel the slope is (102 - 0) / 255 / 2 = 0.2, times the steepness.
  const auto offsets = offset_map(heights, 2.0);
  ASSERT_TRUE(offsets.ok());
  EXPECT_EQ(offsets->format, InternalFormat::dsdt8);
  EXPECT_EQ(texel(*offsets, 0, 2, 1, 0), 51);  // ds: 0.4 × 127 is 50.8
  EXPECT_EQ(texel(*offsets, 0, 1, 1, 0), 0);   // dt
  EXPECT_EQ(texel(*offset_map(heights, 100.0), 0, 2, 0, 0), 129) << "-127: clamped";
  const double length = std::sqrt(1.0 + 0.4 * 0.4);
  const auto normals = signed_normal_map(heights, 2.0);
  ASSERT_TRUE(normals.ok());
  EXPECT_EQ(static_cast<std::int8_t>(texel(*normals, 0, 0, 1, 0)), std::floor(-0.4 / length * 127.0 + 0.5));
  EXPECT_EQ(texel(*normals, 0, 2, 1, 0), std::floor(127.0 / length + 0.5));
  const auto hilo = hilo_normal_map(heights, 2.0);
  ASSERT_TRUE(hilo.ok());
  const int high = 256 * texel(*hilo, 0, 3, 1, 0) + texel(*hilo, 0, 0, 1, 0);
  EXPECT_EQ(static_cast<std::int16_t>(high), std::floor(-0.4 / length * 32767.0 + 0.5));
  const auto words = hilo_height_map(heights);
  ASSERT_TRUE(words.ok());
  EXPECT_EQ(256 * texel(*words, 0, 3, 2, 0) + texel(*words, 0, 0, 2, 0), 102 * 257);
  EXPECT_EQ(texel(*words, 0, 1, 2, 0) + texel(*words, 0, 2, 2, 0), 0);
  for (const double steepness : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(offset_map(heights, steepness).ok());
    EXPECT_FALSE(signed_normal_map(heights, steepness).ok());
    EXPECT_FALSE(hilo_normal_map(heights, steepness).ok());
  }
  EXPECT_FALSE(hilo_height_map(*normalization_cube_map(4)).ok());
}

TEST(GeneratedTextures, TexturesOfOtherKinds) {
  TextureSamples samples{.width = 2, .height = 4};
  samples.samples = std::vector<std::uint8_t>{10, 11, 20, 21, 30, 31, 40, 41};
  const Texture flat = make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{samples}}).value();
  const auto line = retargeted(flat, TextureTarget::texture_1d);
  ASSERT_TRUE(line.ok()) << line.error().message;
  EXPECT_EQ(line->faces[0][0].height, 1);
  EXPECT_EQ(texel(*line, 0, 0, 1, 0), 11);
  const auto volume = retargeted(flat, TextureTarget::texture_3d);
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_EQ(volume->faces[0][0].depth, 2);
  EXPECT_EQ(volume->faces[0][0].height, 2);
  EXPECT_EQ(texel(*volume, 0, 0, 1, 2), 31) << "row 0 of layer 1";
  EXPECT_EQ(retargeted(flat, TextureTarget::rectangle)->faces[0][0].height, 4);
  EXPECT_FALSE(retargeted(ramp_heights(), TextureTarget::texture_3d).ok()) << "wider than high";
}

}  // namespace
