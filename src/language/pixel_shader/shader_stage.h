// Instructions of a pixel shader as portions of general combiners, one stage after the other.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

// Which registers of the combiners hold the registers of a pixel shader, and what they hold.

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

// What a combiner's constant holds of a shader's: all of it, its components above 0, or the negatives of those below 0.
enum class ConstantPart : std::uint8_t { whole, positive, negative };

// The two constants that a stage can read, or all stages together.
class ShaderConstants {
 public:
  // The register of a shader's constant; empty: both hold others.
  [[nodiscard]] std::optional<Register> place(int index, ConstantPart part = ConstantPart::whole);
  // The constants, as far as the text defines them, and what it says of them. `own`: they are a stage's own.
  void store(const ShaderText& text, bool own, ColorF& constant0, ColorF& constant1,
             std::array<ConstantOrigin, 2>& origin) const;
  void clear() { placed_ = {}; }

 private:
  struct Placed {
    int index = 0;
    ConstantPart part = ConstantPart::whole;
    friend bool operator==(const Placed&, const Placed&) = default;
  };
  std::array<std::optional<Placed>, 2> placed_{};
};

// A source as a factor.
struct ShaderFactor {
  CombinerInput input{};
  bool negate = false;   // its mapping has no negative; the other factor must have it
  bool doubled = false;  // _x2, which the scale must do
};

// Whether a constant is stored as its negative: no component is above 0, and one is below.
[[nodiscard]] bool is_negative(const ShaderConstant& constant);

// State that all stages of a shader share.
struct ShaderContext {
  const ShaderText& text;
  const HardwareProfile& profile;
  SourceFaults& faults;
  SourceFaults& notes;
  ShaderRegisters registers;
  ShaderValues values{};
  ShaderConstants constants{};
  // The registers of constants with mixed signs, as soon as a stage has written them.
  std::array<std::optional<Register>, kShaderConstants> mixed{};
};

// Builds the portions of one instruction. Faults of a source that both portions read are reported once.
class ShaderPortions {
 public:
  ShaderPortions(ShaderContext& context, const ShaderInstruction& instruction) : context_(context), one_(instruction) {}

  // The portion of the instruction; one that it does not write is empty.
  [[nodiscard]] Portion build(PortionName which);
  // A source in a portion; without a value there is a fault.
  [[nodiscard]] std::optional<ShaderFactor> factor(const ShaderOperand& from, PortionName which);
  // Makes A·B (or C·D) of a portion. Without a second factor it is 1.
  void multiply(Portion& portion, bool ab, std::optional<ShaderFactor> x, std::optional<ShaderFactor> y);

 private:
  void fill(Portion& portion, PortionName which);
  void interpolate(Portion& portion, PortionName which);
  void combine(Portion& portion, PortionName which);
  void scale(PortionOutput& out);
  void check_distinct(const PortionOutput& out);
  [[nodiscard]] std::optional<ShaderFactor> source(std::size_t operand, PortionName which);
  [[nodiscard]] std::optional<ComponentUsage> usage(const ShaderOperand& from, PortionName which);
  [[nodiscard]] std::optional<CombinerInput> place(const ShaderOperand& from, ComponentUsage usage, PortionName which);
  [[nodiscard]] Register written(std::size_t target, PortionName which) const;
  void fault(std::size_t offset, const std::string& message, GlError gl_error = GlError::no_error);

  ShaderContext& context_;
  const ShaderInstruction& one_;
  int doubled_ = 0, products_ = 0;
  std::vector<std::size_t> reported_;  // places of faults
};

// The mapping of -x; empty: combiners have none. `reg` may be zero, of which 1 - x is 1.
[[nodiscard]] std::optional<InputMapping> negated_mapping(InputMapping mapping, Register reg);
// The components that a portion writes.
[[nodiscard]] constexpr ComponentUsage shader_usage(PortionName which) {
  return which == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
}
// An empty portion: it reads zero and writes nothing.
[[nodiscard]] Portion empty_portion(PortionName which);
// The constant 1 in a portion.
[[nodiscard]] CombinerInput shader_one(PortionName which);

// The final combiner of a shader that ends with xfc, and of one that does not.
void translate_final(ShaderContext& context, const ShaderInstruction& xfc, FinalCombiner& out);
[[nodiscard]] FinalCombiner plain_final(const ShaderContext& context);

// The general combiners of a shader.

// Portions that read zero and write nothing.
[[nodiscard]] GeneralCombiner empty_shader_stage();

class ShaderStages {
 public:
  // `own_constants`: each stage has two constants of its own. `limit_reported`: too many stages were reported before.
  ShaderStages(ShaderContext& context, CombinerState& state, bool own_constants, bool limit_reported)
      : context_(context), state_(state), own_constants_(own_constants), too_many_(limit_reported) {}

  // The instruction that the next stages belong to.
  void belongs_to(std::size_t offset) { offset_ = offset; }
  // Before the sources of a stage are placed.
  void begin() {
    if (own_constants_) context_.constants.clear();
  }
  // Adds a stage; alphas that would be lost are written by its alpha portion, or by a stage before.
  void end(GeneralCombiner& stage);
  // Writes spare0's alpha, if it is another register's blue: a mux reads it itself.
  void settle_spare0_alpha();
  [[nodiscard]] int count() const { return count_; }

 private:
  void write_alpha(GeneralCombiner& stage, Register to, Register from);
  void add(GeneralCombiner& stage);

  ShaderContext& context_;
  CombinerState& state_;
  bool own_constants_, too_many_;
  int count_ = 0;
  std::size_t offset_ = 0;
};

// How registers of a program are read: with their sign or without.

// The one register that a portion writes; discard: none.
[[nodiscard]] constexpr Register written_register(const PortionOutput& out) {
  return out.ab != Register::discard ? out.ab : out.cd != Register::discard ? out.cd : out.sum;
}

struct ReadSigns {
  bool without = false;  // as unsigned_identity
  bool with = false;     // as signed_identity or signed_negate
};
// How the colour or alpha that stage `i` writes to a register is read, until another stage writes it. The weights of
// lrp, which are read without their sign anyway, do not count.
[[nodiscard]] ReadSigns signs_of(std::span<const ProgramStage> stages, std::size_t i, Register reg, bool alpha);

}  // namespace ninebit::detail
