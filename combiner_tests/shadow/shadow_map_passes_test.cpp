// The state of the shadow map's own passes.
#include <gtest/gtest.h>

#include "combiner_tests/shadow/support.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/shadow/shadow_map.h"

namespace {

using namespace ninebit;

TEST(ShadowMapPasses, MapIsDrawnWithTheOffsetAndDepthAlone) {
  RenderSettings settings;
  settings.cull_face = CullFace::front;
  PipelineState s = shadow_map_passes(settings)->map;
  EXPECT_EQ(s.color_mask, (std::array<bool, 4>{}));
  EXPECT_TRUE(s.depth_test.enabled && s.depth_test.write);
  EXPECT_EQ(s.depth_test.function, CompareFunction::less);
  EXPECT_FALSE(s.program || s.alpha_test.enabled || s.stencil_test.enabled);
  EXPECT_EQ(s.cull_face, CullFace::front);
  EXPECT_TRUE(s.polygon_offset.fill);
  EXPECT_EQ(s.polygon_offset.factor, kShadowMapOffset.factor);
  EXPECT_EQ(s.polygon_offset.units, kShadowMapOffset.units);
  settings.shadow_map.polygon_offset = OffsetArguments{3.0F, -2.0F};
  s = shadow_map_passes(settings)->map;
  EXPECT_EQ(s.polygon_offset.factor, 3.0F);
  EXPECT_EQ(s.polygon_offset.units, -2.0F);
}

TEST(ShadowMapPasses, CameraPassesHaveNoOffsetAndTouchOnlyTheStencil) {
  const ShadowMapPasses passes = *shadow_map_passes({});
  for (const PipelineState& s : {passes.comparison, passes.coordinate, passes.averted}) {
    EXPECT_FALSE(s.polygon_offset.fill);
    EXPECT_EQ(s.color_mask, (std::array<bool, 4>{}));
    EXPECT_TRUE(s.depth_test.enabled && !s.depth_test.write);
    EXPECT_EQ(s.depth_test.function, CompareFunction::equal);
  }
  for (const PipelineState& s : {passes.comparison, passes.averted}) {
    EXPECT_TRUE(s.stencil_test.enabled);
    EXPECT_EQ(s.stencil_test.front.function, CompareFunction::always);
    EXPECT_EQ(s.stencil_test.front.reference, 1);
    EXPECT_EQ(s.stencil_test.front.depth_pass, StencilOperation::replace);
  }
  EXPECT_TRUE(passes.comparison.alpha_test.enabled);
  EXPECT_EQ(passes.comparison.alpha_test.function, CompareFunction::greater);
  EXPECT_EQ(passes.comparison.alpha_test.reference, 0);
  EXPECT_FALSE(passes.coordinate.stencil_test.enabled || passes.coordinate.program || passes.averted.program);
}

// Shadow unless both the comparison and the beam let light through, on every card.
TEST(ShadowMapPasses, CombinersMultiplyComparisonAndBeam) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    RenderSettings settings;
    settings.profile = profile;
    const auto passes = shadow_map_passes(settings);
    ASSERT_TRUE(passes.ok()) << profile.name;
    ASSERT_TRUE(passes->comparison.program.has_value());
    for (const int comparison : {0, 255}) {
      for (const int beam : {0, 255}) {
        FragmentInputs inputs;
        inputs.texture[0] =
            Texel{.value = {static_cast<std::uint8_t>(comparison), 0, 0, 0}, .format = TextureFormat::depth_comparison};
        inputs.texture[1] = Texel{.value = {0, 0, 0, static_cast<std::uint8_t>(beam)}, .format = TextureFormat::alpha};
        const auto out = evaluate(*passes->comparison.program, initial_registers(profile, inputs));
        const bool lit = comparison == 255 && beam == 255;
        EXPECT_EQ(to_byte(profile, out[kAlpha]), lit ? 0 : 255) << profile.name << ' ' << comparison << ' ' << beam;
      }
    }
  }
}

}  // namespace
