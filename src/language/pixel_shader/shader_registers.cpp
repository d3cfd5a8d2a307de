// Which registers of the combiners hold the registers of a pixel shader, and what they hold.
#include <algorithm>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_stage.h"

namespace ninebit::detail {

ShaderRegisters::ShaderRegisters(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults)
    : text_(text), profile_(profile) {
  if (text.version.minor != 4) return;
  temporaries_.fill(Register::discard);
  place_loaded(faults);
  place_others(faults);
}

// ps.1.4 loads texture n into rn.
void ShaderRegisters::place_loaded(SourceFaults& faults) {
  bool computes = false;
  for (const ShaderInstruction& one : text_.instructions) {
    const bool loads =
        one.op() == ShaderOp::texture && one.targets[0].file == ShaderFile::temporary && one.text.size() > 4;
    if (one.op() == ShaderOp::bem) {
      faults.add(one.offset, "'bem' changes coordinates of textures: combiners run after all textures are read");
    }
    if (one.op() != ShaderOp::texture) {
      computes = computes || one.op() != ShaderOp::phase;
      continue;
    }
    const bool depends = std::any_of(one.operands.begin(), one.operands.end(),
                                     [](const ShaderOperand& o) { return o.file == ShaderFile::temporary; });
    if (depends && computes) {
      faults.add(one.offset, quoted(one.text) +
                                 " reads a texture at computed coordinates: combiners run after all textures are read");
    }
    if (!loads || one.row->name == "texkill") continue;
    const ShaderTarget& to = one.targets[0];
    if (to.index >= 4) {
      faults.add(to.offset, quoted(to.text) + " loads a fifth or sixth texture; combiners have four, for r0 to r3");
      continue;
    }
    temporaries_.at(static_cast<std::size_t>(to.index)) = texture_register(to.index);
  }
}

bool ShaderRegisters::is_free(Register reg) const {
  if (is_texture(reg) && texture_unit_of(reg) >= profile_.texture_units) return false;
  if (std::find(temporaries_.begin(), temporaries_.end(), reg) != temporaries_.end()) return false;
  const bool is_color = reg == Register::primary || reg == Register::secondary;
  if (!is_color) return true;
  const int index = reg == Register::primary ? 0 : 1;
  return std::none_of(text_.instructions.begin(), text_.instructions.end(), [&](const ShaderInstruction& one) {
    return std::any_of(one.operands.begin(), one.operands.end(),
                       [&](const ShaderOperand& o) { return o.file == ShaderFile::color && o.index == index; });
  });
}

void ShaderRegisters::place_others(SourceFaults& faults) {
  constexpr std::array kOrder{Register::spare0,   Register::spare1,   Register::secondary, Register::primary,
                              Register::texture3, Register::texture2, Register::texture1,  Register::texture0};
  const auto place = [&](std::size_t index, std::size_t offset) {
    Register& to = temporaries_.at(index);
    if (to != Register::discard) return;
    const auto* const free = std::find_if(kOrder.begin(), kOrder.end(), [&](Register r) { return is_free(r); });
    if (free == kOrder.end()) {
      faults.add(offset,
                 "profile " + std::string(profile_.name) + " has no register left for r" + std::to_string(index));
      to = Register::spare1;
      return;
    }
    to = *free;
  };
  place(0, 0);
  for (const ShaderInstruction& one : text_.instructions) {
    if (one.op() == ShaderOp::texture) continue;
    for (const ShaderTarget& target : one.targets) {
      if (target.file == ShaderFile::temporary) place(static_cast<std::size_t>(target.index), target.offset);
    }
    for (const ShaderOperand& operand : one.operands) {
      if (operand.file == ShaderFile::temporary) place(static_cast<std::size_t>(operand.index), operand.offset);
    }
  }
}

std::optional<Register> ShaderRegisters::find(ShaderFile file, int index) const {
  switch (file) {
    case ShaderFile::temporary:
      return temporaries_.at(static_cast<std::size_t>(index));
    case ShaderFile::texture:
      return index < 4 ? std::optional(texture_register(index)) : std::nullopt;
    case ShaderFile::color:
      return index == 0 ? Register::primary : Register::secondary;
    case ShaderFile::fog:
      return Register::fog;
    case ShaderFile::zero:
    case ShaderFile::one:
      return Register::zero;
    case ShaderFile::constant:
    case ShaderFile::sum:
    case ShaderFile::product:
    case ShaderFile::discard:
      break;
  }
  return std::nullopt;
}

bool ShaderRegisters::reads_alpha(const ShaderInstruction& by, std::size_t operand) {
  const ShaderOperand& from = by.operands[operand];
  if (from.selector != ShaderSelector::none) return from.selector == ShaderSelector::alpha;
  switch (by.op()) {
    case ShaderOp::xfc:
      return false;
    case ShaderOp::cnd:
      return operand == 0 || by.writes(true);
    case ShaderOp::dp3:
    case ShaderOp::xdd:
      return false;
    case ShaderOp::xdm:
      return operand >= 2 && by.writes(true);
    default:
      return by.writes(true);
  }
}

bool ShaderRegisters::reads_rgb(const ShaderInstruction& by, std::size_t operand) {
  const ShaderOperand& from = by.operands[operand];
  if (from.selector != ShaderSelector::none) return from.selector != ShaderSelector::alpha;
  const bool dot =
      by.op() == ShaderOp::dp3 || by.op() == ShaderOp::dp4 || by.op() == ShaderOp::xdd || by.op() == ShaderOp::xdm;
  if (by.op() == ShaderOp::xfc) return true;
  return dot || by.writes(false);
}

// Whether an instruction, one of textures included, names a register.
bool ShaderRegisters::is_named(Register reg) const {
  const auto names = [&](const auto& one) { return find(one.file, one.index) == reg; };
  return std::any_of(text_.instructions.begin(), text_.instructions.end(), [&](const ShaderInstruction& one) {
    return std::any_of(one.operands.begin(), one.operands.end(), names) ||
           std::any_of(one.targets.begin(), one.targets.end(), names);
  });
}

std::optional<Register> ShaderRegisters::take_free(const ShaderValues& values) {
  const auto& lent = values.alpha_is_blue_of;
  std::optional<Register> found;
  // Colours last: ps.1.1 cannot write them.
  for (const Register reg : {Register::spare1, Register::texture3, Register::texture2, Register::texture1,
                             Register::texture0, Register::secondary, Register::primary}) {
    const bool exists = !is_texture(reg) || texture_unit_of(reg) < profile_.texture_units;
    const bool is_taken = std::find(taken_.begin(), taken_.end(), reg) != taken_.end();
    if (!exists || is_taken || is_named(reg)) continue;
    const bool is_lent = std::find(lent.begin(), lent.end(), std::optional(reg)) != lent.end();
    if (!found || !is_lent) found = reg;
    if (!is_lent) break;
  }
  if (found) taken_.push_back(*found);
  return found;
}

bool ShaderRegisters::needs(Register reg, std::size_t first, bool alpha) const {
  if (std::find(taken_.begin(), taken_.end(), reg) != taken_.end()) return true;
  bool final = false;
  for (std::size_t i = first; i < text_.instructions.size(); ++i) {
    const ShaderInstruction& one = text_.instructions[i];
    if (one.op() == ShaderOp::texture) continue;
    final = final || one.op() == ShaderOp::xfc;
    for (std::size_t k = 0; k < one.operands.size(); ++k) {
      const ShaderOperand& from = one.operands[k];
      // The colour sum has the result and the secondary colour in it.
      const bool in_sum =
          from.file == ShaderFile::sum && !alpha && (reg == Register::spare0 || reg == Register::secondary);
      const bool same = find(from.file, from.index) == reg && (alpha ? reads_alpha(one, k) : reads_rgb(one, k));
      if (same || in_sum) return true;
    }
    for (const ShaderTarget& to : one.targets) {
      if (find(to.file, to.index) == reg && (alpha ? to.alpha : to.rgb)) return false;
    }
  }
  return !final && reg == result();
}

}  // namespace ninebit::detail
