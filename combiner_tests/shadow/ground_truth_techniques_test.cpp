// Every technique judged by rays.
#include "combiner_tests/shadow/ground_truth_support.h"

namespace shadow_test {
namespace {

using namespace ninebit;

struct Judged {
  Rendering rendering;
  GroundTruth truth;
};

RenderSettings room_settings() {
  RenderSettings settings = judged_settings(160, 120);
  settings.reflective.samples = 1;
  settings.light_cookie.cookie = test::noisy_cookie();
  return settings;
}

Judged judged_by(std::string_view name, const RenderSettings& settings) {
  const Scene scene = index_room(find_technique(name)->lights);
  Rendering rendering = render_by(name, scene, settings);
  GroundTruth truth = judged(scene, settings, rendering);
  return {std::move(rendering), std::move(truth)};
}

TEST(JudgedTechniques, HaveTheCausesOfTheirKind) {
  for (const Technique& technique : techniques()) {
    SCOPED_TRACE(technique.name);
    const Judged j = judged_by(technique.name, room_settings());
    const bool by_index = technique.name == "index-cube" || technique.name == "light-cookie";
    const std::size_t kinds = by_index ? 5 : technique.name == "shadow-volume" ? 1 : 3;
    EXPECT_EQ(causes_of(*j.rendering.evidence).size(), kinds);
    std::uint64_t all = 0;
    for (const ErrorCause cause : causes_of(*j.rendering.evidence)) all += count(j.truth, cause);
    EXPECT_EQ(all, j.truth.false_lit + j.truth.false_shadowed);
    EXPECT_LT(all, 160U * 120U / 5) << "most pixels are right";
  }
}

// One pixel alone is judged as among all, and what its cause is about is there.
TEST(JudgedTechniques, OnePixelAlone) {
  std::size_t wrong = 0, blocked = 0;
  for (const char* name : {"index-cube", "depth-cube", "shadow-volume"}) {
    SCOPED_TRACE(name);
    const Technique& technique = *find_technique(name);
    const Scene scene = index_room(technique.lights);
    const RenderSettings settings = room_settings();
    const auto rendering = technique.render(scene, settings, {});
    ASSERT_TRUE(rendering);
    const auto rays = GroundTruthScene::make(scene);
    ASSERT_TRUE(rays);
    const auto truth = measure(*rays, settings, *rendering);
    ASSERT_TRUE(truth);
    for (std::size_t i = 0; i < truth->truth.size(); ++i) {
      if (truth->cause[i] == ErrorCause::none && i % 97 != 0) continue;
      const auto pixel = judge_pixel(*rays, settings, *rendering, static_cast<int>(i % 160), static_cast<int>(i / 160));
      ASSERT_TRUE(pixel);
      ASSERT_EQ(pixel->truth, truth->truth[i]) << i;
      ASSERT_EQ(pixel->cause, truth->cause[i]) << i;
      ASSERT_EQ(pixel->shown.has_value(), pixel->truth != PixelTruth::background);
      EXPECT_EQ(pixel->occluder.has_value(), pixel->truth == PixelTruth::shadowed) << i;  // a point light, both sides
      wrong += pixel->cause != ErrorCause::none ? 1U : 0U;
      blocked += pixel->occluder ? 1U : 0U;
      if (pixel->cause == ErrorCause::joint) {
        ASSERT_TRUE(pixel->fetched && *pixel->fetched != *pixel->shown);
      }
    }
    EXPECT_FALSE(judge_pixel(*rays, settings, *rendering, 160, 0));
    EXPECT_FALSE(judge_pixel(*rays, settings, *rendering, 0, -1));
  }
  EXPECT_GT(wrong, 50U);
  EXPECT_GT(blocked, 50U);
}

// Two ways to the same shadows that have nothing in common: volumes counted in the stencil buffer, and rays.
TEST(JudgedTechniques, ShadowVolumesAgreeWithRays) {
  const Judged j = judged_by("shadow-volume", room_settings());
  EXPECT_LT(j.truth.false_lit + j.truth.false_shadowed, 160U * 120U / 200);
  EXPECT_GT(j.rendering.shadowed, 1000U);
}

TEST(JudgedTechniques, WithoutABiasThereIsAcneWithTooMuchOfItShadowsAreDetached) {
  RenderSettings none = room_settings(), much = room_settings();
  none.depth_cube.bits = much.depth_cube.bits = DepthCubeBits::real;
  none.depth_cube.bias = 0.0F;
  much.depth_cube.bias = 0.5F;
  none.shadow_map.polygon_offset = OffsetArguments{0.0F, 0.0F};
  much.shadow_map.polygon_offset = OffsetArguments{0.0F, 1e6F};
  for (const char* name : {"depth-cube", "shadow-map"}) {
    SCOPED_TRACE(name);
    const Judged bare = judged_by(name, none), biased = judged_by(name, much);
    EXPECT_GT(count(bare.truth, ErrorCause::acne), 1000U);
    EXPECT_EQ(count(bare.truth, ErrorCause::detached), 0U);
    EXPECT_LT(count(biased.truth, ErrorCause::acne), 5U);  // next to nothing, at the rim of a spot light's map
    EXPECT_GT(count(biased.truth, ErrorCause::detached), 100U);
  }
}

TEST(JudgedTechniques, ACookieWithoutShadowsCannotBeJudged) {
  RenderSettings settings = room_settings();
  settings.light_cookie.shadows = false;
  const Technique& technique = *find_technique("light-cookie");
  const Scene scene = index_room(technique.lights);
  const auto rendering = technique.render(scene, settings, {});
  ASSERT_TRUE(rendering) << rendering.error().text();
  EXPECT_FALSE(rendering->evidence);
  const auto rays = GroundTruthScene::make(scene);
  ASSERT_TRUE(rays);
  EXPECT_FALSE(measure(*rays, settings, *rendering));
}

}  // namespace
}  // namespace shadow_test
