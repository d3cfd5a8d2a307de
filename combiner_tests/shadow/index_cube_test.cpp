// The passes of index cube shadow mapping on scenes whose answer is a formula.
#include "ninebit/shadow/index_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;
using shadow_test::for_each_pixel;
using shadow_test::render;
using shadow_test::small_settings;

TEST(IndexCube, SquareOverFloorCastsTheSquareOfTheFormula) {
  const Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = small_settings();
  const Rendering r = render(scene, settings);
  const auto layers = shadow_test::comparison_layers(r);
  // One map texel on the floor: the -Y face spans 2 × 3 units there; a step aside for the triangles' diagonals.
  const float texel = 6.0F / static_cast<float>(settings.map_size) * 1.5F;
  int inside = 0, outside = 0, background = 0;
  for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    const std::uint32_t object = layers.object[i];
    if (object == 0) ++background;
    if (object != 1) return;
    const glm::vec3 p = shadow_test::on_plane(scene, settings, x, y, 0.0F);
    const float reach = std::max(std::fabs(p.x), std::fabs(p.z));
    const bool near_edge = std::fabs(reach - 1.5F) < texel;
    const bool near_joint = std::fabs(p.x - p.z) < 2 * texel || std::fabs(p.x + p.z) < 2 * texel;
    if (near_edge || near_joint || reach > 3.9F) return;
    ASSERT_EQ(r.frame.stencil()[i], reach < 1.5F ? 1 : 0) << "floor at " << p.x << ", " << p.z;
    ++(reach < 1.5F ? inside : outside);
  });
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 5000);
  EXPECT_EQ(r.background, static_cast<std::uint64_t>(background));
  EXPECT_EQ(r.background + r.lit + r.shadowed, static_cast<std::uint64_t>(settings.width * settings.height));
}

TEST(IndexCube, LayersTellOneStory) {
  const Scene scene = shadow_test::square_over_floor();
  const Rendering r = render(scene, small_settings());
  const shadow_test::ComparisonLayers l = shadow_test::comparison_layers(r);
  std::uint64_t shadowed = 0, drawn = 0;
  for (std::size_t i = 0; i < l.polygon.size(); ++i) {
    const bool is_drawn = r.frame.depth()[i] != max_depth(r.frame.format());
    ASSERT_EQ(l.polygon[i] != 0, is_drawn);
    if (!is_drawn) {
      ASSERT_EQ(l.primary[0][i] + l.texture0[0][i] + l.spare0[0][i] + l.spare1[0][i] + l.output_alpha[i], 0);
      ASSERT_EQ(r.frame.stencil()[i], 0);
      continue;
    }
    ++drawn;
    const ColorBytes own = r.codes.color(l.polygon[i]);
    int dot = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(l.primary[c][i], own[c]);
      const int difference = std::clamp(4 * (l.primary[c][i] - l.texture0[c][i]), -255, 255);
      ASSERT_EQ(l.spare0[c][i], difference);
      dot += difference * difference;
    }
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(l.spare1[c][i], std::min(4 * dot / 255, 255));
    ASSERT_EQ(l.output_alpha[i], l.spare1[2][i]);
    ASSERT_EQ(r.frame.stencil()[i], l.output_alpha[i] > 0 ? 1 : 0);
    ASSERT_EQ(l.object[i], scene.triangle_object[l.polygon[i] - 1] + 1);
    shadowed += r.frame.stencil()[i];
  }
  EXPECT_EQ(shadowed, r.shadowed);
  EXPECT_EQ(drawn, r.lit + r.shadowed);
  EXPECT_GT(shadowed, 500U);
}

// A small quad in a direction of each face, off its middle, lands on the texel that the extension's table names.
TEST(IndexCube, MapFacesFollowTheExtensionsTable) {
  const glm::vec3 light(0.3F, -0.2F, 0.1F);
  Scene scene = shadow_test::scene_with({20.0F, 1.0F, 0.5F}, {0.0F, 0.0F, 0.0F}, light);
  std::vector<glm::vec3> directions;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0F, -1.0F}) {
      glm::vec3 d(0.0F), u(0.0F), v(0.0F);
      d[axis] = 4.0F * sign;
      u[(axis + 1) % 3] = 1.0F;
      v[(axis + 2) % 3] = 1.0F;
      const glm::vec3 center = light + d + u * 1.7F - v * 0.9F;
      shadow_test::add_quad(scene, "quad",
                            {center - u * 0.2F - v * 0.2F, center + u * 0.2F - v * 0.2F, center + u * 0.2F + v * 0.2F,
                             center - u * 0.2F + v * 0.2F});
      directions.push_back(center + u * 0.03F + v * 0.05F - light);
    }
  }
  RenderSettings settings = small_settings();
  settings.index.scope = IndexScope::object;
  const Rendering r = render(scene, settings);
  // sc, tc, ma of ARB_texture_cube_map, faces +X -X +Y -Y +Z -Z, for the direction r.
  const auto table = [](int face, const glm::vec3& d) -> glm::vec3 {
    switch (face) {
      case 0:
        return {-d.z, -d.y, d.x};
      case 1:
        return {d.z, -d.y, -d.x};
      case 2:
        return {d.x, d.z, d.y};
      case 3:
        return {d.x, -d.z, -d.y};
      case 4:
        return {d.x, -d.y, d.z};
      default:
        return {-d.x, -d.y, -d.z};
    }
  };
  for (int face = 0; face < 6; ++face) {
    const glm::vec3 c = table(face, directions[static_cast<std::size_t>(face)]);
    const int s = static_cast<int>((c.x / c.z + 1.0F) / 2.0F * static_cast<float>(settings.map_size));
    const int t = static_cast<int>((c.y / c.z + 1.0F) / 2.0F * static_cast<float>(settings.map_size));
    const IndexMapFace& map = r.index_map[static_cast<std::size_t>(face)];
    const std::size_t at = static_cast<std::size_t>(t * settings.map_size + s);
    EXPECT_EQ(r.codes.number(map.texel(at)), static_cast<std::uint32_t>(face + 1));
    std::size_t set = 0;
    for (std::size_t i = 0; i < map.texels(); ++i) set += map.texel(i)[kRed] != 0 ? 1U : 0U;
    EXPECT_GT(set, 20U);
    EXPECT_LT(set, 1000U);
  }
}

// The torus shadows itself by polygon; by object it cannot: the article's second picture.
TEST(IndexCube, TorusShadowsItselfOnlyByPolygon) {
  const Scene scene = ninebit::test::index_room();
  const auto torus = std::find_if(scene.objects.begin(), scene.objects.end(),
                                  [](const SceneObject& o) { return o.name.find("torus") != std::string::npos; });
  ASSERT_NE(torus, scene.objects.end());
  const auto number = static_cast<std::uint32_t>(torus - scene.objects.begin()) + 1;
  RenderSettings settings = small_settings();
  const auto self_shadowed = [&] {
    const Rendering r = render(scene, settings);
    const auto layers = shadow_test::comparison_layers(r);
    int count = 0;
    for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
      if (layers.object[i] != number || r.frame.stencil()[i] == 0) continue;
      const std::uint32_t fetched = layers.fetched(r.codes, i);
      const std::uint32_t object = settings.index.scope == IndexScope::object ? fetched
                                   : fetched == 0                             ? 0
                                                                              : scene.triangle_object[fetched - 1] + 1;
      count += object == number ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(self_shadowed(), 200);
  settings.index.scope = IndexScope::object;
  EXPECT_EQ(self_shadowed(), 0);
}

TEST(IndexCube, CullingLeavesOutFacesInEveryPass) {
  Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = small_settings();
  settings.cull_face = CullFace::back;
  const Rendering kept = render(scene, settings);
  settings.cull_face = CullFace::none;
  const Rendering all = render(scene, settings);
  // Every front faces up, to the light and to the camera alike.
  EXPECT_EQ(kept.frame.stencil(), all.frame.stencil());
  settings.cull_face = CullFace::front;
  const Rendering none = render(scene, settings);
  EXPECT_EQ(none.background, static_cast<std::uint64_t>(settings.width * settings.height));
  for (const IndexMapFace& face : none.index_map) {
    for (std::size_t i = 0; i < face.texels(); ++i) ASSERT_EQ(face.texel(i)[kRed], 0);
  }
}

}  // namespace
