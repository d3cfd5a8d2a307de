// Scenes that cannot be rendered are reported; odd but harmless ones are rendered.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/shadow/index_cube.h"

namespace {

using namespace ninebit;
using shadow_test::small_settings;

std::string fault_of(const Scene& scene, const RenderSettings& settings) {
  const auto result = render_index_cube(scene, settings, {});
  return result ? std::string() : result.error().message;
}

TEST(BadInput, SettingsAndScenesThatCannotBeDrawn) {
  const Scene scene = shadow_test::square_over_floor();
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is missing in: '" << message << "'";
  };
  RenderSettings s = small_settings();
  s.width = 0;
  expect(fault_of(scene, s), "0x150");
  s = small_settings();
  s.height = kMaxSurfaceSize + 1;
  expect(fault_of(scene, s), "16385");
  for (const int size : {0, -4, 3, 500, 32768}) {
    s = small_settings();
    s.map_size = size;
    expect(fault_of(scene, s), "power of two");
  }
  s = small_settings();
  s.index.step = 0;
  expect(fault_of(scene, s), "expected 1 to 16");
  for (const int size : {kMinSectionSize - 1, kMaxSectionSize + 1, -8}) {
    s = small_settings();
    s.index.section_size = size;
    expect(fault_of(scene, s), "expected 4 to 512");
  }
  for (const glm::ivec2 pixel : {glm::ivec2(-1, 0), glm::ivec2(0, -1), glm::ivec2(200, 0), glm::ivec2(0, 150)}) {
    s = small_settings();
    s.pick = pixel;
    expect(fault_of(scene, s), "outside of the frame of 200 x 150");
  }
  Scene dark = scene;
  dark.lights.clear();
  expect(fault_of(dark, small_settings()), "0 lights");
  Scene empty = scene;
  empty.triangles.clear();
  expect(fault_of(empty, small_settings()), "no triangles");
}

TEST(BadInput, TooManyPolygons) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Scene scene = shadow_test::square_over_floor();
  while (scene.triangles.size() < 4096) {
    shadow_test::add_quad(scene, "more", {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}});
  }
  RenderSettings s = small_settings();
  s.index.step = 16;
  EXPECT_NE(fault_of(scene, s).find("4096 of them"), std::string::npos);
  s.index.step = 15;
  EXPECT_EQ(fault_of(scene, s), "");
  s.index.step = 16;
  s.index.scope = IndexScope::object;
  EXPECT_EQ(fault_of(scene, s), "");
}

TEST(BadInput, DegenerateTrianglesAreHarmless) {
  const Scene scene = shadow_test::square_over_floor();
  Scene odd = scene;
  odd.triangles.emplace_back(0, 0, 1);
  odd.triangles.emplace_back(2, 2, 2);
  odd.triangle_object.insert(odd.triangle_object.end(), 2, 1);
  odd.triangle_material.insert(odd.triangle_material.end(), 2, 0);
  odd.objects[1].triangle_count += 2;
  const Rendering plain = shadow_test::render(scene, small_settings());
  const Rendering with = shadow_test::render(odd, small_settings());
  EXPECT_EQ(with.frame.stencil(), plain.frame.stencil());
  EXPECT_EQ(with.codes_used, plain.codes_used + 2);
}

// A light in the plane of a polygon sees it edge-on: the polygon casts no shadow and draws nothing into the map.
TEST(BadInput, LightOnAPlaneIsHarmless) {
  Scene scene = shadow_test::square_over_floor();
  scene.lights[0].position = {0.25F, 1.0F, 0.1F};
  const Rendering r = shadow_test::render(scene, small_settings());
  for (const IndexMapFace& face : r.index_map) {
    for (std::size_t i = 0; i < face.texels(); ++i) {
      const std::uint32_t number = r.codes.number(face.texel(i));
      ASSERT_LE(number, 2U) << "the square in the light's plane was drawn";
    }
  }
  EXPECT_GT(r.lit, 1000U);
}

}  // namespace
