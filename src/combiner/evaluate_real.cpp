#include "ninebit/combiner/evaluate_real.h"

#include "src/combiner/exact_field.h"
#include "src/combiner/real_rules.h"

namespace ninebit {
namespace {

// Runs the equations and reports every number as a double.
template <class Field>
class Recorder {
 public:
  explicit Recorder(const Program& program) : program_(program), field_(program.datapath.one), combiners_(field_) {}

  RealEvaluation run(const RegisterFile& initial) {
    Registers registers;
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) registers[r][c] = field_.of_code(initial.value[r][c]);
    }
    RealEvaluation result;
    result.before = reported(registers);
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      typename Combiners::Stage stage;
      combiners_.run_general(program_.general[static_cast<std::size_t>(i)], registers, stage);
      RealStage& to = result.stage.emplace_back();
      to.takes_cd = stage.takes_cd;
      for (std::size_t c = 0; c < 3; ++c) to.rgb[c] = reported(stage.channel[c]);
      to.alpha = reported(stage.channel[3]);
      to.after = reported(registers);
      to.codes = codes(registers, initial);
    }
    typename Combiners::Final last;
    combiners_.run_final(program_, registers, last);
    for (std::size_t v = 0; v < 6; ++v) result.final_combiner.input[v] = reported(last.steps.input[v]);
    result.final_combiner.g = field_.to_double(last.steps.g);
    result.final_combiner.e_times_f = reported(last.steps.e_times_f);
    result.final_combiner.color_sum = reported(last.steps.color_sum);
    result.final_combiner.unclamped = reported(last.unclamped);
    result.color = reported(last.steps.color);
    result.codes.registers = codes(registers, initial);
    result.codes.color = codes(last.steps.color);
    return result;
  }

 private:
  using Combiners = RealCombiners<Field>;
  using Registers = typename Combiners::Registers;

  RealColor reported(const typename Combiners::Color& color) {
    RealColor result{};
    for (std::size_t c = 0; c < 4; ++c) result[c] = field_.to_double(color[c]);
    return result;
  }
  RealRegisters reported(const Registers& registers) {
    RealRegisters result;
    for (std::size_t r = 0; r < kRegisterCount; ++r) result.value[r] = reported(registers[r]);
    return result;
  }
  using Channel = detail::ChannelSteps<typename Combiners::General>;
  RealOutput reported(const Channel& channel, std::size_t k) {
    return {field_.to_double(channel.wide[k]), field_.to_double(channel.output[k].scaled),
            field_.to_double(channel.output[k].written)};
  }
  RealChannel reported(const Channel& channel) {
    RealChannel result;
    for (std::size_t v = 0; v < 4; ++v) result.input[v] = field_.to_double(channel.input[v]);
    result.ab = reported(channel, 0);
    result.cd = reported(channel, 1);
    result.third = reported(channel, 2);
    return result;
  }
  Rgba9 codes(const typename Combiners::Color& color) {
    Rgba9 result{};
    for (std::size_t c = 0; c < 4; ++c) result[c] = static_cast<s9>(field_.nearest_code(color[c]));
    return result;
  }

  // `zero` and the constants are unchanged.
  RegisterFile codes(const Registers& registers, const RegisterFile& initial) {
    RegisterFile result;
    for (std::size_t r = 0; r < kRegisterCount; ++r) result.value[r] = codes(registers[r]);
    for (const Register r : {Register::zero, Register::constant0, Register::constant1}) result[r] = initial[r];
    return result;
  }

  const Program& program_;
  Field field_;
  Combiners combiners_;
};

}  // namespace

RealEvaluation evaluate_real(const Program& program, const RegisterFile& initial, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::float32) return Recorder<FloatField>(program).run(initial);
  return Recorder<ExactField<BigIntegers>>(program).run(initial);
}

}  // namespace ninebit
