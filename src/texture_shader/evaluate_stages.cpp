#include "ninebit/texture_shader/evaluate_stages.h"

#include "src/texture_shader/stage_fragment.h"

namespace ninebit {

TextureShaderResult evaluate(const TextureShaderProgram& program, const HardwareProfile& profile,
                             const StageInputs& inputs, const FetchTexel& fetch) {
  TextureShaderResult result;
  one_fragment::Fragment fragment(program, inputs, fetch, result);
  one_fragment::walk_stages(program, profile, fragment);
  for (std::size_t i = 0; i < result.stage.size(); ++i) {
    const ProgramTextureStage& stage = program.stage[i];
    result.stage[i].operation = stage.state.operation;
    result.stage[i].previous = stage.state.previous;
    result.stage[i].is_consistent = stage.inconsistent.empty();
    result.stage[i].coordinates = inputs.at[i];
  }
  return result;
}

std::uint32_t replaced_depth_code(const TextureShaderProgram& program, float depth, std::uint32_t largest) {
  // Exact: a float times a code of 24 bits.
  const double code = program.depth_unit == DepthUnit::window ? static_cast<double>(depth) * largest : depth;
  if (!(code > 0.0)) return 0;
  if (code >= largest) return largest;
  const double half = program.choices.depth_narrowing == Narrowing::nearest_halves_up ? 0.5 : 0.0;
  return static_cast<std::uint32_t>(code + half);
}

}  // namespace ninebit
