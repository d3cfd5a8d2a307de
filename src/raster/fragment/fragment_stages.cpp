#include "src/raster/fragment/fragment_stages.h"

#include <algorithm>

namespace ninebit {

FragmentStages::FragmentStages(const DrawContext& context)
    : context_(context), coordinates_(context.stages->needs_derivatives() ? 3 : 1) {
  for (auto& unit : coordinates_[0]) unit[3].fill(1.0F);
}

StageInputs FragmentStages::inputs(std::size_t i) const {
  StageInputs in;
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (!context_.stages->reads(static_cast<int>(unit), static_cast<int>(k))) continue;
      const float value = coordinates_[0][unit][k][i];
      in.at[unit][k] = value;
      in.right[unit][k] = value + (kinds() > 1 ? coordinates_[1][unit][k][i] : 0.0F);
      in.above[unit][k] = value + (kinds() > 1 ? coordinates_[2][unit][k][i] : 0.0F);
    }
  }
  return in;
}

void FragmentStages::run(std::size_t count, RegisterBatch& registers) {
  StageBatch batch;
  StageOutputs outputs{.codes = {}, .killed = culled_.data(), .depth = depth_.data()};
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
    for (std::size_t k = 0; k < 4; ++k) {
      batch.value[unit][k] = coordinates_[0][unit][k].data();
      if (kinds() > 1) {
        batch.dx[unit][k] = coordinates_[1][unit][k].data();
        batch.dy[unit][k] = coordinates_[2][unit][k].data();
      }
      const Register reg = texture_register(static_cast<int>(unit));
      if (context_.reads_unit[unit]) outputs.codes[unit][k] = registers(reg, static_cast<int>(k));
    }
    if (!has_q(unit)) batch.value[unit][3] = nullptr;
  }
  context_.stages->run(batch, count, outputs);
  if (context_.reads_unit[0]) {
    std::copy_n(registers(Register::texture0, kAlpha), count, registers(Register::spare0, kAlpha));
  }
}

}  // namespace ninebit
