#include "combiner_tests/combiner/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <sstream>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/oracle/real_oracle.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

void print(std::ostream& out, const char* variable, const CombinerInput& in) {
  out << ' ' << variable << '=' << name_of(in.mapping) << '(' << name_of(in.reg) << '.' << name_of(in.usage) << ')';
}

void print(std::ostream& out, const char* name, const Portion& portion) {
  out << "  " << name << ':';
  print(out, "A", portion.a);
  print(out, "B", portion.b);
  print(out, "C", portion.c);
  print(out, "D", portion.d);
  const PortionOutput& o = portion.out;
  out << "\n    AB->" << name_of(o.ab) << (o.ab_dot_product ? " (dot)" : "")
      << (o.ab_blue_to_alpha ? " (blue to alpha)" : "") << " CD->" << name_of(o.cd)
      << (o.cd_dot_product ? " (dot)" : "") << (o.cd_blue_to_alpha ? " (blue to alpha)" : "")
      << (o.mux_sum ? " mux->" : " sum->") << name_of(o.sum) << " scale=" << name_of(o.scale)
      << " bias=" << name_of(o.bias) << '\n';
}

void print(std::ostream& out, const char* name, const ColorF& color) {
  out << ' ' << name << "=(";
  for (const float component : color) out << ' ' << component * 255.0F;
  out << " )/255";
}

Rgba9 of_codes(const oracle::Codes& color) {
  return codes(color[0], color[1], color[2], color[3]);
}

Fragment by_oracle(const CombinerState& state, const HardwareProfile& profile, const RegisterFile& initial) {
  const bool integer = profile.arithmetic.value == Arithmetic::integer;
  const oracle::Outcome outcome =
      integer ? oracle::run(state, profile, to_oracle(initial)) : oracle::run_real(state, profile, to_oracle(initial));
  Fragment fragment;
  for (std::size_t r = 0; r < kRegisterCount; ++r) fragment.registers.value[r] = of_codes(outcome.registers[r]);
  fragment.color = of_codes(outcome.color);
  return fragment;
}

}  // namespace

std::vector<HardwareProfile> profiles_and_rivals() {
  std::vector<HardwareProfile> all = integer_profiles();
  HardwareProfile rival = profiles::geforce2;
  rival.name = "geforce2, lowest -256, expand 2v - 256";
  rival.lowest.value = rival.lowest_output.value = -256;
  rival.expand_offset.value = 256;
  all.push_back(rival);
  rival = profiles::geforce2_early_truncation;
  rival.name = "geforce2, early, to nearest";
  rival.general_narrowing.value = Narrowing::nearest_halves_up;
  all.push_back(rival);
  return all;
}

CombinerState silent_state(int stages) {
  CombinerState state;
  state.num_general_combiners = stages;
  for (GeneralCombiner& stage : state.general) stage.rgb.out.sum = stage.alpha.out.sum = Register::discard;
  state.final_combiner = {kZero, kZero, kZero, kZero, kZero, kZero, alpha_of(Register::spare0)};
  return state;
}

CombinerState rgb_stage(const Portion& rgb) {
  CombinerState state = silent_state(1);
  state.general[0].rgb = rgb;
  return state;
}

Portion of_alpha(Portion portion) {
  for (CombinerInput* const in : {&portion.a, &portion.b, &portion.c, &portion.d}) in->usage = ComponentUsage::alpha;
  return portion;
}

CombinerState index_comparison(Scale scale) {
  CombinerState state = silent_state(2);
  state.general[0].rgb = {rgb_of(Register::primary), kOne, rgb_of(Register::texture0), kMinusOne,
                          sum_to(Register::spare0, scale)};
  const CombinerInput difference = rgb_of(Register::spare0, InputMapping::signed_identity);
  state.general[1].rgb = {difference, difference, kZero, kZero, ab_to(Register::spare1, scale)};
  state.general[1].rgb.out.ab_dot_product = true;
  state.final_combiner.g = blue_of(Register::spare1);
  return state;
}

FinalCombiner final_of(Register r) {
  return {kZero, kZero, kZero, rgb_of(r), kZero, kZero, alpha_of(r)};
}

std::string describe(const CombinerState& state, const HardwareProfile& p) {
  std::ostringstream out;
  out << "profile " << p.name << ": arithmetic=" << static_cast<int>(p.arithmetic.value) << " one=" << p.one
      << " lowest=" << p.lowest << " lowest_output=" << p.lowest_output << " half=" << p.half
      << " expand_offset=" << p.expand_offset << " byte_shift=" << p.byte_shift
      << " general_narrowing=" << (p.general_narrowing.value == Narrowing::toward_zero ? "toward_zero" : "nearest")
      << " narrowing_point="
      << (p.narrowing_point.value == NarrowingPoint::after_scale ? "after_scale" : "before_scale")
      << " final_narrowing=" << (p.final_narrowing.value == Narrowing::toward_zero ? "toward_zero" : "nearest")
      << "\nstages=" << state.num_general_combiners << " color_sum_clamp=" << state.color_sum_clamp
      << " per_stage_constants=" << state.per_stage_constants << " mux_by_lowest_bit=" << state.mux_by_lowest_bit
      << " color_sum_invert_spare0=" << state.color_sum_invert_spare0
      << " color_sum_invert_secondary=" << state.color_sum_invert_secondary;
  print(out, "constant0", state.constant0);
  print(out, "constant1", state.constant1);
  out << '\n';
  for (int i = 0; i < state.num_general_combiners && i < kMaxGeneralCombiners; ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    out << "general combiner " << i << ':';
    if (state.per_stage_constants) {
      print(out, "constant0", stage.constant0);
      print(out, "constant1", stage.constant1);
    }
    out << '\n';
    print(out, "RGB", stage.rgb);
    print(out, "alpha", stage.alpha);
  }
  const FinalCombiner& f = state.final_combiner;
  out << "final combiner:";
  print(out, "A", f.a);
  print(out, "B", f.b);
  print(out, "C", f.c);
  print(out, "D", f.d);
  print(out, "E", f.e);
  print(out, "F", f.f);
  print(out, "G", f.g);
  return out.str() + '\n';
}

std::string describe(const Rgba9& color) {
  std::ostringstream out;
  out << '(' << color[0] << ", " << color[1] << ", " << color[2] << ", " << color[3] << ')';
  return out.str();
}

std::string describe(const RegisterFile& registers) {
  std::ostringstream out;
  for (std::size_t i = 0; i < kRegisterCount; ++i) {
    out << "  " << name_of(static_cast<Register>(i)) << ' ' << describe(registers.value[i]) << '\n';
  }
  return out.str();
}

oracle::Registers to_oracle(const RegisterFile& registers) {
  oracle::Registers result{};
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) result[r][c] = registers.value[r][c];
  }
  return result;
}

std::vector<s9> outputs_by_oracle(const HardwareProfile& p, Scale scale, Bias bias, int low, int high, int step) {
  std::vector<s9> outputs;
  for (int wide = low; wide <= high; wide += step) {
    outputs.push_back(static_cast<s9>(oracle::general_output(p, scale, bias, {wide, p.one * p.one})));
  }
  return outputs;
}

void put(RegisterBatch& batch, std::size_t lane, const RegisterFile& registers) {
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) batch.plane[r][c][lane] = registers.value[r][c];
  }
}

RegisterFile lane_of(const RegisterBatch& batch, std::size_t lane) {
  RegisterFile registers;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) registers.value[r][c] = batch.plane[r][c][lane];
  }
  return registers;
}

Rgba9 lane_of(const OutputBatch& out, std::size_t lane) {
  return {out.plane[0][lane], out.plane[1][lane], out.plane[2][lane], out.plane[3][lane]};
}

void Lanes::expect_on_every_target(const BatchProgram& program, std::size_t count, const HardwareProfile& p,
                                   const std::function<int()>& difference) {
  constexpr s9 kNobodys = 0x5A5A;
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    // What the target before has written must not pass for this one's.
    for (auto& plane : out->plane) plane.fill(kNobodys);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const bool is_input = program.reads().contains(static_cast<Register>(r), static_cast<int>(c));
        if (!is_input) registers->plane[r][c].fill(kNobodys);
      }
    }
    program.run(*registers, count, *out);
    ASSERT_EQ(difference(), 0) << p.name << " on " << simd_target_name(target) << '\n'
                               << program.describe() << "fragment 0 of " << count << ":\n"
                               << describe(lane_of(*registers, 0));
    ASSERT_TRUE(on_target.ran()) << simd_target_name(target);
  }
}

namespace {

// What a state's program makes of batches of fragments, by every path.
class Judge {
 public:
  // `first`: the component of the colour that is wanted alone, too.
  Judge(const CombinerState& state, const HardwareProfile& profile, const Program& program, std::size_t alone)
      : state_(state), profile_(profile), program_(program), with_registers_(program, {.registers = true}) {
    if (!is_integer()) return;
    std::array<bool, 4> one{};
    one[alone] = true;
    for (const std::array<bool, 4>& wanted : {std::array{true, true, true, true}, one}) {
      colors_.push_back({wanted, BatchProgram(program, {.color = wanted})});
    }
  }

  // Whether all paths give what is expected.
  [[nodiscard]] bool agree(std::span<const RegisterFile> initial, std::span<const Fragment> expected) const {
    return reference_agrees(initial, expected) && batches_agree(initial, expected) && colors_agree(initial, expected);
  }

 private:
  struct Color {
    std::array<bool, 4> wanted;
    BatchProgram program;
  };

  [[nodiscard]] bool is_integer() const { return program_.datapath.arithmetic == Arithmetic::integer; }

  // The target's name is made for a failure alone: millions of fragments pass.
  [[nodiscard]] bool is_as(const RegisterFile& initial, const Fragment& expected, const Fragment& actual,
                           const char* path, std::int64_t target = 0) const {
    if (actual.registers == expected.registers && actual.color == expected.color) return true;
    ADD_FAILURE() << path << (target != 0 ? simd_target_name(target) : "") << " differs from the oracle\n"
                  << describe(state_, profile_) << "initial registers:\n"
                  << describe(initial) << "expected color " << describe(expected.color) << ", registers:\n"
                  << describe(expected.registers) << "actual color " << describe(actual.color) << ", registers:\n"
                  << describe(actual.registers);
    return false;
  }

  [[nodiscard]] bool reference_agrees(std::span<const RegisterFile> initial, std::span<const Fragment> expected) const {
    for (std::size_t i = 0; i < initial.size(); ++i) {
      const EvaluatedFragment whole = evaluate_fragment(program_, initial[i]);
      if (!is_as(initial[i], expected[i], {whole.registers, whole.color}, "evaluate_fragment")) return false;
      // The other ways into the reference are the same rules, called one by one.
      if (i % 8 != 0) continue;
      RegisterFile registers = initial[i];
      evaluate_general(program_, registers);
      // In real numbers the final combiner needs more than the codes that evaluate_general leaves.
      const Rgba9 color = is_integer() ? evaluate_final(program_, registers) : whole.color;
      if (!is_as(initial[i], expected[i], {registers, color}, "the reference")) return false;
      if (evaluate(program_, initial[i]) != expected[i].color) ADD_FAILURE() << "evaluate() is not its two halves";
    }
    return true;
  }

  [[nodiscard]] bool batches_agree(std::span<const RegisterFile> initial, std::span<const Fragment> expected) const {
    const std::size_t count = initial.size();
    for (std::size_t i = 0; i < count; ++i) {
      put(*before_, i, initial[i]);
      put(*expected_, i, expected[i].registers);
    }
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
          std::copy_n(before_->plane[r][c].begin(), count, batch_->plane[r][c].begin());
        }
      }
      with_registers_.run(*batch_, count, *out_);
      if (chosen_at_run_time() && on_target.ran() != is_integer()) {
        ADD_FAILURE() << "wrongly dispatched on " << simd_target_name(target);
      }
      bool is_right = same_lanes(*batch_, *expected_, count);
      for (std::size_t i = 0; i < count; ++i) is_right = is_right && lane_of(*out_, i) == expected[i].color;
      for (std::size_t i = 0; i < count && !is_right; ++i) {
        const Fragment actual{lane_of(*batch_, i), lane_of(*out_, i)};
        if (!is_as(initial[i], expected[i], actual, "the batch evaluator on ", target)) return false;
      }
      if (!is_integer()) break;  // real numbers have no vectors
    }
    return true;
  }

  // The colour without the registers, from a batch in which only the components stand that the batch program says it
  // reads; nothing else is written.
  [[nodiscard]] bool colors_agree(std::span<const RegisterFile> initial, std::span<const Fragment> expected) const {
    constexpr s9 kUntouched = 0x5A5A;
    const std::size_t count = expected.size();
    for (const auto& [wanted, program] : colors_) {
      for (std::size_t i = 0; i < std::min(kBatchSize, count + kBeyond); ++i) {
        RegisterFile given;
        for (std::size_t r = 0; r < kRegisterCount; ++r) {
          for (std::size_t c = 0; c < 4; ++c) {
            const bool is_read = i < count && program.reads().contains(static_cast<Register>(r), static_cast<int>(c));
            given.value[r][c] = is_read ? initial[i].value[r][c] : kUntouched;
          }
        }
        put(*batch_, i, given);
        put(*before_, i, given);
      }
      for (const std::int64_t target : simd_targets()) {
        const OnTarget on_target(target);
        for (auto& plane : out_->plane) std::fill_n(plane.begin(), count, kUntouched);
        program.run(*batch_, count, *out_);
        bool is_right = same_lanes(*batch_, *before_, std::min(kBatchSize, count + kBeyond));
        for (std::size_t i = 0; i < count; ++i) {
          for (std::size_t c = 0; c < 4; ++c) {
            is_right = is_right && out_->plane[c][i] == (wanted[c] ? expected[i].color[c] : kUntouched);
          }
        }
        if (is_right) continue;
        ADD_FAILURE() << "the colour without the registers on " << simd_target_name(target) << ", components "
                      << wanted[0] << wanted[1] << wanted[2] << wanted[3] << '\n'
                      << describe(state_, profile_) << program.describe();
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] static bool same_lanes(const RegisterBatch& x, const RegisterBatch& y, std::size_t lanes) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const auto end = x.plane[r][c].begin() + static_cast<std::ptrdiff_t>(lanes);
        if (!std::equal(x.plane[r][c].begin(), end, y.plane[r][c].begin())) return false;
      }
    }
    return true;
  }

  static constexpr std::size_t kBeyond = 64;  // more than any vector has

  const CombinerState& state_;
  const HardwareProfile& profile_;
  const Program& program_;
  BatchProgram with_registers_;
  std::vector<Color> colors_;
  std::unique_ptr<RegisterBatch> batch_ = std::make_unique<RegisterBatch>();
  std::unique_ptr<RegisterBatch> before_ = std::make_unique<RegisterBatch>();
  std::unique_ptr<RegisterBatch> expected_ = std::make_unique<RegisterBatch>();
  std::unique_ptr<OutputBatch> out_ = std::make_unique<OutputBatch>();
};

}  // namespace

std::vector<Fragment> judged(const CombinerState& state, const HardwareProfile& profile,
                             const std::vector<RegisterFile>& initial, std::size_t oracle_every) {
  const Result<Program> program = compile(state, profile);
  std::vector<Fragment> expected;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    if (i % oracle_every == 0 || !program) {
      expected.push_back(by_oracle(state, profile, initial[i]));
    } else {
      const EvaluatedFragment reference = evaluate_fragment(*program, initial[i]);
      expected.push_back({reference.registers, reference.color});
    }
  }
  if (!program) {
    ADD_FAILURE() << program.error().text() << '\n' << describe(state, profile);
    return expected;
  }
  // Which component of the colour is wanted alone depends on what it is.
  const Judge judge(state, profile, *program, static_cast<std::size_t>(expected[0].color[0] & 3));
  for (std::size_t first = 0; first < initial.size(); first += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, initial.size() - first);
    if (!judge.agree(std::span(initial).subspan(first, count), std::span(expected).subspan(first, count))) break;
  }
  return expected;
}

Fragment judged(const CombinerState& state, const HardwareProfile& profile, const RegisterFile& initial) {
  return judged(state, profile, std::vector<RegisterFile>{initial})[0];
}

}  // namespace ninebit::test
