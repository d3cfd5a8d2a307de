// The meshes of shadow volumes, and the parts of a rendering with them besides the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include "combiner_tests/shadow/volume_support.h"
#include "src/frame/views.h"
#include "src/shadow/shadow_volume/volume_mesh.h"

namespace {

using namespace ninebit;
using namespace shadow_test;
using Op = StencilOperation;

RenderSettings with(VolumeMethod method, bool two_sided) {
  RenderSettings settings = volume_settings(method);
  settings.shadow_volume.two_sided = two_sided;
  return settings;
}

TEST(VolumePasses, CountWithoutDrawing) {
  for (const VolumeMethod method : {VolumeMethod::depth_fail, VolumeMethod::depth_pass}) {
    for (const bool two_sided : {true, false}) {
      const auto passes = volume_passes(with(method, two_sided));
      EXPECT_EQ(passes.size(), two_sided ? 1U : 2U);
      for (const VolumePass& pass : passes) {
        const PipelineState& s = pass.state;
        EXPECT_FALSE(s.color_mask[0] || s.color_mask[1] || s.color_mask[2] || s.color_mask[3]);
        EXPECT_TRUE(s.depth_test.enabled && !s.depth_test.write && s.stencil_test.enabled);
        EXPECT_EQ(s.depth_test.function, CompareFunction::less);
        EXPECT_EQ(s.stencil_test.front.function, CompareFunction::always);
        EXPECT_FALSE(s.program || s.alpha_test.enabled || s.polygon_offset.fill);
      }
    }
  }
  const PipelineState fail = volume_passes(with(VolumeMethod::depth_fail, true))[0].state;
  EXPECT_EQ(fail.cull_face, CullFace::none);
  EXPECT_EQ(fail.stencil_test.front.depth_fail, Op::decr_wrap);
  EXPECT_EQ(fail.stencil_test.back->depth_fail, Op::incr_wrap);
  EXPECT_EQ(fail.stencil_test.front.depth_pass, Op::keep);
  EXPECT_EQ(fail.stencil_test.back->depth_pass, Op::keep);
  const auto pass = volume_passes(with(VolumeMethod::depth_pass, false));
  EXPECT_EQ(pass[0].state.cull_face, CullFace::back);
  EXPECT_EQ(pass[1].state.cull_face, CullFace::front);
  EXPECT_EQ(pass[0].state.stencil_test.front.depth_pass, Op::incr_wrap);
  EXPECT_EQ(pass[1].state.stencil_test.front.depth_pass, Op::decr_wrap);
  for (const VolumePass& p : pass) EXPECT_FALSE(p.state.stencil_test.back.has_value());
}

TEST(VolumePasses, EdgesAreJoinedAtEqualPositions) {
  // A tetrahedron, no two triangles of which share a vertex; one corner is 0 in three signs.
  const glm::vec3 a(0.0F), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1), minus(-0.0F, 0.0F, -0.0F);
  Scene scene = scene_with({3, 3, 3}, {0, 0, 0}, {2, 2, 2});
  const std::vector<glm::vec3> corners{a, c, b, minus, b, d, a, d, c, b, c, d};
  add_object(scene, corners, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  const VolumeMesh mesh = volume_mesh(scene);
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.uses.size(), 12U);
  EXPECT_TRUE(mesh.faults[0].none());
  // The face opposite the origin sees the light; its three edges are the silhouette.
  const auto facing = facing_of(mesh, homogeneous_light(scene.lights[0]));
  EXPECT_EQ(facing, (std::vector<std::int8_t>{-1, -1, -1, 1}));
  const auto casters = casters_of(scene, mesh, facing, CullFace::none);
  EXPECT_EQ(casters, (std::vector<std::int8_t>{0, 0, 0, 1}));
  EXPECT_EQ(casters_of(scene, mesh, facing, CullFace::back), casters);
  EXPECT_EQ(casters_of(scene, mesh, facing, CullFace::front), (std::vector<std::int8_t>{-1, -1, -1, 0}));
  EXPECT_EQ(casters_of(scene, mesh, facing, CullFace::front_and_back), (std::vector<std::int8_t>(4, 0)));
  const ShadowVolumes volumes = extrude(mesh, casters, homogeneous_light(scene.lights[0]), {});
  EXPECT_EQ(volumes.silhouette_edges, 3U);
  EXPECT_EQ(volumes.outward.triangles.size(), 1U + 1U + 6U);

  // Two objects at the same places stay apart; one triangle less opens three edges, one more (the same) overloads
  // three.
  Scene two = scene;
  add_object(two, corners, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  add_object(two, corners, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {9, 10, 11}, {9, 9, 4}});
  add_object(two, corners, {{0, 1, 2}, {3, 5, 4}, {6, 7, 8}, {9, 10, 11}});
  const VolumeMesh more = volume_mesh(two);
  EXPECT_EQ(more.positions.size(), 16U);
  EXPECT_TRUE(more.faults[0].none());
  EXPECT_EQ(more.faults[1].open_edges, 3U);
  EXPECT_EQ(more.faults[1].nonmanifold_edges, 0U);
  EXPECT_EQ(more.faults[2].open_edges, 0U);
  EXPECT_EQ(more.faults[2].nonmanifold_edges, 3U);
  EXPECT_EQ(more.faults[3].nonmanifold_edges, 3U);  // one triangle is wound against its neighbours
}

// Every volume is closed: each edge of its triangles has as many that run along it one way as the other.
TEST(VolumePasses, VolumesAreClosed) {
  Scene scene = scene_with({3, 3, 3}, {0, 0, 0}, {0.3F, 2.5F, 0.4F});
  add_ball(scene, {0, 0, 0}, 1.0F, 5);
  add_quad(scene, "sheet", {{{-1, 1.5F, 1}, {1, 1.5F, 1}, {1, 1.5F, -1}, {-1, 1.5F, -1}}});
  add_object(scene, {{0, -2, 0}, {1, -2, 0}, {0, -3, 1}, {0, -1, 1}, {0, -2, -1}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  for (const LightKind kind : {LightKind::point, LightKind::directional}) {
    scene.lights[0].kind = kind;
    const glm::dvec4 light = homogeneous_light(scene.lights[0]);
    const VolumeMesh mesh = volume_mesh(scene);
    const auto casters = casters_of(scene, mesh, facing_of(mesh, light), CullFace::none);
    EXPECT_GT(std::count(casters.begin(), casters.end(), -1), 0);
    const ShadowVolumes volumes = extrude(mesh, casters, light, {});
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> surplus;
    const auto add = [&](const VolumeTriangles& set, int sign) {
      EXPECT_EQ(set.casters.size(), set.triangles.size());
      for (const glm::uvec3& t : set.triangles) {
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t from = t[i], to = t[(i + 1) % 3];
          if (from != to) surplus[std::minmax(from, to)] += from < to ? sign : -sign;
        }
      }
    };
    add(volumes.outward, 1);
    add(volumes.inward, -1);
    EXPECT_FALSE(volumes.inward.triangles.empty());
    for (const auto& [edge, count] : surplus) EXPECT_EQ(count, 0) << edge.first << ' ' << edge.second;
  }
}

// Directions that come close to a silhouette from either side are told apart to the last bit of a double.
TEST(VolumePasses, EdgeOnTrianglesCastNothing) {
  Scene scene = scene_with({3, 3, 3}, {0, 0, 0}, {7.0F, 0.3F, -2.0F});
  add_quad(scene, "level", {{{-1, 0.3F, 1}, {1, 0.3F, 1}, {1, 0.3F, -1}, {-1, 0.3F, -1}}});
  add_quad(scene, "floor", {{{-4, -1, 4}, {4, -1, 4}, {4, -1, -4}, {-4, -1, -4}}});
  const VolumeMesh mesh = volume_mesh(scene);
  EXPECT_EQ(facing_of(mesh, homogeneous_light(scene.lights[0])), (std::vector<std::int8_t>{0, 0, 1, 1}));
  const Rendering r = render_volumes(scene, volume_settings());
  EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "silhouette_edges"), 4U);
  EXPECT_EQ(r.shadowed, 0U);
  scene.lights[0].position.y = std::nextafter(0.3F, 1.0F);
  EXPECT_EQ(facing_of(mesh, homogeneous_light(scene.lights[0])), (std::vector<std::int8_t>{1, 1, 1, 1}));
  scene.lights[0].position = scene.positions[0];  // in a corner
  EXPECT_EQ(facing_of(mesh, homogeneous_light(scene.lights[0])), (std::vector<std::int8_t>{0, 0, 1, 1}));
}

// A surface that the camera does not draw does not hide a volume either.
TEST(VolumePasses, CulledSheetsCastNothing) {
  Scene scene = square_over_floor();
  RenderSettings settings = volume_settings();
  for (const VolumeMethod method : {VolumeMethod::depth_fail, VolumeMethod::depth_pass}) {
    settings.shadow_volume.method = method;
    settings.cull_face = CullFace::back;  // the square shows the light its front
    EXPECT_GT(render_volumes(scene, settings).shadowed, 500U);
    Scene turned = scene;
    for (std::size_t t : {2U, 3U}) std::swap(turned.triangles[t].y, turned.triangles[t].z);
    EXPECT_EQ(render_volumes(turned, settings).shadowed, 0U);
  }
  // From below, through the back of the culled square, which stands over a ceiling lamp: both methods agree.
  Scene above = scene_with({1.0F, -3.0F, 6.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, -3.0F, 0.0F});
  add_quad(above, "ceiling", {{{-6, 3, -6}, {6, 3, -6}, {6, 3, 6}, {-6, 3, 6}}});
  add_quad(above, "square", {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}});
  settings.shadow_volume.method = VolumeMethod::depth_fail;
  const Rendering fail = render_volumes(above, settings);
  settings.shadow_volume.method = VolumeMethod::depth_pass;
  EXPECT_EQ(render_volumes(above, settings).frame.stencil(), fail.frame.stencil());
  EXPECT_GT(fail.shadowed, 300U);
}

// A sheet with its back to the light: in shadow on both sides, with light_facing.
TEST(VolumePasses, LightFacingShadowsBacks) {
  Scene scene = square_over_floor();
  for (std::size_t t : {0U, 1U}) std::swap(scene.triangles[t].y, scene.triangles[t].z);
  RenderSettings settings = volume_settings();
  const Rendering plain = render_volumes(scene, settings);
  settings.light_facing = true;
  settings.layers = true;
  const Rendering facing = render_volumes(scene, settings);
  for (std::size_t i = 0; i < facing.frame.stencil().size(); ++i) {
    const std::uint32_t triangle = facing.frame.primitive()[i];
    const int before = plain.frame.stencil()[i];
    EXPECT_EQ(facing.frame.stencil()[i], triangle <= 1 ? std::max(before, 1) : before);
  }
  EXPECT_GT(plain.lit, facing.lit);
}

TEST(VolumePasses, WhatARenderingHolds) {
  const Scene scene = square_over_floor();
  RenderSettings settings = with(VolumeMethod::depth_fail, false);
  settings.layers = settings.evidence = true;
  const Rendering r = render_volumes(scene, settings);
  std::vector<std::string> parts;
  for (const Layer& layer : r.layers) parts.push_back(layer.part);
  EXPECT_EQ(parts, (std::vector<std::string>{"stencil_fronts", "stencil", "depth", "polygon", "object"}));
  const auto& fronts = std::get<std::vector<std::uint8_t>>(r.layers[0].samples);
  EXPECT_FALSE(std::equal(fronts.begin(), fronts.end(), r.frame.stencil().begin(), r.frame.stencil().end()));
  ASSERT_TRUE(r.evidence.has_value());
  EXPECT_TRUE(r.evidence->fetched.empty() && r.evidence->in_map.empty());
  EXPECT_TRUE(r.maps.empty() && r.index_map.empty());
  ASSERT_EQ(r.pictures.size(), 1U);
  EXPECT_EQ(r.pictures[0].file, "volume.png");
  const Image8& image = r.pictures[0].image;
  const int largest = *std::max_element(r.frame.stencil().begin(), r.frame.stencil().end());
  EXPECT_EQ(largest, 1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto upright = static_cast<std::size_t>((image.height - 1 - y) * image.width + x);
      EXPECT_EQ(image.pixels[static_cast<std::size_t>(y * image.width + x)], r.frame.stencil()[upright] * 255);
    }
  }
  for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
    if (r.frame.depth()[i] == 0xFFFFFF) {
      EXPECT_EQ(r.frame.stencil()[i], 0);
    }
  }
  EXPECT_GT(r.background, 1000U);
  EXPECT_EQ(shadow_test::fact<std::string>(r, "open_object_names"), "floor, square");
}

// A watched pixel in the shadow on the floor: the volume's faces there, each with the triangle that casts it.
TEST(VolumePasses, WatchedPixel) {
  const Scene scene = square_over_floor();
  RenderSettings settings = volume_settings();
  const Rendering plain = render_volumes(scene, settings);
  const std::size_t at = static_cast<std::size_t>(
      std::find(plain.frame.stencil().begin(), plain.frame.stencil().end(), 1) - plain.frame.stencil().begin());
  settings.pixels = {glm::ivec2(static_cast<int>(at) % settings.width, static_cast<int>(at) / settings.width)};
  const Rendering r = render_volumes(scene, settings);
  EXPECT_EQ(r.frame.stencil(), plain.frame.stencil());
  std::vector<std::string> names;
  for (const ProbedPass& pass : r.probed[0]) names.push_back(pass.name);
  ASSERT_EQ(names, (std::vector<std::string>{"depth", "volumes", "lit", "shadow"}));
  const auto& fragments = r.probed[0][1].fragments;
  EXPECT_GE(fragments.size(), 2U);
  for (const ProbedFragment& f : fragments) EXPECT_LT(f.primitive, scene.triangles.size());
  EXPECT_TRUE(
      std::any_of(fragments.begin(), fragments.end(), [](const ProbedFragment& f) { return f.primitive >= 2; }));
  EXPECT_EQ(r.probed[0][3].fragments.back().fate, FragmentFate::written);
}

}  // namespace
