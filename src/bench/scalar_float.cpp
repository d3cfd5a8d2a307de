#include "src/bench/scalar_float.h"

#include <algorithm>

namespace ninebit::bench {
namespace {

using Color = std::array<float, 4>;

float clamped(float v, float low) {
  return v < low ? low : v > 1.0F ? 1.0F : v;
}

float mapped(InputMapping mapping, float v) {
  const float positive = std::max(v, 0.0F);
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return positive;
    case InputMapping::unsigned_invert:
      return 1.0F - std::min(positive, 1.0F);
    case InputMapping::expand_normal:
      return 2.0F * positive - 1.0F;
    case InputMapping::expand_negate:
      return 1.0F - 2.0F * positive;
    case InputMapping::half_bias_normal:
      return positive - 0.5F;
    case InputMapping::half_bias_negate:
      return 0.5F - positive;
    case InputMapping::signed_identity:
      return v;
    case InputMapping::signed_negate:
      return -v;
  }
  return v;
}

// The state of the register combiners for one fragment.
class FloatFragment {
 public:
  FloatFragment(const Program& program, const RegisterFile& start) : program_(program) {
    scale_ = 1.0F / static_cast<float>(program.datapath.one);
    for (const Register r : {Register::fog, Register::primary, Register::secondary, Register::spare0, Register::spare1,
                             Register::texture0, Register::texture1, Register::texture2, Register::texture3}) {
      load(r, start[r]);
    }
  }

  void run_stage(const ProgramStage& stage) {
    load(Register::constant0, stage.constant0);
    load(Register::constant1, stage.constant1);
    const float spare0_alpha = at(Register::spare0)[kAlpha];
    const bool takes_cd = stage.mux_by_lowest_bit ? code(spare0_alpha) % 2 == 1 : spare0_alpha >= 0.5F;
    Outputs rgb, alpha;
    if (is_live(stage.rgb.out)) compute(stage.rgb, 0, 3, takes_cd, rgb);
    if (is_live(stage.alpha.out)) compute(stage.alpha, 3, 1, takes_cd, alpha);
    write(stage.rgb.out, 0, 3, rgb);
    write(stage.alpha.out, 3, 1, alpha);
  }

  Rgba9 run_final() {
    load(Register::constant0, program_.constant0);
    load(Register::constant1, program_.constant1);
    const FinalCombiner& f = program_.final_combiner;
    Color& product = at(Register::e_times_f);
    Color& sum = at(Register::spare0_plus_secondary);
    for (std::size_t c = 0; c < 3; ++c) {
      product[c] = input(f.e, c) * input(f.f, c);
      const auto part = [&](Register r, bool inverted) {
        return mapped(inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity, at(r)[c]);
      };
      sum[c] = part(Register::spare0, program_.color_sum_invert_spare0) +
               part(Register::secondary, program_.color_sum_invert_secondary);
      if (program_.color_sum_clamp) sum[c] = std::min(sum[c], 1.0F);
    }
    Rgba9 out{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float a = input(f.a, c);
      out[c] = code(a * input(f.b, c) + (1.0F - a) * input(f.c, c) + input(f.d, c));
    }
    out[kAlpha] = code(input(f.g, kAlpha));
    return out;
  }

 private:
  struct Outputs {
    Color ab{}, cd{}, sum{};
  };

  Color& at(Register r) { return registers_[static_cast<std::size_t>(r)]; }

  void load(Register r, const Rgba9& codes) {
    for (std::size_t c = 0; c < 4; ++c) at(r)[c] = static_cast<float>(codes[c]) * scale_;
  }

  s9 code(float v) const {
    return static_cast<s9>(clamped(v, 0.0F) * static_cast<float>(program_.datapath.one) + 0.5F);
  }

  float input(const CombinerInput& in, std::size_t channel) {
    const std::size_t component = in.usage == ComponentUsage::alpha  ? std::size_t{kAlpha}
                                  : in.usage == ComponentUsage::blue ? std::size_t{kBlue}
                                                                     : channel;
    return mapped(in.mapping, at(in.reg)[component]);
  }

  static float written(const PortionOutput& out, float v) {
    if (out.bias == Bias::by_negative_one_half) v -= 0.5F;
    switch (out.scale) {
      case Scale::none:
        break;
      case Scale::by_two:
        v *= 2.0F;
        break;
      case Scale::by_four:
        v *= 4.0F;
        break;
      case Scale::by_one_half:
        v *= 0.5F;
        break;
    }
    return clamped(v, -1.0F);
  }

  void compute(const Portion& portion, std::size_t first, std::size_t channels, bool takes_cd, Outputs& result) {
    const PortionOutput& out = portion.out;
    Color ab{}, cd{};
    for (std::size_t c = first; c < first + channels; ++c) {
      ab[c] = input(portion.a, c) * input(portion.b, c);
      cd[c] = input(portion.c, c) * input(portion.d, c);
    }
    if (out.ab_dot_product) ab[0] = ab[1] = ab[2] = ab[0] + ab[1] + ab[2];
    if (out.cd_dot_product) cd[0] = cd[1] = cd[2] = cd[0] + cd[1] + cd[2];
    for (std::size_t c = first; c < first + channels; ++c) {
      result.ab[c] = written(out, ab[c]);
      result.cd[c] = written(out, cd[c]);
      result.sum[c] = written(out, !out.mux_sum ? ab[c] + cd[c] : takes_cd ? cd[c] : ab[c]);
    }
  }

  void write(const PortionOutput& out, std::size_t first, std::size_t channels, const Outputs& result) {
    for (std::size_t c = first; c < first + channels; ++c) {
      if (out.ab != Register::discard) at(out.ab)[c] = result.ab[c];
      if (out.cd != Register::discard) at(out.cd)[c] = result.cd[c];
      if (out.sum != Register::discard) at(out.sum)[c] = result.sum[c];
    }
    if (out.ab_blue_to_alpha) at(out.ab)[kAlpha] = result.ab[kBlue];
    if (out.cd_blue_to_alpha) at(out.cd)[kAlpha] = result.cd[kBlue];
  }

  const Program& program_;
  float scale_ = 0.0F;
  std::array<Color, kRegisterCount + 2> registers_{};  // including E times F and the colour sum
};

}  // namespace

void evaluate_scalar_float(const Program& program, std::span<const RegisterFile> fragments, Rgba9* colors) {
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    FloatFragment fragment(program, fragments[i]);
    for (int stage = 0; stage < program.num_general_combiners; ++stage) {
      fragment.run_stage(program.general[static_cast<std::size_t>(stage)]);
    }
    colors[i] = fragment.run_final();
  }
}

}  // namespace ninebit::bench
