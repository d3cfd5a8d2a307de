#include <gtest/gtest.h>
#include <ninebit/raster/pipeline_state.h>

TEST(Examples, PipelineState) {
  using namespace ninebit;
  const Result<Program> program = compile(CombinerState{}, profiles::geforce2);
  ASSERT_TRUE(program.ok());
  PipelineState state;  // GL's defaults
  state.program = *program;
  state.depth_test = {.enabled = true, .function = CompareFunction::lequal};
  state.blend = {.enabled = true, .source = BlendFactor::src_alpha, .destination = BlendFactor::one};
  state.scissor = PixelRect{.x = 8, .y = 8, .width = 48, .height = 48};
  EXPECT_TRUE(compare(state.depth_test.function, 7, 7));
}
