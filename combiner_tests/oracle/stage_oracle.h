// A slow and naive model of texture-shader stages. Its only job is to judge the library's.
//
// It is written from the formulas that were read off pictures of an NV2A (docs/numerics.md, rules 33 to 40) and from
// NV_texture_shader's rules of consistency, and shares no code with what it judges: of the library's headers it
// includes those of plain data, for the state as the question.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_program.h"
#include "ninebit/texture_shader/stage_state.h"

namespace ninebit::oracle {

struct StageQuestion {
  TextureShaderState state;
  StageTextures textures;
  HardwareProfile profile;
  std::array<std::array<float, 4>, 4> coordinate{};  // s, t, r, q of each unit
  std::function<std::array<int, 4>(int unit, std::array<float, 3> at)> fetch;
};

struct StageAnswer {
  std::array<bool, 4> consistent{};
  std::array<std::array<int, 4>, 4> texel{};  // bytes
  std::array<std::array<int, 4>, 4> code{};   // of the combiners
  std::array<std::optional<float>, 4> dot{};
  bool culled = false;
  std::optional<float> depth{};
};

[[nodiscard]] StageAnswer run_stages(const StageQuestion& question);

}  // namespace ninebit::oracle
