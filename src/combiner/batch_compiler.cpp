#include "src/combiner/batch_compiler.h"

#include <algorithm>
#include <array>
#include <optional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/portion_walk.h"
#include "src/combiner/wide_sum.h"

namespace ninebit::detail {
namespace {

std::size_t at(int component) {
  return static_cast<std::size_t>(component);
}

// Follows a program symbolically: each register component holds a value of the graph.
class Compiler {
 public:
  Compiler(const Program& program, const ComponentSet& varying_constants, BatchInputs inputs)
      : program_(program), varying_constants_(varying_constants), graph_(program.datapath, inputs) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) registers_[r][at(c)] = graph_.input(static_cast<Register>(r), c);
    }
  }

  VectorCode compile(const BatchOutputs& outputs) {
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      const ProgramStage& stage = program_.general[at(i)];
      General domain(*this, stage);
      StageSteps<General> steps;
      walk_stage(domain, stage, steps);
    }
    std::vector<WantedValue> wanted;
    for (int c = 0; c < 4; ++c) {
      if (!outputs.color[at(c)]) continue;
      wanted.push_back({{Space::colors, static_cast<std::uint16_t>(c)}, c == kAlpha ? final_alpha() : final_rgb(c)});
    }
    for (std::size_t r = 0; outputs.registers && r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) {
        const Value value = registers_[r][at(c)];
        if (value == graph_.input(static_cast<Register>(r), c)) continue;
        wanted.push_back({{Space::registers, static_cast<std::uint16_t>(4 * r + at(c))}, value});
      }
    }
    return schedule(graph_, wanted);
  }

 private:
  using Registers = std::array<std::array<Value, 4>, kRegisterCount>;

  // The value domain of a general combiner (portion_walk.h).
  class General {
   public:
    using Input = Linear;
    // A sum of products or, with `or_cd`, a mux's AB and CD: output() decides where to choose.
    struct Wide {
      WideSum sum;
      std::optional<WideSum> or_cd{};
    };
    using Output = Value;

    General(Compiler& compiler, const ProgramStage& stage) : compiler_(compiler), stage_(stage) {}

    Linear input(const CombinerInput& in, int component) {
      return compiler_.mapped(compiler_.read(in.reg, component, stage_.constant0, stage_.constant1), in.mapping);
    }
    static Wide product(const Linear& x, const Linear& y) {
      Wide result;
      result.sum.add(x, y);
      return result;
    }
    static Wide sum(const Wide& x, const Wide& y) {
      Wide result{x.sum};
      result.sum.add(y.sum);
      return result;
    }
    static Wide mux(const Wide& ab, const Wide& cd) { return {ab.sum, cd.sum}; }
    Value output(const Target& target, const Wide& wide) {
      const PortionOutput& out = target.out;
      return wide.or_cd ? compiler_.mux(wide.sum, *wide.or_cd, out, stage_.mux_by_lowest_bit)
                        : combiner_output(compiler_.graph_, wide.sum, out.scale, out.bias);
    }
    void write(Register to, int component, Value value) {
      compiler_.registers_[static_cast<std::size_t>(to)][at(component)] = value;
    }

   private:
    Compiler& compiler_;
    const ProgramStage& stage_;
  };

  // A mapping consists of at most two straight lines, which meet at zero or, for values above one, at one. They are
  // read off the reference.
  Linear mapped(Value value, InputMapping mapping) {
    const Datapath& d = program_.datapath;
    const auto rule = [&](int v) { return reference::map_input(d, mapping, v); };
    Range r = graph_.range(value);
    Linear linear{.value = value, .floored = rule(-1) == rule(0), .factor = rule(1) - rule(0), .offset = rule(0)};
    if (r.high > d.one && rule(r.high) != linear.factor * r.high + linear.offset) {
      const Linear itself{value, false, 1, 0};
      linear.value = graph_.affine({&itself, 1}, Scale::none, d.final_narrowing, r.low, d.one);
      r = graph_.range(linear.value);
    }
    return r.low == r.high ? Linear{.offset = rule(r.low)} : linear;
  }

  Value read(Register reg, int component, const Rgba9& constant0, const Rgba9& constant1) {
    const bool varies = varying_constants_.contains(reg, component);
    if (reg == Register::zero) return graph_.constant(0);
    if (reg == Register::constant0 && !varies) return graph_.constant(constant0[at(component)]);
    if (reg == Register::constant1 && !varies) return graph_.constant(constant1[at(component)]);
    return registers_[static_cast<std::size_t>(reg)][at(component)];
  }

  // Rule 11. Lane by lane, the choice may come before or after the rest. Chosen first, the factors of two products need
  // only one multiplication.
  Value mux(const WideSum& ab, const WideSum& cd, const PortionOutput& out, bool by_lowest_bit) {
    const Value by = registers_[static_cast<std::size_t>(Register::spare0)][kAlpha];
    const auto select = [&](const Operand& no, const Operand& yes) {
      return by_lowest_bit ? graph_.select_odd(by, no, yes) : graph_.select(by, no, yes);
    };
    const auto is_product = [&](const WideSum& w) {
      return w.products().size() == 1 && w.constant() == 0 && !is_affine(graph_, w);
    };
    if (out.ab != Register::discard || out.cd != Register::discard || !is_product(ab) || !is_product(cd)) {
      return select({combiner_output(graph_, ab, out.scale, out.bias), false},
                    {combiner_output(graph_, cd, out.scale, out.bias), false});
    }
    const WideSum::Product &p = ab.products()[0], &q = cd.products()[0];
    const auto chosen = [&](const Linear& no, const Linear& yes) {
      const Value value = select(graph_.operand(no), graph_.operand(yes));
      return Linear{value, false, 1, 0};
    };
    WideSum sum;
    sum.add(chosen(p.x, q.x), chosen(p.y, q.y));
    return combiner_output(graph_, sum, out.scale, out.bias);
  }

  Narrowed final_narrowing(int high) const {
    return {.narrowing = program_.datapath.final_narrowing, .low = 0, .high = high};
  }

  // Rule 13.
  Value color_sum(int channel) {
    const auto part = [&](Register reg, bool inverted) {
      const Value value = registers_[static_cast<std::size_t>(reg)][at(channel)];
      return inverted ? mapped(value, InputMapping::unsigned_invert) : Linear{value, true, 1, 0};
    };
    const int one = program_.datapath.one;
    const std::array<Linear, 2> terms{part(Register::spare0, program_.color_sum_invert_spare0),
                                      part(Register::secondary, program_.color_sum_invert_secondary)};
    return graph_.affine(terms, Scale::none, Narrowing::toward_zero, 0, program_.color_sum_clamp ? one : 2 * one);
  }

  // Rule 10.
  Value e_times_f(int channel) {
    const FinalCombiner& f = program_.final_combiner;
    WideSum product;
    product.add(final_input(f.e, channel), final_input(f.f, channel));
    return narrow(graph_, product, final_narrowing(program_.datapath.one));
  }

  Linear final_input(const CombinerInput& in, int channel) {
    const int component = reference::component_of(in.usage, channel);
    if (in.reg == Register::e_times_f) return mapped(e_times_f(component), in.mapping);
    if (in.reg == Register::spare0_plus_secondary) return mapped(color_sum(component), in.mapping);
    Linear linear = mapped(read(in.reg, component, program_.constant0, program_.constant1), in.mapping);
    if (in.usage == ComponentUsage::alpha) share_floor(linear);
    return linear;
  }

  // Three channels read the value: its positive part is taken once.
  void share_floor(Linear& linear) {
    if (linear.is_constant() || !linear.floored) return;
    linear.value = graph_.chosen({linear.value, true});
    linear.floored = false;
  }

  // Rules 9 and 14.
  Value final_rgb(int channel) {
    const FinalCombiner& f = program_.final_combiner;
    const Linear a = final_input(f.a, channel), b = final_input(f.b, channel), c = final_input(f.c, channel);
    const Linear one_minus_a{a.value, a.floored, -a.factor, program_.datapath.one - a.offset};
    WideSum mix;
    mix.add(a, b);
    mix.add(one_minus_a, c);
    Narrowed how = final_narrowing(program_.datapath.one);
    how.added = final_input(f.d, channel);
    return narrow(graph_, mix, how);
  }

  // Rule 14.
  Value final_alpha() {
    const Linear g = final_input(program_.final_combiner.g, kAlpha);
    return graph_.affine({&g, 1}, Scale::none, Narrowing::toward_zero, 0, program_.datapath.one);
  }

  const Program& program_;
  const ComponentSet& varying_constants_;
  ValueGraph graph_;
  Registers registers_{};
};

}  // namespace

VectorCode compile_batch(const Program& program, const BatchOutputs& outputs, const ComponentSet& varying_constants,
                         BatchInputs inputs) {
  return Compiler(program, varying_constants, inputs).compile(outputs);
}

}  // namespace ninebit::detail
