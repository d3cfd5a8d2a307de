// The layout of a chip's register words. Bit 0 is the least significant.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/register_words.h"
#include "ninebit/numerics/codes.h"
#include "src/language/source/source_faults.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {
namespace words {

// The kinds of words. If a chip has several words of a kind, an index follows: the stage, or the constant (0 or 1) for
// `color`.
enum class Kind : std::uint8_t {
  in_alpha,      // variables A (bits 31..24), B, C, D (bits 7..0) of an alpha portion
  in_rgb,        // the same for an RGB portion
  out_alpha,     // outputs, scale and bias of an alpha portion
  out_rgb,       // the same for an RGB portion; on NV10, that of stage 1 also has the number of stages and the mux bit
  color,         // GL's global constant: of every stage on NV10, only of the final combiner on NV20
  stage_color0,  // NV20: a stage's constant 0; while "unique" is off, stage 0's is used by every stage
  stage_color1,
  final0,  // variables A, B, C, D of the final combiner
  final1,  // variables E, F, G (bits 15..8) and the flags of the colour sum
  enable   // NV20: number of stages, mux bit, "unique" flags of the constants
};
inline constexpr std::size_t kKinds = 10;

struct Slot {
  Kind kind = Kind::in_alpha;
  int index = 0;
};

// The number of words of a kind that a chip has; indices are less than that.
[[nodiscard]] int count_of(Kind kind, ChipClass chip);

// The number of general combiners of a chip.
[[nodiscard]] constexpr int stages_of(ChipClass chip) {
  return chip == ChipClass::nv10 ? 2 : 8;
}

// The envytools name: "RC_IN_RGB[0]", "RC_FINAL0".
[[nodiscard]] std::string canonical_name(Slot slot, ChipClass chip);

// A name in lower case, without the prefix of a class and without SET_.
[[nodiscard]] std::string bare_name(std::string_view name);

// The word of a name or an alias, case-insensitive; otherwise `fault` is the message.
struct FoundSlot {
  std::optional<Slot> slot{};
  std::string fault{};
};
[[nodiscard]] FoundSlot find_slot(std::string_view name, ChipClass chip);

// Whether a text begins like a struct that gdb printed: "$1 = {", or "{combiner_control = " of xemu's PshState.
[[nodiscard]] bool is_printed_struct(std::string_view text);

// Whether a text begins like a list of the NV2A's registers: "NV_PGRAPH_COMBINECTL<0x401940> (69889 <0x11101>)" of
// nv2a-trace, "NV_PGRAPH_COMBINECTL: 0x00011101" or "0x401940: 0x00011101".
[[nodiscard]] bool is_listed_register(std::string_view text);

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

// NV10, RC_OUT_RGB[1]; NV20, RC_ENABLE. The mux bit is 1 if the mux tests the most significant bit of spare0's alpha.
inline constexpr int kNv10MuxMsbBit = 27, kNv10CountShift = 28;
inline constexpr int kNv20CountShift = 0, kNv20MuxMsbBit = 8, kNv20Unique0Bit = 12, kNv20Unique1Bit = 16;

// RC_FINAL1.
inline constexpr int kSumInvertSpare0Bit = 5, kSumInvertSecondaryBit = 6, kColorSumClampBit = 7;

// The bits that a chip accepts in a word.
[[nodiscard]] std::uint32_t mask_of(Slot slot, ChipClass chip);

[[nodiscard]] constexpr std::uint32_t bits(std::uint32_t word, int low, int count) {
  return (word >> low) & ((1U << count) - 1U);
}

// What follows is in the part of C++ that src/combiner/c99/generate.py translates to C.

// The registers by their codes; code 0 is zero as an input and discard as an output. kReserved: no register has it.
inline constexpr Register kReserved = Register::discard;
inline constexpr std::array<Register, 16> kRegisters{
    Register::zero,      Register::constant0, Register::constant1, Register::fog,      Register::primary,
    Register::secondary, kReserved,           kReserved,           Register::texture0, Register::texture1,
    Register::texture2,  Register::texture3,  Register::spare0,    Register::spare1,   Register::spare0_plus_secondary,
    Register::e_times_f};

// Reads usage and mapping of the input whose byte begins at bit `low`. `scalar`: of an alpha portion or of variable G.
// The final combiner's words have only one bit of the mapping.
constexpr void read_input(std::uint32_t word, int low, bool scalar, int mapping_bits, CombinerInput& input) {
  input.usage = scalar ? ComponentUsage::blue : ComponentUsage::rgb;
  if (bits(word, low + kUsageBit, 1) != 0) input.usage = ComponentUsage::alpha;
  input.mapping = static_cast<InputMapping>(bits(word, low + kMappingShift, mapping_bits));
}

// Reads what an output word has besides registers.
constexpr void read_output(std::uint32_t word, bool rgb, bool has_blue_to_alpha, PortionOutput& out) {
  out.scale = static_cast<Scale>(bits(word, kScaleShift, 2));
  out.bias = static_cast<Bias>(bits(word, kBiasBit, 1));
  out.mux_sum = bits(word, kMuxBit, 1) != 0;
  out.ab_dot_product = rgb && bits(word, kAbDotBit, 1) != 0;
  out.cd_dot_product = rgb && bits(word, kCdDotBit, 1) != 0;
  out.ab_blue_to_alpha = rgb && has_blue_to_alpha && bits(word, kAbBlueToAlphaBit, 1) != 0;
  out.cd_blue_to_alpha = rgb && has_blue_to_alpha && bits(word, kCdBlueToAlphaBit, 1) != 0;
}

// Reads the flags of the final combiner's second word.
constexpr void read_final_flags(std::uint32_t word, CombinerState& state) {
  state.color_sum_invert_spare0 = bits(word, kSumInvertSpare0Bit, 1) != 0;
  state.color_sum_invert_secondary = bits(word, kSumInvertSecondaryBit, 1) != 0;
  state.color_sum_clamp = bits(word, kColorSumClampBit, 1) != 0;
}

// The NV2A outputs spare0 where both words of the final combiner are 0.
constexpr void leave_out_final_combiner(FinalCombiner& f) {
  f.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  f.g = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::alpha};
}

// Whether a portion has a mux. Without one in any stage that is used, the mux bit has no meaning.
constexpr bool has_mux(const PortionOutput& out) {
  return out.mux_sum && out.sum != Register::discard;
}

// The colour of a constant's word.
constexpr ColorF color_of(std::uint32_t argb) {
  ColorF color{};
  for (int i = 0; i < 4; ++i) {
    const int low = i == kAlpha ? 24 : 16 - 8 * i;
    color[static_cast<std::size_t>(i)] = static_cast<float>(bits(argb, low, 8)) / 255.0F;
  }
  return color;
}

// The register of a code. Empty: reserved.
[[nodiscard]] std::optional<Register> register_of(std::uint32_t code);
[[nodiscard]] std::uint32_t code_of(Register r);

// The error that OpenGL raises if the register of a code is in a kind of word that does not allow it; no_error: no
// register has the code.
[[nodiscard]] GlError error_of_misplaced(std::uint32_t code, Kind kind);

}  // namespace words
}  // namespace ninebit

// The words of the Xbox's pixel shader definition that combiners do not read, by all their names.

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {
namespace words {

// The name in kOtherWordNames of a name or an alias, case-insensitive and with any prefix; empty if it is none of them.
[[nodiscard]] std::string_view find_other_word(std::string_view name);

// Collects those of a text's words.
struct OtherWords {
  // Keeps a word that is one of them, under its own name; on NV10, and a second time, it is a fault. Returns whether it
  // is one.
  bool take(const RegisterWord& word, ChipClass chip, TextFaults& faults);

  std::vector<RegisterWord> found{};
};

}  // namespace words
}  // namespace ninebit
