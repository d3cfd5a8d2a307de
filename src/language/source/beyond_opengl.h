// Features of the NV2A's registers that OpenGL, and the languages that translate to its calls, cannot express.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/texture_shader/stage_state.h"

namespace ninebit {

// The features that have an effect in a program, such as "mux by the lowest bit of spare0's alpha (general combiner
// 1)"; empty: none.
[[nodiscard]] std::string beyond_opengl(const Program& program);
// The same of texture-shader stages. Whose rules decide on consistency is not a feature: OpenGL's are taken.
[[nodiscard]] std::string beyond_opengl(const TextureShaderState& state);

// A note for words of NV20 that are read for a profile of an older chip.
namespace detail {
inline constexpr std::string_view kReadForOlderChip =
    "these are words of the GeForce3 and the NV2A, read for a profile of an older chip; nv2a is the Xbox's profile";
}

}  // namespace ninebit
