#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/gl_nv/gl_nv_access.h"
#include "src/language/source/beyond_opengl.h"
#include "src/system/digits.h"

namespace ninebit {
namespace {

using detail::gl_name;

constexpr std::array<std::string_view, 7> kVariableNames{"GL_VARIABLE_A_NV", "GL_VARIABLE_B_NV", "GL_VARIABLE_C_NV",
                                                         "GL_VARIABLE_D_NV", "GL_VARIABLE_E_NV", "GL_VARIABLE_F_NV",
                                                         "GL_VARIABLE_G_NV"};

constexpr std::array<std::string_view, 2> kConstantNames{"GL_CONSTANT_COLOR0_NV", "GL_CONSTANT_COLOR1_NV"};

// The shortest C constant of type float.
std::string number_text(float value) {
  std::string text = digits_of(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

// The same for the number as GL would store a colour.
std::string float_text(float component) {
  return number_text(gl::detail::clamped_color(component));
}

template <std::size_t N>
std::string numbers_text(const std::array<float, N>& values) {
  std::string text;
  for (const float value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return "(const GLfloat[]){" + text + "}";
}

std::string array_text(const ColorF& color) {
  std::string text = "(const GLfloat[]){";
  for (std::size_t i = 0; i < color.size(); ++i) text += (i == 0 ? "" : ", ") + float_text(color[i]);
  return text + "}";
}

std::string stage_name(std::size_t stage) {
  return "GL_COMBINER" + std::to_string(stage) + "_NV";
}

class GlPrinter {
 public:
  std::string print(const CombinerState& state, const HardwareProfile& profile,
                    const TextureShaderState& texture_shader) {
    if (texture_shader.enabled) print_stages(only_used(texture_shader));
    call("glCombinerParameteriNV", {"GL_NUM_GENERAL_COMBINERS_NV", std::to_string(state.num_general_combiners)});
    call("glCombinerParameteriNV", {"GL_COLOR_SUM_CLAMP_NV", boolean(state.color_sum_clamp)});
    for (std::size_t which = 0; which < 2; ++which) {
      if (is_shared_constant_unset(state, which)) continue;
      call("glCombinerParameterfvNV",
           {kConstantNames[which], array_text(which == 0 ? state.constant0 : state.constant1)});
    }
    const ByConstant<bool> read = constants_read(state);
    const auto stages = static_cast<std::size_t>(profile.general_combiners.value);
    for (std::size_t i = 0; i < std::min(stages, state.general.size()); ++i) {
      const bool all = static_cast<int>(i) < state.num_general_combiners;
      const GeneralCombiner fresh;
      portion(i, PortionName::rgb, state.general[i].rgb, fresh.rgb, all);
      portion(i, PortionName::alpha, state.general[i].alpha, fresh.alpha, all);
      if (!profile.per_stage_constants) continue;
      for (std::size_t which = 0; which < 2; ++which) {
        const ColorF& color = which == 0 ? state.general[i].constant0 : state.general[i].constant1;
        const bool is_given = state.per_stage_constants && read[i][which] && !state.origin[i][which].unset;
        // The call needs NV_register_combiners2: it is printed only where it says something.
        if (!is_given && color == ColorF{}) continue;
        call("glCombinerStageParameterfvNV", {stage_name(i), kConstantNames[which], array_text(color)});
      }
    }
    text_ += '\n';
    for (std::size_t v = 0; v < gl::detail::kFinalInputs.size(); ++v) {
      const CombinerInput& in = state.final_combiner.*gl::detail::kFinalInputs[v];
      call("glFinalCombinerInputNV", {kVariableNames[v], gl_name(in.reg), gl_name(in.mapping), gl_name(in.usage)});
    }
    text_ += '\n';
    if (state.per_stage_constants) call("glEnable", {"GL_PER_STAGE_CONSTANTS_NV"});
    call("glEnable", {"GL_REGISTER_COMBINERS_NV"});
    return std::move(text_);
  }

 private:
  struct Argument {
    Argument(const char* t) : text(t) {}
    Argument(std::string_view t) : text(t) {}
    Argument(std::string t) : text(std::move(t)) {}
    std::string text;
  };

  void print_stages(const TextureShaderState& stages) {
    const TextureStage fresh;
    constexpr std::string_view kTarget = "GL_TEXTURE_SHADER_NV";
    for (std::size_t i = 0; i < stages.stage.size(); ++i) {
      const TextureStage& stage = stages.stage[i];
      call("glActiveTextureARB", {"GL_TEXTURE" + std::to_string(i) + "_ARB"});
      call("glTexEnvi", {kTarget, "GL_SHADER_OPERATION_NV", "GL_" + std::string(info_of(stage.operation).gl)});
      if (stage.previous != fresh.previous) {
        call("glTexEnvi",
             {kTarget, "GL_PREVIOUS_TEXTURE_INPUT_NV", "GL_TEXTURE" + std::to_string(stage.previous) + "_ARB"});
      }
      if (stage.mapping != fresh.mapping) {
        call("glTexEnvi", {kTarget, "GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV", "GL_EXPAND_NORMAL_NV"});
      }
      if (stage.cull != fresh.cull) {
        std::string modes;
        for (const CullMode mode : stage.cull) {
          modes += modes.empty() ? "" : ", ";
          modes += mode == CullMode::kills_negative ? "GL_GEQUAL" : "GL_LESS";
        }
        call("glTexEnviv", {kTarget, "GL_CULL_MODES_NV", "(const GLint[]){" + modes + "}"});
      }
      if (stage.matrix != fresh.matrix) {
        call("glTexEnvfv", {kTarget, "GL_OFFSET_TEXTURE_MATRIX_NV", numbers_text(stage.matrix)});
      }
      if (stage.scale != fresh.scale)
        call("glTexEnvf", {kTarget, "GL_OFFSET_TEXTURE_SCALE_NV", number_text(stage.scale)});
      if (stage.bias != fresh.bias) call("glTexEnvf", {kTarget, "GL_OFFSET_TEXTURE_BIAS_NV", number_text(stage.bias)});
      if (stage.eye != fresh.eye) call("glTexEnvfv", {kTarget, "GL_CONST_EYE_NV", numbers_text(stage.eye)});
    }
    call("glActiveTextureARB", {"GL_TEXTURE0_ARB"});
    call("glEnable", {kTarget});
    text_ += '\n';
  }

  static std::string_view boolean(bool value) { return value ? "GL_TRUE" : "GL_FALSE"; }

  void call(std::string_view name, std::initializer_list<Argument> arguments) {
    text_ += name;
    char before = '(';
    for (const Argument& argument : arguments) {
      text_ += before;
      if (before == ',') text_ += ' ';
      text_ += argument.text;
      before = ',';
    }
    text_ += ");\n";
  }

  void portion(std::size_t stage, PortionName name, Portion now, const Portion& fresh, bool all) {
    now.out.ab_blue_to_alpha = now.out.cd_blue_to_alpha = false;  // no call sets them: they have no effect here
    if (!all && now == fresh) return;
    const std::string_view which = name == PortionName::rgb ? "GL_RGB" : "GL_ALPHA";
    text_ += '\n';
    for (std::size_t v = 0; v < gl::detail::kGeneralInputs.size(); ++v) {
      const CombinerInput& in = now.*gl::detail::kGeneralInputs[v];
      if (!all && in == fresh.*gl::detail::kGeneralInputs[v]) continue;
      call("glCombinerInputNV",
           {stage_name(stage), which, kVariableNames[v], gl_name(in.reg), gl_name(in.mapping), gl_name(in.usage)});
    }
    const PortionOutput& out = now.out;
    if (!all && out == fresh.out) return;
    call("glCombinerOutputNV",
         {stage_name(stage), which, gl_name(out.ab), gl_name(out.cd), gl_name(out.sum), gl_name(out.scale),
          gl_name(out.bias), boolean(out.ab_dot_product), boolean(out.cd_dot_product), boolean(out.mux_sum)});
  }

  std::string text_;
};

}  // namespace

Result<std::string> print_gl_calls(const CombinerState& state, const HardwareProfile& profile,
                                   const TextureShaderState& texture_shader) {
  if (const std::string beyond = beyond_opengl(normalize(state, profile)); !beyond.empty()) {
    return Diagnostic{.message = "OpenGL has no " + beyond};
  }
  if (const auto refused = validate(texture_shader, profile); !refused.empty()) {
    return Diagnostic{.message = refused.front().message};
  }
  if (const std::string beyond = beyond_opengl(texture_shader); texture_shader.enabled && !beyond.empty()) {
    return Diagnostic{.message = "OpenGL has no " + beyond};
  }
  return GlPrinter().print(state, profile, texture_shader);
}

}  // namespace ninebit
