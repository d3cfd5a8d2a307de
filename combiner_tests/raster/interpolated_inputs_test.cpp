// What reaches registers and planes besides primary colours: secondary colours, fog factors, attributes, and the level
// of detail that a texture's changes give; in perspective, or as the profile says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "combiner_tests/raster/texture_support.h"

namespace ninebit::test {
namespace {

constexpr int kInputsSize = 96;
constexpr double kTangent = 0.8;

struct Input {
  std::array<glm::vec3, 3> positions;
  glm::mat4 matrix = perspective(kTangent, 1.0, 0.2, 40);

  // Weights of the vertices where the ray through a window position meets the triangle's plane.
  [[nodiscard]] glm::dvec3 in_space(double x, double y) const {
    return weights_at(positions, x, y, kInputsSize, kInputsSize, kTangent);
  }
  [[nodiscard]] glm::dvec2 window(std::size_t i) const {
    const glm::dvec3 p(positions[i]);
    return glm::dvec2(p.x, p.y) / (-p.z * kTangent) * (kInputsSize / 2.0) + kInputsSize / 2.0;
  }
  // The same as if there were no perspective.
  [[nodiscard]] glm::dvec3 in_window(double x, double y) const {
    const auto area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const glm::dvec2 p(x, y), a = window(0), b = window(1), c = window(2);
    return glm::dvec3(area(b, c, p), area(c, a, p), area(a, b, p)) / area(a, b, c);
  }
};

Input random_case(Random& random) {
  Input c;
  for (glm::vec3& p : c.positions) {
    const float depth = random.real_f(1, 12), reach = depth * 0.8F;
    p = {random.real_f(-reach, reach), random.real_f(-reach, reach), -depth};
  }
  return c;
}

Surface drawn_with_primitive(const PipelineState& state, const VertexArrays& arrays, const Input& c,
                             std::span<const TextureUnit> units) {
  return drawn_surface(kInputsSize, kInputsSize, state, arrays, units, {.with_primitive = true}, c.matrix);
}

double mix(const glm::dvec3& w, double a, double b, double c) {
  return w.x * a + w.y * b + w.z * c;
}

void expect_secondary_and_fog(ColorInterpolation interpolation, std::uint64_t seed) {
  std::int64_t checked = 0, told = 0;
  for (std::uint64_t index = 0; index < cases_here(150U); ++index) {
    Random random(seed, index);
    const Input c = random_case(random);
    std::array<ColorBytes, 3> colors{};
    std::array<float, 3> fog{};
    for (std::size_t i = 0; i < 3; ++i) {
      colors[i] = {random.byte(), random.byte(), random.byte(), random.byte()};
      fog[i] = random.real_f(-0.2, 1.2);
    }
    PipelineState state;
    state.profile.color_interpolation.value = interpolation;
    state.profile.color_weights.value = ColorWeights::exact;
    state.fog.enabled = true;
    state.program = pass_through(Register::secondary, Register::fog);
    const Surface surface =
        drawn_with_primitive(state, {.positions = c.positions, .secondary_colors = colors, .fog_factors = fog}, c, {});
    const bool affine = interpolation == ColorInterpolation::affine;
    for (int y = 0; y < kInputsSize; ++y) {
      for (int x = 0; x < kInputsSize; ++x) {
        const auto at = static_cast<std::size_t>(y * kInputsSize + x);
        const glm::dvec3 w = c.in_space(x + 0.5, y + 0.5);
        if (surface.primitive()[at] != 0 || std::min({w.x, w.y, w.z}) < 0.02) continue;
        ++checked;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto value = [&](bool in_window) {
            return range_around(x, y, [&](double px, double py) {
              return mix(in_window ? c.in_window(px, py) : c.in_space(px, py), colors[0][k], colors[1][k],
                         colors[2][k]);
            });
          };
          const double drawn = surface.color(static_cast<int>(k))[at];
          const auto [low, high] = value(affine);
          ASSERT_TRUE(drawn >= low - 1 && drawn <= high + 1) << index << ' ' << x << ' ' << y;
          const auto [other_low, other_high] = value(!affine);
          told += drawn < other_low - 1 || drawn > other_high + 1 ? 1 : 0;
        }
        const auto [low, high] = range_around(x, y, [&](double px, double py) {
          const auto unit = [](float f) { return std::clamp(double{f}, 0.0, 1.0); };
          return 255 * mix(c.in_space(px, py), unit(fog[0]), unit(fog[1]), unit(fog[2]));
        });
        const double drawn = surface.color(kAlpha)[at];
        ASSERT_TRUE(drawn >= low - 1 && drawn <= high + 1) << index << ' ' << x << ' ' << y;
      }
    }
  }
  EXPECT_GE(checked, cases_here(20000));
  EXPECT_GE(told, checked / 4);  // the two interpolations differ
}

TEST(InterpolatedInputs, SecondaryColorAndFogInPerspective) {
  expect_secondary_and_fog(ColorInterpolation::perspective, 91);
}
TEST(InterpolatedInputs, SecondaryColorLinearInTheWindow) {
  expect_secondary_and_fog(ColorInterpolation::affine, 92);
}

// The registers' values where the arrays have none.
TEST(InterpolatedInputs, DefaultsOfSecondaryColorAndFog) {
  const std::array<ColorBytes, 3> secondary{{{9, 8, 7, 6}, {9, 8, 7, 6}, {9, 8, 7, 6}}};
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    for (const bool given : {false, true}) {
      PipelineState state;
      state.profile = profile;
      state.fog.color = {20, 40, 60};
      state.program = pass_through(Register::secondary, Register::secondary, profile);
      VertexArrays arrays{.positions = kWholeTarget};
      if (given) arrays.secondary_colors = secondary;
      const Surface colors = drawn_surface(1, 1, state, arrays);
      EXPECT_EQ(colors.color(kRed)[0], given ? 9 : 0);
      const bool as_given = profile.secondary_alpha.value == SecondaryAlpha::as_given;
      EXPECT_EQ(colors.color(kAlpha)[0], given && as_given ? 6 : 255);
      state.program = pass_through(Register::fog, Register::fog, profile);
      const Surface fog = drawn_surface(1, 1, state, arrays);
      EXPECT_EQ(fog.color(kGreen)[0], 40);
      EXPECT_EQ(fog.color(kAlpha)[0], 255);
    }
  }
}

TEST(InterpolatedInputs, AttributesInPerspective) {
  std::int64_t checked = 0;
  for (std::uint64_t index = 0; index < cases_here(100U); ++index) {
    Random random(93, index);
    const Input c = random_case(random);
    std::array<glm::vec4, 3> attribute{};
    for (glm::vec4& a : attribute) a = {random.real_f(-100, 100), random.real_f(0, 1), 1.0F, random.real_f(-1, 1)};
    std::array<std::vector<float>, 4> planes;
    RenderTarget target;
    target.width = target.height = kInputsSize;
    for (int k = 0; k < 4; ++k) {
      auto& plane = planes[static_cast<std::size_t>(k)];
      plane.assign(kInputsSize * kInputsSize, 1e9F);
      target.outputs.push_back({.source = OutputSource::attribute,
                                .attribute = 1,
                                .component = k,
                                .plane = Plane<float>{plane.data(), kInputsSize}});
    }
    VertexArrays arrays{.positions = c.positions};
    arrays.attributes[1] = attribute;
    ASSERT_TRUE(rasterize({}, c.matrix, arrays, {}, target).ok());
    for (int y = 0; y < kInputsSize; ++y) {
      for (int x = 0; x < kInputsSize; ++x) {
        const auto at = static_cast<std::size_t>(y * kInputsSize + x);
        const glm::dvec3 w = c.in_space(x + 0.5, y + 0.5);
        if (planes[0][at] == 1e9F || std::min({w.x, w.y, w.z}) < 0.02) continue;
        ++checked;
        for (int k = 0; k < 4; ++k) {
          const auto [low, high] = range_around(x, y, [&](double px, double py) {
            return mix(c.in_space(px, py), attribute[0][k], attribute[1][k], attribute[2][k]);
          });
          const double drawn = planes[static_cast<std::size_t>(k)][at], slack = 1e-3 + (high - low) * 0.1;
          ASSERT_TRUE(drawn >= low - slack && drawn <= high + slack) << index << ' ' << x << ' ' << y << ' ' << k;
        }
      }
    }
  }
  EXPECT_GE(checked, cases_here(15000));
}

// A texture whose levels say which they are.
const Texture& level_texture() {
  static const Texture texture = texture_of_levels(256, {10, 30, 50, 70, 90, 110, 130, 150, 170});
  return texture;
}
const Sampler kByLevel{.min_filter = MinFilter::nearest_mipmap_nearest, .mag_filter = MagFilter::nearest};

// The level that a pixel takes, by differences over a tiny step of texel(x, y) in exact perspective
// (OpenGL 1.3, 3.8.8); none near the border between two.
template <class Texel>
std::optional<int> level_at(int x, int y, const Texel& texel) {
  const auto [low, high] = range_around(x, y, [&](double px, double py) {
    constexpr double h = 1e-4;
    const double along_x = glm::length(texel(px + h, py) - texel(px - h, py)) / (2 * h);
    const double along_y = glm::length(texel(px, py + h) - texel(px, py - h)) / (2 * h);
    return std::log2(std::max(along_x, along_y));
  });
  const auto level = [](double lambda) { return std::clamp(static_cast<int>(std::ceil(lambda + 0.5)) - 1, 0, 8); };
  if (level(low - 0.15) != level(high + 0.15)) return std::nullopt;
  return level(low);
}

TEST(InterpolatedInputs, ChangesOfTextureCoordinatesGiveTheLevelOfDetail) {
  const std::array<TextureUnit, 1> units{TextureUnit{&level_texture(), kByLevel}};
  std::int64_t checked = 0;
  std::array<int, 9> reached{};
  for (std::uint64_t index = 0; index < cases_here(200U); ++index) {
    Random random(94, index);
    const Input c = random_case(random);
    const float spread = static_cast<float>(std::exp2(random.real(-3, 5)));
    std::array<glm::vec3, 3> coordinates{};
    for (glm::vec3& t : coordinates) t = {random.real_f(-spread, spread), random.real_f(-spread, spread), 0};
    PipelineState state;
    state.program = pass_through(Register::texture0, Register::texture0);
    VertexArrays arrays{.positions = c.positions};
    arrays.texture_coordinates[0] = coordinates;
    const Surface surface = drawn_with_primitive(state, arrays, c, units);
    const auto texel = [&](double x, double y) {
      const glm::dvec3 w = c.in_space(x, y);
      return 256.0 * glm::dvec2(mix(w, coordinates[0].x, coordinates[1].x, coordinates[2].x),
                                mix(w, coordinates[0].y, coordinates[1].y, coordinates[2].y));
    };
    for (int y = 0; y < kInputsSize; ++y) {
      for (int x = 0; x < kInputsSize; ++x) {
        const auto at = static_cast<std::size_t>(y * kInputsSize + x);
        const glm::dvec3 w = c.in_space(x + 0.5, y + 0.5);
        if (surface.primitive()[at] != 0 || std::min({w.x, w.y, w.z}) < 0.05) continue;
        const std::optional<int> level = level_at(x, y, texel);
        if (!level) continue;
        ++checked;
        ++reached[static_cast<std::size_t>(*level)];
        ASSERT_EQ(surface.color(kRed)[at], 20 * *level + 10) << index << ' ' << x << ' ' << y;
      }
    }
  }
  EXPECT_GE(checked, cases_here(20000));
  for (std::size_t level = 0; level < 7; ++level) EXPECT_GE(reached[level], cases_here(300)) << level;
}

// A texture whose texels are their own numbers, at (s/q, t/q), and the level that the changes of s/q and t/q ask for.
TEST(InterpolatedInputs, ProjectiveCoordinatesAreDividedByQ) {
  std::vector<std::uint8_t> numbers(256);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i);
  const Texture ramp =
      make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{{256, 1, numbers}}}).value();
  const std::array<TextureUnit, 2> units{TextureUnit{&ramp, kNearestSampler}, TextureUnit{&level_texture(), kByLevel}};
  std::int64_t checked = 0, told = 0, levels_checked = 0;
  for (std::uint64_t index = 0; index < cases_here(200U); ++index) {
    Random random(95, index);
    const Input c = random_case(random);
    std::array<glm::vec3, 3> coordinates{}, fine{};
    std::array<float, 3> q{};
    const float scale = static_cast<float>(std::exp2(random.real(-2, 4)));
    for (std::size_t i = 0; i < 3; ++i) {
      q[i] = random.real_f(0.5, 4);
      coordinates[i] = glm::vec3(random.real_f(0, 1) * q[i], 0.3F * q[i], 0);
      fine[i] = glm::vec3(random.real_f(-scale, scale), random.real_f(-scale, scale), 0);
    }
    PipelineState state;
    state.program = pass_through(Register::texture0, Register::texture1);
    VertexArrays arrays{.positions = c.positions};
    arrays.texture_coordinates = {coordinates, fine};
    arrays.texture_q = {q, q};
    const Surface surface = drawn_with_primitive(state, arrays, c, units);
    state.program = pass_through(Register::texture1, Register::texture1);
    const Surface second = drawn_with_primitive(state, arrays, c, units);
    const auto over_q = [&](const glm::dvec3& w, double s0, double s1, double s2) {
      return mix(w, s0, s1, s2) / mix(w, q[0], q[1], q[2]);
    };
    const auto texel = [&](double x, double y) {
      const glm::dvec3 w = c.in_space(x, y);
      return 256.0 * glm::dvec2(over_q(w, fine[0].x, fine[1].x, fine[2].x), over_q(w, fine[0].y, fine[1].y, fine[2].y));
    };
    for (int y = 0; y < kInputsSize; ++y) {
      for (int x = 0; x < kInputsSize; ++x) {
        const auto at = static_cast<std::size_t>(y * kInputsSize + x);
        const glm::dvec3 w = c.in_space(x + 0.5, y + 0.5);
        if (surface.primitive()[at] != 0 || std::min({w.x, w.y, w.z}) < 0.05) continue;
        ++checked;
        const int drawn = surface.color(kRed)[at];
        const auto within = [&](auto&& value) {
          const auto [low, high] =
              range_around(x, y, [&](double px, double py) { return 256.0 * value(c.in_space(px, py)); });
          return drawn >= std::floor(low - 0.01) && drawn <= std::floor(high + 0.01);
        };
        ASSERT_TRUE(within([&](const glm::dvec3& v) {
          return over_q(v, coordinates[0].x, coordinates[1].x, coordinates[2].x);
        })) << index
            << ' ' << x << ' ' << y;
        told += within([&](const glm::dvec3& v) {
          return mix(v, coordinates[0].x / q[0], coordinates[1].x / q[1], coordinates[2].x / q[2]);
        })
                    ? 0
                    : 1;
        const std::optional<int> level = level_at(x, y, texel);
        if (!level) continue;
        ++levels_checked;
        ASSERT_EQ(second.color(kRed)[at], 20 * *level + 10) << index << ' ' << x << ' ' << y;
      }
    }
  }
  EXPECT_GE(checked, cases_here(30000));
  EXPECT_GE(told, checked / 4);  // dividing at the vertices is something else
  EXPECT_GE(levels_checked, cases_here(20000));
}

TEST(InterpolatedInputs, CubeMapsDoNotLookAtQ) {
  std::vector<std::vector<TextureSamples>> faces;
  for (int face = 0; face < 6; ++face) {
    faces.push_back({{1, 1, std::vector<std::uint8_t>{static_cast<std::uint8_t>(40 * face + 5)}}});
  }
  const Texture cube = make_texture(TextureTarget::cube_map, InternalFormat::luminance8, faces).value();
  const std::array<TextureUnit, 1> units{TextureUnit{&cube, kNearestSampler}};
  const std::array<glm::vec3, 3> directions{glm::vec3(-2, 0.1F, 1), glm::vec3(2, 0.1F, 1), glm::vec3(0.3F, 2, -3)};
  const std::array<float, 3> q{-2.0F, -0.5F, -1.0F};
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  std::array<PlaneSamples<std::uint8_t>, 2> drawn;
  for (const bool with_q : {false, true}) {
    VertexArrays arrays{.positions = kWholeTarget};
    arrays.texture_coordinates[0] = directions;
    if (with_q) arrays.texture_q[0] = q;
    drawn[with_q ? 1 : 0] = drawn_surface(32, 32, state, arrays, units).color(kRed);
  }
  EXPECT_EQ(drawn[0], drawn[1]);
  EXPECT_NE(*std::min_element(drawn[0].begin(), drawn[0].end()), *std::max_element(drawn[0].begin(), drawn[0].end()));
}

}  // namespace
}  // namespace ninebit::test
