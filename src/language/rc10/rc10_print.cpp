#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/language/rc10.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/gl_nv/gl_nv_access.h"
#include "src/language/rc10/rc10_parser.h"
#include "src/language/source/beyond_opengl.h"
#include "src/system/digits.h"

namespace ninebit {
namespace {

using detail::rc10_one;
using detail::rc10_zero;

// In the order of the enumerators.
constexpr std::array<std::string_view, 15> kRegisterNames{"zero", "const0", "const1",        "fog",       "col0",
                                                          "col1", "spare0", "spare1",        "tex0",      "tex1",
                                                          "tex2", "tex3",   "final_product", "color_sum", "discard"};
struct MappingText {
  std::string_view before, after;
};
constexpr std::array<MappingText, 8> kMappings{MappingText{"unsigned(", ")"},
                                               MappingText{"unsigned_invert(", ")"},
                                               MappingText{"expand(", ")"},
                                               MappingText{"-expand(", ")"},
                                               MappingText{"half_bias(", ")"},
                                               MappingText{"-half_bias(", ")"},
                                               MappingText{"", ""},
                                               MappingText{"-", ""}};

std::string name(Register reg) {
  return std::string(kRegisterNames[static_cast<std::size_t>(reg)]);
}

std::string with_suffix(const CombinerInput& in, ComponentUsage plain) {
  if (in.usage == plain) return name(in.reg);
  return name(in.reg) + (in.usage == ComponentUsage::rgb ? ".rgb" : in.usage == ComponentUsage::alpha ? ".a" : ".b");
}

std::string operand(const CombinerInput& in, ComponentUsage plain) {
  const MappingText& around = kMappings[static_cast<std::size_t>(in.mapping)];
  return std::string(around.before) + with_suffix(in, plain) + std::string(around.after);
}

std::string final_operand(const CombinerInput& in, ComponentUsage plain = ComponentUsage::rgb) {
  const bool invert = in.mapping == InputMapping::unsigned_invert;
  return invert ? "unsigned_invert(" + with_suffix(in, plain) + ")" : with_suffix(in, plain);
}

// The shortest digits without exponent that parse to the same component.
std::string component_text(float component) {
  return plain_digits_of(gl::detail::clamped_color(component));
}

std::string constant(const char* which, const ColorF& color) {
  std::string text = std::string(which) + " = (";
  for (std::size_t i = 0; i < color.size(); ++i) text += (i == 0 ? "" : ", ") + component_text(color[i]);
  return text + ");\n";
}

std::string product(Register to, const CombinerInput& x, const CombinerInput& y, bool dot, ComponentUsage plain) {
  std::string text = "    " + name(to) + " = " + operand(x, plain);
  if (dot || y != rc10_one(plain)) text += (dot ? " . " : " * ") + operand(y, plain);
  return text + ";\n";
}

std::string scale_and_bias(const PortionOutput& out) {
  if (out.bias != Bias::none) {
    return out.scale == Scale::by_two ? "    bias_by_negative_one_half_scale_by_two();\n"
                                      : "    bias_by_negative_one_half();\n";
  }
  switch (out.scale) {
    case Scale::none:
      return {};
    case Scale::by_two:
      return "    scale_by_two();\n";
    case Scale::by_four:
      return "    scale_by_four();\n";
    case Scale::by_one_half:
      return "    scale_by_one_half();\n";
  }
  return {};
}

// The text of a normalized portion; empty for a portion that writes nothing.
std::string portion_text(PortionName which, const Portion& portion) {
  const PortionOutput& out = portion.out;
  if (!is_live(out)) return {};
  const bool rgb = which == PortionName::rgb;
  const ComponentUsage plain = rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
  const bool third = out.sum != Register::discard;
  const bool second = third || out.cd != Register::discard;
  std::string text = rgb ? "  rgb {\n" : "  alpha {\n";
  // A placeholder for an unused first product keeps the second one in its place.
  if (third || out.ab != Register::discard) {
    text += product(out.ab, portion.a, portion.b, out.ab_dot_product, plain);
  } else {
    text += "    discard = zero;\n";
  }
  if (second) text += product(out.cd, portion.c, portion.d, out.cd_dot_product, plain);
  if (third) text += "    " + name(out.sum) + (out.mux_sum ? " = mux();\n" : " = sum();\n");
  return text + scale_and_bias(out) + "  }\n";
}

std::string rgb_text(const FinalCombiner& f) {
  const CombinerInput zero = rc10_zero(ComponentUsage::rgb);
  const auto a = final_operand(f.a), b = final_operand(f.b), c = final_operand(f.c);
  auto d = final_operand(f.d);
  const std::string plus_d = f.d == zero ? "" : " + " + d;
  if (f.c != zero) return "lerp(" + a + ", " + b + ", " + c + ")" + plus_d;
  if (f.a == zero && f.b == zero) return d;
  if (f.b == rc10_one(ComponentUsage::rgb)) return a + " + " + d;
  return a + " * " + b + plus_d;
}

std::string final_text(const Program& program) {
  const FinalCombiner& f = program.final_combiner;
  const auto reads = [&](Register reg) { return f.a.reg == reg || f.b.reg == reg || f.c.reg == reg || f.d.reg == reg; };
  std::string text;
  if (reads(Register::spare0_plus_secondary) && program.color_sum_clamp) text += "clamp_color_sum();\n";
  if (reads(Register::e_times_f)) text += "final_product = " + final_operand(f.e) + " * " + final_operand(f.f) + ";\n";
  text += "out.rgb = " + rgb_text(f) + ";\n";
  return text + "out.a = " + final_operand(f.g, ComponentUsage::alpha) + ";\n";
}

// The features of a valid program that the language cannot express; empty: none.
std::string inexpressible(const Program& program) {
  const std::string_view no_words = "!!RC1.0 cannot express this: ";
  if (const std::string beyond = beyond_opengl(program); !beyond.empty()) return std::string(no_words) + beyond;
  std::string places;
  for (std::size_t i = 0; i < program.general.size(); ++i) {
    const PortionOutput& out = program.general[i].rgb.out;
    const bool dot = out.ab_dot_product || out.cd_dot_product;
    if (out.sum == Register::discard || !dot) continue;
    places += std::string(places.empty() ? "" : "; ") + "general combiner " + std::to_string(i) +
              ", RGB portion: " + (out.mux_sum ? "mux()" : "sum()") + " beside a dot product";
  }
  return places.empty() ? places : std::string(no_words) + places;
}

class Printer {
 public:
  Printer(const CombinerState& state, const Program& program) : state_(state), program_(program) {}

  std::string print() const {
    std::string text = "!!RC1.0\n";
    // A constant before the general combiners would set theirs, too.
    const bool leaves_own = leaves_own_constants();
    if (!leaves_own) text += global_constants();
    for (std::size_t i = 0; i < stages(); ++i) text += stage_text(i);
    if (leaves_own) text += needs_marker() ? marker() : global_constants();
    return text + final_text(program_);
  }

  // Whether no constant that is set makes constants the general combiners' own.
  [[nodiscard]] bool needs_marker() const {
    bool is_own = !leaves_own_constants() || !global_constants().empty();
    for (std::size_t i = 0; i < stages(); ++i) is_own = is_own || !own_constants(i).empty();
    return !is_own;
  }

  // Then one of the final combiner does that it does not read. Empty: it reads both.
  [[nodiscard]] std::string marker() const {
    if (!detail::final_reads(program_.final_combiner, Register::constant0)) return constant("const0", {});
    return detail::final_reads(program_.final_combiner, Register::constant1) ? "" : constant("const1", {});
  }

 private:
  [[nodiscard]] std::size_t stages() const { return static_cast<std::size_t>(program_.num_general_combiners); }

  // Whether a general combiner reads a constant of its own that nobody set.
  [[nodiscard]] bool leaves_own_constants() const {
    return state_.per_stage_constants &&
           std::any_of(program_.general.begin(), program_.general.end(),
                       [](const ProgramStage& stage) { return stage.unset[0] || stage.unset[1]; });
  }

  [[nodiscard]] std::string own_constants(std::size_t i) const {
    const ProgramStage& stage = program_.general[i];
    std::string text;
    if (state_.per_stage_constants && detail::stage_reads(stage, Register::constant0) && !stage.unset[0]) {
      text += "  " + constant("const0", state_.general[i].constant0);
    }
    if (state_.per_stage_constants && detail::stage_reads(stage, Register::constant1) && !stage.unset[1]) {
      text += "  " + constant("const1", state_.general[i].constant1);
    }
    return text;
  }

  [[nodiscard]] std::string global_constants() const {
    std::string text;
    if (reads_globally(Register::constant0) && !is_shared_constant_unset(state_, 0))
      text += constant("const0", state_.constant0);
    if (reads_globally(Register::constant1) && !is_shared_constant_unset(state_, 1))
      text += constant("const1", state_.constant1);
    return text;
  }

  [[nodiscard]] bool reads_globally(Register reg) const {
    bool reads = detail::final_reads(program_.final_combiner, reg);
    for (std::size_t i = 0; i < stages() && !state_.per_stage_constants; ++i) {
      reads = reads || detail::stage_reads(program_.general[i], reg);
    }
    return reads;
  }

  [[nodiscard]] std::string stage_text(std::size_t i) const {
    const ProgramStage& stage = program_.general[i];
    const std::string text = "{\n" + own_constants(i);
    std::string portions = portion_text(PortionName::rgb, stage.rgb) + portion_text(PortionName::alpha, stage.alpha);
    if (portions.empty()) portions = "  rgb {\n    discard = zero;\n  }\n";
    return text + portions + "}\n";
  }

  const CombinerState& state_;
  const Program& program_;
};

}  // namespace

Result<std::string> print_rc10(const CombinerState& state, const HardwareProfile& profile,
                               const TextureShaderState& texture_shader) {
  if (const auto refused = validate(texture_shader, profile); !refused.empty()) {
    return Diagnostic{.message = refused.front().message};
  }
  const Result<std::string> stages = texture_shader.enabled ? detail::print_ts10(texture_shader) : std::string();
  if (!stages) return stages;
  const Result<Program> program = compile(state, profile);
  if (!program) return program.error();
  if (std::string why = inexpressible(*program); !why.empty()) return Diagnostic{.message = std::move(why)};
  const Printer printer(state, *program);
  if (printer.needs_marker() && printer.marker().empty()) {
    return Diagnostic{.message =
                          "!!RC1.0 cannot express this: constants of general combiners' own, none of which is set"};
  }
  return *stages + printer.print();
}

}  // namespace ninebit
