// Wrong models of texture-shader stages: mistakes that emulators make.
#pragma once

#include <string>
#include <vector>

#include "ninebit/study/stage_vectors.h"

namespace ninebit::vectors {

// A rule of the stages that a model breaks, if neither a profile's field nor another state does.
enum class BrokenStageRule {
  none,
  off_is_clear,              // a stage that is off gives alpha 0
  not_projected,             // s, t and r are not divided by q
  third_is_zero,             // 3D textures are read in their first layer
  cube_projected,            // directions are divided by q
  signs_ignored,             // signed bytes are read as unsigned ones
  signs_not_doubled,         // a signed byte is its code
  bytes_rounded_down,        // 255 times the number, rounded down
  three_culled,              // q is not compared
  all_culled,                // a fragment is killed if all four components are
  dependent_exchanged,       // the second component is s
  offsets_unsigned,          // ds and dt are bytes from 0
  offsets_by_127,            // s8 / 127
  offsets_odd,               // (2 s8 + 1) / 255
  alpha_scaled,              // alpha is multiplied by the luminance, too
  luminance_clamped,         // scale times luminance plus bias is clamped to 1
  dots_exchanged,            // the first dot product is t
  dots_with_q,               // the dot product adds q
  mapping_d3d_255,           // MINUS1_TO_1_D3D: 2 v / 255 - 1
  mapping_clamped,           // signed mappings are clamped at -1
  mapping_gl_127,            // MINUS1_TO_1_GL: s / 127
  mapping_odd,               // MINUS1_TO_1: (2 s + 1) / 255
  words_of_8_bits,           // HILO words without their low bytes
  hilo_third_zero,           // HILO_1's third number is 0
  hemisphere_third_one,      // HEMISPHERE's third number is 1
  hemisphere_unsigned,       // HEMISPHERE's words are not signed
  depth_inverted,            // the quotient is that of the second dot product over the first
  depth_kept,                // the depth is not replaced
  unit_normals,              // 2 D (D . E) - E
  eye_negated,               // the reflection of -E
  eye_ignored,               // D itself
  ahead_is_zero,             // the third dot product of a diffuse cube map is 0
  yuv_rounded,               // (298 C + 409 E + 128) >> 8 and its like
  line_not_projected,        // a 1D texture's s is not divided by q
  rectangle_not_projected,   // likewise a rectangle's s and t
  rectangles_of_unit_sides,  // coordinates of rectangles are from 0 to 1
  dots_of_unit_sides         // only those that are dot products
};

struct StageMistake {
  std::string name, rules, group;
  HardwareProfile profile;  // the pack's, or with another value in one field
  BrokenStageRule broken = BrokenStageRule::none;
  void (*edit)(TextureShaderState&) = nullptr;  // what the model does to every state; null: nothing
};

// The mistakes that may be made instead of a profile's rules.
[[nodiscard]] std::vector<StageMistake> stage_mistakes_of(const HardwareProfile& profile);

// The outputs of a model for all fragments of a program.
[[nodiscard]] std::vector<StageOutput> run_stage_mistake(const StageMistake& mistake, const StageVectorPack& pack,
                                                         const StageVectorProgram& program);

// The output of the pack's profile, at other coordinates than the program's and for another state.
[[nodiscard]] StageOutput stage_output(const HardwareProfile& profile, const std::vector<StagePicture>& pictures,
                                       const StageVectorProgram& program, const TextureShaderProgram& compiled,
                                       const StageCoordinates& at);

// A program's stages with its textures.
[[nodiscard]] TextureShaderProgram compiled_stages(const HardwareProfile& profile,
                                                   const std::vector<StagePicture>& pictures,
                                                   const StageVectorProgram& program, const TextureShaderState& state);

}  // namespace ninebit::vectors
