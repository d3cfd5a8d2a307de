// The general combiners of a pixel shader, one after the other.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"
#include "src/language/pixel_shader/shader_stage.h"

namespace ninebit::detail {

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
