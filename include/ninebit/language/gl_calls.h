// Register-combiner programs as C text: a sequence of GL calls, as one would paste them from a program of the time.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Executes the calls of a text in their order on a fresh GL context of the profile, as a driver would: state that
// earlier calls left stays. Accepted: glCombinerParameter{i,f,iv,fv}NV, glCombinerInputNV, glCombinerOutputNV,
// glFinalCombinerInputNV, glCombinerStageParameterfvNV, glEnable and glDisable of the two extensions' capabilities,
// each also with a prefix such as a function pointer has (pglCombinerInputNV, qglCombinerInputNV, glCombinerInputNVptr,
// …: see docs/languages.md); enumerants by name, with GL_FALSE, GL_NONE, 0 for GL_ZERO, GL_TEXTURE0 and
// GL_TEXTURE0_ARB; arrays of constants as braces, `(GLfloat[]){…}` or an earlier `GLfloat name[] = {…};`; comments of
// both kinds. Everything else is an error with its line and column. So is a call that GL refuses: the error then names
// the GL error. All errors are reported, in the order of the text. Time grows with the text's length alone.
[[nodiscard]] Parsed<CombinerState> parse_gl_calls(const SourceText& source, const HardwareProfile& profile);

// The calls that bring a fresh context of the profile into this state; calls that would repeat a default are left out
// for stages beyond num_general_combiners only, and for a stage's constants, whose call a profile may lack. What the
// profile lacks altogether (its last stages, the stages' constants) is left out: it has no effect, and GL would refuse
// the calls. But for that, parse_gl_calls gives the same state again if the state is valid (see validate.h) and its
// colours are in [0, 1]. What only the NV2A's registers can ask for, and has an effect, gives a Diagnostic that names
// it.
[[nodiscard]] Result<std::string> print_gl_calls(const CombinerState& state, const HardwareProfile& profile);

}  // namespace ninebit
