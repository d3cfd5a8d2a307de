#include "src/language/pixel_shader/shader_stages.h"

#include <array>
#include <optional>
#include <string>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_words.h"

namespace ninebit::detail {
namespace {

constexpr std::array kSignedInputs{&Portion::a, &Portion::b, &Portion::c, &Portion::d};

bool stage_writes(const ProgramStage& stage, Register reg, bool alpha) {
  const PortionOutput& rgb = stage.rgb.out;
  if (!alpha) return written_register(rgb) == reg;
  const bool raised = (rgb.ab == reg && rgb.ab_blue_to_alpha) || (rgb.cd == reg && rgb.cd_blue_to_alpha);
  return written_register(stage.alpha.out) == reg || raised;
}

// Whether an input is the weight of lrp, which is read without its sign anyway.
bool is_weight(const Portion& portion, std::size_t n) {
  if (portion.out.sum == Register::discard || portion.out.mux_sum) return false;
  const CombinerInput& in = portion.*kSignedInputs.at(n);
  if (in.mapping != InputMapping::unsigned_identity) return false;
  for (const CombinerInput Portion::*const one : kSignedInputs) {
    if (is_unit(portion.*one) || is_unit(portion.*one, true)) return false;  // mad
  }
  CombinerInput rest = in;
  rest.mapping = InputMapping::unsigned_invert;
  const std::size_t other = n < 2 ? 2 : 0;
  return portion.*kSignedInputs.at(other) == rest || portion.*kSignedInputs.at(other + 1) == rest;
}

}  // namespace

ReadSigns signs_of(std::span<const ProgramStage> stages, std::size_t i, Register reg, bool alpha) {
  ReadSigns out;
  for (std::size_t k = i + 1; k < stages.size(); ++k) {
    const ProgramStage& stage = stages[k];
    for (const Portion* const portion : {&stage.rgb, &stage.alpha}) {
      for (std::size_t n = 0; n < kSignedInputs.size(); ++n) {
        const CombinerInput& in = portion->*kSignedInputs.at(n);
        if (in.reg != reg || (in.usage == ComponentUsage::alpha) != alpha || is_weight(*portion, n)) continue;
        out.without = out.without || in.mapping == InputMapping::unsigned_identity;
        out.with = out.with || in.mapping == InputMapping::signed_identity || in.mapping == InputMapping::signed_negate;
      }
    }
    if (stage_writes(stage, reg, alpha)) break;
  }
  return out;
}

namespace {

bool stage_writes_rgb(const GeneralCombiner& stage, Register reg) {
  const PortionOutput& out = stage.rgb.out;
  return out.ab == reg || out.cd == reg || out.sum == reg;
}

bool stage_writes_alpha(const GeneralCombiner& stage, Register reg) {
  const PortionOutput &out = stage.alpha.out, &rgb = stage.rgb.out;
  return out.ab == reg || out.cd == reg || out.sum == reg || (rgb.ab == reg && rgb.ab_blue_to_alpha) ||
         (rgb.cd == reg && rgb.cd_blue_to_alpha);
}

// The alpha portion that writes a register's blue to the alpha of another one, or its own.
Portion alpha_from_blue(Register to, Register from) {
  Portion portion = empty_portion(PortionName::alpha);
  portion.a = {from, InputMapping::signed_identity, ComponentUsage::blue};
  portion.b = shader_one(PortionName::alpha);
  portion.out.ab = to;
  return portion;
}

}  // namespace

GeneralCombiner empty_shader_stage() {
  GeneralCombiner stage;
  stage.rgb = empty_portion(PortionName::rgb);
  stage.alpha = empty_portion(PortionName::alpha);
  return stage;
}

void ShaderStages::end(GeneralCombiner& stage) {
  for (std::size_t i = 0; i < kRegisterCount; ++i) {
    std::optional<Register>& source = context_.values.alpha_is_blue_of[i];
    const auto reg = static_cast<Register>(i);
    if (!source) continue;
    if (stage_writes_alpha(stage, reg)) {
      source.reset();
    } else if (stage_writes_rgb(stage, *source)) {
      write_alpha(stage, reg, *source);
      source.reset();
    }
  }
  add(stage);
}

void ShaderStages::write_alpha(GeneralCombiner& stage, Register to, Register from) {
  Portion& alpha = stage.alpha;
  const Portion written = alpha_from_blue(to, from);
  if (!is_live(alpha.out)) {
    alpha = written;
    return;
  }
  const bool has_room = alpha.out.cd == Register::discard && alpha.out.sum == Register::discard &&
                        alpha.out.scale == Scale::none && alpha.out.bias == Bias::none;
  if (has_room) {
    alpha.c = written.a;
    alpha.d = written.b;
    alpha.out.cd = to;
    return;
  }
  GeneralCombiner before = empty_shader_stage();
  before.alpha = written;
  add(before);
}

void ShaderStages::add(GeneralCombiner& stage) {
  if (own_constants_) {
    context_.constants.store(context_.text, true, stage.constant0, stage.constant1,
                             state_.origin.at(static_cast<std::size_t>(std::min(count_, kMaxGeneralCombiners))));
  }
  if (count_ == context_.profile.general_combiners) {
    if (!too_many_) {
      context_.faults.add(offset_,
                          "too many general combiners; profile " + std::string(context_.profile.name) + " has " +
                              std::to_string(count_) + ", and this instruction needs another",
                          GlError::invalid_value);
    }
    too_many_ = true;
    return;
  }
  state_.general.at(static_cast<std::size_t>(count_)) = stage;
  ++count_;
}

void ShaderStages::settle_spare0_alpha() {
  std::optional<Register>& source = context_.values.alpha_is_blue_of[index_of(Register::spare0)];
  if (!source) return;
  begin();
  GeneralCombiner stage = empty_shader_stage();
  stage.alpha = alpha_from_blue(Register::spare0, *source);
  source.reset();
  add(stage);
}

}  // namespace ninebit::detail
