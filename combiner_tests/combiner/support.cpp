#include "combiner_tests/combiner/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
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

std::vector<Fragment> by_oracle(const CombinerState& state, const HardwareProfile& profile,
                                const std::vector<RegisterFile>& initial) {
  std::vector<Fragment> fragments;
  for (const RegisterFile& registers : initial) {
    const bool integer = profile.arithmetic.value == Arithmetic::integer;
    const oracle::Outcome outcome = integer ? oracle::run(state, profile, to_oracle(registers))
                                            : oracle::run_real(state, profile, to_oracle(registers));
    fragments.push_back({from_oracle(outcome.registers), from_oracle(outcome.color)});
  }
  return fragments;
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

CombinerState index_comparison(Scale scale) {
  CombinerState state = silent_state(2);
  Portion& difference = state.general[0].rgb;
  difference.a = rgb_of(Register::primary);
  difference.b = kOne;
  difference.c = rgb_of(Register::texture0);
  difference.d = kMinusOne;
  difference.out.sum = Register::spare0;
  difference.out.scale = scale;
  Portion& square = state.general[1].rgb;
  square.a = square.b = rgb_of(Register::spare0, InputMapping::signed_identity);
  square.out.ab = Register::spare1;
  square.out.ab_dot_product = true;
  square.out.scale = scale;
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

Rgba9 from_oracle(const oracle::Codes& color) {
  return codes(color[0], color[1], color[2], color[3]);
}

RegisterFile from_oracle(const oracle::Registers& registers) {
  RegisterFile result;
  for (std::size_t r = 0; r < kRegisterCount; ++r) result.value[r] = from_oracle(registers[r]);
  return result;
}

namespace {

// The colour without the registers, from a batch in which only the components stand that the batch program says it
// reads; nothing else is written. All of the colour at once, then one component that depends on what it is.
void check_color_alone(const CombinerState& state, const HardwareProfile& profile, const RegisterBatch& first,
                       const std::vector<Fragment>& expected) {
  const Program program = normalize(state, profile);
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const std::size_t only = static_cast<std::size_t>(expected[0].color[0] & 3);
  std::array<bool, 4> one{};
  one[only] = true;
  for (const std::array<bool, 4>& wanted : {std::array{true, true, true, true}, one}) {
    const BatchProgram compiled(program, {.color = wanted});
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        batch->plane[r][c] = first.plane[r][c];
        if (!compiled.reads().contains(static_cast<Register>(r), static_cast<int>(c))) batch->plane[r][c].fill(0x5A5A);
      }
    }
    const auto before = batch->plane;
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      for (auto& plane : out->plane) plane.fill(0x5A5A);
      compiled.run(*batch, expected.size(), *out);
      bool is_right = batch->plane == before;
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
          is_right = is_right && out->plane[c][i] == (wanted[c] ? expected[i].color[c] : 0x5A5A);
        }
      }
      if (!is_right) {
        ADD_FAILURE() << "the colour without the registers on " << simd_target_name(target) << ", components "
                      << wanted[0] << wanted[1] << wanted[2] << wanted[3] << '\n'
                      << describe(state, profile) << compiled.describe();
      }
    }
  }
}

}  // namespace

std::vector<Fragment> judged(const CombinerState& state, const HardwareProfile& profile,
                             const std::vector<RegisterFile>& initial) {
  EXPECT_LE(initial.size(), kBatchSize);
  const std::vector<Fragment> expected = by_oracle(state, profile, initial);
  const Result<Program> program = compile(state, profile);
  if (!program) {
    ADD_FAILURE() << program.error().text() << '\n' << describe(state, profile);
    return expected;
  }
  // The target's name is made for a failure alone: millions of fragments pass.
  const auto check = [&](std::size_t i, const RegisterFile& registers, const Rgba9& color, const char* path,
                         std::int64_t target = 0) {
    if (registers == expected[i].registers && color == expected[i].color) return true;
    ADD_FAILURE() << path << (target != 0 ? simd_target_name(target) : "") << " differs from the oracle at fragment "
                  << i << '\n'
                  << describe(state, profile) << "initial registers:\n"
                  << describe(initial[i]) << "expected color " << describe(expected[i].color) << ", registers:\n"
                  << describe(expected[i].registers) << "actual color " << describe(color) << ", registers:\n"
                  << describe(registers);
    return false;
  };

  const bool integer = program->datapath.arithmetic == Arithmetic::integer;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const EvaluatedFragment whole = evaluate_fragment(*program, initial[i]);
    if (!check(i, whole.registers, whole.color, "evaluate_fragment")) return expected;
    // The other ways into the reference are the same rules, called one by one.
    if (i % 8 != 0) continue;
    RegisterFile registers = initial[i];
    evaluate_general(*program, registers);
    // In real numbers the final combiner needs more than the codes that evaluate_general leaves.
    const Rgba9 color = integer ? evaluate_final(*program, registers) : whole.color;
    if (!check(i, registers, color, "the reference")) return expected;
    if (evaluate(*program, initial[i]) != expected[i].color) ADD_FAILURE() << "evaluate() is not its two halves";
  }

  const auto first = std::make_unique<RegisterBatch>();
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      first->plane[r][c].fill(0);
      for (std::size_t i = 0; i < initial.size(); ++i) first->plane[r][c][i] = initial[i].value[r][c];
    }
  }
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const BatchProgram compiled(*program, {.registers = true});
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        std::copy_n(first->plane[r][c].begin(), initial.size(), batch->plane[r][c].begin());
      }
    }
    compiled.run(*batch, initial.size(), *out);
    if (chosen_at_run_time() && on_target.ran() != integer)
      ADD_FAILURE() << "wrongly dispatched on " << simd_target_name(target);
    for (std::size_t i = 0; i < initial.size(); ++i) {
      RegisterFile registers;
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers.value[r][c] = batch->plane[r][c][i];
      }
      const Rgba9 color{out->plane[0][i], out->plane[1][i], out->plane[2][i], out->plane[3][i]};
      if (!check(i, registers, color, "the batch evaluator on ", target)) return expected;
    }
    if (!integer) break;  // real numbers have no vectors
  }
  if (integer) check_color_alone(state, profile, *first, expected);
  return expected;
}

Fragment judged(const CombinerState& state, const HardwareProfile& profile, const RegisterFile& initial) {
  return judged(state, profile, std::vector<RegisterFile>{initial})[0];
}

}  // namespace ninebit::test
