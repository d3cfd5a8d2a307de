#include "src/language/emit/emit_program.h"

#include <algorithm>
#include <iterator>

#include "ninebit/combiner/portion_walk.h"
#include "src/language/emit/emit_comments.h"
#include "src/language/emit/emit_liveness.h"

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
  if (!is_usable_name(function)) {
    return Diagnostic{.message = "\"" + std::string(function) +
                                 "\" is not a valid function name in GLSL and C; expected a letter, then letters, "
                                 "digits and single underscores, not ending in an underscore or starting with gl_"};
  }
  return std::nullopt;
}

}  // namespace ninebit::emit
