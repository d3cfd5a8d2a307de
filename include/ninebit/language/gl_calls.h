// Register-combiner programs as C text: a sequence of GL calls, as pasted from a program of the time.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// Executes the calls of a text in order on a new GL context of the profile, as a driver would: state set by earlier
// calls stays. Accepted: glCombinerParameter{i,f,iv,fv}NV, glCombinerInputNV, glCombinerOutputNV,
// glFinalCombinerInputNV, glCombinerStageParameterfvNV, glEnable and glDisable of the extensions' capabilities, with
// `texture_shader` also glActiveTextureARB and glTexEnv{i,f,iv,fv} of GL_TEXTURE_SHADER_NV, whose stages it receives if
// they are enabled at the end,
// each also with the affixes of function pointers (pglCombinerInputNV, qglCombinerInputNV, glCombinerInputNVptr, …: see
// docs/languages.md); enumerants by name, with GL_FALSE, GL_NONE, 0 for GL_ZERO, GL_TEXTURE0 and GL_TEXTURE0_ARB;
// arrays of constants as braces, `(GLfloat[]){…}` or an earlier `GLfloat name[] = {…};`; comments of both kinds.
// Everything else is an error with its line and column. A call that GL refuses is an error that names the GL error. All
// errors are reported, in the order of the text. Constants that are read and that no call sets are unset: the text is a
// piece of a program, which may have set them before. The time depends only on the length of the text.
[[nodiscard]] Parsed<CombinerState> parse_gl_calls(const SourceText& source, const HardwareProfile& profile,
                                                   TextureShaderState* texture_shader = nullptr);

// The calls that set a new context of the profile to this state. Calls that would repeat a default are omitted only for
// stages past num_general_combiners and for a stage's constants that nothing reads, whose call a profile may not have.
// Calls of constants that are unset are omitted. State that the
// profile does not have (later stages, the stages' constants) is omitted: it has no effect, and GL would refuse the
// calls. Apart from that and from the names of
// constants, parse_gl_calls returns the same state if the state is valid (see validate.h) and its colours
// are in [0, 1]. A feature that only the NV2A's registers have gives a Diagnostic that names it, if it has an effect.
// If `texture_shader` is enabled, its calls come first: what its operations read, without defaults.
[[nodiscard]] Result<std::string> print_gl_calls(const CombinerState& state, const HardwareProfile& profile,
                                                 const TextureShaderState& texture_shader = {});

}  // namespace ninebit
