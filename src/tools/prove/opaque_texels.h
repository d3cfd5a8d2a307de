// Texture-shader stages as a question about combiners sees them: registers that hold one value, and
// opaque ones, which hold what a dependent look-up gives.
#pragma once

#include <string>
#include <vector>

#include "ninebit/language/program_text.h"
#include "ninebit/study/equivalence.h"

namespace ninebit::tools {

// A program of a question.
struct StagedProgram {
  std::string name;
  const TextProgram* program;
  const HardwareProfile* profile;
};

struct TexelsOfStages {
  std::vector<std::string> notes;   // what is opaque or not part of the question, one sentence each
  std::vector<std::string> opaque;  // registers that are opaque inputs: "tex1"
  std::vector<ProofInput> fixed;    // components of registers that stages always leave alike
  std::string reason;               // why registers of two programs cannot be one input; empty: they can
};

// Looks at the texture registers on which the targets of one of the programs depend.
[[nodiscard]] TexelsOfStages texels_of_stages(const std::vector<StagedProgram>& programs,
                                              const std::vector<ProofTarget>& targets);

// Adds `fixed` to inputs, but for those that are there, and prints the notes, unless `quiet`.
void apply_texels(const TexelsOfStages& texels, bool quiet, std::vector<ProofInput>& inputs);

}  // namespace ninebit::tools
