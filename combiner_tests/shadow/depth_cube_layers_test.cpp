// The depth cube's outputs: distances as codes, layers, the watched pixel, facts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "combiner_tests/shadow/depth_cube_support.h"
#include "combiner_tests/shadow/support.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/texture.h"
#include "ninebit/shadow/depth_cube.h"

namespace {

using namespace ninebit;
using shadow_test::draw_depth_cube;
using shadow_test::fact;
using shadow_test::samples_of;

RenderSettings tiny_settings_of(DepthCubeBits bits) {
  RenderSettings settings = shadow_test::depth_cube_settings(bits);
  settings.width = 100;
  settings.height = 75;
  settings.map_size = 64;
  return settings;
}

constexpr std::array kCodes{DepthCubeBits::eight, DepthCubeBits::sixteen};

// A box above a floor that reaches far around the light: all faces of the map but +Y are looked up.
Scene box_over_floor() {
  Scene scene = shadow_test::scene_with({4.0F, 5.0F, 7.0F}, {0.0F, 0.5F, 0.0F}, {-1.0F, 3.0F, 1.0F});
  shadow_test::add_box(scene, "box", {-1.0F, 0.5F, -1.0F}, {1.0F, 1.5F, 1.0F});
  shadow_test::add_quad(scene, "floor", {{{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}});
  return scene;
}

// The code in a texture register's layers at a pixel.
int code_at(const Rendering& r, const std::string& prefix, const std::string& texture, std::size_t i) {
  const int luminance = samples_of<s9>(r.layers, prefix + texture, "R")[i];
  return prefix.empty() ? luminance : 256 * samples_of<s9>(r.layers, prefix + texture, "A")[i] + luminance;
}

TEST(DistanceCode, RampsAreStepsOfOneCodeAndLagByTheBias) {
  const Scene scene = box_over_floor();
  for (const DepthCubeBits bits : kCodes) {
    RenderSettings settings = tiny_settings_of(bits);
    settings.depth_cube.bias = 0.3F;
    const DistanceCode code = distance_code(scene, settings);
    EXPECT_GE(code.bias(), 0.3);
    EXPECT_LT(code.bias(), 0.3 + code.ramp_step());
    EXPECT_EQ(code.map_code(0), 0U);
    EXPECT_EQ(code.map_code(code.ramp_size() - 1), bits == DepthCubeBits::eight ? 255U : 65535U);
    EXPECT_NEAR(code.code_step() * (bits == DepthCubeBits::eight ? 256.0 : 65536.0), code.high - code.low, 1e-4);
    // A code is never above that of a distance that lies nearer by no more than the bias.
    for (std::uint32_t i = 0; i < code.ramp_size(); i += 7) {
      const auto nearer = static_cast<std::uint32_t>(std::max(0.0, std::ceil(i - 0.3 / code.ramp_step())));
      ASSERT_LE(code.camera_code(i), code.map_code(nearer)) << i;
      ASSERT_EQ(code.camera_code(i), i < code.offset ? 0 : code.map_code(i - code.offset));
    }
    settings.depth_cube.bias.reset();
    EXPECT_NEAR(default_depth_cube_bias(scene, settings), 6.0F * code.high / 64.0F, 1e-5F);
    settings.map_size = 128;
    EXPECT_NEAR(default_depth_cube_bias(scene, settings), 6.0F * code.high / 128.0F, 1e-5F);
  }
}

// Each pixel's layers are those of the pass for its own face: own distance, the map's, and the decision.
TEST(DepthCubeLayers, HoldWhatDecidedEachPixel) {
  const Scene scene = box_over_floor();
  for (const DepthCubeBits bits : kCodes) {
    const RenderSettings settings = tiny_settings_of(bits);
    const Rendering r = draw_depth_cube(scene, settings);
    const DistanceCode code = distance_code(scene, settings);
    const std::string prefix = bits == DepthCubeBits::eight ? "" : "low byte ";
    const auto& object = samples_of<std::uint32_t>(r.layers, "object", "object");
    std::array<int, 6> faces{};
    for (int y = 0; y < settings.height; ++y) {
      for (int x = 0; x < settings.width; ++x) {
        const auto i = static_cast<std::size_t>(y * settings.width + x);
        if (object[i] == 0) continue;
        const int own = code_at(r, prefix, "texture0", i), map = code_at(r, prefix, "texture1", i);
        ASSERT_EQ(r.frame.stencil()[i] != 0, own > map) << x << "," << y;
        if (bits == DepthCubeBits::sixteen) {
          ASSERT_EQ(code_at(r, "high byte ", "texture0", i), own);
          ASSERT_EQ(code_at(r, "high byte ", "texture1", i), map);
          const int high = samples_of<s9>(r.layers, "high byte output", "A")[i];
          const int low = samples_of<s9>(r.layers, "low byte output", "A")[i];
          ASSERT_EQ(high > 0 || low > 0, own > map);
        }
        if (object[i] != 2) continue;
        const glm::vec3 p = shadow_test::on_plane(scene, settings, x, y, 0.0F) - scene.lights[0].position;
        const double distance = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        const double expected = (distance - code.bias() - code.low) / code.code_step();
        // Vertices are moved to a sixteenth of a pixel.
        const auto moved = [&](int dx, int dy) {
          const glm::vec3 beside = shadow_test::on_plane(scene, settings, x + dx, y + dy, 0.0F);
          return glm::length(beside - p - scene.lights[0].position);
        };
        const double slack = (moved(1, 0) + moved(0, 1)) / 8.0;
        ASSERT_NEAR(own + 0.5, expected, 0.5 + slack / code.code_step()) << x << "," << y;
        const CubeCoordinate at = cube_coordinate(p.x, p.y, p.z);
        ++faces[static_cast<std::size_t>(at.face)];
        const auto texel = [&](float c) { return static_cast<std::size_t>(c * static_cast<float>(settings.map_size)); };
        const auto near_border = [&](float c) {
          const float t = c * static_cast<float>(settings.map_size);
          return std::fabs(t - std::round(t)) < slack / distance * settings.map_size;
        };
        if (near_border(at.s) || near_border(at.t)) continue;
        const std::size_t t = texel(at.t) * static_cast<std::size_t>(settings.map_size) + texel(at.s);
        const char* const name = std::array{"+X", "-X", "+Y", "-Y", "+Z", "-Z"}[static_cast<std::size_t>(at.face)];
        const int held = bits == DepthCubeBits::eight
                             ? samples_of<std::uint8_t>(r.maps, "depth_cube", name)[t]
                             : static_cast<int>(samples_of<std::uint32_t>(r.maps, "depth_cube", name)[t]);
        ASSERT_EQ(map, held) << x << "," << y;
      }
    }
    for (const std::size_t face : {0U, 1U, 3U, 4U, 5U}) EXPECT_GT(faces[face], 50) << face;
  }
}

TEST(DepthCubeLayers, AreOneSetForEachComparison) {
  const auto count = [](DepthCubeBits bits) {
    return draw_depth_cube(box_over_floor(), tiny_settings_of(bits)).layers.size();
  };
  constexpr std::size_t kSet = 5 * 4 + 1, kFrame = 4;
  EXPECT_EQ(count(DepthCubeBits::eight), kSet + kFrame);
  EXPECT_EQ(count(DepthCubeBits::sixteen), 2 * kSet + kFrame);
  EXPECT_EQ(count(DepthCubeBits::real), 2 + kFrame);
}

// With floats, the planes are those of the comparison.
TEST(DepthCubeLayers, FloatsDecideByTheBias) {
  RenderSettings settings = tiny_settings_of(DepthCubeBits::real);
  settings.depth_cube.bias = 0.25F;
  const Rendering r = draw_depth_cube(box_over_floor(), settings);
  const auto& own = samples_of<float>(r.layers, "own_distance", "distance");
  const auto& map = samples_of<float>(r.layers, "map_distance", "distance");
  for (std::size_t i = 0; i < own.size(); ++i) ASSERT_EQ(r.frame.stencil()[i] != 0, own[i] - 0.25F > map[i]);
  EXPECT_GT(r.shadowed, 200U);
}

TEST(DepthCubeProbe, KeepsThePassesOfThePixelsFace) {
  const Scene scene = box_over_floor();
  for (const DepthCubeBits bits : kCodes) {
    const Rendering whole = draw_depth_cube(scene, tiny_settings_of(bits));
    for (const auto& [x, y] : {std::pair(50, 30), std::pair(10, 20), std::pair(90, 35), std::pair(50, 5)}) {
      RenderSettings settings = tiny_settings_of(bits);
      settings.pixels = {glm::ivec2(x, y)};
      const Rendering r = draw_depth_cube(scene, settings);
      EXPECT_EQ(r.frame.stencil(), whole.frame.stencil());
      std::vector<const ProbedPass*> compared;
      for (const ProbedPass& pass : r.probed[0]) {
        if (pass.program) compared.push_back(&pass);
      }
      ASSERT_EQ(compared.size(), bits == DepthCubeBits::eight ? 1U : 2U);
      const auto i = static_cast<std::size_t>(y * settings.width + x);
      bool marked = false;
      for (const ProbedPass* pass : compared) {
        const ProbedFragment* decided = deciding_fragment(*pass);
        ASSERT_NE(decided, nullptr);
        marked = marked || decided->fate == FragmentFate::written;
        const std::string prefix = bits == DepthCubeBits::eight ? "" : pass->name.substr(0, pass->name.size() - 2);
        for (const auto& [reg, part] : {std::pair(Register::texture0, "texture0"), {Register::texture1, "texture1"}}) {
          EXPECT_EQ(decided->registers[reg][kRed], samples_of<s9>(whole.layers, prefix + part, "R")[i]);
          EXPECT_EQ(decided->registers[reg][kAlpha], samples_of<s9>(whole.layers, prefix + part, "A")[i]);
        }
      }
      EXPECT_EQ(marked, whole.frame.stencil()[i] != 0);
    }
  }
}

// A fragment in shadow met another triangle in the map, nearer to the light; the judge asks for it.
TEST(DepthCubeEvidence, NamesTheTriangleThatTheMapHolds) {
  const Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = tiny_settings_of(DepthCubeBits::sixteen);
  settings.evidence = true;
  const Rendering r = draw_depth_cube(scene, settings);
  ASSERT_TRUE(r.evidence.has_value());
  ASSERT_EQ(r.evidence->fetched.size(), r.frame.stencil().size());
  const auto& object = samples_of<std::uint32_t>(r.layers, "object", "object");
  int shadowed = 0;
  for (std::size_t i = 0; i < object.size(); ++i) {
    if (object[i] == 0) continue;
    const std::uint32_t met = r.evidence->fetched[i];
    ASSERT_GT(met, 0U);
    ASSERT_EQ(r.frame.stencil()[i] != 0, scene.triangle_object[met - 1] + 1 != object[i]);
    shadowed += r.frame.stencil()[i];
  }
  EXPECT_GT(shadowed, 200);
  EXPECT_EQ(r.evidence->in_map, std::vector<bool>(4, true));
}

TEST(DepthCubeFacts, AreThoseOfThePasses) {
  for (const DepthCubeBits bits : kCodes) {
    const RenderSettings settings = tiny_settings_of(bits);
    const Rendering r = draw_depth_cube(box_over_floor(), settings);
    const DistanceCode code = distance_code(box_over_floor(), settings);
    const bool eight = bits == DepthCubeBits::eight;
    EXPECT_EQ(fact<std::string>(r, "depth_bits"), eight ? "8" : "16");
    EXPECT_EQ(fact<std::uint64_t>(r, "texture_units"), 2U);
    EXPECT_EQ(fact<std::uint64_t>(r, "comparison_passes"), eight ? 6U : 12U);
    EXPECT_EQ(fact<std::uint64_t>(r, "general_combiners"), eight ? 1U : 2U);
    EXPECT_EQ(fact<double>(r, "distance_step"), code.code_step());
    EXPECT_EQ(fact<double>(r, "distance_near"), double{code.low});
    EXPECT_EQ(fact<double>(r, "distance_far"), double{code.high});
    EXPECT_EQ(fact<double>(r, "bias"), code.bias());
  }
  const Rendering floats = draw_depth_cube(box_over_floor(), tiny_settings_of(DepthCubeBits::real));
  EXPECT_EQ(fact<std::uint64_t>(floats, "texture_units"), 0U);
  EXPECT_EQ(fact<std::uint64_t>(floats, "comparison_passes"), 0U);
}

}  // namespace
