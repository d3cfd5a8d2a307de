#include "src/language/gl_calls/gl_calls_execute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/gl_nv/gl_nv_access.h"

namespace ninebit::detail {
namespace {

using gl::GLenum;

// The arguments of a call as GL receives them.
struct Converted {
  std::array<GLenum, 10> e{};  // enumerants and booleans, by position
  gl::GLint i = 0;
  gl::GLfloat f = 0;
  std::array<gl::GLint, 4> iv{};
  std::array<gl::GLfloat, 4> fv{};
};

class Call {
 public:
  Call(const GlSignature& call, const std::vector<GlArgument>& arguments, std::size_t offset, gl::Context& context,
       SourceFaults& faults)
      : call_(call), arguments_(arguments), offset_(offset), context_(context), faults_(faults) {}

  void execute() {
    if (!convert()) return;
    const gl::CurrentContext current(context_);
    if (call_.command >= GlCommand::tex_env_i) return set_stage();
    run();
    const GlError error = context_.take_error();
    if (error == GlError::no_error || explain_names() || explain_rules()) return;
    faults_.add(offset_, reason(), error);
  }

 private:
  // A call of texture shaders.
  void set_stage() {
    const auto& e = converted_.e;
    if (call_.command != GlCommand::active_texture && e[0] != gl::GL_TEXTURE_SHADER_NV) {
      return faults_.add(arguments_[0].offset, quoted(arguments_[0].text) + " is another target; gl" +
                                                   std::string(call_.name) +
                                                   " is read with GL_TEXTURE_SHADER_NV alone");
    }
    const auto is_finite = [](float value) { return std::isfinite(value); };
    if (!is_finite(converted_.f) || !std::all_of(converted_.fv.begin(), converted_.fv.end(), is_finite)) {
      return faults_.add(arguments_[2].offset, quoted(arguments_[2].text) + " is too large for a float");
    }
    switch (call_.command) {
      case GlCommand::tex_env_i:
        gl::glTexEnvi(e[0], e[1], converted_.i);
        break;
      case GlCommand::tex_env_f:
        gl::glTexEnvf(e[0], e[1], converted_.f);
        break;
      case GlCommand::tex_env_iv:
        gl::glTexEnviv(e[0], e[1], converted_.iv.data());
        break;
      case GlCommand::tex_env_fv:
        gl::glTexEnvfv(e[0], e[1], converted_.fv.data());
        break;
      default:
        gl::glActiveTexture(e[0]);
    }
    if (const GlError error = context_.take_error(); error != GlError::no_error) {
      faults_.add(offset_, reason_of_stage(), error);
    }
  }

  // How many values glTexEnv reads of an array.
  static std::size_t values_of_stage(GLenum pname) {
    return std::max(gl::detail::texture_shader_values(pname), std::size_t{1});  // one of an unknown name
  }

  // Why GL refused a call of texture shaders.
  [[nodiscard]] std::string reason_of_stage() const {
    const HardwareProfile& profile = context_.profile();
    if (call_.command == GlCommand::active_texture) {
      return "profile " + std::string(profile.name) + " has " +
             std::to_string(std::min(profile.texture_units.value, kTextureStages)) + " texture units";
    }
    if (!profile.texture_shaders) return no_texture_shaders(profile);
    const bool is_scalar = call_.command == GlCommand::tex_env_i || call_.command == GlCommand::tex_env_f;
    const GLenum pname = converted_.e[1];
    if (is_scalar && values_of_stage(pname) > 1) return "this parameter needs an array; expected one of a single value";
    const std::string place = "texture stage " + std::to_string(context_.active_texture());
    const std::string_view value = arguments_[2].text;
    switch (pname) {
      case gl::GL_SHADER_OPERATION_NV:
        for (const TextureOperationInfo& info : texture_operations()) {
          if (info.gl_value == 0 || arguments_[2].real != static_cast<double>(info.gl_value)) continue;
          const std::string first = std::to_string(info.first), last = std::to_string(info.last);
          return place + ": " + quoted(value) + " is for " +
                 (first == last ? "stage " + first : "stages " + first + " to " + last) + " only";
        }
        return "expected an operation, such as GL_TEXTURE_2D or GL_DOT_PRODUCT_NV, not " + quoted(value);
      case gl::GL_PREVIOUS_TEXTURE_INPUT_NV:
        return place + ": expected a texture unit before this one, such as GL_TEXTURE0_ARB, not " + quoted(value);
      case gl::GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
        return "expected GL_UNSIGNED_IDENTITY_NV or GL_EXPAND_NORMAL_NV, not " + quoted(value);
      case gl::GL_CULL_MODES_NV:
        return "expected GL_LESS or GL_GEQUAL, four of them";
      default:
        return "expected a parameter of texture shaders, such as GL_SHADER_OPERATION_NV, not " +
               quoted(arguments_[1].text);
    }
  }

  bool refuse(const GlArgument& argument, const std::string& expected) {
    faults_.add(argument.offset, quoted(argument.text) + " cannot be passed here; expected " + expected);
    return false;
  }

  bool convert() {
    if (arguments_.size() != call_.parameters.size()) {
      faults_.add(offset_, "gl" + std::string(call_.name) + " takes " + std::to_string(call_.parameters.size()) +
                               (call_.parameters.size() == 1 ? " argument, not " : " arguments, not ") +
                               std::to_string(arguments_.size()));
      return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < arguments_.size(); ++i) good = convert_one(i) && good;
    return good;
  }

  bool convert_one(std::size_t i) {
    const GlArgument& argument = arguments_[i];
    const char kind = call_.parameters[i];
    if (argument.is_array != (kind == 'I' || kind == 'F')) {
      return refuse(argument, argument.is_array ? "one value" : "an array, such as (GLfloat[]){0, 0, 0, 1}");
    }
    switch (kind) {
      case 'e':
        return convert_enumerant(argument, std::numeric_limits<GLenum>::max(), "an enumerant", converted_.e[i]);
      case 'b':
        return convert_enumerant(argument, std::numeric_limits<gl::GLboolean>::max(), "GL_TRUE or GL_FALSE",
                                 converted_.e[i]);
      case 'i':
        return convert_integer(argument, converted_.i);
      case 'f':
        converted_.f = static_cast<gl::GLfloat>(argument.real);
        return true;
      default:
        return convert_array(argument, kind);
    }
  }

  bool convert_enumerant(const GlArgument& argument, GLenum most, const char* expected, GLenum& out) {
    if (!argument.is_integer || argument.integer < 0 || argument.integer > std::int64_t{most}) {
      return refuse(argument, expected);
    }
    out = static_cast<GLenum>(argument.integer);
    return true;
  }

  bool convert_integer(const GlArgument& argument, gl::GLint& out) {
    constexpr std::int64_t kLeast = std::numeric_limits<gl::GLint>::min(),
                           kMost = std::numeric_limits<gl::GLint>::max();
    if (!argument.is_integer || argument.integer < kLeast || argument.integer > kMost) {
      return refuse(argument, "an integer");
    }
    out = static_cast<gl::GLint>(argument.integer);
    return true;
  }

  // GL reads four values for a colour and one for other parameters.
  bool convert_array(const GlArgument& array, char kind) {
    const GLenum pname = converted_.e[call_.parameters.size() - 2];
    const bool is_one = pname == gl::GL_NUM_GENERAL_COMBINERS_NV || pname == gl::GL_COLOR_SUM_CLAMP_NV;
    const std::size_t needed = call_.command >= GlCommand::tex_env_i ? values_of_stage(pname) : is_one ? 1 : 4;
    if (array.element == (kind == 'I' ? GlElement::real : GlElement::integer)) {
      return refuse(array, kind == 'I' ? "an array of integers" : "an array of floats");
    }
    if (array.count < needed) {
      return refuse(array, std::to_string(needed) + " values, not " + std::to_string(array.count));
    }
    bool good = true;
    for (std::size_t i = 0; i < needed; ++i) {
      converted_.fv[i] = static_cast<gl::GLfloat>(array.values[i].real);
      if (kind == 'I') good = convert_integer(array.values[i], converted_.iv[i]) && good;
    }
    return good;
  }

  void run() const {
    const auto& e = converted_.e;
    const auto flag = [&](std::size_t i) { return e[i] != 0 ? gl::GL_TRUE : gl::GL_FALSE; };
    switch (call_.command) {
      case GlCommand::combiner_parameter_i:
        return gl::glCombinerParameteriNV(e[0], converted_.i);
      case GlCommand::combiner_parameter_f:
        return gl::glCombinerParameterfNV(e[0], converted_.f);
      case GlCommand::combiner_parameter_iv:
        return gl::glCombinerParameterivNV(e[0], converted_.iv.data());
      case GlCommand::combiner_parameter_fv:
        return gl::glCombinerParameterfvNV(e[0], converted_.fv.data());
      case GlCommand::combiner_input:
        return gl::glCombinerInputNV(e[0], e[1], e[2], e[3], e[4], e[5]);
      case GlCommand::combiner_output:
        return gl::glCombinerOutputNV(e[0], e[1], e[2], e[3], e[4], e[5], e[6], flag(7), flag(8), flag(9));
      case GlCommand::final_combiner_input:
        return gl::glFinalCombinerInputNV(e[0], e[1], e[2], e[3]);
      case GlCommand::combiner_stage_parameter_fv:
        return gl::glCombinerStageParameterfvNV(e[0], e[1], converted_.fv.data());
      case GlCommand::enable:
        return gl::glEnable(e[0]);
      case GlCommand::disable:
        return gl::glDisable(e[0]);
      default:
        return;
    }
  }

  // Reports an argument of the wrong kind; false if the kind is right.
  template <class Word>
  bool misnamed(std::size_t i, const std::optional<Word>& word, const char* expected) {
    if (word) return false;
    faults_.add(arguments_[i].offset, quoted(arguments_[i].text) + " is not a valid " + expected,
                GlError::invalid_enum);
    return true;
  }

  // Reports the arguments that are enumerants of the wrong kind; true if there are any.
  bool explain_names() {
    const auto& e = converted_.e;
    bool found = false;
    const auto check = [&](bool wrong) { found = wrong || found; };
    switch (call_.command) {
      case GlCommand::combiner_input:
        check(misnamed(0, gl::to_stage(e[0]), "general combiner"));
        check(misnamed(1, gl::to_portion(e[1]), "portion; expected GL_RGB or GL_ALPHA"));
        check(misnamed(2, gl::to_variable(e[2]), "variable"));
        check(misnamed(3, gl::to_register(e[3]), "input register"));
        check(misnamed(4, gl::to_input_mapping(e[4]), "input mapping"));
        check(misnamed(5, gl::to_component_usage(e[5]), "component usage; expected GL_RGB, GL_ALPHA or GL_BLUE"));
        break;
      case GlCommand::combiner_output:
        check(misnamed(0, gl::to_stage(e[0]), "general combiner"));
        check(misnamed(1, gl::to_portion(e[1]), "portion; expected GL_RGB or GL_ALPHA"));
        for (std::size_t i = 2; i < 5; ++i) check(misnamed(i, gl::to_register(e[i]), "output register"));
        check(misnamed(5, gl::to_scale(e[5]), "scale"));
        check(misnamed(6, gl::to_bias(e[6]), "bias"));
        break;
      case GlCommand::final_combiner_input:
        check(misnamed(0, gl::to_variable(e[0]), "variable"));
        check(misnamed(1, gl::to_register(e[1]), "input register"));
        check(misnamed(2, gl::to_input_mapping(e[2]), "input mapping"));
        check(misnamed(3, gl::to_component_usage(e[3]), "component usage; expected GL_RGB, GL_ALPHA or GL_BLUE"));
        break;
      case GlCommand::combiner_stage_parameter_fv:
        check(misnamed(0, gl::to_stage(e[0]), "general combiner"));
        break;
      default:
        break;
    }
    return found;
  }

  // Called only if explain_names() returned false. Reports the reasons that validate.h finds; true if there are any.
  bool explain_rules() {
    const auto& e = converted_.e;
    const HardwareProfile& profile = context_.profile();
    std::vector<StateDiagnostic> reasons;
    if (call_.command == GlCommand::combiner_input) {
      reasons =
          validate_input(*gl::to_stage(e[0]), *gl::to_portion(e[1]), *gl::to_variable(e[2]),
                         {*gl::to_register(e[3]), *gl::to_input_mapping(e[4]), *gl::to_component_usage(e[5])}, profile);
    } else if (call_.command == GlCommand::combiner_output) {
      const PortionOutput output{.ab = *gl::to_register(e[2]),
                                 .cd = *gl::to_register(e[3]),
                                 .sum = *gl::to_register(e[4]),
                                 .scale = *gl::to_scale(e[5]),
                                 .bias = *gl::to_bias(e[6]),
                                 .ab_dot_product = e[7] != 0,
                                 .cd_dot_product = e[8] != 0,
                                 .mux_sum = e[9] != 0};
      reasons = validate_output(*gl::to_stage(e[0]), *gl::to_portion(e[1]), output, profile);
    } else if (call_.command == GlCommand::final_combiner_input) {
      reasons = validate_final_input(
          *gl::to_variable(e[0]), {*gl::to_register(e[1]), *gl::to_input_mapping(e[2]), *gl::to_component_usage(e[3])},
          profile);
    }
    for (const StateDiagnostic& why : reasons) faults_.add(offset_, why.message, why.gl_error);
    return !reasons.empty();
  }

  // Why GL refused a call that sets neither an input nor an output.
  [[nodiscard]] std::string reason() const {
    const HardwareProfile& profile = context_.profile();
    std::string combiners = "profile " + std::string(profile.name) + " has " +
                            std::to_string(profile.general_combiners.value) + " general combiners";
    std::string no_stage_constants =
        "profile " + std::string(profile.name) + " has no per-stage constants (NV_register_combiners2)";
    const GLenum pname = converted_.e[0];
    switch (call_.command) {
      case GlCommand::combiner_parameter_i:
      case GlCommand::combiner_parameter_f:
        if (pname == gl::GL_NUM_GENERAL_COMBINERS_NV) return combiners;
        return "expected GL_NUM_GENERAL_COMBINERS_NV or GL_COLOR_SUM_CLAMP_NV, not " + quoted(arguments_[0].text);
      case GlCommand::combiner_parameter_iv:
      case GlCommand::combiner_parameter_fv:
        if (pname == gl::GL_NUM_GENERAL_COMBINERS_NV) return combiners;
        return "expected a constant colour or a parameter of the combiners, not " + quoted(arguments_[0].text);
      case GlCommand::combiner_stage_parameter_fv:
        if (!profile.per_stage_constants) return no_stage_constants;
        if (*gl::to_stage(pname) >= profile.general_combiners) return combiners;
        return "expected GL_CONSTANT_COLOR0_NV or GL_CONSTANT_COLOR1_NV, not " + quoted(arguments_[1].text);
      default:
        if (pname == gl::GL_PER_STAGE_CONSTANTS_NV) return no_stage_constants;
        if (pname == gl::GL_TEXTURE_SHADER_NV) return no_texture_shaders(profile);
        return "expected GL_REGISTER_COMBINERS_NV or GL_PER_STAGE_CONSTANTS_NV, not " + quoted(arguments_[0].text);
    }
  }

  const GlSignature& call_;
  const std::vector<GlArgument>& arguments_;
  std::size_t offset_;
  gl::Context& context_;
  SourceFaults& faults_;
  Converted converted_;
};

}  // namespace

std::optional<GlElement> element_type(std::string_view name) {
  if (name == "GLfloat" || name == "GLclampf" || name == "float") return GlElement::real;
  if (name == "GLint" || name == "int") return GlElement::integer;
  return std::nullopt;
}

void execute_gl_call(const GlSignature& call, std::vector<GlArgument> arguments, std::size_t offset,
                     gl::Context& context, SourceFaults& faults) {
  const std::size_t count = call.parameters.size();
  // Java passes an array and the place of its first number.
  const bool has_place = arguments.size() == count + 1 && call.parameters.back() == 'F' &&
                         arguments[count - 1].is_array && arguments[count].is_integer && arguments[count].integer == 0;
  if (has_place) arguments.pop_back();
  // Bindings with overloads have one name for numbers and arrays.
  const bool overload = call.name == "CombinerParameterNV" && arguments.size() == count && !arguments[1].is_array;
  const auto same = [&](const GlSignature& one) {
    return one.command == (arguments[1].is_integer ? GlCommand::combiner_parameter_i : GlCommand::combiner_parameter_f);
  };
  const std::span<const GlSignature> all = gl_calls();
  Call(overload ? *std::find_if(all.begin(), all.end(), same) : call, arguments, offset, context, faults).execute();
}

}  // namespace ninebit::detail
