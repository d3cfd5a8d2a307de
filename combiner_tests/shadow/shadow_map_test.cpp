// Shadow maps on scenes whose answer is a formula.
#include "ninebit/shadow/shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "combiner_tests/shadow/shadow_map_support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;
using shadow_test::fact;
using shadow_test::for_each_pixel;
using shadow_test::render_map;
using shadow_test::samples_of;
using shadow_test::small_settings;

constexpr std::array kEncodings{DepthEncoding::d24, DepthEncoding::d16, DepthEncoding::rgba8_mod,
                                DepthEncoding::rgba8_256over255, DepthEncoding::rgba8_modf};

struct FloorCount {
  int lit = 0, shadowed = 0;
};

// Compares the floor of square_over_floor(), but for a texel on both sides of a boundary, with a formula of x and z
// that gives how far inside the light a point lies, in world units.
template <class Distance>
FloorCount expect_floor(const Scene& scene, const RenderSettings& settings, float texel, Distance inside_light) {
  const Rendering r = render_map(scene, settings);
  const auto& object = samples_of<std::uint32_t>(r.layers, "object", "object");
  FloorCount count;
  for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    if (object[i] == 2) {
      EXPECT_EQ(r.frame.stencil()[i], 0) << "the square at " << x << ", " << y;
    }
    if (object[i] != 1) return;
    const glm::vec3 p = shadow_test::on_plane(scene, settings, x, y, 0.0F);
    const float distance = inside_light(p);
    if (std::fabs(distance) < 1.01F * texel || std::max(std::fabs(p.x), std::fabs(p.z)) > 3.9F) return;
    EXPECT_EQ(r.frame.stencil()[i], distance > 0.0F ? 0 : 1) << "floor at " << p.x << ", " << p.z;
    ++(distance > 0.0F ? count.lit : count.shadowed);
  });
  EXPECT_EQ(r.background + r.lit + r.shadowed, static_cast<std::uint64_t>(settings.width * settings.height));
  return count;
}

// The beam of 90 degrees meets the floor in |x|, |z| < 3, the shadow is |x|, |z| < 1.5.
TEST(ShadowMap, SpotLightOverASquareByTheFormula) {
  Scene scene = shadow_test::square_over_floor();
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  for (const DepthEncoding encoding : kEncodings) {
    for (const DepthStencilFormat frame : {DepthStencilFormat::d24s8, DepthStencilFormat::d15s1}) {
      SCOPED_TRACE(testing::Message() << "encoding " << static_cast<int>(encoding));
      RenderSettings settings = small_settings();
      settings.shadow_map.encoding = encoding;
      settings.depth_stencil = frame;
      const FloorCount count = expect_floor(scene, settings, 6.0F / 256.0F, [](const glm::vec3& p) {
        const float reach = std::max(std::fabs(p.x), std::fabs(p.z));
        return std::min(reach - 1.5F, 3.0F - reach);
      });
      EXPECT_GT(count.lit, 3000);
      EXPECT_GT(count.shadowed, 1500);
    }
  }
}

// Parallel light moves the square's outline over the floor without widening it, and reaches everything.
TEST(ShadowMap, DirectionalLightOverASquareByTheFormula) {
  Scene scene = shadow_test::square_over_floor();
  scene.lights[0] = shadow_test::directional_light({0.5F, -1.0F, 0.25F});
  const float diameter = bounds_of(scene).diagonal() * 1.01F;
  for (const DepthEncoding encoding : kEncodings) {
    SCOPED_TRACE(testing::Message() << "encoding " << static_cast<int>(encoding));
    RenderSettings settings = small_settings();
    settings.shadow_map.encoding = encoding;
    // A texel across the light's axis is longer on the floor, which the light meets at an angle.
    const float texel = diameter / static_cast<float>(settings.map_size) * std::sqrt(1.3125F) * 1.5F;
    const FloorCount count = expect_floor(scene, settings, texel, [](const glm::vec3& p) {
      return std::max(std::fabs(p.x - 0.5F), std::fabs(p.z - 0.25F)) - 1.0F;
    });
    EXPECT_GT(count.lit, 5000);
    EXPECT_GT(count.shadowed, 300);
  }
}

// A lamp that shines sideways lights one half of the floor's plane alone: the other one is behind it, though its points
// have s/q and t/q within the map.
TEST(ShadowMap, NoLightFallsBehindASpotLight) {
  Scene scene = shadow_test::scene_with({1.0F, 7.0F, 7.0F}, {0.0F, 0.0F, 0.0F}, {});
  shadow_test::add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
  scene.lights[0] = shadow_test::spot_light({0, 1, 0}, {1, 1, 0}, 120.0F);
  for (const DepthEncoding encoding : {DepthEncoding::d24, DepthEncoding::rgba8_modf}) {
    RenderSettings settings = small_settings();
    settings.map_size = 1024;
    settings.shadow_map.encoding = encoding;
    const Rendering r = render_map(scene, settings);
    int lit = 0, dark = 0;
    for_each_pixel(settings, [&](int x, int y, std::size_t i) {
      const glm::vec3 p = shadow_test::on_plane(scene, settings, x, y, 0.0F);
      if (std::max(std::fabs(p.x), std::fabs(p.z)) > 3.9F) return;
      const float inside = std::sqrt(3.0F) * p.x - std::max(1.0F, std::fabs(p.z));
      if (std::fabs(inside) < 0.1F) return;
      ASSERT_EQ(r.frame.stencil()[i], inside > 0.0F ? 0 : 1) << p.x << ' ' << p.z;
      ++(inside > 0.0F ? lit : dark);
    });
    EXPECT_GT(lit, 1500);
    EXPECT_GT(dark, 3000);
  }
}

// No offset, the slides' minimum, this technique's own, and too much.
TEST(ShadowMap, PolygonOffsetTradesAcneForLeaks) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene scene = shadow_test::wall_on_floor();
  RenderSettings settings = small_settings();
  settings.width = 320;
  settings.height = 240;
  const auto errors = [&](std::optional<OffsetArguments> offset) {
    settings.shadow_map.polygon_offset = offset;
    const Rendering r = render_map(scene, settings);
    return shadow_test::wall_errors(scene, settings, r, 3.0 * fact<double>(r, "texel_size"));
  };
  const auto none = errors(OffsetArguments{0.0F, 0.0F}), least = errors(OffsetArguments{0.0F, 1.0F});
  const auto own = errors(std::nullopt);
  const double step = fact<double>(render_map(scene, settings), "depth_step");
  const auto large = errors(OffsetArguments{0.0F, static_cast<float>(0.5 / step)});
  EXPECT_GT(own.judged_lit, 10000);
  EXPECT_GT(own.judged_shadowed, 10000);
  EXPECT_GT(none.acne, own.judged_lit / 4);
  EXPECT_GT(least.acne, own.judged_lit / 8);
  EXPECT_LE(least.acne, none.acne);
  EXPECT_EQ(none.leaks + least.leaks, 0);
  EXPECT_EQ(own.acne, 0);
  EXPECT_EQ(own.leaks, 0);
  EXPECT_EQ(large.acne, 0);
  EXPECT_GT(large.leaks, 300);
}

// Where surfaces face the light, rounding alone makes acne, and a unit or two suffice.
TEST(ShadowMap, UnitsServeWhereSurfacesFaceTheLight) {
  Scene scene = shadow_test::square_over_floor();
  scene.lights[0] = shadow_test::directional_light({0, -1, 0});
  const auto shadowed = [&](float units) {
    RenderSettings settings = small_settings();
    settings.shadow_map.polygon_offset = OffsetArguments{0.0F, units};
    return render_map(scene, settings).shadowed;
  };
  const std::uint64_t right = render_map(scene, small_settings()).shadowed;
  EXPECT_GT(shadowed(0.0F), right + 1000);
  EXPECT_LT(shadowed(1.0F), right + 100);
  EXPECT_EQ(shadowed(4.0F), right);
}

// The text's case: a plane through the depth of a scene 256 units deep. Packed by fract, it shades itself beyond the
// middle, by up to half a unit; before it, what should be hidden stays lit; the other packings do neither.
TEST(ShadowMap, FractShadesAPlaneBehindTheMiddleOf256Units) {
  Scene scene = shadow_test::scene_with({0.0F, 160.0F, 160.0F}, {0.0F, 0.0F, 0.0F}, {});
  scene.lights[0] = shadow_test::directional_light({0, 0, -1});
  // The diagonal whose beam is 256 units deep.
  const float half = std::sqrt((256.0F / 1.01F) * (256.0F / 1.01F) - 40.0F * 40.0F) / std::sqrt(8.0F);
  shadow_test::add_quad(scene, "plane",
                        {{{-20, -half, half}, {20, -half, half}, {20, half, -half}, {-20, half, -half}}});
  RenderSettings settings = small_settings();
  settings.map_size = 2048;
  const auto shadowed_between = [&](const Rendering& r, float from, float to, int& pixels) {
    const auto& depth = samples_of<float>(r.layers, "shadow_coordinate", "r");
    int count = 0;
    pixels = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const float units = 256.0F * depth[i];
      if (units <= from || units >= to || r.frame.depth()[i] == max_depth(r.frame.format())) continue;
      ++pixels;
      count += r.frame.stencil()[i];
    }
    return count;
  };
  int pixels = 0;
  for (const DepthEncoding encoding : kEncodings) {
    settings.shadow_map.encoding = encoding;
    const Rendering r = render_map(scene, settings);
    EXPECT_EQ(shadowed_between(r, 0.0F, 256.0F, pixels), 0) << static_cast<int>(encoding);
    EXPECT_GT(pixels, 3000);
  }
  settings.shadow_map.encoding = DepthEncoding::rgba8_fract;
  const Rendering fract = render_map(scene, settings);
  EXPECT_EQ(shadowed_between(fract, 0.0F, 128.9F, pixels), 0);
  EXPECT_EQ(shadowed_between(fract, 129.2F, 170.0F, pixels), pixels);
  EXPECT_GT(pixels, 500);
  EXPECT_NEAR(fact<double>(fract, "encoding_error"), 0.5 / 256.0, 0.01 / 256.0);
  settings.shadow_map.encoding = DepthEncoding::rgba8_modf;
  EXPECT_LE(fact<double>(render_map(scene, settings), "encoding_error"), 6e-8);
}

// Every intermediate value of the comparison follows from the one before it.
TEST(ShadowMap, LayersTellOneStory) {
  const Scene scene = shadow_test::wall_on_floor();
  RenderSettings settings = small_settings();
  for (const DepthEncoding encoding : {DepthEncoding::d24, DepthEncoding::d16, DepthEncoding::rgba8_mod}) {
    settings.shadow_map.encoding = encoding;
    const Rendering r = render_map(scene, settings);
    std::array<const std::vector<float>*, 4> strq{};
    for (std::size_t c = 0; c < 4; ++c) {
      strq[c] = &samples_of<float>(r.layers, "shadow_coordinate", std::string(1, "strq"[c]));
    }
    const auto& map = samples_of<std::uint32_t>(r.maps, "shadow_map", "depth");
    const std::uint32_t codes = encoding == DepthEncoding::d16 ? 0xFFFF : 0xFFFFFF;
    int lit = 0, shadowed = 0, outside = 0;
    for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
      if (r.frame.depth()[i] == max_depth(r.frame.format())) {
        ASSERT_EQ(r.frame.stencil()[i], 0);
        continue;
      }
      const float q = (*strq[3])[i], s = (*strq[0])[i] / q, t = (*strq[1])[i] / q, depth = (*strq[2])[i] / q;
      const bool inside = q > 0.0F && std::min(s, t) > 0.0F && std::max(s, t) < 1.0F;
      outside += inside ? 0 : 1;
      if (!inside) {
        ASSERT_EQ(r.frame.stencil()[i], 1);
        continue;
      }
      const std::size_t texel = static_cast<std::size_t>(t * 256.0F) * 256 + static_cast<std::size_t>(s * 256.0F);
      bool in_shadow = false;
      if (encoding == DepthEncoding::rgba8_mod) {
        DepthBytes bytes{};
        for (std::size_t c = 0; c < 4; ++c) {
          bytes[c] = samples_of<std::uint8_t>(r.maps, "packed_depth", std::string(1, "RGBA"[c]))[texel];
        }
        const float read = samples_of<float>(r.layers, "map_depth", "depth")[i];
        ASSERT_EQ(read, read_depth(*depth_packing(encoding), bytes, ChannelStorage::round));
        in_shadow = read < depth;
      } else {
        const auto own = static_cast<std::uint32_t>(std::floor(static_cast<double>(depth) * codes + 0.5));
        in_shadow = own > map[texel];
        ASSERT_EQ(samples_of<s9>(r.layers, "texture0", "A")[i], in_shadow ? 0 : 255);
        ASSERT_EQ(samples_of<s9>(r.layers, "texture1", "A")[i], 255);
        ASSERT_EQ(samples_of<s9>(r.layers, "spare0", "A")[i], in_shadow ? 0 : 255);
        ASSERT_EQ(samples_of<s9>(r.layers, "output", "A")[i], in_shadow ? 255 : 0);
      }
      ASSERT_EQ(r.frame.stencil()[i], in_shadow ? 1 : 0);
      ++(in_shadow ? shadowed : lit);
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(shadowed, 1000);
    EXPECT_GT(outside, 1000);
  }
}

// The sizes that the facts tell, from the geometry of the light.
TEST(ShadowMap, FactsTellTheResolution) {
  Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = small_settings();
  // The middle of the bounding box is (0, 0.5, 0), 2.5 below the light; its beam is 5 wide there.
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  const Rendering spot = render_map(scene, settings);
  EXPECT_NEAR(fact<double>(spot, "texel_size"), 5.0 / 256.0, 1e-6);
  // Window depth is f (d - n) / (d (f - n)), with the range that views.h promises.
  const double f = 1.01 * std::sqrt(16.0 + 16.0 + 9.0), n = 2.0 * 0.9 / std::sqrt(3.0);
  EXPECT_NEAR(fact<double>(spot, "depth_step") * 16777215.0, 2.5 * 2.5 * (f - n) / (f * n), 1e-4);
  EXPECT_EQ(fact<double>(spot, "polygon_offset_factor"), static_cast<double>(kShadowMapOffset.factor));
  EXPECT_EQ(fact<double>(spot, "polygon_offset_units"), static_cast<double>(kShadowMapOffset.units));
  scene.lights[0] = shadow_test::directional_light({0.3F, -1, 0.1F});
  settings.shadow_map.encoding = DepthEncoding::d16;
  settings.shadow_map.polygon_offset = OffsetArguments{2.0F, -3.0F};
  const Rendering beam = render_map(scene, settings);
  const double diameter = 1.01 * std::sqrt(64.0 + 64.0 + 1.0);
  EXPECT_NEAR(fact<double>(beam, "texel_size"), diameter / 256.0, 1e-6);
  EXPECT_NEAR(fact<double>(beam, "depth_step"), diameter / 65535.0, 1e-8);
  EXPECT_EQ(fact<double>(beam, "polygon_offset_factor"), 2.0);
  EXPECT_EQ(fact<double>(beam, "polygon_offset_units"), -3.0);
}

// A light in the middle of the bounding box has no depth there: the facts are those of the near plane.
TEST(ShadowMap, FactsOfALightInTheMiddleAreOfTheNearPlane) {
  Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = small_settings();
  scene.lights[0] = shadow_test::spot_light({0, 0.5F, 0}, {0, 0, 0}, 90.0F);
  const Rendering r = render_map(scene, settings);
  const double f = 1.01 * std::sqrt(16.0 + 16.0 + 0.25), n = 0.5 * 0.9 / std::sqrt(3.0);
  EXPECT_NEAR(fact<double>(r, "texel_size"), 2.0 * n / 256.0, 1e-7);
  EXPECT_NEAR(fact<double>(r, "depth_step") * 16777215.0, n * (f - n) / f, 1e-5);
}

// As three.js clears its maps: such a texel reads as a depth of 1 or more, whatever the packing.
TEST(ShadowMap, TexelsThatNothingWasDrawnToAreWhite) {
  Scene scene = shadow_test::square_over_floor(2.0F);
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  RenderSettings settings = small_settings();
  settings.shadow_map.encoding = DepthEncoding::rgba8_fract;
  const Rendering r = render_map(scene, settings);
  const auto& map = samples_of<std::uint32_t>(r.maps, "shadow_map", "depth");
  int cleared = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] != 0xFFFFFF) continue;
    ++cleared;
    for (const char* channel : {"R", "G", "B", "A"}) {
      ASSERT_EQ(samples_of<std::uint8_t>(r.maps, "packed_depth", channel)[i], 255);
    }
  }
  EXPECT_GT(cleared, 10000);
}

// Nearest white, farthest dark grey, nothing black; upright.
TEST(ShadowMap, PictureShowsTheMap) {
  Scene scene = shadow_test::square_over_floor(2.0F);
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  const Rendering r = render_map(scene, small_settings());
  ASSERT_EQ(r.pictures.size(), 1U);
  EXPECT_EQ(r.pictures[0].file, "shadow_map.png");
  const Image8& image = r.pictures[0].image;
  ASSERT_EQ(image.width, 256);
  ASSERT_EQ(image.height, 256);
  const auto& map = samples_of<std::uint32_t>(r.maps, "shadow_map", "depth");
  const auto at = [&](int x, int y) { return image.pixels[static_cast<std::size_t>((255 - y) * 256 + x)]; };
  EXPECT_EQ(at(128, 128), 255);  // the square
  EXPECT_EQ(at(60, 128), 40);    // the floor
  EXPECT_EQ(at(5, 128), 0);      // beside it
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      ASSERT_EQ(at(x, y) == 0, map[static_cast<std::size_t>(y * 256 + x)] == 0xFFFFFF);
    }
  }
}

// Where the floor is dark beneath the square, the map holds one of the square's triangles.
TEST(ShadowMap, EvidenceNamesTheTriangleInTheMap) {
  Scene scene = shadow_test::square_over_floor();
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  RenderSettings settings = small_settings();
  for (const DepthEncoding encoding : {DepthEncoding::d16, DepthEncoding::rgba8_modf}) {
    settings.shadow_map.encoding = encoding;
    settings.evidence = false;
    const Rendering plain = render_map(scene, settings);
    EXPECT_FALSE(plain.evidence.has_value());
    settings.evidence = true;
    const Rendering r = render_map(scene, settings);
    EXPECT_EQ(r.frame.stencil(), plain.frame.stencil());
    ASSERT_TRUE(r.evidence.has_value());
    EXPECT_EQ(r.evidence->in_map, std::vector<bool>(4, true));
    const auto& object = samples_of<std::uint32_t>(r.layers, "object", "object");
    int dark = 0, outside = 0;
    for_each_pixel(settings, [&](int x, int y, std::size_t i) {
      const glm::vec3 p = shadow_test::on_plane(scene, settings, x, y, 0.0F);
      const float reach = std::max(std::fabs(p.x), std::fabs(p.z));
      const std::uint32_t fetched = r.evidence->fetched[i];
      if (object[i] == 0 || (object[i] == 1 && reach > 3.05F)) {
        ASSERT_EQ(fetched, 0U);
        outside += object[i] == 1 ? 1 : 0;
      } else if (object[i] == 1 && reach < 1.45F) {
        ASSERT_TRUE(fetched == 3 || fetched == 4) << fetched;
        ++dark;
      } else if (object[i] == 1 && reach > 1.55F && reach < 2.95F) {
        ASSERT_TRUE(fetched == 1 || fetched == 2) << fetched;
      }
    });
    EXPECT_GT(dark, 300);
    EXPECT_GT(outside, 500);
  }
}

TEST(ShadowMap, TracedPixelHasBothTextures) {
  const Scene scene = shadow_test::wall_on_floor();
  RenderSettings settings = small_settings();
  settings.pixels = {glm::ivec2(100, 40)};
  const Rendering r = render_map(scene, settings);
  const auto pass =
      std::find_if(r.probed[0].begin(), r.probed[0].end(), [](const auto& p) { return p.name == "comparison"; });
  ASSERT_NE(pass, r.probed[0].end());
  ASSERT_TRUE(pass->program.has_value());
  const ProbedFragment* fragment = deciding_fragment(*pass);
  ASSERT_NE(fragment, nullptr);
  const std::size_t i = 40 * 200 + 100;
  EXPECT_EQ(fragment->registers[Register::texture0][kAlpha], samples_of<s9>(r.layers, "texture0", "A")[i]);
  EXPECT_EQ(fragment->registers[Register::texture1][kAlpha], samples_of<s9>(r.layers, "texture1", "A")[i]);
}

TEST(ShadowMap, ReportsWhatCannotBeDrawn) {
  Scene scene = shadow_test::square_over_floor();
  const auto fault = [&](const RenderSettings& settings) {
    const auto result = render_shadow_map(scene, settings, {});
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(fault(small_settings()), "the scene's light is a point light; expected a spot or directional light");
  scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 90.0F);
  RenderSettings settings = small_settings();
  settings.map_size = 500;
  EXPECT_NE(fault(settings).find("power of two"), std::string::npos);
  settings = small_settings();
  settings.shadow_map.polygon_offset = OffsetArguments{std::nanf(""), 0.0F};
  EXPECT_NE(fault(settings).find("polygon offset"), std::string::npos);
  EXPECT_EQ(fault(small_settings()), "");
}

}  // namespace
