// Byte textures in SIMD lanes: on every target the same codes as the scalar texel(), fragment by
// fragment.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/slow_build.h"
#include "src/raster/texture/texture_level.h"

namespace ninebit::test {
namespace {

constexpr std::array kByteFormats{
    InternalFormat::alpha8,     InternalFormat::luminance8, InternalFormat::luminance8_alpha8,
    InternalFormat::intensity8, InternalFormat::rgb8,       InternalFormat::rgba8};
constexpr std::array kTargets{TextureTarget::texture_2d, TextureTarget::cube_map};

Sampler nearest(Wrap wrap_s, Wrap wrap_t) {
  Sampler sampler = kNearestSampler;
  sampler.wrap_s = wrap_s;
  sampler.wrap_t = wrap_t;
  sampler.border_color = {1, 0.5F, 0.25F, 0};
  return sampler;
}

Sampler linear(Wrap wrap_s, Wrap wrap_t) {
  Sampler sampler = nearest(wrap_s, wrap_t);
  sampler.min_filter = MinFilter::linear;
  sampler.mag_filter = MagFilter::linear;
  return sampler;
}

HardwareProfile with_random_filters(Random& random, HardwareProfile profile) {
  profile.texture_weight_bits.value = random.between(1, 8);
  profile.texture_weight_narrowing.value = random.pick({Narrowing::toward_zero, Narrowing::nearest_halves_up});
  profile.texture_filter_rounding.value = random.pick({FilterRounding::once, FilterRounding::each_blend});
  return profile;
}

// What a filter may have to tell apart: zeros, the smallest and largest, no numbers, powers of two and their
// neighbours.
std::vector<float> adversarial_values() {
  using Limits = std::numeric_limits<float>;
  std::vector<float> values{0.0F,
                            Limits::denorm_min(),
                            3 * Limits::denorm_min(),
                            Limits::min() / 2,
                            Limits::min(),
                            1e-30F,
                            0.3F,
                            Limits::max() / 2,
                            Limits::max(),
                            Limits::infinity()};
  for (const float power : {0x1p-10F, 0.5F, 1.0F, 2.0F, 0x1p23F, 0x1p24F, 0x1p31F}) {
    values.insert(values.end(), {std::nextafter(power, 0.0F), power, std::nextafter(power, 1e30F)});
  }
  const std::size_t positive = values.size();
  for (std::size_t i = 0; i < positive; ++i) values.push_back(-values[i]);
  values.push_back(Limits::quiet_NaN());
  return values;
}

std::string describe(const CoordinateArrays& at, std::size_t i) {
  char text[120];
  std::snprintf(text, sizeof text, "fragment %zu at %a %a %a", i, static_cast<double>(at.value[0][i]),
                static_cast<double>(at.value[1][i]), static_cast<double>(at.value[2][i]));
  return text;
}

// sample() on every target, all at once, against texel(). Counts where the codes change from fragment to fragment.
void expect_as_scalar(const HardwareProfile& profile, const Texture& texture, const Sampler& parameters,
                      const CoordinateArrays& at, int& changes) {
  const auto sampler = TextureSampler::make(profile, texture, parameters);
  ASSERT_TRUE(sampler.has_value());
  const auto wraps = [&](Wrap wrap) { return parameters.wrap_s == wrap || parameters.wrap_t == wrap; };
  const bool filters = is_linear(parameters.min_filter) || parameters.mag_filter == MagFilter::linear;
  const bool in_words = texture.format == InternalFormat::rgb8 || texture.format == InternalFormat::rgba8;
  const bool has_border = parameters.border_texels || wraps(Wrap::clamp_to_border) || (filters && wraps(Wrap::clamp));
  const bool has_key = parameters.color_key.operation != ColorKeyOperation::disable;
  // A key that gives an alpha to texels without one is applied texel by texel.
  const bool adds_alpha = texture.format == InternalFormat::rgb8 && sampler->format() == TextureFormat::rgba;
  const bool in_lanes = !adds_alpha && !(has_key && filters) && !(has_border && filters && !in_words) &&
                        !((has_key || !in_words) && sampler->needs_derivatives());
  CodeArrays expected(at.size());
  std::vector<std::uint8_t> expected_killed;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Rgba9 codes = texel_codes(profile, sampler->texel(at.view(), i));
    for (std::size_t k = 0; k < 4; ++k) expected.plane[k][i] = codes[k];
    expected_killed.push_back(sampler->kills(at.view(), i) ? 1 : 0);
    if (i > 0 && codes != expected.of(i - 1)) ++changes;
  }
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    CodeArrays codes(at.size());
    std::vector<std::uint8_t> killed(at.size());  // a sanitizer sees a write beyond
    sampler->sample(at.view(), at.size(), codes.at(), killed.data());
    if (chosen_at_run_time()) {
      ASSERT_EQ(on.ran(), in_lanes);
    }
    ASSERT_EQ(killed, expected_killed) << simd_target_name(target);
    if (codes.plane == expected.plane) continue;
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_EQ(codes.of(i), expected.of(i))
          << simd_target_name(target) << ", " << texture.faces[0][0].width << " x " << texture.faces[0][0].height
          << ", format " << static_cast<int>(texture.format) << ", wraps " << static_cast<int>(parameters.wrap_s) << ' '
          << static_cast<int>(parameters.wrap_t) << ", " << describe(at, i);
    }
  }
}

TEST(TextureLanes, AdversarialDirectionsOfACube) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::vector<float> values = adversarial_values();
  CoordinateArrays at;
  for (const float x : values) {
    for (const float y : values) {
      for (std::size_t i = at.size() % 3; i < values.size(); i += kSlowBuild ? 9 : 3) at.push({x, y, values[i]});
      at.push({x, y, x});
      at.push({x, y, -y});
    }
  }
  Random random(51);
  for (const int size : {1, 2, 8, 512}) {
    const Texture texture = random_texture(random, TextureTarget::cube_map, InternalFormat::rgb8, size, size, false);
    int changes = 0;
    for (const auto& [s, t] : {std::pair{Wrap::clamp_to_edge, Wrap::clamp_to_edge},
                               {Wrap::repeat, Wrap::mirrored_repeat},
                               {Wrap::clamp, Wrap::repeat}}) {
      for (const Sampler& sampler : {nearest(s, t), linear(s, t)}) {
        expect_as_scalar(profiles::geforce2, texture, sampler, at, changes);
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_GE(changes, static_cast<int>(at.size()) / 2);
  }
}

// Coordinates that are hard to tell apart, in a texture of so many texels. `borders`: images that hold a border around
// their texels, with other filters of profiles.
void expect_plane_as_scalar(Random& random, InternalFormat format, int width, int height, bool borders) {
  const std::vector<float> values = adversarial_values();
  const Texture texture = random_texture(random, TextureTarget::texture_2d, format, width, height, false);
  CoordinateArrays at;
  for (const float s : values) {
    for (const float t : values) at.push({s, t, 0});
  }
  for (int i = 0; i < (kSlowBuild ? 500 : 4000); ++i) {
    // Where a border is stored, and just beyond.
    if (borders && i % 2 == 0) {
      at.push({random.real_f(-1, 2), random.real_f(-1, 2), 0});
    } else {
      const int part = borders ? 2 : 1;
      at.push({random_coordinate(random, width / part), random_coordinate(random, height / part), 0});
    }
  }
  int changes = 0;
  std::size_t fragments = 0;
  for (const Wrap s : kWraps) {
    for (const Wrap t : kWraps) {
      for (Sampler sampler : {nearest(s, t), linear(s, t)}) {
        sampler.border_texels = borders && !random.one_in(4);
        const HardwareProfile profile = borders ? with_random_filters(random, profiles::nv2a) : profiles::geforce2;
        expect_as_scalar(profile, texture, sampler, at, changes);
        if (testing::Test::HasFatalFailure()) return;
        fragments += at.size();
      }
    }
  }
  EXPECT_GE(changes, width * height == 1 ? 0 : static_cast<int>(fragments / (borders ? 8 : 50)));
}

TEST(TextureLanes, AdversarialCoordinatesInTwoDimensions) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Random random(52);
  for (const auto& [width, height, format] : {std::tuple{1, 1, InternalFormat::rgba8},
                                              {2, 16, InternalFormat::luminance8_alpha8},
                                              {64, 1, InternalFormat::rgb8},
                                              {1024, 32, InternalFormat::luminance8_alpha8},
                                              {16, 2048, InternalFormat::rgba8}}) {
    expect_plane_as_scalar(random, format, width, height, false);
  }
}

TEST(TextureLanes, BorderTexels) {
  Random random(58);
  for (const auto& [width, height, format] : {std::tuple{16, 16, InternalFormat::rgba8},
                                              {32, 128, InternalFormat::luminance8_alpha8},
                                              {1024, 16, InternalFormat::rgb8}}) {
    expect_plane_as_scalar(random, format, width, height, true);
  }
}

// Directions whose s or t lies on an edge between texels, or a float beside it.
TEST(TextureLanes, EdgesOfTexelsOnEveryFace) {
  Random random(53);
  for (const int size : {1, 4, 32, 256, 1024}) {
    const Texture texture =
        random_texture(random, TextureTarget::cube_map, InternalFormat::luminance8, size, size, false);
    CoordinateArrays at;
    for (int i = 0; i < (kSlowBuild ? 2000 : 20000); ++i) {
      const float major = std::ldexp(random.one_in(2) ? 1.0F : random.real_f(1, 2), random.between(-140, 120));
      const auto minor = [&] {
        const float edge = static_cast<float>(2 * random.between(0, size) - size) / static_cast<float>(size) * major;
        return random.pick(
            {edge, std::nextafter(edge, 1e38F), std::nextafter(edge, -1e38F), random.real_f(-1, 1) * major});
      };
      std::array<float, 3> r{minor(), minor(), minor()};
      r[static_cast<std::size_t>(random.below(3))] = random.one_in(2) ? major : -major;
      at.push(r);
    }
    int changes = 0;
    expect_as_scalar(profiles::geforce2, texture, kNearestSampler, at, changes);
    if (HasFatalFailure()) return;
    EXPECT_GE(changes, static_cast<int>(at.size()) / 2);
    expect_as_scalar(profiles::geforce2, texture, linear(Wrap::repeat, Wrap::clamp_to_edge), at, changes);
    if (HasFatalFailure()) return;
  }
}

TEST(TextureLanes, EveryFormatAndProfile) {
  Random random(54);
  for (const InternalFormat format : kByteFormats) {
    for (const TextureTarget target : kTargets) {
      const Texture texture = random_texture(random, target, format, 32, 32, false);
      CoordinateArrays at;
      for (int i = 0; i < (kSlowBuild ? 300 : 3000); ++i)
        at.push({random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)});
      int changes = 0;
      for (const HardwareProfile& profile : {profiles::geforce2, profiles::geforce256_8bit}) {
        expect_as_scalar(profile, texture, nearest(Wrap::mirrored_repeat, Wrap::repeat), at, changes);
        if (HasFatalFailure()) return;
        HardwareProfile coarse = profile;
        for (int bits = 1; bits <= 8; ++bits) {
          coarse.texture_weight_bits.value = bits;
          const bool by_nv2a = random.one_in(2);
          coarse.texture_weight_narrowing.value = by_nv2a ? Narrowing::toward_zero : Narrowing::nearest_halves_up;
          coarse.texture_filter_rounding.value = by_nv2a ? FilterRounding::each_blend : FilterRounding::once;
          expect_as_scalar(coarse, texture, linear(Wrap::mirrored_repeat, Wrap::repeat), at, changes);
          if (HasFatalFailure()) return;
        }
      }
      EXPECT_GE(changes, 2 * static_cast<int>(at.size()));
    }
  }
}

// Levels of detail from far below 0 to beyond the last level, whole ones and the numbers beside them.
TEST(TextureLanes, EveryFilterOfMipmaps) {
  Random random(57);
  int changes = 0;
  std::size_t fragments = 0;
  for (const TextureTarget target : kTargets) {
    const bool cube = target == TextureTarget::cube_map;
    for (const auto& [width, height] : {std::pair{1, 1}, {32, 32}, {128, 4}}) {
      if (cube && width != height) continue;
      const InternalFormat format = random.pick({InternalFormat::rgb8, InternalFormat::rgba8});
      const Texture texture = random_texture(random, target, format, width, height, true);
      for (const MinFilter min_filter : kMinFilters) {
        for (const MagFilter mag_filter : kMagFilters) {
          CoordinateArrays at;
          for (int i = 0; i < (kSlowBuild ? 100 : 1500); ++i) {
            const auto change = [&] {
              return std::array{random_change(random), random_change(random), random_change(random)};
            };
            const auto place = [&, size = width] {
              return cube ? random.real_f(-1, 1) : random_coordinate(random, size);
            };
            at.push({place(), place(), place()}, change(), change());
          }
          const HardwareProfile profile = with_random_filters(random, profiles::geforce2);
          for (const Wrap wrap_s : kWraps) {
            Sampler sampler = linear(wrap_s, kWraps[static_cast<std::size_t>(random.below(kWraps.size()))]);
            sampler.min_filter = min_filter;
            sampler.mag_filter = mag_filter;
            sampler.lod_bias = random.pick({0.0F, -2.5F, 1.0F, 0.01F});
            expect_as_scalar(profile, texture, sampler, at, changes);
            if (HasFatalFailure()) return;
            fragments += at.size();
          }
        }
      }
    }
  }
  EXPECT_GE(changes, static_cast<int>(fragments / 3));
}

// Textures of a few colours, one of which is the key, and the border's colour.
TEST(TextureLanes, ColorKeys) {
  Random random(59);
  int changes = 0, keyed = 0;
  std::size_t fragments = 0;
  for (const InternalFormat format : {InternalFormat::rgb8, InternalFormat::rgba8}) {
    std::vector<std::uint8_t> planes;
    for (int i = 0; i < 16 * 16 * (format == InternalFormat::rgb8 ? 3 : 4); ++i) {
      planes.push_back(random.pick<std::uint8_t>({128, 255}));
    }
    const Texture texture = make_texture(TextureTarget::texture_2d, format, {{{16, 16, planes}}}).value();
    CoordinateArrays at;
    for (int i = 0; i < 777; ++i) at.push({random_coordinate(random, 16), random_coordinate(random, 16), 0});
    for (const ColorKeyOperation operation :
         {ColorKeyOperation::alpha, ColorKeyOperation::rgba, ColorKeyOperation::kill}) {
      for (const std::uint32_t key : {0xFF80FF80U, 0x80FFFF80U, 0xFF8080FFU, 0x12FF8080U, 0x80808080U, 0x7F80FF80U}) {
        Sampler sampler = nearest(random.pick({Wrap::clamp_to_border, Wrap::repeat}), Wrap::repeat);
        sampler.color_key = {operation, key};
        sampler.border_color = {0.5F, 1, 1, 1};  // 0xFF80FFFF
        expect_as_scalar(random.pick({profiles::nv2a, profiles::geforce256_8bit}), texture, sampler, at, changes);
        if (HasFatalFailure()) return;
        fragments += at.size();
        const auto made = TextureSampler::make(profiles::nv2a, texture, sampler);
        for (std::size_t i = 0; i < at.size(); ++i) keyed += made->kills(at.view(), i) ? 1 : 0;
      }
    }
  }
  EXPECT_GE(changes, static_cast<int>(fragments / 3));
  EXPECT_GE(keyed, static_cast<int>(fragments / 100));
}

// Every number of fragments, from one face or many: exactly these are read and written.
TEST(TextureLanes, EveryCountOfFragments) {
  Random random(55);
  for (const TextureTarget target : kTargets) {
    const Texture texture = random_texture(random, target, InternalFormat::rgba8, 64, 64, false);
    const auto by_nearest = TextureSampler::make(profiles::geforce2, texture, nearest(Wrap::repeat, Wrap::repeat));
    const auto by_linear = TextureSampler::make(profiles::geforce2, texture, linear(Wrap::repeat, Wrap::repeat));
    for (const std::int64_t simd : simd_targets()) {
      const OnTarget on(simd);
      for (std::size_t count = 0; count <= 2 * kBatchSize + 2; count += count < kBatchSize + 2 ? 1 : 37) {
        CoordinateArrays at;  // as long as what is sampled: a sanitizer sees a read beyond
        for (std::size_t i = 0; i < count; ++i) {
          at.push({random.real_f(-1, 1), random.real_f(-1, 1), count % 2 == 0 ? 1.0F : random.real_f(-1, 1)});
        }
        for (std::vector<float>& values : at.value) values.shrink_to_fit();
        CodeArrays codes(count + 40);
        const auto& sampler = count % 3 == 0 ? by_linear : by_nearest;
        sampler->sample(at.view(), count, codes.at(3));
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(codes.of(i + 3), texel_codes(profiles::geforce2, sampler->texel(at.view(), i)))
              << simd_target_name(simd) << ", " << count << " fragments, " << describe(at, i);
        }
        for (std::size_t i = 0; i < codes.plane[0].size(); ++i) {
          if (i >= 3 && i < count + 3) continue;
          ASSERT_EQ(codes.of(i), (Rgba9{-999, -999, -999, -999})) << simd_target_name(simd) << ' ' << count << ' ' << i;
        }
      }
    }
  }
}

// Planes with padded rows, upside down, longer rows than a batch's offsets hold, all alike or each its own.
TEST(TextureLanes, RowsOfEveryLength) {
  Random random(56);
  constexpr int kSize = 8;
  const std::vector<std::ptrdiff_t> strides{kSize, kSize + 5, -kSize, -40, 0x1FFFF, 0x20000, -0x20001};
  for (const TextureTarget target : kTargets) {
    const std::size_t face_count = target == TextureTarget::cube_map ? 6 : 1;
    for (std::size_t choice = 0; choice <= strides.size(); ++choice) {
      std::vector<std::vector<std::uint8_t>> samples;
      std::vector<TextureImage> faces;
      for (std::size_t f = 0; f < face_count; ++f) {
        std::array<Plane<const std::uint8_t>, 4> planes{};
        for (std::size_t k = 0; k < 3; ++k) {
          const std::ptrdiff_t stride =
              choice < strides.size() ? strides[choice] : strides[static_cast<std::size_t>(random.below(7))];
          samples.emplace_back(static_cast<std::size_t>(std::abs(stride) * (kSize - 1) + kSize));
          const std::ptrdiff_t first = stride < 0 ? -stride * (kSize - 1) : 0;
          for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
              samples.back()[static_cast<std::size_t>(first + stride * y + x)] = random.byte();
            }
          }
          planes[k] = {samples.back().data() + first, stride};
        }
        faces.push_back({kSize, kSize, planes});
      }
      const Texture texture = texture_view(InternalFormat::rgb8, faces);
      CoordinateArrays many, one;
      for (int i = 0; i < 600; ++i) {
        many.push({random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)});
        one.push({random.real_f(-1, 1), random.real_f(-1, 1), -1});
      }
      int changes = 0;
      expect_as_scalar(profiles::geforce2, texture, kNearestSampler, many, changes);
      expect_as_scalar(profiles::geforce2, texture, kNearestSampler, one, changes);
      expect_as_scalar(profiles::geforce2, texture, linear(Wrap::repeat, Wrap::clamp_to_edge), many, changes);
      if (HasFatalFailure()) return;
      EXPECT_GE(changes, 800);
    }
  }
}

// Words of RGBA, and samples interleaved otherwise.
TEST(TextureLanes, TexelsOfEveryStep) {
  struct Layout {
    InternalFormat format;
    int step, gap;  // from one texel to the next; bytes after a row
    std::array<int, 4> place;
    bool with_alpha;  // whether the texture is told where alpha is
  };
  using enum InternalFormat;
  const std::vector<Layout> layouts{
      {rgb8, 4, 0, {0, 1, 2, 3}, true},       {rgb8, 4, 0, {0, 1, 2, 3}, false},
      {rgba8, 4, 0, {0, 1, 2, 3}, true},      {rgba8, 4, 8, {0, 1, 2, 3}, true},
      {rgba8, 4, 3, {0, 1, 2, 3}, true},      {rgba8, 4, 8, {1, 2, 3, 4}, true},
      {rgba8, 4, 0, {2, 1, 0, 3}, true},      {rgb8, 3, 0, {0, 1, 2, 0}, false},
      {rgb8, 5, 1, {4, 0, 2, 0}, false},      {luminance8_alpha8, 2, 0, {0, 0, 0, 1}, true},
      {luminance8, 4, 4, {1, 0, 0, 0}, false}};
  Random random(57);
  constexpr int kSize = 16;
  for (const Layout& layout : layouts) {
    for (const TextureTarget target : kTargets) {
      const std::array<bool, 4> stored = stored_components(layout.format);
      const int stride = layout.step * kSize + layout.gap;
      std::vector<std::vector<std::uint8_t>> samples;
      std::vector<TextureImage> faces, apart;
      for (std::size_t f = 0; f < (target == TextureTarget::cube_map ? 6U : 1U); ++f) {
        std::vector<std::uint8_t>& own = samples.emplace_back(static_cast<std::size_t>(stride * kSize));
        for (std::uint8_t& sample : own) sample = random.byte();
        std::array<Plane<const std::uint8_t>, 4> planes{};
        for (std::size_t k = 0; k < 4; ++k) {
          if (!stored[k] && !(k == kAlpha && layout.with_alpha)) continue;
          planes[k] = {own.data() + layout.place[k], stride, layout.step};
        }
        faces.push_back({kSize, kSize, planes});
      }
      const Texture texture = texture_view(layout.format, faces);
      ASSERT_TRUE(check_texture(texture).ok());
      CoordinateArrays many, one;
      for (int i = 0; i < 1000; ++i) {
        many.push({random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)});
        one.push({random.real_f(-1, 1), random.real_f(-1, 1), -1});
      }
      int changes = 0;
      expect_as_scalar(profiles::geforce2, texture, kNearestSampler, many, changes);
      expect_as_scalar(profiles::geforce256_8bit, texture, kNearestSampler, one, changes);
      expect_as_scalar(profiles::geforce2, texture, linear(Wrap::repeat, Wrap::clamp_to_edge), many, changes);
      // The same memory from its last row on, upside down; fewer coordinates than a group has.
      for (TextureImage& face : faces) {
        for (auto& plane : std::get<0>(face.planes)) {
          if (plane) plane = {plane.row(kSize - 1), -plane.stride, plane.step};
        }
      }
      const Texture turned = texture_view(layout.format, faces);
      expect_as_scalar(profiles::geforce2, turned, kNearestSampler, many, changes);
      CoordinateArrays few;
      for (int i = 0; i < 5; ++i) few.push({random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)});
      expect_as_scalar(profiles::geforce2, turned, kNearestSampler, few, changes);
      if (HasFatalFailure()) return;
      EXPECT_GE(changes, 2000);
      // The scalar side reads the bytes that the layout says.
      const auto sampler = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize && target == TextureTarget::texture_2d; ++x) {
          const Texel texel =
              texel_at(*sampler, {(static_cast<float>(x) + 0.5F) / kSize, (static_cast<float>(y) + 0.5F) / kSize, 0});
          for (std::size_t k = 0; k < 4; ++k) {
            if (!stored[k]) continue;
            ASSERT_EQ(texel.value[k],
                      samples[0][static_cast<std::size_t>(stride * y + layout.step * x + layout.place[k])]);
          }
        }
      }
    }
  }
}

// Rows farther apart than 32 bits can say. Only the pages that are touched become memory.
TEST(TextureLanes, RowsFarApart) {
  constexpr std::ptrdiff_t kStride = std::ptrdiff_t{1} << 32;
  constexpr std::size_t kBytes = static_cast<std::size_t>(kStride) + 4096;
  void* const mapped =
      mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) GTEST_SKIP() << "no 4 GiB of addresses here";
  auto* const bytes = static_cast<std::uint8_t*>(mapped);
  for (int i = 0; i < 4; ++i) bytes[kStride * (i / 2) + i % 2] = static_cast<std::uint8_t>(20 + i);
  const std::array<Plane<const std::uint8_t>, 4> planes{{{bytes, kStride}}};
  const Texture texture = texture_view(InternalFormat::luminance8, std::vector<TextureImage>{{2, 2, planes}});
  CoordinateArrays at;
  for (int i = 0; i < 100; ++i) at.push({i % 2 == 0 ? 0.3F : 0.7F, i % 3 == 0 ? 0.3F : 0.7F, 0});
  int changes = 0;
  expect_as_scalar(profiles::geforce2, texture, kNearestSampler, at, changes);
  EXPECT_EQ(munmap(mapped, kBytes), 0);
  EXPECT_EQ(changes, 99);
}

}  // namespace
}  // namespace ninebit::test
