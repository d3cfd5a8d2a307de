// The index plane as a selection buffer.
#include <gtest/gtest.h>

#include "combiner_tests/shadow/support.h"
#include "src/shadow/index_cube/index_sections.h"

namespace {

using namespace ninebit;

Scene boxes_on_a_floor() {
  Scene scene = shadow_test::square_over_floor();
  shadow_test::add_box(scene, "box", {-2.5F, 0.2F, -0.5F}, {-1.5F, 0.9F, 0.5F});
  return scene;
}

RenderSettings pick_settings() {
  RenderSettings settings = shadow_test::small_settings();
  settings.width = 48;
  settings.height = 36;
  settings.map_size = 32;
  return settings;
}

TEST(Pick, TellsWhatTheLayersShow) {
  const Scene scene = boxes_on_a_floor();
  const Sections sections = cut_into_sections(scene, 4);
  for (const IndexScope scope : {IndexScope::polygon, IndexScope::object, IndexScope::section}) {
    for (const IndexFormat format : {IndexFormat::rgb, IndexFormat::luminance_alpha, IndexFormat::alpha}) {
      RenderSettings settings = pick_settings();
      settings.index = {.format = format, .scope = scope, .section_size = 4};
      const auto layers = shadow_test::comparison_layers(shadow_test::render(scene, settings));
      settings.layers = false;
      settings.light_facing = format == IndexFormat::rgb;
      int background = 0, drawn = 0;
      for (int y = 0; y < settings.height; y += 5) {
        for (int x = 0; x < settings.width; x += 5) {
          settings.pick = glm::ivec2(x, y);
          const Rendering r = shadow_test::render(scene, settings);
          ASSERT_TRUE(r.picked.has_value());
          const std::uint32_t polygon = layers.polygon[static_cast<std::size_t>(y * settings.width + x)];
          if (polygon == 0) {
            ++background;
            ASSERT_EQ(r.picked->number, 0U);
            ASSERT_FALSE(r.picked->polygon || r.picked->section || r.picked->object);
            continue;
          }
          ++drawn;
          ASSERT_EQ(r.picked->object, scene.triangle_object[polygon - 1]);
          ASSERT_EQ(r.picked->polygon.has_value(), scope == IndexScope::polygon);
          ASSERT_EQ(r.picked->section.has_value(), scope == IndexScope::section);
          ASSERT_EQ(r.picked->polygon.value_or(polygon - 1), polygon - 1);
          const std::uint32_t section = sections.of_triangle[polygon - 1];
          ASSERT_EQ(r.picked->section.value_or(section), section);
        }
      }
      EXPECT_GT(background, 5);
      EXPECT_GT(drawn, 20);
    }
  }
}

TEST(Pick, ChangesNothing) {
  const Scene scene = boxes_on_a_floor();
  RenderSettings settings = pick_settings();
  settings.layers = false;
  const Rendering plain = shadow_test::render(scene, settings);
  EXPECT_FALSE(plain.picked.has_value());
  settings.pick = glm::ivec2(20, 18);
  const Rendering picked = shadow_test::render(scene, settings);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(picked.frame.color(c), plain.frame.color(c));
  EXPECT_EQ(picked.frame.stencil(), plain.frame.stencil());
  EXPECT_EQ(picked.frame.depth(), plain.frame.depth());
}

}  // namespace
