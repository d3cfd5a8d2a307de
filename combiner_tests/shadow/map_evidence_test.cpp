// Each fragment's texel in the light's map, against the texels that the combiners read and against a formula.
#include "src/frame/map_evidence.h"

#include <cmath>
#include <set>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "ninebit/scene/scene_io.h"
#include "src/frame/camera_frame.h"
#include "src/frame/views.h"

namespace shadow_test {
namespace {

using namespace ninebit;

void expect_what_was_read(const Scene& scene, const RenderSettings& settings) {
  const Rendering r = render(scene, settings);
  const ComparisonLayers layers = comparison_layers(r);
  ASSERT_TRUE(r.evidence);
  ASSERT_EQ(r.evidence->fetched.size(), layers.polygon.size());
  std::size_t looked_up = 0, wrong = 0;
  for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
    const std::uint32_t read = layers.polygon[i] == 0 ? 0 : layers.fetched(r.codes, i);
    looked_up += read != 0 ? 1U : 0U;
    wrong += read != r.evidence->fetched[i] ? 1U : 0U;
  }
  EXPECT_EQ(wrong, 0U) << "of " << layers.polygon.size() << " pixels";
  EXPECT_GT(looked_up, layers.polygon.size() / 10);

  std::set<std::uint32_t> in_map;
  for (const IndexMapFace& face : r.index_map) {
    for (std::size_t i = 0; i < face.texels(); ++i) {
      in_map.insert(r.codes.number(face.texel(i)));
    }
  }
  ASSERT_EQ(r.evidence->in_map.size(), scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    EXPECT_EQ(r.evidence->in_map[t], in_map.count(t + 1) != 0) << "triangle " << t;
  }
}

RenderSettings with_evidence() {
  RenderSettings settings = small_settings();
  settings.evidence = true;
  return settings;
}

TEST(MapEvidence, IsTheTexelThatTheCombinersRead) {
  expect_what_was_read(square_over_floor(), with_evidence());
  const Scene scene = ninebit::test::index_room();
  RenderSettings settings = with_evidence();
  for (const CullFace cull : {CullFace::none, CullFace::back, CullFace::front}) {
    settings.cull_face = cull;
    settings.map_size = cull == CullFace::none ? 256 : 32;
    expect_what_was_read(scene, settings);
  }
}

TEST(MapEvidence, ComesOnlyWhereItIsAsked) {
  EXPECT_FALSE(render(square_over_floor(), small_settings()).evidence);
}

TEST(MapEvidence, OfIndicesByObject) {
  RenderSettings settings = with_evidence();
  settings.index.scope = IndexScope::object;
  const Rendering r = render(square_over_floor(), settings);
  EXPECT_EQ(r.evidence->index_of_triangle, (std::vector<std::uint32_t>{1, 1, 2, 2}));
}

// A spot light above the square: its map holds the square where |x|, |z| < 1.5 on the floor, the floor up to 3, and
// nothing is looked up beyond.
TEST(MapEvidence, OfAProjectedMap) {
  Scene scene = square_over_floor();
  scene.lights[0].kind = LightKind::spot;
  RenderSettings settings = with_evidence();
  auto made = CameraFrame::make(scene, settings, {.spot = true});
  ASSERT_TRUE(made) << made.error().text();
  CameraFrame& frame = *made;
  ASSERT_TRUE(frame.draw_depth());

  const glm::mat4 projection = light_projection(scene, scene.lights[0]);
  std::vector<glm::vec4> coordinates;
  for (const glm::vec3& p : scene.positions) {
    const glm::vec4 clip = projection * glm::vec4(p, 1.0F);
    coordinates.emplace_back(0.5F * (clip.x + clip.w), 0.5F * (clip.y + clip.w), 0.0F, clip.w);
  }
  PipelineState pass;
  pass.depth_test = {.enabled = true};
  const LightMap map{.pass = pass,
                     .positions = scene.positions,
                     .projections = {&projection, 1},
                     .size = settings.map_size,
                     .coordinates = coordinates};
  ASSERT_TRUE(add_map_evidence(frame, map));
  ASSERT_TRUE(frame.draw_lit_and_shadow());
  const Rendering& r = frame.rendering();
  constexpr float kTexel = 6.0F / 256.0F;
  std::array<int, 3> seen{};
  for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    if (r.frame.primitive()[i] > 1) return;  // not the floor
    const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
    const float from_middle = std::max(std::fabs(p.x), std::fabs(p.z));
    if (std::fabs(from_middle - 1.5F) < kTexel || std::fabs(from_middle - 3.0F) < kTexel) return;
    const std::uint32_t fetched = r.evidence->fetched[i];
    const int expected = from_middle < 1.5F ? 1 : from_middle < 3.0F ? 0 : 2;
    ++seen[static_cast<std::size_t>(expected)];
    EXPECT_EQ(fetched == 0 ? 2 : fetched <= 2 ? 0 : 1, expected) << x << "," << y << " shows " << p.x << "," << p.z;
  });
  for (const int count : seen) EXPECT_GT(count, 100);
  EXPECT_EQ(r.evidence->in_map, std::vector<bool>(4, true));
}

}  // namespace
}  // namespace shadow_test
