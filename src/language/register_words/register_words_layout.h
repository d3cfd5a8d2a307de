// Where the register words of a chip keep what. Bits count from 0, the least significant.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/register_words.h"

// The JSON forms stand in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {
namespace words {

// The words that there are. An index follows where a chip has several: the stage, or the constant (0 or 1) for `color`.
enum class Kind : std::uint8_t {
  in_alpha,      // variables A (bits 31..24), B, C, D (bits 7..0) of an alpha portion
  in_rgb,        // the same of an RGB portion
  out_alpha,     // outputs, scale and bias of an alpha portion
  out_rgb,       // the same of an RGB portion; NV10 keeps the number of stages and the mux's bit in that of stage 1
  color,         // the constant that GL calls global: of every stage on NV10, of the final combiner alone on NV20
  stage_color0,  // NV20: a stage's constant 0; while "unique" is off, stage 0's is every stage's
  stage_color1,
  final0,  // variables A, B, C, D of the final combiner
  final1,  // variables E, F, G (bits 15..8) and the flags of the colour sum
  enable   // NV20: number of stages, the mux's bit, "unique" flags of the constants
};
inline constexpr std::size_t kKinds = 10;

struct Slot {
  Kind kind = Kind::in_alpha;
  int index = 0;
};

// How many words of a kind a chip has: the end of the index. 0: none.
[[nodiscard]] int count_of(Kind kind, ChipClass chip);

// General combiners of a chip.
[[nodiscard]] constexpr int stages_of(ChipClass chip) {
  return chip == ChipClass::nv10 ? 2 : 8;
}

// The envytools name: "RC_IN_RGB[0]", "RC_FINAL0".
[[nodiscard]] std::string canonical_name(Slot slot, ChipClass chip);

// The word of a name or an alias in either case; otherwise `fault` says what is wrong with it.
struct FoundSlot {
  std::optional<Slot> slot{};
  std::string fault{};
};
[[nodiscard]] FoundSlot find_slot(std::string_view name, ChipClass chip);

// "0x0badcafe".
[[nodiscard]] std::string hex_text(std::uint32_t value, int digits = 8);

// "bit 5", "bits 20 and 18", "bits 7, 4 and 3" of a mask that is not 0.
[[nodiscard]] std::string bits_text(std::uint32_t mask);

// An input is a byte: register in bits 3..0, component usage in bit 4 (1: alpha), mapping in bits 7..5.
inline constexpr int kUsageBit = 4, kMappingShift = 5;

// Outputs: CD in bits 3..0, AB in 7..4, sum in 11..8, then flags.
inline constexpr int kCdShift = 0, kAbShift = 4, kSumShift = 8;
inline constexpr int kCdDotBit = 12, kAbDotBit = 13, kMuxBit = 14, kBiasBit = 15, kScaleShift = 16;
inline constexpr int kCdBlueToAlphaBit = 18, kAbBlueToAlphaBit = 19;  // NV20, RGB portion

// NV10, RC_OUT_RGB[1]; NV20, RC_ENABLE. The mux's bit is 1 for the most significant of spare0's alpha.
inline constexpr int kNv10MuxMsbBit = 27, kNv10CountShift = 28;
inline constexpr int kNv20CountShift = 0, kNv20MuxMsbBit = 8, kNv20Unique0Bit = 12, kNv20Unique1Bit = 16;

// RC_FINAL1.
inline constexpr int kSumInvertSpare0Bit = 5, kSumInvertSecondaryBit = 6, kColorSumClampBit = 7;

// The bits that a chip accepts in a word.
[[nodiscard]] std::uint32_t mask_of(Slot slot, ChipClass chip);

[[nodiscard]] constexpr std::uint32_t bits(std::uint32_t word, int low, int count) {
  return (word >> low) & ((1U << count) - 1U);
}

// The register of a code; code 0 is zero as an input and discard as an output. Empty: reserved.
[[nodiscard]] std::optional<Register> register_of(std::uint32_t code);
[[nodiscard]] std::uint32_t code_of(Register r);

// What OpenGL raises where the register of a code stands in a kind of word that has no place for it; no_error: the code
// is no register's.
[[nodiscard]] GlError error_of_misplaced(std::uint32_t code, Kind kind);

}  // namespace words
}  // namespace ninebit
