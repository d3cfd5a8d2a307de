// Finds the part of a context that the arguments of a GL command name. Shared by the setters and the getters.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "ninebit/language/gl_nv.h"

namespace ninebit::gl::detail {

inline constexpr std::array<CombinerInput Portion::*, 4> kGeneralInputs{&Portion::a, &Portion::b, &Portion::c,
                                                                        &Portion::d};
inline constexpr std::array<CombinerInput FinalCombiner::*, 7> kFinalInputs{
    &FinalCombiner::a, &FinalCombiner::b, &FinalCombiner::c, &FinalCombiner::d,
    &FinalCombiner::e, &FinalCombiner::f, &FinalCombiner::g};

// The general combiner that an enumerant names; empty if the profile does not have it.
inline std::optional<int> existing_stage(const Context& context, GLenum value) {
  const std::optional<int> stage = to_stage(value);
  return stage && *stage < context.profile().general_combiners ? stage : std::nullopt;
}

// The result is const if `state` is.
template <class State>
auto& stage_of(State& state, int stage) {
  return state.general[static_cast<std::size_t>(stage)];
}

template <class State>
auto& portion_of(State& state, int stage, PortionName portion) {
  auto& general = stage_of(state, stage);
  return portion == PortionName::rgb ? general.rgb : general.alpha;
}

// A constant colour of a CombinerState or of a GeneralCombiner; nullptr if the enumerant names none.
template <class Owner>
auto* constant_of(Owner& owner, GLenum pname) {
  return pname == GL_CONSTANT_COLOR0_NV   ? &owner.constant0
         : pname == GL_CONSTANT_COLOR1_NV ? &owner.constant1
                                          : nullptr;
}

// The number of values of a parameter of GL_TEXTURE_SHADER_NV; 0: there is none of that name.
inline std::size_t texture_shader_values(GLenum pname) {
  switch (pname) {
    case GL_CULL_MODES_NV:
    case GL_OFFSET_TEXTURE_MATRIX_NV:
      return 4;
    case GL_CONST_EYE_NV:
      return 3;
    case GL_SHADER_OPERATION_NV:
    case GL_PREVIOUS_TEXTURE_INPUT_NV:
    case GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
    case GL_OFFSET_TEXTURE_SCALE_NV:
    case GL_OFFSET_TEXTURE_BIAS_NV:
      return 1;
    default:
      return 0;
  }
}

// NaN becomes 0.
inline float clamped_color(float component) {
  return component > 0.0F ? std::min(component, 1.0F) : 0.0F;
}

}  // namespace ninebit::gl::detail
