// A program as a function a general combiner, in vectors of red, green and blue.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/portion_walk.h"
#include "ninebit/language/glsl.h"
#include "src/language/emit/emit_printer.h"

namespace ninebit::emit::pixel {
namespace {

#define NINEBIT_RULE inline
#include "ninebit/combiner/arithmetic.inl"
#undef NINEBIT_RULE

// The words in which the languages differ.
struct Words {
  std::string_view head;         // the first lines
  std::string_view int3, int4;   // types
  std::string_view splat;        // a number as a vector: what stands before it
  std::string_view open, close;  // around the array of constants
};

Words words_of(PixelLanguage language) {
  const auto glsl = [](std::string_view head) { return Words{head, "ivec3", "ivec4", "ivec3(", "uniform ivec4 ", ""}; };
  switch (language) {
    case PixelLanguage::glsl_130:
      return glsl("#version 130\n");
    case PixelLanguage::glsl_330:
      return glsl("#version 330 core\n");
    case PixelLanguage::glsl_450:
      return glsl("#version 450 core\n");
    case PixelLanguage::es_300:
      return glsl("#version 300 es\nprecision highp int;\n");
    case PixelLanguage::hlsl:
      break;
  }
  return {"// Shader model 4 and later.\n", "int3", "int4", "(int3)(", "cbuffer NAME_of_program {\n  int4 ", "}\n"};
}

// What is known of the registers between two stages.
struct Known {
  std::array<Interval, kRegisterCount> rgb{}, alpha{};
  Interval& of(Register r, bool is_alpha) { return (is_alpha ? alpha : rgb)[static_cast<std::size_t>(r)]; }
};

// One function: values of registers as the function begins, and what it writes.
class Function {
 public:
  Function(const Program& program, const Known& known, const std::string& name, int stage)
      : program_(program), d_(program.datapath), known_(known), name_(name), stage_(stage) {}
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  // The part of a register, or of a constant, that an input reads.
  V read(const CombinerInput& in, bool is_alpha_channel) {
    const bool alpha = in.usage == ComponentUsage::alpha, blue = in.usage == ComponentUsage::blue || is_alpha_channel;
    const std::string part = alpha ? ".a" : blue ? ".b" : ".rgb";
    if (in.reg == Register::zero) return set(0);
    if (in.reg == Register::constant0 || in.reg == Register::constant1) {
      const int element = 2 * stage_ + (in.reg == Register::constant1 ? 1 : 0);
      return graph_.input(name_ + "_constants[" + std::to_string(element) + ']' + part, {0, d_.one}, part == ".rgb");
    }
    return of_register(in.reg, part);
  }
  V of_register(Register r, const std::string& part) {
    const Interval range = known_.of(r, part == ".a");
    if (range.low == range.high) return set(static_cast<int>(range.low));
    return graph_.input("r." + std::string(short_name_of(r)) + part, range, part == ".rgb");
  }

  Graph& graph() { return graph_; }
  const Program& program_;
  const Datapath& d_;

 private:
  Known known_;
  const std::string& name_;
  int stage_;
  Graph graph_;
};

// The value domain of a general combiner (portion_walk.h). The walk visits red, green and blue, which get the same
// values here: vectors of all three.
class General {
 public:
  using Input = V;
  using Wide = V;
  using Output = V;

  General(Function& function, const ProgramStage& stage, const LiveSet& live)
      : function_(function), stage_(stage), live_(live) {}

  V input(const CombinerInput& in, int) {
    return map_input(function_.d_, in.mapping, function_.read(in, in.usage == ComponentUsage::blue));
  }
  V product(const V& x, const V& y) {
    last_ = mul(x, y);
    return last_;
  }
  static V sum(const V& x, const V& y) { return add(x, y); }
  // The walk has added a product three times.
  void name_dot_product(Variable, V& total) const { total = sum_of_components(last_); }
  V mux(const V& ab, const V& cd) {
    const V by = function_.of_register(Register::spare0, ".a");
    return pixel::mux(function_.d_, stage_.mux_by_lowest_bit, by, ab, cd);
  }
  V output(const detail::Target& target, const V& wide) const {
    const Register to = detail::register_of(target.out, target.k);
    bool is_live = live_.has(to, target.component);
    for (int c = 0; c < 3 && target.component != kAlpha; ++c) is_live = is_live || live_.has(to, c);
    const bool copies = detail::copies_to_alpha(target.out, target.k, kBlue) && target.component != kAlpha;
    if (!is_live && !(copies && live_.has(to, kAlpha))) return set(0);
    return combiner_output(function_.d_, target.out.scale, target.out.bias, wide);
  }
  void write(Register to, int component, const V& value) {
    if (!live_.has(to, component)) return;
    // Blue that goes to alpha is written in blue's turn.
    Written one{to, component == kAlpha, value};
    for (const Written& before : written) {
      if (before.to == to && before.alpha == one.alpha) return;
    }
    written.push_back(std::move(one));
  }

  struct Written {
    Register to;
    bool alpha;
    V value;
  };
  std::vector<Written> written;  // an RGB register once

 private:
  Function& function_;
  const ProgramStage& stage_;
  const LiveSet& live_;
  V last_{};
};

// The value domain of the final combiner (final_walk.h), in vectors as well.
class Final {
 public:
  using Input = V;
  using Code = V;
  static constexpr bool kEveryStep = false;

  explicit Final(Function& function) : function_(function), d_(function.d_) {}

  V input(const CombinerInput& in, int) { return map(in.mapping, function_.read(in, false)); }
  V map(InputMapping mapping, const V& value) const { return map_input(d_, mapping, value); }
  V product(const V& e, const V& f) const { return e_times_f(d_, e, f); }
  V sum_part(bool inverted, Register r, int) { return color_sum_part(d_, inverted, function_.of_register(r, ".rgb")); }
  V sum(bool clamp, const V& spare0, const V& secondary) const { return color_sum(d_, clamp, spare0, secondary); }
  V rgb(int, const V& a, const V& b, const V& c, const V& d) const { return final_rgb(d_, a, b, c, d); }
  V alpha(const V& g) const { return final_alpha(d_, g); }

 private:
  Function& function_;
  const Datapath& d_;
};

constexpr std::array kHeld{Register::fog,      Register::primary,  Register::secondary,
                           Register::spare0,   Register::spare1,   Register::texture0,
                           Register::texture1, Register::texture2, Register::texture3};

class Writer {
 public:
  Writer(const Program& program, PixelLanguage language, std::string_view function)
      : program_(program), words_(words_of(language)), language_(language), name_(function) {
    dialect_ = {"int", "min", "max", "clamp", "abs", name_ + "_with_sign"};
    dialect_.vector_type = words_.int3;
    dialect_.splat_open = words_.splat;
    dialect_.sum_of_components = name_ + "_sum";
    for (const Register r : kHeld) {
      known_.of(r, false) = known_.of(r, true) = {program.datapath.lowest, program.datapath.one};
    }
    known_.of(Register::spare0, false) = known_.of(Register::spare1, false) = known_.of(Register::spare1, true) = {};
  }

  Result<std::string> text() {
    std::string functions;
    const std::vector<LiveSet> live = live_after_stages(program_);
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      functions += stage_text(i, live[static_cast<std::size_t>(i)]);
    }
    functions += final_text();
    if (wrong_) return *wrong_;
    return head() + helpers() + functions + whole_text();
  }

 private:
  std::string stage_text(int i, const LiveSet& live) {
    const ProgramStage& stage = program_.general[static_cast<std::size_t>(i)];
    Function function(program_, known_, name_, i);
    General domain(function, stage, live);
    detail::StageSteps<General> steps;
    detail::walk_stage(domain, stage, steps);
    if (domain.written.empty()) return {};
    std::vector<V> values;
    for (const General::Written& one : domain.written) values.push_back(one.value);
    Printer printer(function.graph(), values, dialect_);
    comments(printer, i, domain.written);
    std::string writes;
    const bool reads_itself = domain.written.size() > 1;
    for (const General::Written& one : domain.written) {
      const std::string target(short_name_of(one.to)), part = one.alpha ? "a" : "rgb";
      const bool is_blue = one.alpha && one.value.is_vector();
      printer.prepare(one.value, target + '_' + part);
      std::string value = one.alpha ? printer.whole(one.value) : printer.vector(one.value);
      if (is_blue) value = printer.atom(one.value) + ".b";
      if (reads_itself) {
        const std::string type(one.alpha ? "int" : words_.int3);
        printer.statement(type + " new_" + target + '_' + part + " = " + value);
        value = "new_" + target + '_' + part;
      }
      writes += "  r." + target + '.' + part + " = " + value + ";\n";
      known_.of(one.to, one.alpha) = one.value.range();
    }
    finish(printer, function.graph());
    stages_.push_back(i);
    return "\nvoid " + name_ + "_stage" + std::to_string(i) + "(inout " + name_ + "_registers r) {\n" + printer.out() +
           writes + "}\n";
  }

  void comments(Printer& printer, int i, const std::vector<General::Written>& written) const {
    const ProgramStage& stage = program_.general[static_cast<std::size_t>(i)];
    for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
      const PortionOutput& out = (name == PortionName::rgb ? stage.rgb : stage.alpha).out;
      const auto is_written = [&](Register r) {
        return r != Register::discard && std::any_of(written.begin(), written.end(), [&](const auto& one) {
                 return one.to == r && one.alpha == (name == PortionName::alpha);
               });
      };
      const LiveOutputs live{is_written(out.ab), is_written(out.cd), is_written(out.sum)};
      if (!live.any()) continue;
      for (const std::string& line : comments_of(program_, i, name, live)) printer.comment(line);
    }
  }

  std::string final_text() {
    Function function(program_, known_, name_, kMaxGeneralCombiners);
    Final domain(function);
    detail::FinalSteps<Final> steps;
    detail::walk_final(domain, program_, steps);
    const V rgb = steps.color[0], alpha = steps.color[kAlpha];
    Printer printer(function.graph(), {rgb, alpha}, dialect_);
    for (const std::string& line : comments_of_final(program_)) printer.comment(line);
    printer.prepare(rgb, "rgb");
    printer.prepare(alpha, "a");
    printer.statement("return " + std::string(words_.int4) + '(' + printer.vector(rgb) + ", " + printer.whole(alpha) +
                      ')');
    finish(printer, function.graph());
    return "\n" + std::string(words_.int4) + ' ' + name_ + "_final(" + name_ + "_registers r) {\n" + printer.out() +
           "}\n";
  }

  void finish(const Printer& printer, const Graph& graph) {
    called_.insert(printer.called().begin(), printer.called().end());
    range_ = {std::min(range_.low, printer.range().low), std::max(range_.high, printer.range().high)};
    if (auto fault = refusal(printer, graph); fault && !wrong_) wrong_ = std::move(fault);
  }

  std::string head() const {
    const std::string four(words_.int4);
    std::string open(words_.open);
    if (language_ == PixelLanguage::hlsl) open.replace(open.find("NAME"), 4, name_);
    std::string out(words_.head);
    out += '\n' + codes_comment(program_.datapath) + ". Every value lies in [" + std::to_string(range_.low) + ", " +
           std::to_string(range_.high) + "]; only numbers that are not negative are divided.\n";
    out +=
        "\n// The codes of constants: elements 2 i and 2 i + 1 are constant 0 and 1 of general combiner i, the last "
        "two\n"
        "// those of the final combiner.\n" +
        open + name_ + "_constants[" + std::to_string(kGlslConstants) + "];\n" + std::string(words_.close);
    out += "\nstruct " + name_ + "_registers {\n";
    for (const Register r : kHeld) out += "  " + four + ' ' + std::string(short_name_of(r)) + ";\n";
    return out + "};\n";
  }

  std::string helpers() const {
    std::string out;
    const std::string three(words_.int3);
    if (called_.count(dialect_.with_sign) != 0) {
      out += "\nint " + dialect_.with_sign + "(int n, int magnitude) {\n  return n < 0 ? -magnitude : magnitude;\n}\n";
      out += three + ' ' + dialect_.with_sign + '(' + three + " n, " + three +
             " magnitude) {\n  return magnitude * (1 - 2 * " +
             (language_ == PixelLanguage::hlsl ? "(int3)(n < 0)" : "ivec3(lessThan(n, ivec3(0)))") + ");\n}\n";
    }
    if (called_.count(dialect_.sum_of_components) != 0) {
      out += "\nint " + dialect_.sum_of_components + '(' + three + " v) {\n  return v.r + v.g + v.b;\n}\n";
    }
    return out;
  }

  std::string whole_text() const {
    const std::string four(words_.int4), indent(four.size() + name_.size() + 2, ' ');
    std::string out = "\n" + four + ' ' + name_ + "(" + four + " primary, " + four + " secondary, " + four + " fog, " +
                      four + " texture0, " + four + " texture1,\n" + indent + four + " texture2, " + four +
                      " texture3, int spare0_alpha) {\n  " + name_ + "_registers r;\n";
    for (const Register r : kHeld) {
      const std::string field(short_name_of(r));
      const std::string value = r == Register::spare0   ? four + "(0, 0, 0, spare0_alpha)"
                                : r == Register::spare1 ? four + "(0, 0, 0, 0)"
                                                        : field;
      out += "  r." + field + " = " + value + ";\n";
    }
    for (const int i : stages_) out += "  " + name_ + "_stage" + std::to_string(i) + "(r);\n";
    return out + "  return " + name_ + "_final(r);\n}\n";
  }

  const Program& program_;
  Words words_;
  PixelLanguage language_;
  std::string name_;
  Dialect dialect_;
  Known known_;
  std::vector<int> stages_;
  std::set<std::string> called_;
  Interval range_;
  std::optional<Diagnostic> wrong_;
};

}  // namespace
}  // namespace ninebit::emit::pixel

namespace ninebit {

Result<std::string> emit_pixel_shader(const Program& program, PixelLanguage language, std::string_view function) {
  if (auto fault = emit::refusal(program, function)) return *fault;
  return emit::pixel::Writer(program, language, function).text();
}

}  // namespace ninebit
