// Which mistakes an emulator makes together: a plan to mend it.
#pragma once

#include <vector>

#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_mistakes.h"
#include "src/study/vectors/verdicts.h"

namespace ninebit::vectors {

// Fills verdict.plan and verdict.unexplained. `given`: programs with results, some of which differ. Fails with
// Fault::cancelled if `go_on` ends the work.
[[nodiscard]] Status make_plan(const VectorPack& pack, const std::vector<JudgedProgram<Bytes4>>& given,
                               const std::vector<Mistake>& mistakes, const VectorProgress& go_on,
                               VectorVerdict& verdict);

}  // namespace ninebit::vectors
