// The final combiner's two equations for explain.
#pragma once

#include "src/language/explain/explain_terms.h"

namespace ninebit::explain_detail {

// RGB = A·B + (1 - A)·C + D and alpha = G, simplified; codes before the clamp to [0, 1].
[[nodiscard]] Expression final_color(const Program& program, const Scope& scope);
[[nodiscard]] Expression final_alpha(const Program& program, const Scope& scope);

// Whether the color equation is GL's default: fog and colour sum.
[[nodiscard]] bool is_default_color(const FinalCombiner& f);

}  // namespace ninebit::explain_detail
