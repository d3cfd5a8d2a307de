// A record of a technique's drawing, made while it draws: its passes, and the memory of its maps.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/frame/rendering.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/texture.h"

namespace ninebit {

// In the order of CubeFace.
inline constexpr std::array kCubeFaceNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

// Adds a pass that is drawn with this state to Rendering::drawn. A name is added once: a pass may take several draws.
void note_pass(Rendering& rendering, std::string_view name, const PipelineState& state);

// The same for a pass that is computed in floats, beyond the hardware. `marks_shadows`: it is the comparison.
void note_float_pass(Rendering& rendering, std::string_view name, bool marks_shadows);

// Memory of all levels and faces: three components take four bytes, 24 bits of depth as well.
[[nodiscard]] std::uint64_t texture_bytes(const Texture& texture);

// Counting the texture units that a technique needs.

// The number of texture registers that the program's output colour depends on.
[[nodiscard]] int texture_units_read(const Program& program);

}  // namespace ninebit
