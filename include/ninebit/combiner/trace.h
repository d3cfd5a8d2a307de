// Every step of one fragment: what each unit of the combiners read, computed and wrote, with the exact numbers.
//
// Every value is given three ways:
//   - as the hardware holds it: a code (units of 1 / one) or a wide value (units of 1 / one²);
//   - `real`, the number of that code or wide value: code / one, or units / one²;
//   - `ideal`, the result of the same step in exact arithmetic, without narrowing in any earlier step: evaluate_real of
//     the same program and registers, as the nearest double.
// These identities are exact in codes: scaled = dropped + narrowed, and narrowed = cut + written.
//
// A program whose arithmetic is not integer computes real numbers instead of codes: `real` is the result of
// evaluate_real with that arithmetic, and codes and units are the nearest whole ones, halves up. Nothing is narrowed
// there: `dropped` is 0 and `narrowed` is `scaled`.
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

// A value in units of one code, the three ways.
struct TracedCode {
  int code = 0;      // units of 1 / one; between units not limited to the register range
  double real = 0;   // code / one
  double ideal = 0;  // the same in exact arithmetic
};

// A product, a sum, or a scaled sum before narrowing, the three ways.
struct TracedWide {
  double units = 0;  // of 1 / one²: a whole number, or a half of one after a scale of one half; exact
  double real = 0;   // units / one²
  double ideal = 0;  // the same in exact arithmetic
};

// A variable in one channel.
struct TracedInput {
  CombinerInput from;    // as the program has it
  int component = kRed;  // the register's component that the channel reads
  TracedCode read;       // its value; `zero` and constants included
  TracedCode mapped;     // the factor of the product
};

// One of a portion's three outputs in one channel.
struct TracedOutput {
  TracedWide wide;                  // the product, dot product, sum or mux choice
  TracedWide biased;                // with the bias
  std::optional<TracedCode> early;  // the biased value narrowed, in profiles that narrow before they scale
  TracedWide scaled;                // (wide + bias) · scale, exactly
  TracedWide dropped;               // scaled - narrowed, the part lost by narrowing, `early` included. ideal: 0
  TracedCode narrowed;              // what it left
  TracedCode cut;                   // narrowed - written, the part lost by the clamp to the register range
  TracedCode written;               // what it left
};

// A portion in one channel. Products that are not used are 0, and so are their variables.
struct TracedChannel {
  int component = kRed;               // the component of the registers that it writes
  std::array<TracedInput, 4> input;   // A to D
  TracedWide ab_product, cd_product;  // of this channel
  TracedWide ab, cd;                  // these or, with a dot product, the sum over the channels
  TracedWide third;                   // AB + CD or the mux's choice; 0 if it is discarded
  std::optional<TracedOutput> ab_output, cd_output, third_output;  // empty: discarded
};

// A general combiner's portion in all its channels.
struct TracedPortion {
  Portion state;                       // as the program has it
  bool uses_ab = false;                // whether an output uses the product AB
  bool uses_cd = false;                // whether an output uses the product CD
  std::vector<TracedChannel> channel;  // red, green, blue, or alpha; none: the portion writes nothing
};

// All registers. `zero` and the constants stay as given; nothing reads them.
struct TracedRegisters {
  RegisterFile codes;   // as in the hardware
  RealRegisters real;   // the numbers of these codes
  RealRegisters ideal;  // in exact arithmetic
};

// A general combiner: what it read, computed and wrote.
struct TracedStage {
  TracedCode spare0_alpha;         // as it enters the stage; the muxes test it
  bool mux_by_lowest_bit = false;  // whether they test its lowest bit
  bool takes_cd = false;           // a mux's choice: CD, because spare0's alpha is at least one half, or odd; or AB
  bool ideal_takes_cd = false;     // its choice in exact arithmetic
  TracedPortion rgb, alpha;        // both read the registers as they entered the stage
  TracedRegisters after;           // with the stage's outputs written
};

// The final combiner in red, green or blue.
struct TracedFinalChannel {
  std::array<TracedInput, 6> input;  // A to F
  TracedWide e_times_f_product;      // E·F, exactly
  TracedWide e_times_f_dropped;      // what narrowing took away from that
  TracedCode e_times_f;              // what it left
  TracedCode color_sum_unclamped;    // spare0 + secondary, or 1 - x of either
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
  bool uses_e_times_f = false;            // whether a variable reads E·F; if not, E·F is 0
  bool uses_color_sum = false;            // whether a variable reads the colour sum; if not, it is 0
  std::array<TracedFinalChannel, 3> rgb;  // red, green, blue
  TracedInput g;                          // alpha
  TracedCode alpha_cut, alpha;            // G clamped to [0, 1]
};

// One fragment's evaluation, step by step.
struct Trace {
  TracedRegisters before;               // before the first general combiner
  std::vector<TracedStage> stage;       // one for each general combiner
  TracedFinal final_combiner;           // computes the colour
  Rgba9 color{};                        // the final colour, codes in [0, one]
  std::array<std::uint8_t, 4> bytes{};  // the same as bytes, for the fragment operations

  // The registers after the last general combiner.
  [[nodiscard]] const TracedRegisters& registers() const { return stage.empty() ? before : stage.back().after; }
};

// Runs a program over one fragment's registers, codes in [lowest, one], and keeps every step. `profile` is the profile
// that the program was compiled for. The codes equal those of evaluate_fragment, after each stage and at the end.
[[nodiscard]] Trace trace(const Program& program, const HardwareProfile& profile, const RegisterFile& initial);

}  // namespace ninebit
