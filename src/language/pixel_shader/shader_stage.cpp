#include "src/language/pixel_shader/shader_stage.h"

#include <algorithm>
#include <utility>

namespace ninebit::detail {
namespace {

constexpr ComponentUsage plain_usage_of(PortionName which) {
  return which == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
}

// The mapping of -x; empty: combiners have none.
std::optional<InputMapping> negated(InputMapping mapping, Register reg) {
  switch (mapping) {
    case InputMapping::signed_identity:
      return InputMapping::signed_negate;
    case InputMapping::signed_negate:
      return InputMapping::signed_identity;
    case InputMapping::expand_normal:
      return InputMapping::expand_negate;
    case InputMapping::expand_negate:
      return InputMapping::expand_normal;
    case InputMapping::half_bias_normal:
      return InputMapping::half_bias_negate;
    case InputMapping::half_bias_negate:
      return InputMapping::half_bias_normal;
    case InputMapping::unsigned_invert:  // 1 of zero
      return reg == Register::zero ? std::optional(InputMapping::expand_normal) : std::nullopt;
    case InputMapping::unsigned_identity:
      return reg == Register::zero ? std::optional(mapping) : std::nullopt;
  }
  return std::nullopt;
}

// The mapping of a source that is neither negated nor inverted.
InputMapping mapping_of(ShaderModifier modifier, bool saturated) {
  switch (modifier) {
    case ShaderModifier::bias:
      return InputMapping::half_bias_normal;
    case ShaderModifier::expand:
      return InputMapping::expand_normal;
    case ShaderModifier::saturate:
      return InputMapping::unsigned_identity;
    case ShaderModifier::none:
    case ShaderModifier::by_two:
      break;
  }
  return saturated ? InputMapping::unsigned_identity : InputMapping::signed_identity;
}

// The mapping of zero that gives what `mapping` makes of 1.
InputMapping mapping_of_one(const ShaderOperand& from) {
  if (from.invert) return InputMapping::unsigned_identity;
  if (from.modifier == ShaderModifier::bias) return InputMapping::half_bias_negate;
  return InputMapping::unsigned_invert;
}

}  // namespace

std::optional<Register> ShaderConstants::place(int index) {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (placed_[i] && *placed_[i] != index) continue;
    placed_[i] = index;
    return i == 0 ? Register::constant0 : Register::constant1;
  }
  return std::nullopt;
}

void ShaderConstants::store(const ShaderText& text, ColorF& constant0, ColorF& constant1) const {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (!placed_[i]) continue;
    const ShaderConstant& from = text.constants.at(static_cast<std::size_t>(*placed_[i]));
    const float sign = is_negative(from) && !text.version.is_xbox ? -1.0F : 1.0F;
    ColorF& to = i == 0 ? constant0 : constant1;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = std::clamp(sign * from.color[k], 0.0F, 1.0F) + 0.0F;
  }
}

bool is_negative(const ShaderConstant& constant) {
  const auto& color = constant.color;
  return std::all_of(color.begin(), color.end(), [](float c) { return c <= 0; }) &&
         std::any_of(color.begin(), color.end(), [](float c) { return c < 0; });
}

Portion empty_portion(PortionName which) {
  Portion portion;
  portion.a = portion.b = portion.c = portion.d = {Register::zero, InputMapping::unsigned_identity,
                                                   plain_usage_of(which)};
  portion.out.sum = Register::discard;
  return portion;
}

CombinerInput shader_one(PortionName which) {
  return {Register::zero, InputMapping::unsigned_invert, plain_usage_of(which)};
}

void ShaderPortions::fault(std::size_t offset, const std::string& message, GlError gl_error) {
  // Both portions may read the same sources.
  if (std::find(reported_.begin(), reported_.end(), offset) != reported_.end()) return;
  reported_.push_back(offset);
  context_.faults.add(offset, message, gl_error);
}

std::optional<ComponentUsage> ShaderPortions::usage(const ShaderOperand& from, PortionName which) {
  const bool rgb = which == PortionName::rgb;
  switch (from.selector) {
    case ShaderSelector::none:
      return plain_usage_of(which);
    case ShaderSelector::rgb:
      return rgb ? ComponentUsage::rgb : ComponentUsage::blue;
    case ShaderSelector::alpha:
      return ComponentUsage::alpha;
    case ShaderSelector::blue:
      if (!rgb) return ComponentUsage::blue;
      // The Xbox's assembler has one bit for both.
      if (context_.text.version.is_xbox) return ComponentUsage::rgb;
      fault(from.offset, quoted(from.text) + ".b: combiners read blue alone only where .a is written");
      return std::nullopt;
    case ShaderSelector::red:
    case ShaderSelector::green:
      break;
  }
  fault(from.offset, quoted(from.text) + ": combiners do not read red or green alone; expected .rgb, .a or .b");
  return std::nullopt;
}

std::optional<CombinerInput> ShaderPortions::place(const ShaderOperand& from, ComponentUsage usage, PortionName which) {
  if (from.file == ShaderFile::sum || from.file == ShaderFile::product) {
    fault(from.offset, quoted(from.text) + " can be read by xfc alone", GlError::invalid_enum);
    return std::nullopt;
  }
  if (from.file == ShaderFile::constant) {
    const ShaderConstant& constant = context_.text.constants.at(static_cast<std::size_t>(from.index));
    const bool below = std::any_of(constant.color.begin(), constant.color.end(), [](float c) { return c < 0; });
    if (below && !is_negative(constant) && !context_.text.version.is_xbox) {
      fault(from.offset, quoted(from.text) + " has values below 0 and above 0, and constants of combiners have none below 0; "
                                             "expected (x + 1) / 2, read as " + std::string(from.text) + "_bx2");
      return std::nullopt;
    }
    const auto reg = context_.constants.place(from.index);
    if (!reg) {
      const bool own = context_.profile.per_stage_constants;
      fault(from.offset, quoted(from.text) + " is a third constant: a general combiner reads two" +
                             std::string(own ? "" : ", and with profile " + std::string(context_.profile.name) +
                                                        " all read the same two"));
      return std::nullopt;
    }
    return CombinerInput{*reg, InputMapping::signed_identity, usage};
  }
  Register reg = context_.registers.find(from.file, from.index).value_or(Register::zero);
  if (is_texture(reg) && texture_unit_of(reg) >= context_.profile.texture_units) {
    fault(from.offset, quoted(from.text) + " is beyond the " + std::to_string(context_.profile.texture_units.value) +
                           " texture units of profile " + std::string(context_.profile.name),
          GlError::invalid_enum);
    return std::nullopt;
  }
  if (reg == Register::fog && usage == ComponentUsage::alpha) {
    fault(from.offset, "fog's alpha can be read by xfc alone", GlError::invalid_operation);
    return std::nullopt;
  }
  const auto source = usage == ComponentUsage::alpha ? context_.values.alpha_is_blue_of[index_of(reg)] : std::nullopt;
  if (source) {
    reg = *source;
    usage = which == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::blue;
  }
  return CombinerInput{reg, InputMapping::signed_identity, usage};
}

std::optional<ShaderFactor> ShaderPortions::factor(const ShaderOperand& from, PortionName which) {
  const auto components = usage(from, which);
  if (!components) return std::nullopt;
  const auto input = place(from, *components, which);
  if (!input) return std::nullopt;
  ShaderFactor out{.input = *input, .negate = from.negate, .doubled = from.modifier == ShaderModifier::by_two};
  CombinerInput& in = out.input;
  if (from.file == ShaderFile::one) {
    in.mapping = mapping_of_one(from);
  } else if (from.invert) {
    in.mapping = InputMapping::unsigned_invert;
  } else {
    const bool alpha = in.usage == ComponentUsage::alpha;
    const auto& saturated = alpha ? context_.values.saturated_alpha : context_.values.saturated_rgb;
    in.mapping = mapping_of(from.modifier, saturated[index_of(in.reg)]);
  }
  if (from.file == ShaderFile::constant && !context_.text.version.is_xbox &&
      is_negative(context_.text.constants.at(static_cast<std::size_t>(from.index)))) {
    if (from.invert || from.modifier != ShaderModifier::none) {
      fault(from.offset, quoted(from.text) + " is below 0, where combiners can only read it or its negative");
      return std::nullopt;
    }
    out.negate = !out.negate;
  }
  if (out.negate) {
    if (const auto mapping = negated(in.mapping, in.reg)) {
      in.mapping = *mapping;
      out.negate = false;
    }
  }
  return out;
}

std::optional<ShaderFactor> ShaderPortions::source(std::size_t operand, PortionName which) {
  return factor(one_.operands[operand], which);
}

void ShaderPortions::multiply(Portion& portion, bool ab, std::optional<ShaderFactor> x, std::optional<ShaderFactor> y) {
  if (!x || !y) return;
  if (x->negate != y->negate) {
    ShaderFactor& other = x->negate ? *y : *x;
    const auto mapping = negated(other.input.mapping, other.input.reg);
    if (mapping) {
      other.input.mapping = *mapping;
    } else {
      fault(one_.offset, quoted(one_.text) + " negates a register that was saturated, and combiners cannot; expected it without '-'");
    }
  }
  ++products_;
  const int twice = (x->doubled ? 1 : 0) + (y->doubled ? 1 : 0);
  if (products_ > 1 && twice != doubled_) {
    fault(one_.offset, quoted(one_.text) + " adds a register with _x2 to one without it; combiners scale only the result");
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

// A·B + (1 - A)·C
void ShaderPortions::interpolate(Portion& portion, PortionName which) {
  auto weight = source(0, which);
  if (!weight) return;
  const ShaderOperand& from = one_.operands[0];
  if ((from.modifier != ShaderModifier::none && from.modifier != ShaderModifier::saturate) || from.negate || weight->negate ||
      weight->input.mapping == InputMapping::signed_negate) {
    fault(from.offset, "the weight of lrp, " + quoted(from.text) + ", takes no modifier but 1-x");
    return;
  }
  const bool inverted = weight->input.mapping == InputMapping::unsigned_invert;
  const InputMapping same = InputMapping::unsigned_identity, other = InputMapping::unsigned_invert;
  weight->input.mapping = inverted ? other : same;
  auto rest = weight;
  rest->input.mapping = inverted ? same : other;
  multiply(portion, true, weight, source(1, which));
  multiply(portion, false, rest, source(2, which));
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
      ShaderOperand second = one_.operands[1];
      const bool minus = one_.op() == ShaderOp::sub;
      auto added = factor(second, which);
      if (added && minus) {
        const auto mapping = negated(added->input.mapping, added->input.reg);
        if (mapping && !added->negate) {
          added->input.mapping = *mapping;
        } else {
          added->negate = !added->negate;
        }
      }
      multiply(portion, true, source(0, which), one);
      return multiply(portion, false, added, one);
    }
    case ShaderOp::mad:
      out.sum = to;
      multiply(portion, true, source(0, which), source(1, which));
      return multiply(portion, false, source(2, which), one);
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

}  // namespace ninebit::detail
