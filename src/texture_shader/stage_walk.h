// The walk through a texture-shader stage, once for all that walks it: one fragment, batches, texts.
//
// The domain D has a type At (three coordinates, or arrays of them) and these members; `i` is the stage:
//
//   At projected(i)                          s, t, r over q
//   At coordinates(i)                        s, t, r
//   At offset(i, stage)                      s, t, moved by the texel of stage.previous (rule 34)
//   At dependent(i, stage, first, second)    two components of the texel of stage.previous (rule 37)
//   void dot(i, stage)                       computes the dot product of stage i (rule 36)
//   At dots(first, count)                    the dot products of `count` stages from `first` on
//   At reflected(i, stage, is_constant)      the eye, reflected by the dots of stages i - 2 to i (rule 38)
//   void fetch(i, At)                        the stage's texel is its texture's there
//   void scale(i, stage)                     times the luminance of the texel of stage.previous (rule 35)
//   void pass(i)                             s, t, r, q as bytes (rule 33)
//   void cull(i, stage)                      kills fragments by their coordinates
//   void replace_depth(i)                    the quotient of the dots of stages i - 1 and i (rule 39)
//   void nothing(i); void off(i)             (0, 0, 0, 0); what a unit without a texture reads (rule 16)
#pragma once

#include "ninebit/numerics/codes.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit {

namespace stage_walk_detail {

// An operation that is a dot product, with what follows from it.
template <class D>
void walk_dot_product(const TextureShaderProgram& program, int i, D& d) {
  const TextureStage& stage = program.stage[static_cast<std::size_t>(i)].state;
  d.dot(i, stage);
  switch (stage.operation) {
    case TextureOperation::dot_product_2d:
    case TextureOperation::dot_product_rectangle:
      return d.fetch(i, d.dots(i - 1, 2));
    case TextureOperation::dot_product_3d:
    case TextureOperation::dot_product_cube_map:
      return d.fetch(i, d.dots(i - 2, 3));
    case TextureOperation::dot_product_diffuse_cube_map: {
      // The next stage's dot product is computed ahead.
      TextureStage ahead = program.stage[static_cast<std::size_t>(i + 1)].state;
      if (program.choices.ahead_mapping == AheadMapping::of_diffuse) ahead.mapping = stage.mapping;
      d.dot(i + 1, ahead);
      return d.fetch(i, d.dots(i - 1, 3));
    }
    case TextureOperation::dot_product_reflect_cube_map:
    case TextureOperation::dot_product_const_eye_reflect_cube_map:
      return d.fetch(
          i, d.reflected(i, stage, stage.operation == TextureOperation::dot_product_const_eye_reflect_cube_map));
    case TextureOperation::dot_product_depth_replace:
      d.replace_depth(i);
      return d.nothing(i);
    default:
      return d.nothing(i);
  }
}

}  // namespace stage_walk_detail

template <class D>
void walk_stage(const TextureShaderProgram& program, int i, D& d) {
  const ProgramTextureStage& at = program.stage[static_cast<std::size_t>(i)];
  if (!at.inconsistent.empty()) return d.nothing(i);
  const TextureStage& stage = at.state;
  switch (stage.operation) {
    case TextureOperation::none:
    case TextureOperation::brdf:
      return d.off(i);
    case TextureOperation::texture_1d:
    case TextureOperation::texture_2d:
    case TextureOperation::texture_rectangle:
    case TextureOperation::texture_3d:
      return d.fetch(i, d.projected(i));
    case TextureOperation::texture_cube_map:
      return d.fetch(i, d.coordinates(i));
    case TextureOperation::pass_through:
      return d.pass(i);
    case TextureOperation::cull_fragment:
      d.cull(i, stage);
      return d.nothing(i);
    case TextureOperation::offset_2d:
    case TextureOperation::offset_rectangle:
      return d.fetch(i, d.offset(i, stage));
    case TextureOperation::offset_2d_scale:
    case TextureOperation::offset_rectangle_scale:
      d.fetch(i, d.offset(i, stage));
      return d.scale(i, stage);
    case TextureOperation::dependent_ar:
      return d.fetch(i, d.dependent(i, stage, kAlpha, kRed));
    case TextureOperation::dependent_gb:
      return d.fetch(i, d.dependent(i, stage, kGreen, kBlue));
    default:
      return stage_walk_detail::walk_dot_product(program, i, d);
  }
}

}  // namespace ninebit
