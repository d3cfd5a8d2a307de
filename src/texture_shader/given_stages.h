// Stages of a fragment whose coordinates and texels somebody gives, where no draw makes them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/evaluate_stages.h"

namespace NINEBIT_PUBLIC ninebit {  // the library above this room calls it

// The coordinates of the units, and their textures, each of which has one texel, which is read wherever a stage reads
// the texture. Without more, a unit's coordinates are (0, 0, 0, 1) and the bytes of its texel 0.
struct GivenFragment {
  StageCoordinates at{{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}};
  std::array<Bytes4, kTextureStages> texel{};  // red, green, blue, alpha
};

// A component of such a fragment: "at1.s", a coordinate, or "texel0.r", a byte.
struct GivenComponent {
  bool is_texel = false;
  int unit = 0, component = 0;
  friend bool operator==(const GivenComponent&, const GivenComponent&) = default;
};
// The components that a name means: one of "at1.s", four of "at1"; empty: it is no such name.
[[nodiscard]] std::vector<GivenComponent> given_components(std::string_view name);
// Gives a fragment a component: a coordinate, or a whole number from 0 to 255.
void give(GivenFragment& fragment, const GivenComponent& component, float value);
// Its name.
[[nodiscard]] std::string name_of(const GivenComponent& component);

// Whether stages run before the combiners of a fragment for which somebody gives coordinates or texels, or textures'
// registers. Without either, stages that only read their textures do not: the combiners read what is given.
[[nodiscard]] bool runs_stages(const TextureShaderState& state, bool gives_components, bool gives_textures);

// Compiles stages for textures of the kinds that the operations read; one that an offset reads has the format DSDT_MAG.
// Reports as compile() does.
[[nodiscard]] Result<TextureShaderProgram> compile_for_given(const TextureShaderState& state,
                                                             const HardwareProfile& profile);

// Evaluates such a program, and gives the registers of textures what the stages give; spare 0's alpha is that of
// texture 0 unless somebody gave it.
[[nodiscard]] TextureShaderResult evaluate_given(const TextureShaderProgram& program, const HardwareProfile& profile,
                                                 const GivenFragment& fragment, bool gives_spare0_alpha,
                                                 RegisterFile& registers);

}  // namespace ninebit
