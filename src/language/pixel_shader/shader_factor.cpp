// Sources of a pixel shader as factors of general combiners.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_stage.h"

namespace ninebit::detail {
namespace {

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
    case ShaderModifier::other:
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

// What a constant holds for a component below 0: its negative, so that the nearest code is that of the component with
// halves up, as for those above 0. -0.5 is 127.5 255ths below 0, of which 127 is nearest so.
float negative_of(float component) {
  const float magnitude = std::clamp(-component, 0.0F, 1.0F) + 0.0F;
  const double codes = static_cast<double>(magnitude) * 255.0;
  const double whole = std::floor(codes);
  return codes - whole == 0.5 ? static_cast<float>(whole / 255.0) : magnitude;
}

}  // namespace

std::optional<InputMapping> negated_mapping(InputMapping mapping, Register reg) {
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

std::optional<Register> ShaderConstants::place(int index, ConstantPart part) {
  const Placed wanted{index, part};
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (placed_[i] && *placed_[i] != wanted) continue;
    placed_[i] = wanted;
    return i == 0 ? Register::constant0 : Register::constant1;
  }
  return std::nullopt;
}

void ShaderConstants::store(const ShaderText& text, bool own, ColorF& constant0, ColorF& constant1,
                            std::array<ConstantOrigin, 2>& origin) const {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (!placed_[i]) continue;
    const auto index = static_cast<std::size_t>(placed_[i]->index);
    const ShaderConstant& from = text.constants.at(index);
    const bool is_whole = placed_[i]->part == ConstantPart::whole;
    origin.at(i).unset = !from.defined;
    // A part has no name: who gives another value to c1 would have to give both.
    if (is_whole && (own || index != i)) origin.at(i).name = static_cast<ConstantName>(index);
    const bool negative =
        placed_[i]->part == ConstantPart::negative || (is_whole && is_negative(from) && !text.version.is_xbox);
    ColorF& to = i == 0 ? constant0 : constant1;
    for (std::size_t k = 0; k < to.size(); ++k) {
      to[k] = negative ? negative_of(from.color[k]) : std::clamp(from.color[k], 0.0F, 1.0F) + 0.0F;
    }
  }
}

bool is_negative(const ShaderConstant& constant) {
  const auto& color = constant.color;
  return std::all_of(color.begin(), color.end(), [](float c) { return c <= 0; }) &&
         std::any_of(color.begin(), color.end(), [](float c) { return c < 0; });
}

bool is_mixed(const ShaderConstant& constant) {
  const auto& color = constant.color;
  return std::any_of(color.begin(), color.end(), [](float c) { return c < 0; }) &&
         std::any_of(color.begin(), color.end(), [](float c) { return c > 0; });
}

std::optional<ComponentUsage> ShaderPortions::usage(const ShaderOperand& from, PortionName which) {
  const bool rgb = which == PortionName::rgb;
  switch (from.selector) {
    case ShaderSelector::none:
      return shader_usage(which);
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
    if (const auto& mixed = context_.mixed.at(static_cast<std::size_t>(from.index))) {
      return CombinerInput{*mixed, InputMapping::signed_identity, usage};
    }
    const auto reg = context_.constants.place(from.index);
    if (!reg) {
      const bool own = context_.profile.per_stage_constants;
      fault(from.offset,
            quoted(from.text) + " is a third constant: a general combiner reads two" +
                std::string(
                    own ? "" : ", and with profile " + std::string(context_.profile.name) + " all read the same two"));
      return std::nullopt;
    }
    return CombinerInput{*reg, InputMapping::signed_identity, usage};
  }
  Register reg = context_.registers.find(from.file, from.index).value_or(Register::zero);
  if (is_texture(reg) && texture_unit_of(reg) >= context_.profile.texture_units) {
    fault(from.offset,
          quoted(from.text) + " is beyond the " + std::to_string(context_.profile.texture_units.value) +
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
  if (from.file == ShaderFile::constant && !context_.text.version.is_xbox) {
    const ShaderConstant& constant = context_.text.constants.at(static_cast<std::size_t>(from.index));
    const bool negative = is_negative(constant);
    if ((negative || is_mixed(constant)) && (from.invert || from.modifier != ShaderModifier::none)) {
      fault(from.offset, quoted(from.text) + " is below 0, where combiners can only read it or its negative");
      return std::nullopt;
    }
    out.negate = out.negate != negative;
  }
  if (out.negate) {
    if (const auto mapping = negated_mapping(in.mapping, in.reg)) {
      in.mapping = *mapping;
      out.negate = false;
    }
  }
  return out;
}

}  // namespace ninebit::detail
