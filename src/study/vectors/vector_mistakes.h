// Wrong models of the combiners: mistakes that emulators make.
#pragma once

#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::vectors {

// A rule of the arithmetic that a model breaks, if no field of a profile has the wrong value for it.
enum class BrokenRule {
  none,
  negative_inputs,    // mappings do not clamp negative codes to 0
  outputs_from_zero,  // general combiners clamp their outputs to [0, one]
  outputs_unclamped,  // general combiners do not clamp their outputs
  bias_after_scale,   // wide × scale + bias
  products_narrowed,  // each product is narrowed before it is added
  sums_clamped,       // sums and dot products are clamped to [-1, 1] before bias and scale
  mux_above_half,     // the mux takes CD above one half, not at one half
  mux_swapped,        // the mux takes AB where it should take CD
  portions_in_turn,   // the alpha portion reads what the RGB portion wrote
  rounded_down,       // general combiners narrow toward minus infinity
  halves_from_zero,   // general combiners narrow halves away from zero
  half_exact,         // one half is one / 2, which is not a code
  shifted,            // sums are shifted by 8 instead of divided by 255; so is the bias, of one half times 256
  shifted_bias_255,   // the same with a bias of one half times 255
  sums_shifted,       // sums are shifted by 8 before bias and scale
  products_shifted,   // each product is shifted by 8 before the sum
  spare0_alpha_zero   // spare0's alpha starts as 0
};

struct Mistake {
  std::string name, rules;
  HardwareProfile profile;  // the pack's, or with another value in one field
  BrokenRule broken = BrokenRule::none;
  void (*edit)(CombinerState&) = nullptr;   // what the model does to every program; null: nothing
  bool in_general = true, in_final = true;  // the combiners in which the broken is made
};

// The mistakes that may be made instead of a profile's rules.
[[nodiscard]] std::vector<Mistake> mistakes_of(const HardwareProfile& profile);

// The program that a model runs for a state.
[[nodiscard]] Program mistaken_program(const Mistake& mistake, const CombinerState& state);

// The model's result.
[[nodiscard]] Rgba9 run_mistaken(const Mistake& mistake, const Program& program, RegisterFile registers);

// A colour as bytes.
[[nodiscard]] Bytes4 bytes_of(const HardwareProfile& profile, const Rgba9& color);

}  // namespace ninebit::vectors
