#include "ninebit/texture_shader/stage_state.h"

#include <algorithm>

namespace ninebit {
namespace {

TextureStage only_used(const TextureStage& stage) {
  if (stage.operation > TextureOperation::brdf) return stage;
  const TextureOperationInfo& info = info_of(stage.operation);
  TextureStage used;
  used.operation = stage.operation;
  if (info.input != StageInput::none) used.previous = stage.previous;
  if (info.input == StageInput::normal) used.mapping = stage.mapping;
  if (stage.operation == TextureOperation::cull_fragment) used.cull = stage.cull;
  if (info.input == StageInput::offset || info.input == StageInput::luminance) used.matrix = stage.matrix;
  if (info.input == StageInput::luminance) {
    used.scale = stage.scale;
    used.bias = stage.bias;
  }
  if (stage.operation == TextureOperation::dot_product_const_eye_reflect_cube_map) used.eye = stage.eye;
  return used;
}

}  // namespace

TextureShaderState only_used(const TextureShaderState& state) {
  TextureShaderState used;
  used.enabled = state.enabled;
  if (!state.enabled) return used;
  used.rules = state.rules;
  std::transform(state.stage.begin(), state.stage.end(), used.stage.begin(),
                 [](const TextureStage& stage) { return only_used(stage); });
  const auto any = [&](auto has) { return std::any_of(used.stage.begin(), used.stage.end(), has); };
  const auto replaces_depth = [](const TextureStage& stage) {
    return stage.operation == TextureOperation::dot_product_depth_replace;
  };
  if (any(replaces_depth)) used.depth_unit = state.depth_unit;
  const auto reads_texture = [](const TextureStage& stage) {
    return stage.operation <= TextureOperation::brdf && info_of(stage.operation).target != StageTarget::none;
  };
  used.converts_yuv = state.converts_yuv && any(reads_texture);
  return used;
}

bool only_reads_textures(const TextureShaderState& stages) {
  if (stages.enabled && only_used(stages).converts_yuv) return false;
  return !stages.enabled || std::all_of(stages.stage.begin(), stages.stage.end(), [](const TextureStage& stage) {
    return stage.operation <= TextureOperation::texture_cube_map;
  });
}

}  // namespace ninebit
