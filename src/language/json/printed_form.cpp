#include "src/language/json/printed_form.h"

#include "ninebit/combiner/program.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit {

Result<std::string> print_in_form(std::string_view form, const TextProgram& program, ChipClass chip,
                                  const HardwareProfile& profile) {
  const CombinerState& state = program.state;
  if (form == "gl") return print_gl_calls(state, profile);
  if (form == "rc10") return print_rc10(state, profile);
  if (form == "ps11") return print_pixel_shader(state, profile);
  if (form == "words") return print_register_words(state, chip, profile, program.other_words);
  if (form == "words-json") return print_json_register_words(state, chip, profile, program.other_words);
  if (form == "json") return print_json_program(state, program.other_words);
  if (form == "xbox") return print_xbox_pixel_shader(state, profile, program.other_words);
  const Program normal = normalize(state, profile);
  if (form == "c") return emit_c(normal);
  return emit_glsl(normal, form == "glsl-es" ? GlslVersion::es_300 : GlslVersion::glsl_330);
}

}  // namespace ninebit
