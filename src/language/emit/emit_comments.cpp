#include "src/language/emit/emit_comments.h"

#include "ninebit/combiner/portion_walk.h"
#include "src/language/emit/emit_program.h"

namespace ninebit::emit {
namespace {

std::string text_of(char variable, const CombinerInput& in) {
  return std::string(1, variable) + " = " + std::string(name_of(in.mapping)) + "(" + std::string(name_of(in.reg)) +
         "." + std::string(name_of(in.usage)) + ")";
}

std::string pair_of(char first, const CombinerInput& x, char second, const CombinerInput& y) {
  return "  " + text_of(first, x) + ", " + text_of(second, y);
}

std::string output_text(const PortionOutput& out, const std::string& wide, bool is_sum) {
  const bool bias = out.bias == Bias::by_negative_one_half;
  std::string text = is_sum && (bias || out.scale != Scale::none) ? "(" + wide + ")" : wide;
  if (bias) text += " - half";
  if (bias && out.scale != Scale::none) text = "(" + text + ")";
  if (out.scale == Scale::by_two) text += " * 2";
  if (out.scale == Scale::by_four) text += " * 4";
  if (out.scale == Scale::by_one_half) text += " / 2";
  return text;
}

}  // namespace

std::vector<std::string> comments_of(const Program& program, int stage, PortionName name, const LiveOutputs& live) {
  const ProgramStage& from = program.general[static_cast<std::size_t>(stage)];
  const Portion& portion = name == PortionName::rgb ? from.rgb : from.alpha;
  const PortionOutput& out = portion.out;
  const std::string component = name == PortionName::rgb ? ".rgb" : ".alpha";
  std::vector<std::string> lines{"General combiner " + std::to_string(stage) +
                                 (name == PortionName::rgb ? ", RGB portion" : ", alpha portion")};
  if (!live.any()) {
    lines[0] += ": none of its outputs is read.";
    return lines;
  }
  if (live.ab || live.sum) lines.push_back(pair_of('A', portion.a, 'B', portion.b));
  if (live.cd || live.sum) lines.push_back(pair_of('C', portion.c, 'D', portion.d));
  const std::string ab = out.ab_dot_product ? "dot(A, B)" : "A*B", cd = out.cd_dot_product ? "dot(C, D)" : "C*D";
  const std::string condition = from.mux_by_lowest_bit ? "spare0.alpha is odd" : "spare0.alpha >= half";
  const std::string third = out.mux_sum ? condition + " ? " + cd + " : " + ab : ab + " + " + cd;
  const auto equation = [&](bool is_live, Register to, const std::string& wide, bool is_sum) {
    if (!is_live) return;
    lines.push_back("  " + std::string(name_of(to)) + component + " = " + output_text(out, wide, is_sum));
  };
  const auto blue = [&](bool is_live, std::size_t k) {
    if (!is_live || name != PortionName::rgb) return;
    detail::for_each_write({out, k, kBlue}, [&](Register to, int i) {
      if (i == kAlpha) lines.push_back("  " + std::string(name_of(to)) + ".alpha = that blue");
    });
  };
  equation(live.ab, out.ab, ab, false);
  blue(live.ab, 0);
  equation(live.cd, out.cd, cd, false);
  blue(live.cd, 1);
  equation(live.sum, out.sum, third, true);
  return lines;
}

std::vector<std::string> comments_of_final(const Program& program) {
  const FinalCombiner& f = program.final_combiner;
  std::vector<std::string> lines{"Final combiner", pair_of('A', f.a, 'B', f.b), pair_of('C', f.c, 'D', f.d)};
  if (detail::reads_directly(f, Register::e_times_f)) lines.push_back(pair_of('E', f.e, 'F', f.f));
  if (detail::reads_directly(f, Register::spare0_plus_secondary)) {
    const bool invert0 = program.color_sum_invert_spare0, invert1 = program.color_sum_invert_secondary;
    const std::string sum = std::string(invert0 ? "(1 - spare0)" : "spare0") + " + " +
                            (invert1 ? "(1 - secondary_color)" : "secondary_color");
    lines.push_back("  spare0_plus_secondary_color is " + (invert0 || invert1 ? sum + ", " : "") +
                    (program.color_sum_clamp ? "at most one" : "not clamped"));
  }
  lines.push_back("  " + text_of('G', f.g));
  lines.push_back("  result.rgb = A*B + (1 - A)*C + D, result.alpha = G");
  return lines;
}

}  // namespace ninebit::emit
