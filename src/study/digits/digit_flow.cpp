#include "src/study/digits/digit_flow.h"

#include <bit>

#include "ninebit/combiner/evaluate.h"

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

}  // namespace

ByComponent<unsigned> digits_after_first_stage(const Program& program, const ByComponent<unsigned>& before) {
  const ProgramStage& stage = program.general[0];
  ByComponent<unsigned> after = before;
  const auto write = [&](const Portion& portion, int first, int channels) {
    if (!is_live(portion.out)) return;
    const auto digits = [&](const CombinerInput& in, int c) {
      return before[static_cast<std::size_t>(in.reg)]
                   [static_cast<std::size_t>(reference::component_of(in.usage, first + c))];
    };
    std::array<unsigned, 3> ab{}, cd{};
    unsigned all_ab = 0, all_cd = 0;
    for (int c = 0; c < channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      all_ab |= ab[i] = digits(portion.a, c) | digits(portion.b, c);
      all_cd |= cd[i] = digits(portion.c, c) | digits(portion.d, c);
    }
    if (portion.out.ab_dot_product) ab.fill(all_ab);
    if (portion.out.cd_dot_product) cd.fill(all_cd);
    const unsigned choice = portion.out.mux_sum ? before[static_cast<std::size_t>(Register::spare0)][kAlpha] : 0;
    const auto put = [&](Register to, int c, unsigned set) {
      if (to != Register::discard) after[static_cast<std::size_t>(to)][static_cast<std::size_t>(first + c)] = set;
    };
    for (int c = 0; c < channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      put(portion.out.ab, c, ab[i]);
      put(portion.out.cd, c, cd[i]);
      put(portion.out.sum, c, ab[i] | cd[i] | choice);
    }
    if (portion.out.ab_blue_to_alpha) put(portion.out.ab, kAlpha, ab[kBlue]);
    if (portion.out.cd_blue_to_alpha) put(portion.out.cd, kAlpha, cd[kBlue]);
  };
  write(stage.rgb, kRed, 3);
  write(stage.alpha, kAlpha, 1);
  return after;
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
  const bool alpha_is_blue = (rgb.ab_blue_to_alpha && rgb.ab == g.reg) || (rgb.cd_blue_to_alpha && rgb.cd == g.reg);
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
