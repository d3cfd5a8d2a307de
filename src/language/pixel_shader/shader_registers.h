// Which registers of the combiners hold the registers of a pixel shader, and what they hold.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

// Known facts about the registers between two stages.
struct ShaderValues {
  // Whether a result was saturated: the register may hold less than 0, and means 0 then.
  std::array<bool, kRegisterCount> saturated_rgb{}, saturated_alpha{};
  // A register whose blue is the alpha that a register should have, but does not have yet.
  std::array<std::optional<Register>, kRegisterCount> alpha_is_blue_of{};
};

[[nodiscard]] constexpr std::size_t index_of(Register reg) {
  return static_cast<std::size_t>(reg);
}

class ShaderRegisters {
 public:
  // Gives each temporary register a place; reports those that have none.
  ShaderRegisters(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults);

  // The register that a source or destination names; nothing for those of the final combiner, constants and discard.
  [[nodiscard]] std::optional<Register> find(ShaderFile file, int index) const;
  // The register of the shader's result.
  [[nodiscard]] Register result() const { return temporaries_[0]; }
  // Whether an instruction from `first` on reads a register's alpha (or colour) before another one writes it.
  [[nodiscard]] bool needs_alpha(Register reg, std::size_t first) const { return needs(reg, first, true); }
  [[nodiscard]] bool needs_rgb(Register reg, std::size_t first) const { return needs(reg, first, false); }
  // Takes a register that no instruction reads or writes, for the rest of the shader, if possible one whose blue is no
  // other register's alpha. Empty: there is none.
  [[nodiscard]] std::optional<Register> take_free(const ShaderValues& values);
  // Whether a source's alpha is read by an instruction, and whether its colour is.
  [[nodiscard]] static bool reads_alpha(const ShaderInstruction& by, std::size_t operand);
  [[nodiscard]] static bool reads_rgb(const ShaderInstruction& by, std::size_t operand);

 private:
  void place_loaded(SourceFaults& faults);
  void place_others(SourceFaults& faults);
  [[nodiscard]] bool is_free(Register reg) const;
  [[nodiscard]] bool needs(Register reg, std::size_t first, bool alpha) const;
  [[nodiscard]] bool is_named(Register reg) const;

  const ShaderText& text_;
  const HardwareProfile& profile_;
  std::array<Register, 6> temporaries_{Register::spare0,  Register::spare1,  Register::discard,
                                       Register::discard, Register::discard, Register::discard};
  std::vector<Register> taken_{};  // by take_free()
};

}  // namespace ninebit::detail
