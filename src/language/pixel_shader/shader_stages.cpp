#include "src/language/pixel_shader/shader_stages.h"

#include <optional>
#include <string>

#include "ninebit/combiner/program.h"

namespace ninebit::detail {
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
