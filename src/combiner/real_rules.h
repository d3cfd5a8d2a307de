// The equations of NV_register_combiners in real numbers, over any kind of numbers: a Field has a type Number and
//   whole(int), half(), of_code(int), add, sub, mul, scaled(x, exponent) = x · 2^exponent, is_negative(x), less(x, y),
//   nearest_code(x).
// The order of all operations is fixed, because floats feel it. Nothing is narrowed; registers are clamped to [-1, 1].
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/evaluate.h"

namespace ninebit {

template <class Field>
class RealCombiners {
 public:
  using Number = typename Field::Number;
  using Color = std::array<Number, 4>;
  using Registers = std::array<Color, kRegisterCount>;

  // One of the three outputs of a portion, in one channel.
  struct Output {
    Number wide{};     // the product, dot product, sum or mux choice
    Number scaled{};   // with bias and scale
    Number written{};  // clamped
  };
  struct Channel {
    std::array<Number, 4> input{};   // A to D, mapped
    std::array<Output, 3> output{};  // AB, CD, sum or mux
  };
  struct Stage {
    bool takes_cd = false;
    std::array<Channel, 4> channel{};  // red, green and blue of the RGB portion, then the alpha portion
  };
  struct Final {
    std::array<Color, 6> input{};  // A to F, mapped; no alpha
    Number g{};
    Color e_times_f{};
    Color color_sum{};
    Color unclamped{};
    Color out{};
  };

  explicit RealCombiners(Field& field)
      : f_(field), zero_(field.whole(0)), one_(field.whole(1)), minus_one_(field.whole(-1)) {}

  // Computes one general combiner and writes its outputs into the registers.
  void run_general(const ProgramStage& stage, Registers& registers, Stage& result) {
    const Number& spare0_alpha = registers[static_cast<std::size_t>(Register::spare0)][kAlpha];
    // A number has no bits: those of the nearest code stand for them.
    result.takes_cd =
        stage.mux_by_lowest_bit ? f_.nearest_code(positive(spare0_alpha)) % 2 == 1 : !f_.less(spare0_alpha, f_.half());
    compute_portion(stage, stage.rgb, 0, 3, registers, result);
    compute_portion(stage, stage.alpha, 3, 1, registers, result);
    write_portion(stage.rgb, 0, 3, result, registers);
    write_portion(stage.alpha, 3, 1, result, registers);
  }

  void run_final(const Program& program, const Registers& registers, Final& result) {
    const FinalCombiner& c = program.final_combiner;
    const auto mapped = [&](const CombinerInput& in, int channel) {
      const auto component = static_cast<std::size_t>(reference::component_of(in.usage, channel));
      if (in.reg == Register::e_times_f) return map_input(in.mapping, result.e_times_f[component]);
      if (in.reg == Register::spare0_plus_secondary) return map_input(in.mapping, result.color_sum[component]);
      return map_input(in.mapping, fetch(registers, in.reg, component, program.constant0, program.constant1));
    };
    const Color& spare0 = registers[static_cast<std::size_t>(Register::spare0)];
    const Color& secondary = registers[static_cast<std::size_t>(Register::secondary)];
    const std::array<const CombinerInput*, 6> inputs{&c.a, &c.b, &c.c, &c.d, &c.e, &c.f};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto channel = static_cast<int>(i);
      auto& in = result.input;
      for (std::size_t v = 4; v < 6; ++v) in[v][i] = mapped(*inputs[v], channel);
      result.e_times_f[i] = f_.mul(in[4][i], in[5][i]);
      const auto part = [&](const Number& x, bool inverted) {
        return map_input(inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity, x);
      };
      const Number sum = f_.add(part(spare0[i], program.color_sum_invert_spare0),
                                part(secondary[i], program.color_sum_invert_secondary));
      result.color_sum[i] = program.color_sum_clamp ? at_most_one(sum) : sum;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      auto& in = result.input;
      for (std::size_t v = 0; v < 4; ++v) in[v][i] = mapped(*inputs[v], static_cast<int>(i));
      const Number mixed = f_.add(f_.mul(in[0][i], in[1][i]), f_.mul(f_.sub(one_, in[0][i]), in[2][i]));
      result.unclamped[i] = f_.add(mixed, in[3][i]);
      result.out[i] = at_most_one(positive(result.unclamped[i]));
    }
    result.g = result.unclamped[kAlpha] = mapped(c.g, kAlpha);
    result.out[kAlpha] = at_most_one(positive(result.g));
  }

 private:
  Number positive(const Number& x) const { return f_.is_negative(x) ? zero_ : x; }
  Number at_most_one(const Number& x) { return f_.less(one_, x) ? one_ : x; }
  Number clamp(const Number& x) {
    if (f_.is_negative(x)) return f_.less(x, minus_one_) ? minus_one_ : x;
    return at_most_one(x);
  }

  Number map_input(InputMapping mapping, const Number& e) {
    switch (mapping) {
      case InputMapping::unsigned_identity:
        return positive(e);
      case InputMapping::unsigned_invert:
        return f_.sub(one_, at_most_one(positive(e)));
      case InputMapping::expand_normal:
        return f_.sub(f_.scaled(positive(e), 1), one_);
      case InputMapping::expand_negate:
        return f_.sub(one_, f_.scaled(positive(e), 1));
      case InputMapping::half_bias_normal:
        return f_.sub(positive(e), f_.half());
      case InputMapping::half_bias_negate:
        return f_.sub(f_.half(), positive(e));
      case InputMapping::signed_identity:
        return e;
      case InputMapping::signed_negate:
        return f_.sub(zero_, e);
    }
    return e;
  }

  Number fetch(const Registers& registers, Register reg, std::size_t component, const Rgba9& constant0,
               const Rgba9& constant1) const {
    switch (reg) {
      case Register::zero:
        return zero_;
      case Register::constant0:
        return f_.of_code(constant0[component]);
      case Register::constant1:
        return f_.of_code(constant1[component]);
      default:
        return registers[static_cast<std::size_t>(reg)][component];
    }
  }

  void compute_portion(const ProgramStage& stage, const Portion& portion, std::size_t first, std::size_t channels,
                       const Registers& registers, Stage& result) {
    if (!is_live(portion.out)) return;
    const auto channel = [&](std::size_t c) -> Channel& { return result.channel[first + c]; };
    const std::array<const CombinerInput*, 4> inputs{&portion.a, &portion.b, &portion.c, &portion.d};
    for (std::size_t c = 0; c < channels; ++c) {
      auto& in = channel(c).input;
      for (std::size_t v = 0; v < 4; ++v) {
        const auto component =
            static_cast<std::size_t>(reference::component_of(inputs[v]->usage, static_cast<int>(first + c)));
        in[v] = map_input(inputs[v]->mapping,
                          fetch(registers, inputs[v]->reg, component, stage.constant0, stage.constant1));
      }
      channel(c).output[0].wide = f_.mul(in[0], in[1]);
      channel(c).output[1].wide = f_.mul(in[2], in[3]);
    }
    const std::array<bool, 2> dot{portion.out.ab_dot_product, portion.out.cd_dot_product};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!dot[k] || channels != 3) continue;
      const Number total =
          f_.add(f_.add(channel(0).output[k].wide, channel(1).output[k].wide), channel(2).output[k].wide);
      for (std::size_t c = 0; c < 3; ++c) channel(c).output[k].wide = total;
    }
    const std::array<Register, 3> to{portion.out.ab, portion.out.cd, portion.out.sum};
    for (std::size_t c = 0; c < channels; ++c) {
      auto& out = channel(c).output;
      if (portion.out.sum != Register::discard) {
        out[2].wide = !portion.out.mux_sum ? f_.add(out[0].wide, out[1].wide)
                      : result.takes_cd    ? out[1].wide
                                           : out[0].wide;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (to[k] == Register::discard) continue;
        out[k].scaled = scaled(portion.out.scale, portion.out.bias, out[k].wide);
        out[k].written = clamp(out[k].scaled);
      }
    }
  }

  Number scaled(Scale scale, Bias bias, const Number& wide) {
    Number biased = bias == Bias::none ? wide : f_.sub(wide, f_.half());
    switch (scale) {
      case Scale::none:
        return biased;
      case Scale::by_two:
        return f_.scaled(biased, 1);
      case Scale::by_four:
        return f_.scaled(biased, 2);
      case Scale::by_one_half:
        return f_.scaled(biased, -1);
    }
    return biased;
  }

  static void write_portion(const Portion& portion, std::size_t first, std::size_t channels, const Stage& result,
                            Registers& registers) {
    const std::array<Register, 3> to{portion.out.ab, portion.out.cd, portion.out.sum};
    const std::array<bool, 3> blue_to_alpha{portion.out.ab_blue_to_alpha, portion.out.cd_blue_to_alpha, false};
    for (std::size_t k = 0; k < 3; ++k) {
      if (to[k] == Register::discard) continue;
      Color& target = registers[static_cast<std::size_t>(to[k])];
      for (std::size_t c = first; c < first + channels; ++c) target[c] = result.channel[c].output[k].written;
      if (blue_to_alpha[k]) target[kAlpha] = target[kBlue];
    }
  }

  Field& f_;
  const Number zero_, one_, minus_one_;
};

}  // namespace ninebit
