// Sampling against the oracle: every format, target, filter and wrap mode, on random textures of random sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/environment.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/raster/texture_stages.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kTextureSeed = 7001;
constexpr int kTextureFragments = kSlowBuild ? 4 : 40;

struct TextureCase {
  HardwareProfile profile = profiles::geforce2;
  Texture texture;
  Sampler sampler;
  CoordinateArrays fragments;
};

// TextureCase `index` has the index's own format, target, filters and wrap modes; the rest is random.
constexpr auto kAllFormats = [] {
  std::array<InternalFormat, kInternalFormats.size() + kStageFormats.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = i < kInternalFormats.size() ? kInternalFormats[i] : kStageFormats[i - kInternalFormats.size()];
  }
  return all;
}();
constexpr std::array kAllTargets{TextureTarget::texture_2d, TextureTarget::cube_map, TextureTarget::texture_3d,
                                 TextureTarget::rectangle, TextureTarget::texture_1d};
constexpr std::uint64_t kTextureCases =
    kAllFormats.size() * kAllTargets.size() * kMinFilters.size() * 2 * kWraps.size() * kWraps.size();

// One texel of bytes as a word: 0xAARRGGBB.
std::uint32_t some_word(Random& random, const Texture& texture) {
  const TextureImage& image = texture.faces[0][0];
  const auto& planes = *std::get_if<std::array<Plane<const std::uint8_t>, 4>>(&image.planes);
  const int x = random.below(image.width), y = random.below(image.height);
  const auto byte = [&](std::size_t k) -> std::uint32_t { return planes[k] ? planes[k].at(x, y) : random.byte(); };
  return byte(3) << 24 | byte(0) << 16 | byte(1) << 8 | byte(2);
}

TextureCase make_case(std::uint64_t index) {
  Random random(kTextureSeed, index);
  std::uint64_t rest = index;
  const auto take = [&](const auto& list) {
    const auto value = list[rest % list.size()];
    rest /= list.size();
    return value;
  };
  TextureCase c;
  const InternalFormat format = take(kAllFormats);
  TextureTarget target = take(kAllTargets);
  if (is_depth(format) && (target == TextureTarget::cube_map || target == TextureTarget::texture_3d)) {
    target = TextureTarget::texture_2d;
  }
  c.sampler.min_filter = take(kMinFilters);
  c.sampler.mag_filter = take(kMagFilters);
  c.sampler.wrap_s = take(kWraps);
  c.sampler.wrap_t = take(kWraps);
  const bool mipmaps = c.sampler.min_filter != MinFilter::nearest && c.sampler.min_filter != MinFilter::linear;
  for (float& border : c.sampler.border_color) border = random.real_f(-0.2, 1.2);
  c.sampler.comparison = static_cast<DepthComparison>(random.below(static_cast<int>(DepthComparison::always) + 1));
  c.sampler.lod_bias = random.pick({0.0F, 0.0F, random.real_f(-2, 2), std::numeric_limits<float>::quiet_NaN(), 99.0F});
  if (random.one_in(4)) c.profile = profiles::geforce256_8bit;
  c.profile.texture_weight_bits.value = random.one_in(2) ? 8 : random.between(1, 8);
  c.profile.texture_weight_narrowing.value = random.pick({Narrowing::toward_zero, Narrowing::nearest_halves_up});
  c.profile.texture_filter_rounding.value = random.pick({FilterRounding::once, FilterRounding::each_blend});
  c.profile.texture_bias_narrowing.value = random.pick({Narrowing::toward_zero, Narrowing::nearest_halves_up});
  const int width = 1 << random.below(6);
  int height = target == TextureTarget::cube_map || random.one_in(3) ? width : 1 << random.below(6);
  if (target == TextureTarget::texture_1d) height = 1;
  const bool has_levels = target != TextureTarget::rectangle && (mipmaps || random.one_in(4));
  c.texture = random_texture(random, target, format, width, height, has_levels);
  c.sampler.wrap_r = kWraps[static_cast<std::size_t>(random.below(static_cast<int>(kWraps.size())))];
  if (random.one_in(3)) {
    for (bool& is_signed : c.sampler.is_signed) is_signed = random.one_in(2);
  }
  c.sampler.border_texels =
      target == TextureTarget::texture_2d && !mipmaps && width >= 16 && height >= 16 && random.one_in(3);
  const bool is_nearest = c.sampler.min_filter == MinFilter::nearest && c.sampler.mag_filter == MagFilter::nearest;
  if (is_nearest && (format == InternalFormat::rgba8 || format == InternalFormat::rgb8)) {
    c.sampler.color_key = {static_cast<ColorKeyOperation>(random.below(4)), some_word(random, c.texture)};
  }
  for (int i = 0; i < kTextureFragments; ++i) {
    std::array<float, 3> at{}, dx{}, dy{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = target == TextureTarget::cube_map && random.one_in(2)
                  ? random.real_f(-1, 1)
                  : random_coordinate(random, k == 0 ? width : height);
      dx[k] = random_change(random);
      dy[k] = random_change(random);
    }
    if (random.one_in(4)) at[1] = at[0];  // ties of a cube map
    c.fragments.push(at, dx, dy);
  }
  return c;
}

std::string describe(const TextureCase& c, std::uint64_t index, std::size_t i) {
  const TextureImage& base = c.texture.faces[0][0];
  std::string text = "case " + std::to_string(index) + " fragment " + std::to_string(i) + ": format " +
                     std::to_string(static_cast<int>(c.texture.format)) + ", " + std::to_string(base.width) + " x " +
                     std::to_string(base.height) + ", min " + std::to_string(static_cast<int>(c.sampler.min_filter)) +
                     ", mag " + std::to_string(static_cast<int>(c.sampler.mag_filter)) + ", wraps " +
                     std::to_string(static_cast<int>(c.sampler.wrap_s)) + ' ' +
                     std::to_string(static_cast<int>(c.sampler.wrap_t)) + ", bits " +
                     std::to_string(c.profile.texture_weight_bits.value) + ", at";
  char number[64];
  for (const auto& arrays : {c.fragments.value, c.fragments.dx, c.fragments.dy}) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::snprintf(number, sizeof number, " %a", static_cast<double>(arrays[k][i]));
      text += number;
    }
  }
  return text + "\nagain: NINEBIT_TEXTURE_INDEX=" + std::to_string(index) +
         " ninebit_raster_tests --gtest_filter='RandomTextures.*'";
}

// Whether a float may be the rounding of the oracle's sum: within 2^-48 of the terms, and half a step of the float.
bool near(float actual, long double expected, long double magnitude) {
  if (std::isnan(expected) || std::isinf(expected)) return std::isnan(expected) == std::isnan(actual);
  const long double step = std::fabs(std::nextafter(actual, std::numeric_limits<float>::infinity()) - actual);
  return std::fabs(static_cast<long double>(actual) - expected) <= 0.5001L * step + magnitude * 0x1p-48L;
}

struct TexturesSeen {
  int fragments = 0, border = 0, stored_border = 0, killed = 0, coarse = 0, ambiguous = 0, incomplete = 0;
};

bool agrees(const TextureCase& c, const TextureSampler& sampler, const oracle::TextureAnswer& answer, std::size_t i) {
  const Texel texel = sampler.texel(c.fragments.view(), i);
  const std::array<bool, 4> stored = stored_components(c.texture.format);
  if (is_real(c.texture.format)) {
    const std::array<float, 4> color = sampler.color(c.fragments.view(), i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!near(color[k], answer.real[k], answer.magnitude[k])) return false;
      if (texel.value[k] != byte_of_color(color[k])) return false;
    }
    return true;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (stored[k] && texel.value[k] != answer.value[k]) return false;
  }
  return true;
}

// The codes of a texel whose components are signed or not, each by itself.
Rgba9 register_codes(const TextureCase& c, Texel texel) {
  const StageTexture seen = stage_texture(c.texture, c.sampler);
  const Rgba9 plain = texel_codes(c.profile, texel);
  texel.is_signed = true;
  Rgba9 codes = texel_codes(c.profile, texel);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!seen.is_signed[k]) codes[k] = plain[k];
  }
  return codes;
}

void run(std::uint64_t index, TexturesSeen& seen) {
  const TextureCase c = make_case(index);
  const auto sampler = TextureSampler::make(c.profile, c.texture, c.sampler);
  CodeArrays codes(c.fragments.size());
  if (sampler) sampler->sample(c.fragments.view(), c.fragments.size(), codes.at());
  oracle::TextureQuestion question = texture_question(c.profile, c.texture, c.sampler);
  for (std::size_t i = 0; i < c.fragments.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      question.coordinate[k] = c.fragments.value[k][i];
      question.dx[k] = c.fragments.dx[k][i];
      question.dy[k] = c.fragments.dy[k][i];
    }
    const std::vector<oracle::TextureAnswer> answers = oracle::sample(question);
    ASSERT_EQ(sampler.has_value(), !answers.empty()) << describe(c, index, i);
    if (answers.empty()) {
      ++seen.incomplete;
      continue;
    }
    const bool agreed = agrees(c, *sampler, answers.front(), i) || agrees(c, *sampler, answers.back(), i);
    const Texel texel = sampler->texel(c.fragments.view(), i);
    ASSERT_TRUE(agreed) << describe(c, index, i) << "\nexpected " << int{answers[0].value[0]} << ' '
                        << int{answers[0].value[1]} << ' ' << int{answers[0].value[2]} << ' '
                        << int{answers[0].value[3]} << " real " << static_cast<double>(answers[0].real[0])
                        << "\nactual " << int{texel.value[0]} << ' ' << int{texel.value[1]} << ' '
                        << int{texel.value[2]} << ' ' << int{texel.value[3]};
    ASSERT_EQ(sampler->kills(c.fragments.view(), i), answers[0].killed) << describe(c, index, i);
    Rgba9 expected = register_codes(c, texel);
    if (c.texture.format == InternalFormat::rgb8) expected[kAlpha] = from_byte(c.profile, answers[0].value[3]);
    ASSERT_EQ(codes.of(i), expected) << describe(c, index, i);
    seen.killed += answers[0].killed ? 1 : 0;
    seen.stored_border += c.sampler.border_texels ? 1 : 0;
    ++seen.fragments;
    seen.border += answers[0].border ? 1 : 0;
    seen.coarse += answers[0].level > 0 ? 1 : 0;
    seen.ambiguous += answers.size() > 1 ? 1 : 0;
  }
}

TEST(RandomTextures, EveryFilterAndWrapIsAsTheOracleHasIt) {
  TexturesSeen seen;
  const CaseRange range("NINEBIT_TEXTURE_INDEX", kTextureCases);
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    run(index, seen);
    if (HasFatalFailure()) return;
  }
  if (!range.is_whole) return;
  // Rectangles have no mip-maps.
  EXPECT_EQ(seen.incomplete, static_cast<int>(kTextureCases / kAllTargets.size() * 4 / 6) * kTextureFragments);
  EXPECT_GE(seen.fragments, (static_cast<int>(kTextureCases) - 1) * kTextureFragments - seen.incomplete);
  EXPECT_GE(seen.border, seen.fragments / 50);
  EXPECT_GE(seen.coarse, seen.fragments / 5);
  EXPECT_GE(seen.stored_border, seen.fragments / 200);
  EXPECT_GE(seen.killed, seen.fragments / 4000);
  EXPECT_LE(seen.ambiguous, seen.fragments / 1000);
  RecordProperty("fragments", seen.fragments);
}

// The register codes do not depend on the run that a fragment comes in.
TEST(RandomTextures, AnyCutGivesTheSameBits) {
  for (std::uint64_t index = 0; index < 60; ++index) {
    Random random(kTextureSeed + 1, index);
    TextureCase c = make_case(static_cast<std::uint64_t>(random.below(static_cast<int>(kTextureCases))));
    if (index % 2 == 0) {  // the short way for bytes without a filter
      c.sampler.min_filter = MinFilter::nearest;
      c.sampler.mag_filter = MagFilter::nearest;
    }
    while (c.fragments.size() < 700) {
      c.fragments.push({random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-2, 2)},
                       {random_change(random), random_change(random), random_change(random)},
                       {random_change(random), random_change(random), random_change(random)});
    }
    const auto sampler = TextureSampler::make(c.profile, c.texture, c.sampler);
    if (!sampler) continue;  // a rectangle with mip-maps
    const std::size_t count = c.fragments.size();
    CodeArrays whole(count), cut(count);
    sampler->sample(c.fragments.view(), count, whole.at());
    for (std::size_t first = 0; first < count;) {
      const std::size_t size = std::min(static_cast<std::size_t>(random.between(0, 300)), count - first);
      sampler->sample(c.fragments.view(first), size, cut.at(first));
      first += size;
    }
    EXPECT_EQ(whole.plane, cut.plane) << index;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(whole.of(i), register_codes(c, sampler->texel(c.fragments.view(), i))) << index << ' ' << i;
    }
  }
}

// In lanes: one change for all fragments, of which the arrays have one value each, gives what the same change for each
// one gives.
TEST(TextureLanes, OneChangeOfAllFragments) {
  Random random(57);
  constexpr std::size_t kCount = 300;
  std::set<std::array<int, 3>> levels;
  for (int round = 0; round < 200; ++round) {
    const TextureTarget target = round % 2 == 0 ? TextureTarget::texture_2d : TextureTarget::cube_map;
    const InternalFormat format =
        round % 3 == 0 ? InternalFormat::rgb8 : kInternalFormats[static_cast<std::size_t>(random.below(6))];
    const Texture texture = random_texture(random, target, format, 32, 32, true);
    const Sampler parameters{.min_filter =
                                 random.pick({MinFilter::linear_mipmap_linear, MinFilter::nearest_mipmap_nearest})};
    const auto sampler = TextureSampler::make(profiles::geforce2, texture, parameters);
    ASSERT_TRUE(sampler.has_value());
    std::array<float, 3> dx{}, dy{};
    for (std::size_t k = 0; k < 3; ++k) dx[k] = random_change(random), dy[k] = random_change(random);
    CoordinateArrays each, one;
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::array<float, 3> at{random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-2, 2)};
      each.push(at, dx, dy);
      for (std::size_t k = 0; k < 3; ++k) one.value[k].push_back(at[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) one.dx[k] = {dx[k]}, one.dy[k] = {dy[k]};
    TextureCoordinates view = one.view();
    view.one_change = true;
    for (const std::int64_t simd : simd_targets()) {
      const OnTarget on(simd);
      CodeArrays expected(kCount), codes(kCount);
      sampler->sample(each.view(), kCount, expected.at());
      sampler->sample(view, kCount, codes.at());
      for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(codes.plane[k], expected.plane[k]) << round;
      for (std::size_t i = 0; i < kCount; i += 60) {
        ASSERT_EQ(texel_codes(profiles::geforce2, sampler->texel(view, i)), codes.of(i)) << round << ' ' << i;
      }
      levels.insert({codes.plane[0][0], codes.plane[1][0], codes.plane[2][0]});
    }
  }
  EXPECT_GT(levels.size(), 100U);
}

}  // namespace
}  // namespace ninebit::test
