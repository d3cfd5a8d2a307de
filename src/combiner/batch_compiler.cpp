#include "src/combiner/batch_compiler.h"

#include <algorithm>
#include <array>

#include "ninebit/combiner/evaluate.h"
#include "src/combiner/wide_sum.h"

namespace ninebit::detail {
namespace {

std::size_t at(int component) {
  return static_cast<std::size_t>(component);
}

// Follows a program symbolically: each register component holds a value of the graph. A stage's new values take their
// registers when all of its old ones have been read (rule 12).
class Compiler {
 public:
  Compiler(const Program& program, const ComponentSet& varying_constants)
      : program_(program), varying_constants_(varying_constants), graph_(program.datapath) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) registers_[r][at(c)] = graph_.input(static_cast<Register>(r), c);
    }
  }

  VectorCode compile(const BatchOutputs& outputs) {
    for (int i = 0; i < program_.num_general_combiners; ++i) run_stage(program_.general[at(i)]);
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

  // A mapping is two straight lines at most, which meet at zero or, for values above one, at one: the rule itself tells
  // them.
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

  Linear input(const CombinerInput& in, int channel, const Rgba9& constant0, const Rgba9& constant1) {
    return mapped(read(in.reg, reference::component_of(in.usage, channel), constant0, constant1), in.mapping);
  }

  void run_stage(const ProgramStage& stage) {
    Registers next = registers_;
    run_portion(stage, stage.rgb, kRed, 3, next);
    run_portion(stage, stage.alpha, kAlpha, 1, next);
    registers_ = next;
  }

  void run_portion(const ProgramStage& stage, const Portion& portion, int first, int channels, Registers& next) {
    const PortionOutput& out = portion.out;
    const auto products = [&](const CombinerInput& x, const CombinerInput& y, bool dot) {
      std::array<WideSum, 3> sums;
      for (int c = 0; c < channels; ++c) {
        sums[dot ? 0 : at(c)].add(input(x, c, stage.constant0, stage.constant1),
                                  input(y, c, stage.constant0, stage.constant1));
      }
      if (dot) sums[1] = sums[2] = sums[0];
      return sums;
    };
    const std::array<WideSum, 3> ab = products(portion.a, portion.b, out.ab_dot_product);
    const std::array<WideSum, 3> cd = products(portion.c, portion.d, out.cd_dot_product);
    const auto write = [&](Register reg, int c, bool blue_to_alpha, const auto& value) {
      if (reg == Register::discard) return;
      auto& target = next[static_cast<std::size_t>(reg)];
      target[at(first + c)] = value();
      if (blue_to_alpha && c == kBlue) target[kAlpha] = target[kBlue];
    };
    for (int c = 0; c < channels; ++c) {
      const WideSum &x = ab[at(c)], &y = cd[at(c)];
      write(out.ab, c, out.ab_blue_to_alpha, [&] { return combiner_output(graph_, x, out.scale, out.bias); });
      write(out.cd, c, out.cd_blue_to_alpha, [&] { return combiner_output(graph_, y, out.scale, out.bias); });
      write(out.sum, c, false, [&] {
        if (out.mux_sum) return mux(x, y, out, stage.mux_by_lowest_bit);
        WideSum sum = x;
        sum.add(y);
        return combiner_output(graph_, sum, out.scale, out.bias);
      });
    }
  }

  // Rule 11. What is computed lane by lane may be computed before or after the choice: two products are only one if
  // their factors are chosen first.
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
    return input(in, channel, program_.constant0, program_.constant1);
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

VectorCode compile_batch(const Program& program, const BatchOutputs& outputs, const ComponentSet& varying_constants) {
  return Compiler(program, varying_constants).compile(outputs);
}

}  // namespace ninebit::detail
