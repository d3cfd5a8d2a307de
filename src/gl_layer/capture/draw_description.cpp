#include "src/gl_layer/capture/draw_description.h"

#include <array>
#include <cstdio>
#include <string>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/shader/program_cache.h"

namespace ninebit::gl_layer {
namespace {

using Json = nlohmann::ordered_json;

// OpenGL's words for comparison, stencil operations and blend factors; others as numbers.
Json word_of(GLint value) {
  struct Word {
    GLint value;
    const char* name;
  };
  static constexpr Word kWords[]{{GL_NEVER, "GL_NEVER"},
                                 {GL_LESS, "GL_LESS"},
                                 {GL_EQUAL, "GL_EQUAL"},
                                 {GL_LEQUAL, "GL_LEQUAL"},
                                 {GL_GREATER, "GL_GREATER"},
                                 {GL_NOTEQUAL, "GL_NOTEQUAL"},
                                 {GL_GEQUAL, "GL_GEQUAL"},
                                 {GL_ALWAYS, "GL_ALWAYS"},
                                 {GL_KEEP, "GL_KEEP"},
                                 {GL_REPLACE, "GL_REPLACE"},
                                 {GL_INCR, "GL_INCR"},
                                 {GL_DECR, "GL_DECR"},
                                 {GL_INVERT, "GL_INVERT"},
                                 {GL_INCR_WRAP, "GL_INCR_WRAP"},
                                 {GL_DECR_WRAP, "GL_DECR_WRAP"},
                                 {GL_SRC_COLOR, "GL_SRC_COLOR"},
                                 {GL_ONE_MINUS_SRC_COLOR, "GL_ONE_MINUS_SRC_COLOR"},
                                 {GL_SRC_ALPHA, "GL_SRC_ALPHA"},
                                 {GL_ONE_MINUS_SRC_ALPHA, "GL_ONE_MINUS_SRC_ALPHA"},
                                 {GL_DST_ALPHA, "GL_DST_ALPHA"},
                                 {GL_ONE_MINUS_DST_ALPHA, "GL_ONE_MINUS_DST_ALPHA"},
                                 {GL_DST_COLOR, "GL_DST_COLOR"},
                                 {GL_ONE_MINUS_DST_COLOR, "GL_ONE_MINUS_DST_COLOR"},
                                 {GL_SRC_ALPHA_SATURATE, "GL_SRC_ALPHA_SATURATE"},
                                 {GL_LINEAR, "GL_LINEAR"},
                                 {GL_EXP, "GL_EXP"},
                                 {GL_EXP2, "GL_EXP2"}};
  for (const Word& word : kWords) {
    if (word.value == value) return word.name;
  }
  return value;
}

// Blend factors 0 and 1 are GL_ZERO and GL_ONE, which are no other words.
Json factor_of(GLenum name) {
  const GLint value = driver_integer(name);
  if (value == GL_ZERO) return "GL_ZERO";
  return value == GL_ONE ? Json("GL_ONE") : word_of(value);
}

void describe_tests(Json& draw) {
  if (driver_enables(GL_ALPHA_TEST)) {
    GLfloat reference = 0.0F;
    found_driver.GetFloatv(GL_ALPHA_TEST_REF, &reference);
    draw["alpha_test"] = {{"function", word_of(driver_integer(GL_ALPHA_TEST_FUNC))}, {"reference", reference}};
  }
  if (driver_enables(GL_STENCIL_TEST)) {
    draw["stencil"] = {{"function", word_of(driver_integer(GL_STENCIL_FUNC))},
                       {"reference", driver_integer(GL_STENCIL_REF)},
                       {"mask", static_cast<GLuint>(driver_integer(GL_STENCIL_VALUE_MASK))},
                       {"fail", factor_of(GL_STENCIL_FAIL)},
                       {"depth_fail", factor_of(GL_STENCIL_PASS_DEPTH_FAIL)},
                       {"depth_pass", factor_of(GL_STENCIL_PASS_DEPTH_PASS)}};
  }
  if (driver_enables(GL_DEPTH_TEST)) {
    draw["depth"] = {{"function", word_of(driver_integer(GL_DEPTH_FUNC))},
                     {"write", driver_integer(GL_DEPTH_WRITEMASK) != 0}};
  }
  if (driver_enables(GL_BLEND))
    draw["blend"] = {{"source", factor_of(GL_BLEND_SRC)}, {"destination", factor_of(GL_BLEND_DST)}};
  GLboolean mask[4]{};
  found_driver.GetBooleanv(GL_COLOR_WRITEMASK, mask);
  if (mask[0] == 0 || mask[1] == 0 || mask[2] == 0 || mask[3] == 0) {
    draw["color_mask"] = Json::array({mask[0] != 0, mask[1] != 0, mask[2] != 0, mask[3] != 0});
  }
  if (driver_enables(GL_FOG)) draw["fog"] = word_of(driver_integer(GL_FOG_MODE));
}

struct Target {
  GLenum target;
  GLenum binding;
  const char* name;
};

// nullptr: the unit samples no texture.
const Target* target_of_unit(StageTarget target) {
  static constexpr Target kTargets[]{{GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D, "GL_TEXTURE_1D"},
                                     {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D, "GL_TEXTURE_2D"},
                                     {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE, "GL_TEXTURE_RECTANGLE"},
                                     {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D, "GL_TEXTURE_3D"},
                                     {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP, "GL_TEXTURE_CUBE_MAP"}};
  if (target == StageTarget::none) return nullptr;
  return &kTargets[static_cast<std::size_t>(target) - 1];
}

Json describe_units(const Context& context) {
  Json units = Json::array();
  const GLint active = driver_integer(GL_ACTIVE_TEXTURE);
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const Target* const target = target_of_unit(context.inputs.units[i].target);
    if (target == nullptr) {
      units.push_back(nullptr);
      continue;
    }
    found_driver.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    const GLenum image =
        target->target == GL_TEXTURE_CUBE_MAP ? GLenum{GL_TEXTURE_CUBE_MAP_POSITIVE_X} : target->target;
    GLint width = 0, height = 0, format = 0;
    found_driver.GetTexLevelParameteriv(image, 0, GL_TEXTURE_WIDTH, &width);
    found_driver.GetTexLevelParameteriv(image, 0, GL_TEXTURE_HEIGHT, &height);
    found_driver.GetTexLevelParameteriv(image, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    char hex[16];
    std::snprintf(hex, sizeof(hex), "0x%04X", static_cast<unsigned>(format));
    units.push_back({{"target", target->name},
                     {"texture", driver_integer(target->binding)},
                     {"size", Json::array({width, height})},
                     {"internal_format", hex}});
  }
  found_driver.ActiveTexture(static_cast<GLenum>(active));
  return units;
}

Json constants_of(const CombinerState& state) {
  Json constants{{"const0", state.constant0}, {"const1", state.constant1}};
  if (!state.per_stage_constants) return constants;
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const GeneralCombiner& general = state.general[static_cast<std::size_t>(i)];
    constants["combiners"].push_back({{"const0", general.constant0}, {"const1", general.constant1}});
  }
  return constants;
}

}  // namespace

Json describe_draw(const Context& context, const char* call) {
  Json draw{{"call", call}, {"program", nullptr}};
  GLint viewport[4]{};
  found_driver.GetIntegerv(GL_VIEWPORT, viewport);
  draw["viewport"] = Json::array({viewport[0], viewport[1], viewport[2], viewport[3]});
  if (context.program != nullptr) {
    draw["program"] = context.program->number;
    draw["constants"] = constants_of(context.combiners.state());
    draw["units"] = describe_units(context);
  }
  describe_tests(draw);
  return draw;
}

}  // namespace ninebit::gl_layer
