// The files and generated things that an effect draws with.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/effect/effect_renderer.h"

namespace ninebit {

// The message with the part of the effect that it is about. A fault in a file keeps its place.
[[nodiscard]] Diagnostic fault_in(const std::string& part, const Diagnostic& fault);

// The mesh as its file has it, or generated; without a mesh, a rectangle.
[[nodiscard]] Result<Scene> effect_mesh(const Effect& effect, const EffectReaders& readers);

// The effect's scene, complete: that mesh with one camera and one light.
[[nodiscard]] Result<Scene> effect_scene(const Effect& effect, Scene mesh);

// The rectangle that passes draw, with the scene's camera and light.
[[nodiscard]] Scene rectangle_scene(const Scene& scene);

// A texture that is not a target's. Adds a warning if the file's picture was resized.
[[nodiscard]] Result<Texture> effect_texture(const Effect& effect, const EffectTexture& texture,
                                             const HardwareProfile& profile, const EffectReaders& readers);

// A program of a pass: its combiners, and the texture-shader stages of its file.
struct EffectProgram {
  Program combiners;
  TextureShaderState texture_shader{};
};

// The program of a pass with its constants. Adds a warning for each unit without a texture that the program reads
// without stages, and for each constant that it reads and nobody set.
[[nodiscard]] Result<EffectProgram> effect_program(const Effect& effect, const EffectPass& pass,
                                                   const HardwareProfile& profile, const EffectReaders& readers,
                                                   std::vector<std::string>& warnings);

// Whether a sampler reads mip-maps.
[[nodiscard]] constexpr bool needs_mipmaps(const Sampler& sampler) {
  return sampler.min_filter != MinFilter::nearest && sampler.min_filter != MinFilter::linear;
}

}  // namespace ninebit
