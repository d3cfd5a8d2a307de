#include "src/language/emit/emit_program.h"

#include <algorithm>
#include <iterator>

#include "ninebit/combiner/portion_walk.h"

namespace ninebit::emit {
namespace {

#define NINEBIT_RULE inline
#include "ninebit/combiner/arithmetic.inl"
#undef NINEBIT_RULE

using Values = std::array<V, 4>;

// Every register component as a value of the graph.
class TextRegisters {
 public:
  V& operator()(Register r, int component) {
    return value_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }
  const V& operator()(Register r, int component) const {
    return value_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }

 private:
  std::array<Values, kRegisterCount> value_{};
};

class Lister {
 public:
  Lister(const Program& program, const InputValue& input, const ConstantValue& constant)
      : program_(program), constant_(constant), d_(program.datapath), live_(live_after_stages(program)) {
    for (const Register r : {Register::fog, Register::primary, Register::secondary, Register::texture0,
                             Register::texture1, Register::texture2, Register::texture3}) {
      for (int c = 0; c < 4; ++c) registers_(r, c) = input(r, c);
    }
    registers_(Register::spare0, kAlpha) = input(Register::spare0, kAlpha);
  }

  Listing run() {
    Listing listing;
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      General domain(*this, i);
      detail::StageSteps<General> steps;
      detail::walk_stage(domain, program_.general[static_cast<std::size_t>(i)], steps);
      for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
        if (auto block = domain.block(name)) listing.blocks.push_back(std::move(*block));
      }
    }
    listing.final_comments = comments_of_final(program_);
    Final domain(*this);
    detail::FinalSteps<Final> steps;
    detail::walk_final(domain, program_, steps);
    for (std::size_t c = 0; c < 4; ++c) {
      listing.result[c] = steps.color[c];
      Graph::name(listing.result[c], std::string("result_") + kComponentLetters[c]);
    }
    return listing;
  }

 private:
  // The value domain of a general combiner (portion_walk.h). Each output's value gets its lines and names before the
  // next output is computed.
  class General {
   public:
    using Input = V;
    using Wide = V;
    using Output = V;

    General(Lister& lister, int stage)
        : lister_(lister),
          number_(stage),
          stage_(lister.program_.general[static_cast<std::size_t>(stage)]),
          live_(lister.live_[static_cast<std::size_t>(stage)]) {}

    V input(const CombinerInput& in, int component) const {
      const V value = lister_.read(in.reg, component, number_, stage_.constant0, stage_.constant1);
      return map_input(lister_.d_, in.mapping, value);
    }
    static V product(const V& x, const V& y) { return mul(x, y); }
    static V sum(const V& x, const V& y) { return add(x, y); }
    void name_dot_product(Variable first, const V& total) const {
      Graph::name(total, "s" + std::to_string(number_) + (first == Variable::a ? "_dot_ab" : "_dot_cd"));
    }
    V mux(const V& ab, const V& cd) const {
      const V& by = lister_.registers_(Register::spare0, kAlpha);
      return emit::mux(lister_.d_, stage_.mux_by_lowest_bit, by, ab, cd);
    }
    V output(const detail::Target& target, const V& wide) {
      std::optional<V> value;
      PortionLines& to_portion = lines_[target.component == kAlpha ? 1 : 0];
      detail::for_each_write(target, [&](Register to, int component) {
        if (!live_.has(to, component)) return;
        if (!value) value = combiner_output(lister_.d_, target.out.scale, target.out.bias, wide);
        const char letter = kComponentLetters[static_cast<std::size_t>(component)];
        const std::string text(short_name_of(to));
        Line line{text + '.' + letter, "s" + std::to_string(number_) + '_' + text + '_' + letter, *value};
        if (Graph::name(*value, line.name)) to_portion.named.push_back(*value);
        to_portion.of_output[target.k].push_back(std::move(line));
      });
      return value.value_or(set(0));
    }
    void write(Register to, int component, const V& value) {
      // A value that is not live is not read before it is written again.
      lister_.registers_(to, component) = live_.has(to, component) ? value : set(0);
    }

    // The lines of a portion after the walk; empty for a portion that writes nothing.
    std::optional<Block> block(PortionName name) {
      if (!is_live((name == PortionName::rgb ? stage_.rgb : stage_.alpha).out)) return std::nullopt;
      PortionLines& lines = lines_[name == PortionName::rgb ? 0 : 1];
      auto& [ab, cd, third] = lines.of_output;
      const LiveOutputs live{!ab.empty(), !cd.empty(), !third.empty()};
      Block result{comments_of(lister_.program_, number_, name, live), {}};
      for (std::vector<Line>& of_output : lines.of_output) {
        std::move(of_output.begin(), of_output.end(), std::back_inserter(result.lines));
      }
      // The walk names values channel by channel. Of the lines that share a value, the first one printed names it.
      for (auto line = result.lines.rbegin(); line != result.lines.rend(); ++line) {
        const bool is_named = std::find(lines.named.begin(), lines.named.end(), line->value) != lines.named.end();
        if (is_named) Graph::rename(line->value, line->name);
      }
      return result;
    }

   private:
    struct PortionLines {
      std::array<std::vector<Line>, 3> of_output{};  // AB, CD, third
      std::vector<V> named{};                        // values that got their names here
    };

    Lister& lister_;
    int number_;
    const ProgramStage& stage_;
    const LiveSet& live_;
    std::array<PortionLines, 2> lines_{};  // RGB, alpha
  };

  // The value domain of the final combiner (final_walk.h).
  class Final {
   public:
    using Input = V;
    using Code = V;
    static constexpr bool kEveryStep = false;

    explicit Final(const Lister& lister) : lister_(lister), d_(lister.d_), program_(lister.program_) {}

    V input(const CombinerInput& in, int component) const {
      return map(in.mapping,
                 lister_.read(in.reg, component, kMaxGeneralCombiners, program_.constant0, program_.constant1));
    }
    V map(InputMapping mapping, const V& value) const { return map_input(d_, mapping, value); }
    V product(const V& e, const V& f) const { return e_times_f(d_, e, f); }
    V sum_part(bool inverted, Register r, int component) const {
      return color_sum_part(d_, inverted, lister_.registers_(r, component));
    }
    V sum(bool clamp, const V& spare0, const V& secondary) const { return color_sum(d_, clamp, spare0, secondary); }
    V rgb(int, const V& a, const V& b, const V& c, const V& d) const { return final_rgb(d_, a, b, c, d); }
    V alpha(const V& g) const { return final_alpha(d_, g); }

   private:
    const Lister& lister_;
    const Datapath& d_;
    const Program& program_;
  };

  // A component as an input of a combiner reads it.
  V read(Register r, int component, int stage, const Rgba9& constant0, const Rgba9& constant1) const {
    if (r == Register::zero) return set(0);
    if (r != Register::constant0 && r != Register::constant1) return registers_(r, component);
    if (constant_) return constant_(r, stage, component);
    return set((r == Register::constant0 ? constant0 : constant1)[static_cast<std::size_t>(component)]);
  }

  const Program& program_;
  const ConstantValue& constant_;
  const Datapath& d_;
  std::vector<LiveSet> live_;
  TextRegisters registers_;
};

bool is_usable_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_rest = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= 200 && is_letter(name.front()) && name.back() != '_' &&
         std::all_of(name.begin(), name.end(), is_rest) && name.find("__") == std::string_view::npos &&
         name.substr(0, 3) != "gl_";
}

}  // namespace

std::string_view short_name_of(Register r) {
  constexpr std::array<std::string_view, kRegisterCount> names{"zero",     "constant0", "constant1", "fog",
                                                               "primary",  "secondary", "spare0",    "spare1",
                                                               "texture0", "texture1",  "texture2",  "texture3"};
  return names[static_cast<std::size_t>(r)];
}

Listing list_program(const Program& program, const InputValue& input, const ConstantValue& constant) {
  return Lister(program, input, constant).run();
}

V any_code(const Program& program, Graph& graph, std::string text) {
  return graph.input(std::move(text), {program.datapath.lowest, program.datapath.one});
}

std::optional<Diagnostic> refusal(const Program& program, std::string_view function) {
  if (program.datapath.arithmetic != Arithmetic::integer) {
    return Diagnostic{.message = "only programs of integer profiles can be emitted as source"};
  }
  // arithmetic.inl assumes that six products of the largest mapped values, and the bias, stay below eight.
  const Datapath& d = program.datapath;
  constexpr std::int64_t kMostOne = 1 << 15;
  const std::int64_t one = d.one, half = d.half, lowest = d.lowest, expand_offset = d.expand_offset;
  const std::int64_t most = std::max({one, -lowest, expand_offset, half});
  const bool usable = one > 0 && one <= kMostOne && lowest <= 0 && half >= 0 && expand_offset >= 0 && most <= 2 * one &&
                      6 * most * most + half * one <= 8 * one * one;
  if (!usable) return Diagnostic{.message = "the profile's codes are out of the datapath's range"};
  return refused_name(function);
}

std::string byte_helper(std::string_view text, NegativeNumber negative, std::string_view size) {
  std::string made(text);
  if (negative != NegativeNumber::size) return made;
  constexpr std::string_view kHead = "(float c) {\n";
  return made.insert(made.find(kHead) + kHead.size(), "  c = " + std::string(size) + ";\n");
}

std::string called_helpers(std::span<const Helper> all, const std::string& function, const std::string& lines) {
  std::string text;
  for (std::size_t i = all.size(); i-- > 0;) {
    const std::string name = function + std::string(all[i].name);
    if (lines.find(name) == std::string::npos && text.find(name) == std::string::npos) continue;
    std::string named;
    for (const char c : all[i].text) c == '$' ? named += function : named += c;
    text = named + text;
  }
  return text;
}

std::optional<Diagnostic> refused_name(std::string_view function) {
  if (is_usable_name(function)) return std::nullopt;
  return Diagnostic{.message = "\"" + std::string(function) +
                               "\" is not a valid function name in GLSL and C; expected a letter, then letters, digits "
                               "and single underscores, not ending in an underscore or starting with gl_"};
}

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

namespace {

LiveSet read_by_final(const Program& program) {
  LiveSet live;
  const FinalCombiner& f = program.final_combiner;
  const auto read = [&](const CombinerInput& in, int channel) {
    if (in.reg < Register::e_times_f) live.add(in.reg, reference::component_of(in.usage, channel));
    if (in.reg == Register::spare0_plus_secondary) {
      live.add(Register::spare0, channel);
      live.add(Register::secondary, channel);
    }
  };
  for (int c = 0; c < 3; ++c) {
    for (const CombinerInput* const in : {&f.a, &f.b, &f.c, &f.d}) {
      read(*in, c);
      if (in->reg != Register::e_times_f) continue;
      read(f.e, c);
      read(f.f, c);
    }
  }
  read(f.g, kAlpha);
  return live;
}

// Adds the components that a portion reads for its outputs that are live afterwards.
void read_by_portion(const Portion& portion, int first, int channels, const LiveSet& after, LiveSet& live) {
  const PortionOutput& out = portion.out;
  const auto read = [&](const CombinerInput& x, const CombinerInput& y, int channel, bool dot) {
    for (int c = dot ? 0 : channel; c < (dot ? channels : channel + 1); ++c) {
      live.add(x.reg, reference::component_of(x.usage, c));
      live.add(y.reg, reference::component_of(y.usage, c));
    }
  };
  for (int c = 0; c < channels; ++c) {
    const auto is_live = [&](std::size_t k) {
      bool any = false;
      detail::for_each_write({out, k, first + c}, [&](Register to, int i) { any = any || after.has(to, i); });
      return any;
    };
    const bool third = is_live(2);
    if (third || is_live(0)) read(portion.a, portion.b, c, out.ab_dot_product);
    if (third || is_live(1)) read(portion.c, portion.d, c, out.cd_dot_product);
    if (third && out.mux_sum) live.add(Register::spare0, kAlpha);
  }
}

void remove_written(const Portion& portion, int first, int channels, LiveSet& live) {
  for (int c = first; c < first + channels; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      detail::for_each_write({portion.out, k, c}, [&](Register to, int component) { live.remove(to, component); });
    }
  }
}

}  // namespace

std::vector<LiveSet> live_after_stages(const Program& program) {
  std::vector<LiveSet> after(static_cast<std::size_t>(program.num_general_combiners));
  LiveSet live = read_by_final(program);
  for (std::size_t i = after.size(); i-- > 0;) {
    const ProgramStage& stage = program.general[i];
    after[i] = live;
    remove_written(stage.rgb, kRed, 3, live);
    remove_written(stage.alpha, kAlpha, 1, live);
    read_by_portion(stage.rgb, kRed, 3, after[i], live);
    read_by_portion(stage.alpha, kAlpha, 1, after[i], live);
  }
  return after;
}

}  // namespace ninebit::emit
