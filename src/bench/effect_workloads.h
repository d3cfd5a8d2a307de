// Effects of the gallery and programs of combiners on a rectangle, and the same in GLSL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/effect/effect_renderer.h"

namespace ninebit::bench {

// An effect of one pass. Textures have kEffectTexels texels a side.
struct EffectWorkload {
  std::string name;           // of the gallery's effect, or of the program
  Effect effect{};            // its textures are numbered
  std::string fragment;       // of GLSL 3.30: reads `uv`, the textures tex0 and tex1 or cube1, writes `color`
  HardwareProfile profile{};  // that it is drawn with
};
inline constexpr int kEffectTexels = 256;

// The measured effects: sepia reads one nearest texel, emboss twice four, light_map_detail twice eight (trilinear).
// Texture-shader stages: water moves four texels by four others, reflect reads a cube map where a normal of four texels
// reflects the eye.
// With the given profile, those with stages with nv2a if it has none.
[[nodiscard]] std::vector<EffectWorkload> effect_workloads(int width, int height, const HardwareProfile& profile);

// The programs index, heavy and eight of measured_programs(), whose texture units 0 and 1 read a nearest texel. The
// GLSL is emit_glsl()'s: it draws the same bytes. Reports a profile that refuses a program or that GLSL cannot follow.
[[nodiscard]] Result<std::vector<EffectWorkload>> program_workloads(int width, int height,
                                                                    const HardwareProfile& profile);

// A texture of a workload, as ninebit draws it.
[[nodiscard]] Result<Texture> workload_texture(const EffectWorkload& workload, std::size_t number);

// Readers of the workloads' programs and textures, which are not files.
[[nodiscard]] EffectReaders workload_readers();

}  // namespace ninebit::bench
