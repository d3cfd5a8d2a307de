#include "src/study/datapath/color_inputs.h"

#include "ninebit/combiner/final_walk.h"
#include "ninebit/combiner/portion_walk.h"

namespace ninebit {
namespace {

// A value as the inputs that can change it. `zero`, `one`: it is this number for all inputs, and `of` is empty.
struct Dependent {
  InputSet of;
  bool zero = false, one = false;
};

constexpr Dependent kZero{.of = {}, .zero = true};

Dependent either(const Dependent& x, const Dependent& y) {
  return {.of = x.of | y.of, .zero = x.zero && y.zero};
}

Dependent mapped(InputMapping mapping, const Dependent& value) {
  if (!value.zero) return {.of = value.of};
  const bool stays = mapping == InputMapping::unsigned_identity || mapping == InputMapping::signed_identity ||
                     mapping == InputMapping::signed_negate;
  return {.of = {}, .zero = stays, .one = mapping == InputMapping::unsigned_invert};
}

Dependent times(const Dependent& x, const Dependent& y) {
  return x.zero || y.zero ? kZero : Dependent{.of = x.of | y.of};
}

using Registers = std::array<std::array<Dependent, 4>, kRegisterCount>;

Dependent& at(Registers& registers, Register reg, int component) {
  return registers[static_cast<std::size_t>(reg)][static_cast<std::size_t>(component)];
}

// The value domain of dependences (portion_walk.h): a value depends on all that it is made of.
class Dependences {
 public:
  using Input = Dependent;
  using Wide = Dependent;
  using Output = Dependent;

  explicit Dependences(Registers& registers) : registers_(registers) {}

  [[nodiscard]] Dependent input(const CombinerInput& in, int component) const {
    return mapped(in.mapping, at(registers_, in.reg, component));
  }
  static Dependent product(const Dependent& x, const Dependent& y) { return times(x, y); }
  static Dependent sum(const Dependent& x, const Dependent& y) { return either(x, y); }
  [[nodiscard]] Dependent mux(const Dependent& ab, const Dependent& cd) const {
    Dependent out = either(ab, cd);
    if (!out.zero) out.of |= at(registers_, Register::spare0, kAlpha).of;
    return out;
  }
  static Dependent output(const detail::Target& target, const Dependent& wide) {
    return {.of = wide.of, .zero = wide.zero && target.out.bias == Bias::none};
  }
  void write(Register to, int component, const Dependent& value) { at(registers_, to, component) = value; }

 private:
  Registers& registers_;
};

// The same of the final combiner (final_walk.h).
class FinalDependences {
 public:
  using Input = Dependent;
  using Code = Dependent;
  static constexpr bool kEveryStep = false;

  explicit FinalDependences(Registers& registers) : registers_(registers) {}

  [[nodiscard]] Dependent input(const CombinerInput& in, int component) const {
    return mapped(in.mapping, at(registers_, in.reg, component));
  }
  static Dependent map(InputMapping mapping, const Dependent& value) { return mapped(mapping, value); }
  static Dependent product(const Dependent& e, const Dependent& f) { return times(e, f); }
  [[nodiscard]] Dependent sum_part(bool inverted, Register r, int component) const {
    const Dependent& value = at(registers_, r, component);
    return inverted ? Dependent{.of = value.of} : value;
  }
  static Dependent sum(bool /*clamp*/, const Dependent& x, const Dependent& y) { return either(x, y); }
  static Dependent rgb(int /*channel*/, const Dependent& a, const Dependent& b, const Dependent& c,
                       const Dependent& d) {
    // (1 - A) · C is zero if A is one, and depends on A unless C is zero.
    const Dependent rest = a.one || c.zero ? kZero : Dependent{.of = a.of | c.of};
    return either(either(times(a, b), rest), d);
  }
  static Dependent alpha(const Dependent& g) { return g; }

 private:
  Registers& registers_;
};

}  // namespace

std::array<InputSet, 4> inputs_of_color(const Program& program, bool own_alpha) {
  Registers registers;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int c = 0; c < 4; ++c)
      at(registers, static_cast<Register>(r), c).of.set(input_bit(static_cast<Register>(r), c));
  }
  registers[static_cast<std::size_t>(Register::zero)].fill(kZero);
  if (!own_alpha) at(registers, Register::spare0, kAlpha) = at(registers, Register::texture0, kAlpha);
  for (int i = 0; i < program.num_general_combiners; ++i) {
    Dependences domain(registers);
    detail::StageSteps<Dependences> steps;
    detail::walk_stage(domain, program.general[static_cast<std::size_t>(i)], steps);
  }
  FinalDependences domain(registers);
  detail::FinalSteps<FinalDependences> steps;
  detail::walk_final(domain, program, steps);
  std::array<InputSet, 4> out;
  for (std::size_t c = 0; c < 4; ++c) out[c] = steps.color[c].of;
  return out;
}

}  // namespace ninebit
