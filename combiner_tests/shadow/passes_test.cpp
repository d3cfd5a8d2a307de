// The state of each pass, as the article sets it.
#include <gtest/gtest.h>

#include "ninebit/ninebit.h"

namespace {

using namespace ninebit;

bool writes_color(const PipelineState& s) {
  return s.color_mask[0] || s.color_mask[1] || s.color_mask[2] || s.color_mask[3];
}

TEST(Passes, IndexMapIsFlatAndDepthTested) {
  const PipelineState s = index_cube_passes({})->map;
  EXPECT_EQ(s.shade_model, ShadeModel::flat);
  EXPECT_TRUE(s.depth_test.enabled && s.depth_test.write);
  EXPECT_EQ(s.depth_test.function, CompareFunction::less);
  EXPECT_EQ(s.color_mask, (std::array<bool, 4>{true, true, true, true}));
  EXPECT_FALSE(s.program || s.alpha_test.enabled || s.stencil_test.enabled);
  EXPECT_EQ(s.cull_face, CullFace::none);  // no back-face rejection
}

TEST(Passes, CameraDepthWritesDepthAlone) {
  const PipelineState s = index_cube_passes({})->depth;
  EXPECT_FALSE(writes_color(s));
  EXPECT_TRUE(s.depth_test.enabled && s.depth_test.write);
  EXPECT_EQ(s.depth_test.function, CompareFunction::less);
  EXPECT_FALSE(s.program || s.alpha_test.enabled || s.stencil_test.enabled);
}

TEST(Passes, ComparisonWritesOneWhereIndicesDiffer) {
  const PipelineState s = index_cube_passes({})->comparison;
  EXPECT_EQ(s.shade_model, ShadeModel::flat);
  EXPECT_FALSE(writes_color(s));
  EXPECT_TRUE(s.depth_test.enabled);
  EXPECT_FALSE(s.depth_test.write);
  EXPECT_EQ(s.depth_test.function, CompareFunction::equal);
  EXPECT_TRUE(s.alpha_test.enabled);
  EXPECT_EQ(s.alpha_test.function, CompareFunction::greater);
  EXPECT_EQ(s.alpha_test.reference, 0);
  EXPECT_TRUE(s.stencil_test.enabled);
  EXPECT_EQ(s.stencil_test.front.function, CompareFunction::always);
  EXPECT_EQ(s.stencil_test.front.reference, 1);
  EXPECT_EQ(s.stencil_test.front.mask & s.stencil_test.front.write_mask, 0xFF);
  EXPECT_EQ(s.stencil_test.front.fail, StencilOperation::keep);
  EXPECT_EQ(s.stencil_test.front.depth_fail, StencilOperation::keep);
  EXPECT_EQ(s.stencil_test.front.depth_pass, StencilOperation::replace);
  ASSERT_TRUE(s.program.has_value());
  EXPECT_EQ(*s.program, normalize(*index_comparison_state(profiles::geforce2), profiles::geforce2));
  EXPECT_EQ(s.program->num_general_combiners, 2);
}

// With light_facing: what turns away is in shadow, whatever the map says.
TEST(Passes, AvertedPolygonsAreMarkedWithoutComparison) {
  const PipelineState s = index_cube_passes({})->averted;
  const PipelineState compared = index_cube_passes({})->comparison;
  EXPECT_FALSE(s.program || s.alpha_test.enabled || writes_color(s));
  EXPECT_TRUE(s.depth_test.enabled && !s.depth_test.write);
  EXPECT_EQ(s.depth_test.function, CompareFunction::equal);
  EXPECT_TRUE(s.stencil_test.enabled);
  EXPECT_EQ(s.stencil_test.front.function, CompareFunction::always);
  EXPECT_EQ(s.stencil_test.front.reference, compared.stencil_test.front.reference);
  EXPECT_EQ(s.stencil_test.front.depth_pass, StencilOperation::replace);
  EXPECT_EQ(s.stencil_test.front.depth_fail, StencilOperation::keep);
}

TEST(Passes, LitWhereTheStencilIsZeroShadowWhereItIsNot) {
  const IndexCubePasses passes = *index_cube_passes({});
  EXPECT_EQ(passes.lit.stencil_test.front.function, CompareFunction::equal);
  EXPECT_EQ(passes.shadow.stencil_test.front.function, CompareFunction::notequal);
  for (const PipelineState& s : {passes.lit, passes.shadow}) {
    EXPECT_EQ(s.shade_model, ShadeModel::smooth);
    EXPECT_TRUE(writes_color(s));
    EXPECT_EQ(s.depth_test.function, CompareFunction::equal);
    EXPECT_TRUE(s.depth_test.enabled && !s.depth_test.write);
    EXPECT_TRUE(s.stencil_test.enabled);
    EXPECT_EQ(s.stencil_test.front.reference, 0);
    EXPECT_EQ(s.stencil_test.front.mask, 0xFF);
    EXPECT_EQ(s.stencil_test.front.depth_pass, StencilOperation::keep);
    EXPECT_FALSE(s.program || s.alpha_test.enabled);
  }
}

TEST(Passes, SettingsReachEveryPass) {
  RenderSettings settings;
  settings.cull_face = CullFace::back;
  settings.profile = profiles::nv2a;
  const IndexCubePasses p = *index_cube_passes(settings);
  for (const PipelineState& s : {p.map, p.depth, p.comparison, p.averted, p.lit, p.shadow}) {
    EXPECT_EQ(s.cull_face, CullFace::back);
    EXPECT_EQ(s.profile.name, "nv2a");
  }
}

TEST(Passes, EveryShippedProfileTakesTheArticlesSetUp) {
  for (const HardwareProfile& profile : hardware_profiles())
    EXPECT_TRUE(index_comparison_state(profile).ok()) << profile.name;
}

TEST(Passes, AProfileWithOneGeneralCombinerIsRefused) {
  RenderSettings settings;
  settings.profile.general_combiners.value = 1;
  const auto passes = index_cube_passes(settings);
  ASSERT_FALSE(passes.ok());
  EXPECT_NE(passes.error().message.find("refuses"), std::string::npos) << passes.error().message;
}

}  // namespace
