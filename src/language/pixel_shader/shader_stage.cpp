#include "src/language/pixel_shader/shader_stage.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "src/language/pixel_shader/shader_words.h"

namespace ninebit::detail {
Portion empty_portion(PortionName which) {
  Portion portion;
  portion.a = portion.b = portion.c =
      portion.d = {Register::zero, InputMapping::unsigned_identity, shader_usage(which)};
  portion.out.sum = Register::discard;
  return portion;
}

CombinerInput shader_one(PortionName which) {
  return {Register::zero, InputMapping::unsigned_invert, shader_usage(which)};
}

void ShaderPortions::fault(std::size_t offset, const std::string& message, GlError gl_error) {
  // Both portions may read the same sources.
  if (std::find(reported_.begin(), reported_.end(), offset) != reported_.end()) return;
  reported_.push_back(offset);
  context_.faults.add(offset, message, gl_error);
}

std::optional<ShaderFactor> ShaderPortions::source(std::size_t operand, PortionName which) {
  return factor(one_.operands[operand], which);
}

void ShaderPortions::multiply(Portion& portion, bool ab, std::optional<ShaderFactor> x, std::optional<ShaderFactor> y) {
  if (!x || !y) return;
  if (x->negate != y->negate) {
    ShaderFactor& other = x->negate ? *y : *x;
    const auto mapping = negated_mapping(other.input.mapping, other.input.reg);
    if (mapping) {
      // -1 of zero becomes 1 as it is written elsewhere.
      const bool minus_one = other.input.reg == Register::zero && other.input.mapping == InputMapping::expand_normal;
      other.input.mapping = minus_one ? InputMapping::unsigned_invert : *mapping;
    } else {
      fault(one_.offset, quoted(one_.text) +
                             " negates a register that was saturated, and combiners cannot; expected it without '-'");
    }
  }
  ++products_;
  const int twice = (x->doubled ? 1 : 0) + (y->doubled ? 1 : 0);
  if (products_ > 1 && twice != doubled_) {
    fault(one_.offset,
          quoted(one_.text) + " adds a register with _x2 to one without it; combiners scale only the result");
  }
  doubled_ = twice;
  (ab ? portion.a : portion.c) = x->input;
  (ab ? portion.b : portion.d) = y->input;
}

Register ShaderPortions::written(std::size_t target, PortionName which) const {
  const ShaderTarget& to = one_.targets[target];
  const bool here = which == PortionName::rgb ? to.rgb : to.alpha;
  return here ? context_.registers.find(to.file, to.index).value_or(Register::discard) : Register::discard;
}

// The scale of the instruction, and of its sources with _x2.
void ShaderPortions::scale(PortionOutput& out) {
  out.scale = one_.scale;
  out.bias = one_.bias;
  for (int i = 0; i < doubled_; ++i) {
    if (out.bias != Bias::none || out.scale == Scale::by_four) {
      fault(one_.offset, quoted(one_.text) + " scales by more than 4 with _x2 of its registers");
      return;
    }
    out.scale = out.scale == Scale::by_one_half ? Scale::none
                : out.scale == Scale::none      ? Scale::by_two
                                                : Scale::by_four;
  }
}

// A·B + C·(1 - A), in the order of the Xbox's assembler.
void ShaderPortions::interpolate(Portion& portion, PortionName which) {
  auto weight = source(0, which);
  if (!weight) return;
  const ShaderOperand& from = one_.operands[0];
  if ((from.modifier != ShaderModifier::none && from.modifier != ShaderModifier::saturate) || from.negate ||
      weight->negate || weight->input.mapping == InputMapping::signed_negate) {
    fault(from.offset, "the weight of lrp, " + quoted(from.text) + ", takes no modifier but 1-x");
    return;
  }
  if (from.file == ShaderFile::constant && context_.mixed.at(static_cast<std::size_t>(from.index))) {
    fault(from.offset, "the weight of lrp, " + quoted(from.text) + ", has values below 0, which lrp reads as 0");
    return;
  }
  const bool inverted = weight->input.mapping == InputMapping::unsigned_invert;
  const InputMapping same = InputMapping::unsigned_identity, other = InputMapping::unsigned_invert;
  weight->input.mapping = inverted ? other : same;
  auto rest = weight;
  rest->input.mapping = inverted ? same : other;
  multiply(portion, true, weight, source(1, which));
  multiply(portion, false, source(2, which), rest);
}

void ShaderPortions::check_distinct(const PortionOutput& out) {
  const auto same = [](Register a, Register b) { return a == b && a != Register::discard; };
  if (same(out.ab, out.cd) || same(out.ab, out.sum) || same(out.cd, out.sum)) {
    fault(one_.offset, quoted(one_.text) + " writes one register twice", GlError::invalid_operation);
  }
}

// xmma, xmmc, xdm, xdd
void ShaderPortions::combine(Portion& portion, PortionName which) {
  const bool rgb = which == PortionName::rgb;
  PortionOutput& out = portion.out;
  out.ab = written(0, which);
  out.cd = written(1, which);
  const bool dot_ab = one_.op() == ShaderOp::xdm || one_.op() == ShaderOp::xdd;
  const bool dot_cd = one_.op() == ShaderOp::xdd;
  if (one_.row->targets == 3) out.sum = written(2, which);
  out.mux_sum = one_.op() == ShaderOp::xmmc && out.sum != Register::discard;
  if (!rgb) {
    // Alpha portions have no dot product; blue goes to alpha, or is read for it.
    if (dot_ab) out.ab = Register::discard;
    if (dot_cd) out.cd = Register::discard;
  } else {
    out.ab_dot_product = dot_ab;
    out.cd_dot_product = dot_cd;
  }
  check_distinct(out);
  const bool third = out.sum != Register::discard;
  if (third || out.ab != Register::discard) multiply(portion, true, source(0, which), source(1, which));
  if (third || out.cd != Register::discard) {
    if (!third) products_ = doubled_ = 0;
    multiply(portion, false, source(2, which), source(3, which));
  }
}

void ShaderPortions::fill(Portion& portion, PortionName which) {
  PortionOutput& out = portion.out;
  const std::optional<ShaderFactor> one = ShaderFactor{.input = shader_one(which)};
  const Register to = written(0, which);
  switch (one_.op()) {
    case ShaderOp::mov:
      out.ab = to;
      return multiply(portion, true, source(0, which), one);
    case ShaderOp::mul:
    case ShaderOp::dp3:
      out.ab = to;
      out.ab_dot_product = one_.op() == ShaderOp::dp3;
      return multiply(portion, true, source(0, which), source(1, which));
    case ShaderOp::add:
    case ShaderOp::sub: {
      out.sum = to;
      ShaderFactor last = *one;
      if (one_.op() == ShaderOp::sub) last.input.mapping = InputMapping::expand_normal;  // of zero: -1
      multiply(portion, true, source(0, which), one);
      return multiply(portion, false, source(1, which), last);
    }
    case ShaderOp::mad:
      out.sum = to;
      multiply(portion, true, source(0, which), source(1, which));
      return multiply(portion, false, one, source(2, which));
    case ShaderOp::lrp:
      out.sum = to;
      return interpolate(portion, which);
    case ShaderOp::cnd:
    case ShaderOp::cmp:
      // A mux takes C·D where spare0's alpha is one half or more.
      out.sum = to;
      out.mux_sum = true;
      multiply(portion, true, source(2, which), one);
      return multiply(portion, false, source(1, which), one);
    default:
      return combine(portion, which);
  }
}

Portion ShaderPortions::build(PortionName which) {
  Portion portion = empty_portion(which);
  products_ = doubled_ = 0;
  const bool dot = one_.op() == ShaderOp::dp3;  // always in the rgb portion
  if (dot ? which == PortionName::alpha : !one_.writes(which == PortionName::alpha)) return portion;
  fill(portion, which);
  scale(portion.out);
  return portion;
}

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
