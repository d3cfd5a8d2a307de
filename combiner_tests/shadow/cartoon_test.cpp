// The cartoon style: flat colours, shadows and joint errors in ink.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;

TEST(Cartoon, EachPolygonHasOneColourInTheLightAndInkInTheShadow) {
  const Scene scene = ninebit::test::index_room();
  RenderSettings settings = shadow_test::small_settings();
  const Rendering plain = shadow_test::render(scene, settings);
  settings.cartoon = true;
  const Rendering r = shadow_test::render(scene, settings);
  EXPECT_EQ(r.frame.stencil(), plain.frame.stencil());
  const auto layers = shadow_test::comparison_layers(r);
  using Color = std::array<std::uint8_t, 3>;
  std::map<std::pair<std::uint32_t, bool>, std::set<Color>> of_polygon;
  std::map<std::pair<std::uint32_t, bool>, std::set<Color>> of_material;
  int brightest_ink = 0, darkest_light = 255;
  for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
    if (layers.polygon[i] == 0) continue;
    const Color color{r.frame.color(kRed)[i], r.frame.color(kGreen)[i], r.frame.color(kBlue)[i]};
    const bool shadow = r.frame.stencil()[i] != 0;
    of_polygon[{layers.polygon[i], shadow}].insert(color);
    of_material[{scene.triangle_material[layers.polygon[i] - 1], shadow}].insert(color);
    const int largest = std::max({color[0], color[1], color[2]});
    if (shadow) brightest_ink = std::max(brightest_ink, largest);
    if (!shadow) darkest_light = std::min(darkest_light, largest);
  }
  for (const auto& [polygon, colors] : of_polygon) EXPECT_EQ(colors.size(), 1U) << "polygon " << polygon.first;
  std::size_t bands = 0;
  for (const auto& [material, colors] : of_material) {
    if (material.second) {
      EXPECT_EQ(colors.size(), 1U) << "ink does not depend on the light";
    } else {
      EXPECT_LE(colors.size(), 4U) << "a few bands";
      bands = std::max(bands, colors.size());
    }
  }
  EXPECT_GT(bands, 2U);
  EXPECT_LT(brightest_ink + 40, darkest_light);
}

}  // namespace
