#include "combiner_tests/fuzz/common.h"

#include <algorithm>
#include <tuple>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit::fuzz {
namespace {

// The first fault of a text that should have none.
std::string refused(const char* form, const Parsed<CombinerState>& parsed, const std::string& text) {
  return std::string(form) + " that ninebit printed are refused: " + parsed.faults().front().text() + "\n" + text;
}

// The state without what the profile has no place for.
CombinerState held_by(const HardwareProfile& profile, CombinerState state) {
  for (std::size_t i = 0; i < state.general.size(); ++i) {
    GeneralCombiner& stage = state.general[i];
    if (static_cast<int>(i) >= profile.general_combiners) stage = {};
    if (!profile.per_stage_constants) stage.constant0 = stage.constant1 = {};
    // Features that OpenGL does not have are printed only where they have no effect.
    stage.rgb.out.ab_blue_to_alpha = stage.rgb.out.cd_blue_to_alpha = false;
  }
  state.mux_by_lowest_bit = state.color_sum_invert_spare0 = state.color_sum_invert_secondary = false;
  return state;
}

std::string wrong_with_gl_calls(const CombinerState& state, const HardwareProfile& profile) {
  const auto text = print_gl_calls(state, profile);
  if (!text) return wrong_with_message(text.error().message);
  const auto back = parse_gl_calls({*text, kFile}, profile);
  if (!back) return refused("GL calls", back, *text);
  if (*back != held_by(profile, state)) return "GL calls give another state:\n" + *text;
  const auto again = print_gl_calls(*back, profile);
  return again && *again == *text ? "" : "GL calls are printed in another way again:\n" + *text;
}

std::string wrong_with_rc10(const CombinerState& state, const Program& program, const HardwareProfile& profile) {
  const auto text = print_rc10(state, profile);
  if (!text) return wrong_with_message(text.error().message);
  const auto back = parse_rc10({*text, kFile}, profile);
  if (!back) return refused("!!RC1.0 words", back, *text);
  if (normalize(*back, profile) != program) return "!!RC1.0 gives another program:\n" + *text;
  const auto again = print_rc10(*back, profile);
  return again && *again == *text ? "" : "!!RC1.0 is printed in another way again:\n" + *text;
}

// A text need not give the same program, but it must give the same one again.
std::string wrong_with_ps(const CombinerState& state, const HardwareProfile& profile) {
  const auto text = print_pixel_shader(state, profile);
  if (!text) return wrong_with_message(text.error().message);
  const auto back = parse_pixel_shader({*text, kFile}, profile);
  if (!back) return refused("ps.1.1 texts", back, *text);
  const auto again = print_pixel_shader(*back, profile);
  if (!again) return "a ps.1.1 text is not printed again: " + again.error().message + "\n" + *text;
  const auto third = parse_pixel_shader({*again, kFile}, profile);
  if (!third) return refused("ps.1.1 texts", third, *again);
  const bool same = normalize(*third, profile) == normalize(*back, profile);
  return same ? "" : "ps.1.1 gives another program:\n" + *text + *again;
}

std::string wrong_with_words(const CombinerState& state, const Program& program, ChipClass chip,
                             const HardwareProfile& profile) {
  const auto text = print_register_words(state, chip, profile);
  if (!text) return wrong_with_message(text.error().message);
  const auto back = parse_register_words({*text, kFile}, chip, profile);
  if (!back) return refused("register words", back, *text);
  if (normalize(*back, profile) != program) return "register words give another program:\n" + *text;
  const auto again = print_register_words(*back, chip, profile);
  return again && *again == *text ? "" : "register words are printed in another way again:\n" + *text;
}

// The sanitizers judge what these compute; here they must only answer.
std::string wrong_with_outputs(const Program& program, const HardwareProfile& profile) {
  if (print_explanation(explain(program, profile)).empty()) return "the explanation is empty";
  if (const auto c = emit_c(program); !c) return "no C: " + c.error().message;
  if (const auto glsl = emit_glsl(program, GlslVersion::es_300); !glsl) return "no GLSL: " + glsl.error().message;
  return {};
}

}  // namespace

std::string wrong_with_message(std::string_view message) {
  constexpr std::size_t kLongest = 2000;
  if (message.empty()) return "a fault has no message";
  if (message.size() > kLongest) return "a message has " + std::to_string(message.size()) + " bytes";
  const auto control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
  return std::any_of(message.begin(), message.end(), control) ? "a message has control characters" : "";
}

std::string wrong_with_place(TextPlace place, std::string_view text) {
  const std::string where = std::to_string(place.line) + ":" + std::to_string(place.column);
  for (int line = 1; line < place.line; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return "the place " + where + " is below the text";
    text.remove_prefix(end + 1);
  }
  const std::size_t width = std::min(text.find('\n'), text.size());
  const bool within =
      place.line >= 1 && place.column >= 1 && static_cast<std::size_t>(place.column) <= width + 1;  // 1: the end
  return within ? "" : "the place " + where + " is not in the text";
}

std::string wrong_with_faults(const std::vector<TextFault>& faults, std::string_view text) {
  if (faults.empty()) return "neither a value nor a fault";
  if (faults.size() > kMaxTextFaults) return std::to_string(faults.size()) + " faults";
  const TextFault* before = nullptr;
  for (const TextFault& fault : faults) {
    std::string wrong = first_of(wrong_with_message(fault.message), [&] {
      return wrong_with_place({fault.line, fault.column}, text);
    });
    if (!wrong.empty()) return wrong + ": " + fault.message;
    if (fault.file != kFile) return "a fault is in the file '" + fault.file + "'";
    const bool sorted =
        before == nullptr || std::tie(before->line, before->column) <= std::tie(fault.line, fault.column);
    if (!sorted) return "not in the order of the text: " + fault.text();
    before = &fault;
  }
  return {};
}

std::string wrong_with_state(const CombinerState& read, const HardwareProfile& profile) {
  // Only pixel shaders have names of their own for constants.
  CombinerState state = read;
  for (auto& place : state.origin) {
    for (ConstantOrigin& origin : place) origin.name.reset();
  }
  if (const auto found = validate(state, profile); !found.empty()) return "GL refuses it: " + found.front().message;
  const auto program = compile(state, profile);
  if (!program) return "it does not compile: " + program.error().message;
  if (*program != normalize(state, profile)) return "compile() and normalize() give different programs";
  return first_of(
      wrong_with_gl_calls(state, profile), [&] { return wrong_with_rc10(state, *program, profile); },
      [&] { return wrong_with_ps(state, profile); },
      [&] { return wrong_with_words(state, *program, ChipClass::nv10, profile); },
      [&] { return wrong_with_words(state, *program, ChipClass::nv20, profile); },
      [&] { return wrong_with_outputs(*program, profile); });
}

std::string wrong_with_stages(const TextureShaderState& stages, const HardwareProfile& profile) {
  if (!stages.enabled) return {};
  if (const auto found = validate(stages, profile); !found.empty()) return "GL refuses stages: " + found[0].message;
  (void)print_stages(stages);
  TextureShaderState expected = only_used(stages), back;
  expected.rules = StageRules::open_gl;
  if (const auto text = print_gl_calls({}, profile, stages)) {
    if (const auto parsed = parse_gl_calls({*text, kFile}, profile, &back); !parsed) {
      return refused("GL calls", parsed, *text);
    }
    if (back != expected) return "GL calls give other stages:\n" + *text;
  }
  if (const auto text = print_rc10({}, profile, stages)) {
    if (const auto parsed = parse_rc10({*text, kFile}, profile, &back); !parsed)
      return refused("!!TS1.0", parsed, *text);
    if (back != expected) return "!!TS1.0 gives other stages:\n" + *text;
  }
  return {};
}

}  // namespace ninebit::fuzz
