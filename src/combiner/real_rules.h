// The equations of NV_register_combiners in real numbers. A Field defines the numbers: the type Number and the
// functions
//   whole(int), half(), of_code(int), add, sub, mul, scaled(x, exponent) = x · 2^exponent, is_negative(x), less(x, y),
//   nearest_code(x).
// The order of all operations is fixed, because it decides how floats are rounded. Nothing is narrowed; registers are
// clamped to [-1, 1].
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/portion_walk.h"

namespace ninebit {

template <class Field>
class RealCombiners {
 public:
  using Number = typename Field::Number;
  using Color = std::array<Number, 4>;
  using Registers = std::array<Color, kRegisterCount>;

  // The value domain of the general combiners (portion_walk.h).
  class General {
   public:
    using Input = Number;
    using Wide = Number;
    struct Output {
      Number scaled{};   // with bias and scale
      Number written{};  // clamped
    };

    General(RealCombiners& rules, const ProgramStage& stage, Registers& registers, bool takes_cd)
        : rules_(rules), stage_(stage), registers_(registers), takes_cd_(takes_cd) {}

    Number input(const CombinerInput& in, int component) {
      return rules_.map_input(in.mapping, rules_.fetch(registers_, in.reg, static_cast<std::size_t>(component),
                                                       stage_.constant0, stage_.constant1));
    }
    Number product(const Number& x, const Number& y) { return rules_.f_.mul(x, y); }
    Number sum(const Number& x, const Number& y) { return rules_.f_.add(x, y); }
    const Number& mux(const Number& ab, const Number& cd) const { return takes_cd_ ? cd : ab; }
    Output output(const detail::Target& target, const Number& wide) {
      Output result;
      result.scaled = rules_.scaled(target.out.scale, target.out.bias, wide);
      result.written = rules_.clamp(result.scaled);
      return result;
    }
    void write(Register to, int component, const Output& value) {
      registers_[static_cast<std::size_t>(to)][static_cast<std::size_t>(component)] = value.written;
    }

   private:
    RealCombiners& rules_;
    const ProgramStage& stage_;
    Registers& registers_;
    bool takes_cd_;
  };

  struct Stage {
    bool takes_cd = false;
    detail::StageSteps<General> channel{};  // red, green and blue of the RGB portion, then the alpha portion
  };
  // The value domain of the final combiner (final_walk.h).
  class FinalNumbers {
   public:
    using Input = Number;
    using Code = Number;
    static constexpr bool kEveryStep = true;

    FinalNumbers(RealCombiners& rules, const Program& program, const Registers& registers, Color& unclamped)
        : rules_(rules), program_(program), registers_(registers), unclamped_(unclamped) {}

    Number input(const CombinerInput& in, int component) {
      return map(in.mapping, rules_.fetch(registers_, in.reg, static_cast<std::size_t>(component), program_.constant0,
                                          program_.constant1));
    }
    Number map(InputMapping mapping, const Number& e) { return rules_.map_input(mapping, e); }
    Number product(const Number& e, const Number& f) { return rules_.f_.mul(e, f); }
    Number sum_part(bool inverted, Register r, int component) {
      return map(inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity,
                 registers_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)]);
    }
    Number sum(bool clamp, const Number& spare0, const Number& secondary) {
      const Number total = rules_.f_.add(spare0, secondary);
      return clamp ? rules_.at_most_one(total) : total;
    }
    Number rgb(int channel, const Number& a, const Number& b, const Number& c, const Number& d) {
      Field& f = rules_.f_;
      const Number mixed = f.add(f.mul(a, b), f.mul(f.sub(rules_.one_, a), c));
      return clamped(channel, f.add(mixed, d));
    }
    Number alpha(const Number& g) { return clamped(kAlpha, g); }

   private:
    Number clamped(int component, const Number& x) {
      unclamped_[static_cast<std::size_t>(component)] = x;
      return rules_.at_most_one(rules_.positive(x));
    }

    RealCombiners& rules_;
    const Program& program_;
    const Registers& registers_;
    Color& unclamped_;
  };

  struct Final {
    detail::FinalSteps<FinalNumbers> steps{};
    Color unclamped{};
  };

  explicit RealCombiners(Field& field)
      : f_(field), zero_(field.whole(0)), one_(field.whole(1)), minus_one_(field.whole(-1)) {}

  // Computes one general combiner and writes its outputs into the registers.
  void run_general(const ProgramStage& stage, Registers& registers, Stage& result) {
    const Number& spare0_alpha = registers[static_cast<std::size_t>(Register::spare0)][kAlpha];
    // A real number has no lowest bit. The nearest code's is taken (rule 11).
    result.takes_cd =
        stage.mux_by_lowest_bit ? f_.nearest_code(positive(spare0_alpha)) % 2 == 1 : !f_.less(spare0_alpha, f_.half());
    General domain(*this, stage, registers, result.takes_cd);
    detail::walk_stage(domain, stage, result.channel);
  }

  void run_final(const Program& program, const Registers& registers, Final& result) {
    FinalNumbers domain(*this, program, registers, result.unclamped);
    detail::walk_final(domain, program, result.steps);
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

  Field& f_;
  const Number zero_, one_, minus_one_;
};

}  // namespace ninebit
