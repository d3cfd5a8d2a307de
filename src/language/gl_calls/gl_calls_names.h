// GL's names as text: of values and of the accepted calls.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ninebit/language/gl_nv.h"

namespace ninebit::detail {

// The value of an enumerant or boolean by its C name; empty if the name is unknown. GL_TEXTURE0 to GL_TEXTURE31 and
// GL_COMBINER0_NV to GL_COMBINER7_NV are all accepted: the GL call checks whether the profile has them.
[[nodiscard]] std::optional<gl::GLenum> value_of_name(std::string_view name);

enum class GlCommand {
  combiner_parameter_i,
  combiner_parameter_f,
  combiner_parameter_iv,
  combiner_parameter_fv,
  combiner_input,
  combiner_output,
  final_combiner_input,
  combiner_stage_parameter_fv,
  enable,
  disable
};

// The GL name of a call without its prefix, and its parameters, one letter each: e an enumerant, b a boolean, i an
// integer, f a float, I and F arrays of integers and floats.
struct GlSignature {
  GlCommand command;
  std::string_view name;
  std::string_view parameters;
};

// All calls that are read.
[[nodiscard]] std::span<const GlSignature> gl_calls();

// The names of enumerants of the combiners, for suggestions.
[[nodiscard]] std::vector<std::string_view> gl_names();

// The C name of an enumerator; "0xFFFFFFFF", which GL refuses, for a value that is not an enumerator.
[[nodiscard]] std::string_view gl_name(Register reg);
[[nodiscard]] std::string_view gl_name(InputMapping mapping);
[[nodiscard]] std::string_view gl_name(ComponentUsage usage);
[[nodiscard]] std::string_view gl_name(Scale scale);
[[nodiscard]] std::string_view gl_name(Bias bias);

}  // namespace ninebit::detail
