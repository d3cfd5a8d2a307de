// How registers of a program are read: with their sign or without.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/program.h"

namespace ninebit::detail {

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
