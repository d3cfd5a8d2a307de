// An emulator's combiner as its author might write it: from register words, in floats or in rounded codes, with faults
// that can be switched on. It shares no code with the library. The faults are those that were found in emulators.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "ninebit/study/vectors.h"

namespace ninebit::test {

enum class EmulatorFault {
  floats,                // nothing is rounded before the bytes; one half is 0.5
  third_of_products,     // the sum beside a dot product is of the products
  no_third_beside_dot,   // no third output beside a dot product
  zero_stage_skipped,    // stages whose two input words are 0 are skipped
  own_constants,         // each stage's own constants, always
  final_last_constants,  // the final combiner reads the last stage's constants
  sum_negative,          // the colour sum adds negative registers
  ef_unrounded,
  mix_unrounded,
  alpha_reads_red,
  red_blue_swapped,
  mux_swapped,
  registers_kept,  // spare0's RGB and spare1 keep the last fragment's values
  spare1_alpha_tex1,
  cd_reads_ab,
  bias_of_products,
  mappings_keep_sign,  // but for unsigned identity
  third_unclamped,
  bytes_cut,
  two_stages_at_least,
  invert_above_one,
  sum_always_clamped,
  sum_inverts_swapped,
  constant_alpha_one,
  constants_abgr,
  alpha_before_rgb_blue,  // the alpha portion is written before the RGB portion
  no_output_clamp,
  no_scale,
  no_bias,
  no_mux,  // the sum instead
  no_blue_to_alpha,
  no_sum_inverts,
  alpha_reads_alpha,  // where it should read blue
  spare0_alpha_kept,  // starts as 0 and keeps the last fragment's value
  alpha_reads_rgb_written,
  eight_stages_none,
  sum_never_clamped,
  mux_by_threshold,       // also where the control word says the lowest bit
  final_zero_shows_zero,  // final words of 0 are read as they stand: 0 in, 0 out
  final_g_reads_red,      // where it should read blue
  clamped_when_read,      // outputs are not clamped; registers that are read as unsigned identity are
};

// The colours of a pack of profile nv2a, by program and fragment. The programs run in turn.
[[nodiscard]] std::vector<std::vector<Bytes4>> emulator_colors(const VectorPack& pack,
                                                               const std::set<EmulatorFault>& faults);

}  // namespace ninebit::test
