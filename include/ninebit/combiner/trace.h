// One fragment, every step: what each unit of the combiners read, made and wrote, with the exact numbers beside it.
//
// Every value stands here three ways:
//   - as the hardware holds it: a code (units of 1 / one) or a wide value (units of 1 / one²);
//   - `real`, the number that this is: code / one, or units / one²;
//   - `ideal`, what the same step gives in exact arithmetic, where nothing was narrowed in any earlier step either:
//     evaluate_real of the same program and registers, as the nearest double.
// Identities, exact in the first way: scaled = dropped + narrowed, and narrowed = cut + written.
//
// A program whose arithmetic is not integer holds real numbers instead of codes: `real` is what evaluate_real gives
// with that arithmetic, and codes and units are the nearest whole ones, halves up. Nothing is narrowed there: `dropped`
// is 0 and `narrowed` is `scaled`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A value that a register could hold, or nearly: the three ways, in units of one code.
struct TracedCode {
  int code = 0;      // units of 1 / one; between units not limited to the register range
  double real = 0;   // code / one
  double ideal = 0;  // the same in exact arithmetic
};

// A product, a sum, or what is left of them before narrowing: the three ways.
struct TracedWide {
  double units = 0;  // of 1 / one²: a whole number, or a half of one after a scale of one half; exact
  double real = 0;   // units / one²
  double ideal = 0;  // the same in exact arithmetic
};

// A variable in one channel.
struct TracedInput {
  CombinerInput from;    // as the program has it
  int component = kRed;  // of the register, that the channel reads
  TracedCode read;       // what stands there; `zero` and constants included
  TracedCode mapped;     // what the product sees
};

// One of a portion's three outputs in one channel.
struct TracedOutput {
  TracedWide wide;                  // the product, dot product, sum or mux choice
  TracedWide biased;                // with the bias
  std::optional<TracedCode> early;  // the biased value narrowed, in profiles that narrow before they scale
  TracedWide scaled;                // (wide + bias) · scale, exactly
  TracedWide dropped;               // what narrowing took away from that; `early` included. ideal: 0
  TracedCode narrowed;              // what it left
  TracedCode cut;                   // what the clamp to the register range took away from that
  TracedCode written;               // what it left
};

// A portion in one channel. Products without use are 0 and so are their variables.
struct TracedChannel {
  int component = kRed;               // of the registers, that is written
  std::array<TracedInput, 4> input;   // A to D
  TracedWide ab_product, cd_product;  // of this channel
  TracedWide ab, cd;                  // these or, with a dot product, the sum over the channels
  TracedWide third;                   // AB + CD or the mux's choice; 0 if it is discarded
  std::optional<TracedOutput> ab_output, cd_output, third_output;  // empty: discarded
};

// A general combiner's portion in all its channels.
struct TracedPortion {
  Portion state;                       // as the program has it
  bool uses_ab = false;                // whether an output takes the product AB
  bool uses_cd = false;                // likewise CD
  std::vector<TracedChannel> channel;  // red, green, blue, or alpha; none: the portion writes nothing
};

// Every register's components; `zero` and the constants stay as they were given, nothing reads them.
struct TracedRegisters {
  RegisterFile codes;   // as the hardware holds them
  RealRegisters real;   // what these codes are
  RealRegisters ideal;  // in exact arithmetic
};

// A general combiner: what it read, made and left.
struct TracedStage {
  TracedCode spare0_alpha;         // as it enters the stage; the muxes look at it
  bool mux_by_lowest_bit = false;  // whether they look at its lowest bit
  bool takes_cd = false;           // what a mux does: CD, because that is at least one half, or odd; or AB
  bool ideal_takes_cd = false;     // what it would do in exact arithmetic
  TracedPortion rgb, alpha;        // both read the registers as they entered the stage
  TracedRegisters after;           // with the stage's outputs
};

// The final combiner in red, green or blue.
struct TracedFinalChannel {
  std::array<TracedInput, 6> input;  // A to F
  TracedWide e_times_f_product;      // E·F, exactly
  TracedWide e_times_f_dropped;      // what narrowing took away from that
  TracedCode e_times_f;              // what it left
  TracedCode color_sum_unclamped;    // spare0 + secondary, or 1 - x of them
  TracedCode color_sum;              // the same, clamped if the program says so
  TracedWide a_times_b;              // A·B, exactly
  TracedWide one_minus_a_times_c;    // (1 - A)·C, exactly
  TracedWide mix;                    // A·B + (1 - A)·C
  TracedWide dropped;                // what narrowing took away from the mix
  TracedCode narrowed;               // what it left
  TracedCode sum;                    // narrowed + D
  TracedCode cut;                    // what the clamp to [0, 1] took away from the sum
  TracedCode written;                // what it left
};

// The final combiner in all its channels.
struct TracedFinal {
  bool uses_e_times_f = false;            // whether a variable reads E·F; if not, it is 0
  bool uses_color_sum = false;            // whether a variable reads spare0 + secondary; if not, it is 0
  std::array<TracedFinalChannel, 3> rgb;  // red, green, blue
  TracedInput g;                          // alpha
  TracedCode alpha_cut, alpha;            // G clamped to [0, 1]
};

// One fragment's way through a program.
struct Trace {
  TracedRegisters before;               // as the fragment brings them
  std::vector<TracedStage> stage;       // one for each general combiner
  TracedFinal final_combiner;           // what made the colour
  Rgba9 color{};                        // what leaves the combiners, codes in [0, one]
  std::array<std::uint8_t, 4> bytes{};  // and as which it goes to the fragment operations

  // The registers after the last general combiner.
  [[nodiscard]] const TracedRegisters& registers() const { return stage.empty() ? before : stage.back().after; }
};

// Runs a program over one fragment's registers, codes in [lowest, one], and keeps every step. `profile` is the one that
// the program was compiled for. The codes are those of evaluate_fragment, after each stage and at the end.
[[nodiscard]] Trace trace(const Program& program, const HardwareProfile& profile, const RegisterFile& initial);

}  // namespace ninebit
