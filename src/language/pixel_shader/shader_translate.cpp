#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_parser.h"
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

namespace {

class ShaderTranslator {
 public:
  ShaderTranslator(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults, SourceFaults& notes)
      : text_(text),
        profile_(profile),
        faults_(faults),
        context_{.text = text,
                 .profile = profile,
                 .faults = faults,
                 .notes = notes,
                 .registers = ShaderRegisters(text, profile, faults)},
        own_constants_(profile.per_stage_constants && (text.version.is_xbox || text.constants_read() > 2)),
        stages_(context_, state_, own_constants_, exceeds_version()) {}

  CombinerState translate() {
    const std::vector<ShaderInstruction>& all = text_.instructions;
    for (std::size_t i = 0; i < all.size() && !faults_.full();) {
      const bool pair = i + 1 < all.size() && all[i + 1].paired && all[i].is_arithmetic() && all[i + 1].is_arithmetic();
      const std::size_t next = i + (pair ? 2 : 1);
      if (all[i].op() == ShaderOp::xfc) {
        final_ = &all[i];
      } else if (all[i].is_arithmetic()) {
        group(all[i], pair ? &all[i + 1] : nullptr, next);
      }
      i = next;
    }
    finish();
    return state_;
  }

 private:
  // Whether Direct3D's own limit, of 8 instructions, is exceeded where the profile has as many.
  [[nodiscard]] bool exceeds_version() const {
    if (text_.version.is_xbox || text_.version.minor == 4 || profile_.general_combiners < kMaxGeneralCombiners)
      return false;
    return std::count_if(text_.instructions.begin(), text_.instructions.end(), [](const ShaderInstruction& one) {
             return one.op() != ShaderOp::texture && !one.paired;
           }) > kMaxGeneralCombiners;
  }

  // One stage, and what must come before it.
  void group(const ShaderInstruction& first, const ShaderInstruction* second, std::size_t next) {
    stages_.belongs_to(first.offset);
    if (!write_mixed_constants(first) || (second != nullptr && !write_mixed_constants(*second))) return;
    if (first.op() == ShaderOp::dp4) return dot_of_four(first, second);
    for (const ShaderInstruction* const one : {&first, second}) {
      if (one != nullptr && one->op() == ShaderOp::dp4) {
        faults_.add(one->offset, "dp4 needs two general combiners and cannot be joined to another instruction");
        return;
      }
    }
    for (const ShaderInstruction* const one : {&first, second}) {
      if (one != nullptr && !prepare_mux(*one, second != nullptr, next)) return;
    }
    stages_.begin();
    place_constants(first);
    if (second != nullptr) place_constants(*second);
    GeneralCombiner stage = empty_shader_stage();
    for (const ShaderInstruction* const one : {&first, second}) {
      if (one == nullptr) continue;
      ShaderPortions portions(context_, *one);
      if (one->writes(false) || one->op() == ShaderOp::dp3) stage.rgb = portions.build(PortionName::rgb);
      if (one->writes(true)) stage.alpha = portions.build(PortionName::alpha);
    }
    std::vector<std::pair<Register, Register>> late;  // alphas that are blue of another register
    for (const ShaderInstruction* const one : {&first, second}) {
      if (one != nullptr) dots(*one, second != nullptr, stage, next, late);
    }
    stages_.end(stage);
    for (const ShaderInstruction* const one : {&first, second}) {
      if (one != nullptr) note_saturation(*one);
    }
    for (const auto& [to, from] : late) context_.values.alpha_is_blue_of[index_of(to)] = from;
  }

  // Constants have their registers in the order of the text.
  void place_constants(const ShaderInstruction& one) {
    for (const ShaderOperand& from : one.operands) {
      if (from.file != ShaderFile::constant || context_.mixed.at(static_cast<std::size_t>(from.index))) continue;
      (void)context_.constants.place(from.index);
    }
  }

  // Before the first instruction that reads it: a constant with values below 0 and above 0 is the difference of two
  // constants of the combiners, in a register that is free. False: a fault.
  bool write_mixed_constants(const ShaderInstruction& one) {
    for (const ShaderOperand& from : one.operands) {
      if (from.file != ShaderFile::constant || text_.version.is_xbox) continue;
      const auto index = static_cast<std::size_t>(from.index);
      if (context_.mixed.at(index) || !is_mixed(text_.constants.at(index))) continue;
      stages_.begin();
      const auto above = context_.constants.place(from.index, ConstantPart::positive);
      const auto below = context_.constants.place(from.index, ConstantPart::negative);
      const auto reg = above && below ? context_.registers.take_free(context_.values) : std::nullopt;
      if (!reg) {
        const std::string missing = above && below ? "a register that the shader does not use, and there is none"
                                                   : "two constants of the combiners, which read no more than two";
        faults_.add(from.offset, quoted(from.text) + " has values below 0 and above 0, which takes " + missing +
                                     "; expected (x + 1) / 2, read as " + std::string(from.text) + "_bx2");
        return false;
      }
      GeneralCombiner stage = empty_shader_stage();
      for (const PortionName which : {PortionName::rgb, PortionName::alpha}) {
        Portion& portion = which == PortionName::rgb ? stage.rgb : stage.alpha;
        portion.a = {*above, InputMapping::signed_identity, shader_usage(which)};
        portion.b = portion.d = shader_one(which);
        portion.c = {*below, InputMapping::signed_negate, shader_usage(which)};
        portion.out.sum = *reg;
      }
      stages_.end(stage);
      // A saturated dot product may have been there before.
      context_.values.saturated_rgb[index_of(*reg)] = context_.values.saturated_alpha[index_of(*reg)] = false;
      context_.mixed.at(index) = reg;
    }
    return true;
  }

  // Dot products that go to alpha, too: alpha portions have none.
  void dots(const ShaderInstruction& one, bool is_paired, GeneralCombiner& stage, std::size_t next,
            std::vector<std::pair<Register, Register>>& late) {
    const bool dot_ab = one.op() == ShaderOp::dp3 || one.op() == ShaderOp::xdm || one.op() == ShaderOp::xdd;
    if (!dot_ab) return;
    const std::size_t count = one.op() == ShaderOp::xdd ? 2 : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const ShaderTarget& to = one.targets[i];
      const auto reg = context_.registers.find(to.file, to.index);
      if (!reg || !to.alpha) continue;
      if (!to.rgb) {
        dot_to_alpha(one, is_paired, stage, next, late);
      } else if (profile_.blue_to_alpha) {
        (i == 0 ? stage.rgb.out.ab_blue_to_alpha : stage.rgb.out.cd_blue_to_alpha) = true;
      } else {
        late.emplace_back(*reg, *reg);
      }
    }
  }

  // dp3 r0.a: the product goes to the colour of a register that nothing reads any more.
  void dot_to_alpha(const ShaderInstruction& one, bool is_paired, GeneralCombiner& stage, std::size_t next,
                    std::vector<std::pair<Register, Register>>& late) {
    if (is_paired || one.op() != ShaderOp::dp3) {
      faults_.add(one.offset,
                  quoted(one.text) +
                      " writes a dot product to .a alone; alpha portions have none, and the rgb portion is in use");
      return;
    }
    const Register to = context_.registers.find(one.targets[0].file, one.targets[0].index).value_or(Register::discard);
    const std::array free{to,
                          Register::spare1,
                          Register::secondary,
                          Register::primary,
                          Register::texture3,
                          Register::texture2,
                          Register::texture1,
                          Register::texture0,
                          Register::spare0};
    const auto* const found = std::find_if(free.begin(), free.end(), [&](Register reg) {
      const bool exists = !is_texture(reg) || texture_unit_of(reg) < profile_.texture_units;
      return exists && !context_.registers.needs_rgb(reg, next);
    });
    if (found == free.end()) {
      faults_.add(
          one.offset,
          quoted(one.text) + " writes a dot product to .a alone, for which another register's colour must be free");
      return;
    }
    stage.rgb.out.ab = dot_register_ = *found;
    if (profile_.blue_to_alpha && *found == to) {
      stage.rgb.out.ab_blue_to_alpha = true;
    } else {
      late.emplace_back(to, *found);
    }
  }

  void note_saturation(const ShaderInstruction& one) {
    const bool dot = one.op() == ShaderOp::dp3;
    for (const ShaderTarget& target : one.targets) {
      const auto reg = context_.registers.find(target.file, target.index);
      if (!reg) continue;
      if (target.rgb) context_.values.saturated_rgb[index_of(*reg)] = one.saturate;
      if (target.alpha) context_.values.saturated_alpha[index_of(*reg)] = one.saturate;
      // The alpha may be another register's blue.
      if (dot && target.alpha && !target.rgb) {
        context_.values.saturated_rgb[index_of(dot_register_)] = one.saturate;
      }
    }
  }

  // Before cnd and cmp: spare0's alpha becomes what the mux tests. False: a fault.
  bool prepare_mux(const ShaderInstruction& one, bool is_paired, std::size_t next) {
    const bool is_cmp = one.op() == ShaderOp::cmp;
    if (one.op() == ShaderOp::xmmc) {
      stages_.settle_spare0_alpha();
      return true;
    }
    if (one.op() != ShaderOp::cnd && !is_cmp) return true;
    const ShaderOperand& tested = one.operands[0];
    const bool whole = tested.selector == ShaderSelector::none;
    const bool is_spare0 = context_.registers.find(tested.file, tested.index) == Register::spare0;
    const bool scalar = tested.selector == ShaderSelector::alpha ||
                        (!one.writes(false) && tested.selector != ShaderSelector::rgb) ||
                        (text_.version.is_xbox && whole && is_spare0);
    const bool half = tested.modifier == ShaderModifier::bias || tested.modifier == ShaderModifier::expand;
    const bool as_it_is = is_spare0 && !tested.negate && !tested.invert &&
                          (is_cmp ? half : tested.modifier == ShaderModifier::none) &&
                          tested.selector != ShaderSelector::blue;
    if (scalar && as_it_is) {
      stages_.settle_spare0_alpha();
      return true;
    }
    if (text_.version.minor < 4 && !is_cmp) {
      faults_.add(tested.offset, "cnd tests r0.a in " + text_.version.name + ", found " + quoted(tested.text));
      return false;
    }
    if (!scalar) {
      faults_.add(tested.offset,
                  quoted(one.row->name) + " tests each component of " + quoted(tested.text) +
                      "; the mux of combiners tests spare0's alpha alone: expected one component, such as " +
                      std::string(tested.text) + ".a");
      return false;
    }
    return test(one, is_paired, next);
  }

  // A stage that writes what is tested to spare0's alpha, plus one half for cmp.
  bool test(const ShaderInstruction& one, bool is_paired, std::size_t next) {
    const bool reads = ShaderRegisters::reads_alpha(one, 1) || ShaderRegisters::reads_alpha(one, 2);
    const auto is_spare0 = [&](const ShaderOperand& from) {
      return context_.registers.find(from.file, from.index) == Register::spare0;
    };
    const bool own = reads && (is_spare0(one.operands[1]) || is_spare0(one.operands[2]));
    bool written = false;
    for (const ShaderTarget& to : one.targets) {
      written = written || (to.alpha && context_.registers.find(to.file, to.index) == Register::spare0);
    }
    if (is_paired || own || (!written && context_.registers.needs_alpha(Register::spare0, next))) {
      faults_.add(one.offset,
                  quoted(one.text) +
                      " needs spare0's alpha for its test, which holds a value that is still read; expected a "
                      "test of r0.a");
      return false;
    }
    ShaderOperand tested = one.operands[0];
    if (tested.selector == ShaderSelector::alpha) tested.selector = ShaderSelector::none;
    ShaderInstruction move{.offset = one.offset, .text = one.text, .row = one.row, .targets = one.targets};
    for (ShaderTarget& to : move.targets) to.rgb = false;
    ShaderPortions portions(context_, move);
    stages_.begin();
    GeneralCombiner stage = empty_shader_stage();
    Portion& alpha = stage.alpha;
    const ShaderFactor unit{.input = shader_one(PortionName::alpha)};
    portions.multiply(alpha, true, portions.factor(tested, PortionName::alpha), unit);
    if (one.op() == ShaderOp::cmp) {
      alpha.c = {Register::zero, InputMapping::half_bias_negate, ComponentUsage::alpha};
      alpha.d = shader_one(PortionName::alpha);
      alpha.out.sum = Register::spare0;
    } else {
      alpha.out.ab = Register::spare0;
    }
    stages_.end(stage);
    context_.values.saturated_alpha[index_of(Register::spare0)] = false;
    return true;
  }

  // The dot product of three components and the product of the fourth, then their sum.
  void dot_of_four(const ShaderInstruction& one, const ShaderInstruction* second) {
    const ShaderTarget& to = one.targets[0];
    if (second != nullptr || !to.rgb || !to.alpha) {
      faults_.add(one.offset,
                  "dp4 needs two general combiners, of which the first writes .rgb and .a; expected it alone, "
                  "with all components");
      return;
    }
    const Register reg = context_.registers.find(to.file, to.index).value_or(Register::discard);
    ShaderPortions portions(context_, one);
    stages_.begin();
    place_constants(one);
    GeneralCombiner products = empty_shader_stage();
    for (const PortionName which : {PortionName::rgb, PortionName::alpha}) {
      Portion& portion = which == PortionName::rgb ? products.rgb : products.alpha;
      portions.multiply(portion, true, portions.factor(one.operands[0], which),
                        portions.factor(one.operands[1], which));
      portion.out.ab = reg;
      portion.out.ab_dot_product = which == PortionName::rgb;
    }
    stages_.end(products);
    stages_.begin();
    GeneralCombiner sum = empty_shader_stage();
    for (const PortionName which : {PortionName::rgb, PortionName::alpha}) {
      Portion& portion = which == PortionName::rgb ? sum.rgb : sum.alpha;
      const ComponentUsage dot = which == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::blue;
      portion.a = {reg, InputMapping::signed_identity, dot};
      portion.c = {reg, InputMapping::signed_identity, ComponentUsage::alpha};
      portion.b = portion.d = shader_one(which);
      portion.out.sum = reg;
      portion.out.scale = one.scale;
    }
    stages_.end(sum);
    note_saturation(one);
  }

  void finish() {
    stages_.begin();
    if (final_ != nullptr) {
      translate_final(context_, *final_, state_.final_combiner);
    } else {
      state_.final_combiner = plain_final(context_);
    }
    std::array<ConstantOrigin, 2>& shared = state_.origin[kFinalConstants];
    context_.constants.store(text_, own_constants_, state_.constant0, state_.constant1, shared);
    state_.per_stage_constants = own_constants_;
    state_.num_general_combiners = std::max(stages_.count(), 1);
    if (stages_.count() == 0) state_.general[0] = empty_shader_stage();
    const ByConstant<bool> read = constants_read(state_);
    for (std::size_t place = 0; place <= kFinalConstants; ++place) {
      if (!own_constants_) state_.origin[place] = shared;
      for (std::size_t which = 0; which < 2; ++which) {
        if (!read[place][which]) state_.origin[place][which] = {};
      }
    }
  }

  const ShaderText& text_;
  const HardwareProfile& profile_;
  SourceFaults& faults_;
  ShaderContext context_;
  CombinerState state_;
  bool own_constants_;
  ShaderStages stages_;
  Register dot_register_ = Register::spare0;  // that holds a dot product for an alpha
  const ShaderInstruction* final_ = nullptr;
};

}  // namespace

CombinerState translate_shader(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults,
                               SourceFaults& notes) {
  return ShaderTranslator(text, profile, faults, notes).translate();
}

}  // namespace ninebit::detail
