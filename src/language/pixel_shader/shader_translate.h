// A pixel shader's instructions as general combiners and a final combiner.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/pixel_shader/shader_stage.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

// The state of a shader. Reports what register combiners cannot express; the state is of use only without faults.
[[nodiscard]] CombinerState translate_shader(const ShaderText& text, const HardwareProfile& profile,
                                             SourceFaults& faults, SourceFaults& notes);

// The final combiner of a shader that ends with xfc, and of one that does not.
void translate_final(ShaderContext& context, const ShaderInstruction& xfc, FinalCombiner& out);
[[nodiscard]] FinalCombiner plain_final(const ShaderContext& context);

}  // namespace ninebit::detail
