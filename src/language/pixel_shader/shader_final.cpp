#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "src/language/pixel_shader/shader_stage.h"

namespace ninebit::detail {
namespace {

constexpr std::size_t kOfG = 6;

class FinalReader {
 public:
  FinalReader(ShaderContext& context, const ShaderInstruction& xfc) : context_(context), xfc_(xfc) {}

  [[nodiscard]] CombinerInput input(std::size_t i) {
    const ShaderOperand& from = xfc_.operands[i];
    const bool is_g = i == kOfG;
    CombinerInput out{.usage = is_g ? ComponentUsage::alpha : ComponentUsage::rgb};
    if (from.negate || (from.modifier != ShaderModifier::none && from.modifier != ShaderModifier::saturate)) {
      context_.faults.add(from.offset, "registers of xfc take no modifier but 1-x, found " + written(from));
      return out;
    }
    const bool inverts = from.invert != (from.file == ShaderFile::one);
    out.mapping = inverts ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
    out.usage = usage(from, is_g);
    if (const auto reg = place(from, i)) out.reg = *reg;
    const auto source = out.usage == ComponentUsage::alpha && out.reg < Register::e_times_f
                            ? context_.values.alpha_is_blue_of[index_of(out.reg)]
                            : std::nullopt;
    if (source) {
      out.reg = *source;
      out.usage = is_g ? ComponentUsage::blue : ComponentUsage::rgb;
    }
    return out;
  }

 private:
  static std::string written(const ShaderOperand& from) {
    const std::string name(from.text);
    return quoted((from.negate ? "-" : "") + name);
  }

  // The Xbox has one bit for rgb and blue. G has no rgb.
  ComponentUsage usage(const ShaderOperand& from, bool is_g) {
    switch (from.selector) {
      case ShaderSelector::none:
        return is_g ? ComponentUsage::blue : ComponentUsage::rgb;
      case ShaderSelector::alpha:
        return ComponentUsage::alpha;
      case ShaderSelector::rgb:
      case ShaderSelector::blue:
        return is_g ? ComponentUsage::blue : ComponentUsage::rgb;
      case ShaderSelector::red:
      case ShaderSelector::green:
        break;
    }
    context_.faults.add(from.offset, quoted(from.text) + ": combiners do not read red or green alone");
    return ComponentUsage::rgb;
  }

  std::optional<Register> place(const ShaderOperand& from, std::size_t i) {
    if (from.file == ShaderFile::sum || from.file == ShaderFile::product) {
      const bool sum = from.file == ShaderFile::sum;
      if (from.selector == ShaderSelector::alpha) {
        context_.faults.add(from.offset, quoted(from.text) + " has no alpha", GlError::invalid_operation);
        return std::nullopt;
      }
      if (i >= 4 || (sum && i == 0 && !swaps_sum())) {
        context_.faults.add(
            from.offset,
            quoted(from.text) + " can be read as " + (sum ? "B, C or D" : "A, B, C or D") + " of xfc alone",
            GlError::invalid_operation);
        return std::nullopt;
      }
      return sum ? Register::spare0_plus_secondary : Register::e_times_f;
    }
    if (from.file == ShaderFile::constant) {
      const auto reg = context_.constants.place(from.index);
      if (!reg)
        context_.faults.add(from.offset, quoted(from.text) + " is a third constant: the final combiner reads two");
      return reg;
    }
    const auto reg = context_.registers.find(from.file, from.index);
    if (reg && is_texture(*reg) && texture_unit_of(*reg) >= context_.profile.texture_units) {
      context_.faults.add(from.offset,
                          quoted(from.text) + " is beyond the " + std::to_string(context_.profile.texture_units.value) +
                              " texture units of profile " + std::string(context_.profile.name),
                          GlError::invalid_enum);
      return std::nullopt;
    }
    return reg;
  }

  // GL does not read the colour sum as A. Where C is zero, A and B can be swapped.
  [[nodiscard]] bool swaps_sum() const {
    const ShaderOperand &b = xfc_.operands[1], &c = xfc_.operands[2];
    return b.file != ShaderFile::sum && c.file == ShaderFile::zero && !c.invert;
  }

  ShaderContext& context_;
  const ShaderInstruction& xfc_;
};

}  // namespace

void translate_final(ShaderContext& context, const ShaderInstruction& xfc, FinalCombiner& out) {
  FinalReader reader(context, xfc);
  constexpr std::array kInputs{&FinalCombiner::a, &FinalCombiner::b, &FinalCombiner::c, &FinalCombiner::d,
                               &FinalCombiner::e, &FinalCombiner::f, &FinalCombiner::g};
  for (std::size_t i = 0; i < kInputs.size(); ++i) out.*kInputs.at(i) = reader.input(i);
  if (out.a.reg == Register::spare0_plus_secondary) std::swap(out.a, out.b);
}

FinalCombiner plain_final(const ShaderContext& context) {
  FinalCombiner out{};
  out.a = out.b = out.c = {};
  const Register result = context.registers.result();
  out.d = {result, InputMapping::unsigned_identity, ComponentUsage::rgb};
  out.g = {result, InputMapping::unsigned_identity, ComponentUsage::alpha};
  if (const auto source = context.values.alpha_is_blue_of[index_of(result)]) {
    out.g = {*source, InputMapping::unsigned_identity, ComponentUsage::blue};
  }
  return out;
}

}  // namespace ninebit::detail
