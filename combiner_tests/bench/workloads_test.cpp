// The scenes and meshes that are measured, and how samples are summed up.
#include <gtest/gtest.h>

#include <set>

#include "src/bench/generated_scene.h"
#include "src/bench/meshes.h"
#include "src/bench/raster_rate.h"
#include "src/bench/timing.h"

namespace bench_test {
namespace {

using namespace ninebit;

TEST(GeneratedScene, IsASceneOfAboutSoManyTriangles) {
  for (const std::uint32_t triangles : {100U, 500U, 2000U, 3001U, 20000U, 100000U}) {
    SCOPED_TRACE(triangles);
    const Scene scene = bench::generated_scene(triangles);
    const Status valid = validate(scene);
    EXPECT_TRUE(valid.ok()) << valid.error().text();
    EXPECT_LE(scene.triangles.size(), triangles);
    EXPECT_GE(scene.triangles.size(), triangles * (triangles < 2000 ? 6 : 9) / 10);
    ASSERT_EQ(scene.objects.size(), 7U);
    ASSERT_EQ(scene.lights.size(), 1U);
    ASSERT_EQ(scene.cameras.size(), 1U);
  }
}

// Closed, facing outward, and neither light nor camera in any of them; the room faces inward and holds both.
TEST(GeneratedScene, BodiesAreClosedAndApartFromTheLight) {
  const Scene scene = bench::generated_scene(20000);
  for (const SceneObject& object : scene.objects) {
    const double inside = object.name == "room" ? -1.0 : 0.0;
    EXPECT_NEAR(winding_number(scene, object, scene.lights[0].position), inside, 1e-4) << object.name;
    EXPECT_NEAR(winding_number(scene, object, scene.cameras[0].position), inside, 1e-4) << object.name;
    if (object.name == "room") continue;
    glm::vec3 middle(0.0F);
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
      middle += scene.positions[scene.triangles[object.first_triangle + t].x];
    }
    middle /= static_cast<float>(object.triangle_count);
    EXPECT_NEAR(winding_number(scene, object, middle), 1.0, 1e-4) << object.name;
    EXPECT_GT(distance_to_nearest_triangle(scene, object, scene.lights[0].position), 0.3F) << object.name;
  }
}

// Every pixel of the window lies in a whole cell of each sheet, but for a margin along its sides: the sheets have no
// holes and no overlaps, and the legs are about as long as they claim.
TEST(Meshes, SheetsCoverTheWindowOnce) {
  for (const float leg : {1.0F, 4.0F}) {
    const bench::Mesh mesh = bench::small_triangles(160, 120, leg);
    const double cells = 3.0 * 160.0 * 120.0 / leg / leg;
    EXPECT_GT(static_cast<double>(mesh.triangles.size()), 1.6 * cells) << leg;
    EXPECT_LT(static_cast<double>(mesh.triangles.size()), 2.0 * cells) << leg;
    EXPECT_EQ(mesh.colors.size(), mesh.triangles.size());

    auto surface = *Surface::make(160, 120);
    PipelineState state;
    state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
    RenderTarget target = surface.target();
    ASSERT_TRUE(rasterize(state, glm::mat4(1.0F), mesh.arrays(), {}, target).ok());
    std::uint64_t total = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const int layers = target.stencil.at(x, y);
        total += static_cast<std::uint64_t>(layers);
        const bool margin = x < 8 || y < 8 || x >= 152 || y >= 112;
        if (margin) {
          EXPECT_LE(layers, 3) << x << ", " << y;
        } else {
          EXPECT_EQ(layers, 3) << x << ", " << y;
        }
      }
    }
    EXPECT_EQ(*bench::covered_pixels(mesh, 160, 120), total);
  }
}

// Some fragments fail the depth test and some pass it over others.
TEST(Meshes, SheetsHideEachOther) {
  const bench::Mesh mesh = bench::small_triangles(160, 120, 4.0F);
  auto surface = *Surface::make(160, 120);
  PipelineState state = bench::flat_depth_state();
  state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
  RenderTarget target = surface.target();
  ASSERT_TRUE(rasterize(state, glm::mat4(1.0F), mesh.arrays(), {}, target).ok());
  EXPECT_EQ(target.stencil.at(80, 60), 2);
}

TEST(Meshes, LargeTrianglesCoverEverythingAndAllPass) {
  const bench::Mesh mesh = bench::large_triangles();
  EXPECT_EQ(mesh.triangles.size(), 64U);
  EXPECT_EQ(*bench::covered_pixels(mesh, 64, 48), 32U * 64 * 48);
  auto surface = *Surface::make(64, 48);
  PipelineState state = bench::flat_depth_state();
  state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
  RenderTarget target = surface.target();
  ASSERT_TRUE(rasterize(state, glm::mat4(1.0F), mesh.arrays(), {}, target).ok());
  EXPECT_EQ(std::set<std::uint8_t>(surface.stencil().begin(), surface.stencil().end()), std::set<std::uint8_t>{32});
}

TEST(ProvokingVertices, EachTriangleEndsAtAVertexOfItsColor) {
  const Scene scene = bench::generated_scene(2000);
  std::vector<ColorBytes> colors;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    colors.push_back({static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(t >> 8U), 1, 255});
  }
  const auto mesh = bench::provoking_vertices(scene.triangles, colors, scene.positions.size());
  ASSERT_EQ(mesh.triangles.size(), scene.triangles.size());
  ASSERT_EQ(mesh.colors.size(), mesh.source.size());
  EXPECT_LE(mesh.source.size(), scene.triangles.size() + scene.positions.size() / 4);
  for (std::size_t t = 0; t < colors.size(); ++t) {
    const glm::uvec3 v = mesh.triangles[t];
    EXPECT_EQ(mesh.colors[v.z], colors[t]);
    // The same corners in the same sense.
    const glm::uvec3 now(mesh.source[v.x], mesh.source[v.y], mesh.source[v.z]), old = scene.triangles[t];
    EXPECT_TRUE(now == old || now == glm::uvec3(old.y, old.z, old.x) || now == glm::uvec3(old.z, old.x, old.y)) << t;
  }
}

TEST(Spread, MedianAndExtremes) {
  const bench::Spread odd = bench::spread_of({5.0, 1.0, 3.0});
  EXPECT_EQ(odd.median, 3.0);
  EXPECT_EQ(odd.min, 1.0);
  EXPECT_EQ(odd.max, 5.0);
  EXPECT_EQ(bench::spread_of({4.0, 1.0, 2.0, 9.0}).median, 3.0);
  EXPECT_EQ(bench::spread_of({7.0}).median, 7.0);
}

}  // namespace
}  // namespace bench_test
