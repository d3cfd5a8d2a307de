// Finds everything that is wrong with texture-shader stages, each with the error that GL raises for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// One fault of texture-shader stages, with its place.
struct TextureShaderDiagnostic {
  std::optional<int> stage;              // 0-based; empty: about all stages
  GlError gl_error = GlError::no_error;  // that GL's setter would have raised; no_error: GL accepts it
  std::string message;                   // one sentence: what is wrong and what is allowed
};

// The fault of stages that are enabled on a profile without texture shaders: one sentence, with profiles that have
// them.
[[nodiscard]] std::string no_texture_shaders(const HardwareProfile& profile);

// Returns the diagnostics of all stages, stage by stage: GL_INVALID_ENUM first, then other errors of OpenGL, then what
// only the NV2A or this library refuses. Empty: valid. A state that is not enabled is valid with every profile. Whether
// a stage is consistent depends on the textures, too: see compile(). Rules: NV_texture_shader and NV_texture_shader2,
// errors of TexEnv; docs/texture_shaders.md for the NV2A.
[[nodiscard]] std::vector<TextureShaderDiagnostic> validate(const TextureShaderState& state,
                                                            const HardwareProfile& profile);

}  // namespace ninebit
