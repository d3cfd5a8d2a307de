#include "src/study/digits/digit_flow.h"

#include <bit>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/portion_walk.h"

namespace ninebit {
namespace {

class Reads {
 public:
  void add(const CombinerInput& in, int first, int channels) {
    if (in.reg == Register::spare0_plus_secondary) {
      for (std::size_t c = 0; c < 3; ++c) at(Register::spare0)[c] = at(Register::secondary)[c] = true;
      return;
    }
    if (static_cast<std::size_t>(in.reg) >= kRegisterCount) return;  // E times F: E and F are added themselves
    for (int c = 0; c < channels; ++c) {
      at(in.reg)[static_cast<std::size_t>(reference::component_of(in.usage, first + c))] = true;
    }
  }
  void add(const Portion& portion, int first, int channels) {
    if (!is_live(portion.out)) return;
    for (const CombinerInput* in : {&portion.a, &portion.b, &portion.c, &portion.d}) add(*in, first, channels);
    if (portion.out.mux_sum) at(Register::spare0)[kAlpha] = true;
  }
  [[nodiscard]] const ByComponent<bool>& set() const { return set_; }

 private:
  std::array<bool, 4>& at(Register r) { return set_[static_cast<std::size_t>(r)]; }
  ByComponent<bool> set_{};
};

// Collects the terms of a DigitSum. Fails on a product of two digits, and on a second product of a digit.
class Terms {
 public:
  Terms(const ProgramStage& stage, const ByComponent<unsigned>& after) : stage_(stage), after_(after) {}

  [[nodiscard]] bool add(const ProductTerm& term) {
    const Portion& portion = term.channel == kAlpha ? stage_.alpha : stage_.rgb;
    const auto channel = static_cast<int>(term.channel);
    const auto digits = [&](const CombinerInput& in) {
      return after_[static_cast<std::size_t>(in.reg)]
                   [static_cast<std::size_t>(reference::component_of(in.usage, channel))];
    };
    const unsigned set = term.cd ? digits(portion.c) | digits(portion.d) : digits(portion.a) | digits(portion.b);
    if (set == 0) return true;
    auto& place = sum_.of_digit[static_cast<std::size_t>(std::countr_zero(set))];
    if (std::popcount(set) > 1 || place) return false;
    place = term;
    return true;
  }
  [[nodiscard]] DigitSum& sum() { return sum_; }

 private:
  const ProgramStage& stage_;
  const ByComponent<unsigned>& after_;
  DigitSum sum_;
};

// The value domain of dependences (portion_walk.h): what is computed depends on the digits of all that it is made of.
class DigitSets {
 public:
  using Input = unsigned;
  using Wide = unsigned;
  using Output = unsigned;

  explicit DigitSets(ByComponent<unsigned>& registers) : registers_(registers) {}

  [[nodiscard]] unsigned input(const CombinerInput& in, int component) const {
    return registers_[static_cast<std::size_t>(in.reg)][static_cast<std::size_t>(component)];
  }
  static unsigned product(unsigned x, unsigned y) { return x | y; }
  static unsigned sum(unsigned x, unsigned y) { return x | y; }
  [[nodiscard]] unsigned mux(unsigned ab, unsigned cd) const {
    return ab | cd | registers_[static_cast<std::size_t>(Register::spare0)][kAlpha];
  }
  static unsigned output(const detail::Target& /*target*/, unsigned wide) { return wide; }
  void write(Register to, int component, unsigned set) {
    registers_[static_cast<std::size_t>(to)][static_cast<std::size_t>(component)] = set;
  }

 private:
  ByComponent<unsigned>& registers_;
};

}  // namespace

ByComponent<unsigned> digits_after_first_stage(const Program& program, const ByComponent<unsigned>& before) {
  ByComponent<unsigned> registers = before;
  DigitSets domain(registers);
  detail::StageSteps<DigitSets> steps{};
  detail::walk_stage(domain, program.general[0], steps);
  return registers;
}

ByComponent<bool> read_from_stage(const Program& program, int first) {
  Reads reads;
  for (int i = first; i < program.num_general_combiners; ++i) {
    reads.add(program.general[static_cast<std::size_t>(i)].rgb, kRed, 3);
    reads.add(program.general[static_cast<std::size_t>(i)].alpha, kAlpha, 1);
  }
  const FinalCombiner& f = program.final_combiner;
  // Only the final combiner's alpha decides a comparison.
  reads.add(f.g, kAlpha, 1);
  return reads.set();
}

std::optional<DigitSum> digit_sum(const Program& program, const ByComponent<unsigned>& after) {
  const CombinerInput& g = program.final_combiner.g;
  if (program.num_general_combiners != 2 || static_cast<std::size_t>(g.reg) >= kRegisterCount) return std::nullopt;
  if (g.mapping != InputMapping::unsigned_identity && g.mapping != InputMapping::unsigned_invert) return std::nullopt;
  const ProgramStage& stage = program.general[1];
  const PortionOutput& rgb = stage.rgb.out;
  bool alpha_is_blue = false;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    detail::for_each_write({rgb, k, kBlue}, [&](Register to, int component) {
      alpha_is_blue = alpha_is_blue || (to == g.reg && component == kAlpha);
    });
  }
  const auto component =
      alpha_is_blue ? std::size_t{kBlue} : static_cast<std::size_t>(reference::component_of(g.usage, kAlpha));
  const PortionOutput& out = component == kAlpha ? stage.alpha.out : stage.rgb.out;
  const bool third = out.sum == g.reg;
  const std::array<bool, 2> takes{third || out.ab == g.reg, third || out.cd == g.reg};
  if (g.reg == Register::zero || (!takes[0] && !takes[1]) || (third && out.mux_sum)) return std::nullopt;

  Terms terms(stage, after);
  terms.sum().falling = g.mapping == InputMapping::unsigned_invert;
  const std::array<bool, 2> dot{out.ab_dot_product, out.cd_dot_product};
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const bool summed = channel == component || (dot[k] && component != kAlpha && channel != kAlpha);
      if (takes[k] && summed && !terms.add({channel, k == 1})) return std::nullopt;
    }
  }
  return terms.sum();
}

}  // namespace ninebit
