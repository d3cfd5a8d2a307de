// Traces as JSON, in the library ninebit::json.
#pragma once

#include <string>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/evaluate_stages.h"

namespace NINEBIT_PUBLIC ninebit {

// One object, indented by two spaces; docs/languages.md lists its members. `trace` must be of this program.
[[nodiscard]] std::string print_json_trace(const Program& program, const Trace& trace);

// The values of a texture-shader stage in a line: "s, t, r, q = (0.5, 0.25, 0, 1), texture read at (0.5, 0.25, 0),
// texel (255, 0, 0, 255)". Coordinates that the stage does not read are 0.
[[nodiscard]] std::string stage_text(const StageValues& stage);

// The results of texture-shader stages as one object: `stages`, in the order of the units, whose keys without a value
// are left out; whether the fragment is `culled`; and the `depth` that replaces its own, or null.
[[nodiscard]] std::string print_json_stages(const TextureShaderResult& result);

}  // namespace ninebit
