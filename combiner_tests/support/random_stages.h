// Random valid texture-shader states.
#pragma once

#include "combiner_tests/support/random.h"
#include "ninebit/texture_shader/stage_state.h"

namespace ninebit::test {

// An operation that may stand on a stage.
inline TextureOperation random_stage_operation(Random& random, int place) {
  while (true) {
    const auto operation = static_cast<TextureOperation>(random.below(static_cast<int>(TextureOperation::brdf)));
    if (place >= info_of(operation).first && place <= info_of(operation).last) return operation;
  }
}

// Stages that are valid for profiles with texture shaders, and enabled. Half of them have chains of dot products.
inline TextureShaderState random_stages(Random& random) {
  TextureShaderState state;
  state.enabled = true;
  state.rules = random.pick({StageRules::open_gl, StageRules::nv2a});
  state.depth_unit = random.pick({DepthUnit::window, DepthUnit::codes});
  state.converts_yuv = random.one_in(4);
  for (int place = 0; place < kTextureStages; ++place) {
    TextureStage& stage = state.stage[static_cast<std::size_t>(place)];
    stage.operation = random_stage_operation(random, place);
    stage.previous = place == 0 ? 0 : random.below(place);
    do {
      stage.mapping = static_cast<DotMapping>(random.below(8));
    } while (stage.mapping == DotMapping::hilo_hemisphere_d3d || stage.mapping == DotMapping::hilo_hemisphere_gl);
    for (CullMode& mode : stage.cull) mode = random.pick({CullMode::kills_negative, CullMode::kills_not_negative});
    if (random.one_in(2)) {
      for (float& entry : stage.matrix) entry = random.pick({0.0F, 1.0F, random.real_f(-8, 8)});
    }
    stage.scale = random.pick({1.0F, 0.0F, random.real_f(-2, 3)});
    stage.bias = random.pick({0.0F, random.real_f(-1, 1)});
    if (random.one_in(2)) {
      for (float& component : stage.eye) component = random.real_f(-1, 1);
    }
  }
  if (random.one_in(2)) return state;
  const int last = random.between(2, 3);
  const auto at = [&](int place) -> TextureStage& { return state.stage[static_cast<std::size_t>(place)]; };
  do {
    at(last).operation = random_stage_operation(random, last);
  } while (info_of(at(last).operation).dots_before == 0);
  for (int i = 1; i <= info_of(at(last).operation).dots_before; ++i) {
    at(last - i).operation = TextureOperation::dot_product;
  }
  return state;
}

}  // namespace ninebit::test
