// Wrong models of the combiners: mistakes that emulators make, alone and together.
#pragma once

#include <bitset>
#include <functional>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/vectors.h"

namespace ninebit::vectors {

// A rule of the arithmetic that a model breaks, if no field of a profile has the wrong value for it.
enum class BrokenRule {
  negative_inputs,     // mappings do not clamp negative codes to 0
  signed_mappings,     // mappings other than unsigned identity do not
  invert_above_one,    // 1 - x of x above 1 is negative
  alpha_reads_red,     // alpha portions read red instead of blue
  outputs_from_zero,   // general combiners clamp their outputs to [0, one]
  outputs_unclamped,   // general combiners do not clamp their outputs
  thirds_unclamped,    // general combiners do not clamp their third output
  bias_after_scale,    // wide × scale + bias
  bias_of_products,    // a sum has the bias of each of its products
  products_narrowed,   // each product is narrowed before it is added
  sums_clamped,        // sums and dot products are clamped to [-1, 1] before bias and scale
  thirds_of_products,  // the sum or mux beside a dot product is of the products
  mux_above_half,      // the mux takes CD above one half, not at one half
  mux_swapped,         // the mux takes AB where it should take CD
  portions_in_turn,    // the alpha portion reads what the RGB portion wrote
  products_in_turn,    // C and D read what AB wrote
  rounded_down,        // general combiners narrow toward minus infinity
  halves_from_zero,    // general combiners narrow halves away from zero
  half_exact,          // one half is one / 2, which is not a code
  shifted,             // sums are shifted by 8 instead of divided by 255; so is the bias, of one half times 256
  shifted_bias_255,    // the same with a bias of one half times 255
  sums_shifted,        // sums are shifted by 8 before bias and scale
  products_shifted,    // each product is shifted by 8 before the sum
  spare0_alpha_zero,   // spare0's alpha starts as 0
  spare1_alpha_tex1,   // spare1's alpha starts as texture 1's
  registers_kept,      // spare0's RGB and spare1 start as the last fragment left them
  spare0_alpha_kept,   // so does spare0's alpha
  sum_negative,        // the colour sum adds negative codes
  e_times_f_exact,     // E times F is not narrowed
  mix_exact,           // A·B + (1 - A)·C is not narrowed before D is added
  mix_of_narrowed,     // A·B and (1 - A)·C are narrowed one by one
  colors_cut,          // A·B + (1 - A)·C + D is not narrowed, and the bytes of the colour are cut
  red_blue_swapped,    // the colour's red and blue are exchanged
  g_reads_red,         // G of the final combiner reads a register's red instead of its blue
  identity_to_one,     // a register that is read as unsigned identity is clamped to 1
  count
};
using BrokenRules = std::bitset<static_cast<std::size_t>(BrokenRule::count)>;

struct Mistake {
  std::string name, rules;
  std::string group;                            // the first of a pack's groups that fails because of it
  std::function<void(HardwareProfile&)> set{};  // gives a field another value; null: none
  BrokenRules in_general{}, in_final{};         // what the combiners break
  void (*edit)(CombinerState&) = nullptr;       // what the model does to every program; null: nothing
};

// The rules that a model looked up while it ran: whether it breaks any others makes no difference to what it gave.
struct AskedRules {
  BrokenRules in_general{}, in_final{};
};

// Whether one mistake more may change what a model gives, by the rules that the model was asked for.
[[nodiscard]] bool may_change(const Mistake& mistake, const AskedRules& asked);

// The mistakes that may be made instead of a profile's rules.
[[nodiscard]] std::vector<Mistake> mistakes_of(const HardwareProfile& profile);

// A combiner with some mistakes.
class Model {
 public:
  // `made`: indices of `mistakes`. Edits are made in the order of `mistakes`.
  Model(const HardwareProfile& profile, const std::vector<Mistake>& mistakes, std::vector<std::size_t> made);

  // The program that it runs for a state.
  [[nodiscard]] Program program_of(const CombinerState& state) const;
  // Whether it runs programs as their profile says.
  [[nodiscard]] bool breaks_nothing() const { return in_general_.none() && in_final_.none(); }
  [[nodiscard]] bool keeps_registers() const;

  // A register file in the numbers of the model: codes, or fractions of 1 with floats.
  using Registers = std::array<std::array<double, 4>, kRegisterCount>;
  // The colour. `kept`: what the last fragment left of the registers, and what this one leaves. The rules that are
  // asked for are added to `asked`, if there is one.
  [[nodiscard]] Bytes4 run(const Program& program, const RegisterFile& input, Registers& kept,
                           AskedRules* asked = nullptr) const;

 private:
  template <class T>
  [[nodiscard]] Bytes4 run_in(const Program& program, const RegisterFile& input, Registers& kept,
                              AskedRules* asked) const;

  HardwareProfile profile_;
  BrokenRules in_general_{}, in_final_{};
  std::vector<void (*)(CombinerState&)> edits_{};
};

// The colours that a model shows for programs of a pack.
class ModelColors {
 public:
  // `programs`: those that run, in turn. They, the pack and the model live longer.
  ModelColors(const VectorPack& pack, const Model& model, const std::vector<std::size_t>& programs);

  // The colours of a program's fragments, and what was asked for them.
  [[nodiscard]] std::vector<Bytes4> operator()(std::size_t program, AskedRules* asked = nullptr) const;

 private:
  const VectorPack& pack_;
  const Model& model_;
  std::vector<std::vector<Bytes4>> shown_{};  // by program, where the model keeps registers
};

// A colour as bytes.
[[nodiscard]] Bytes4 bytes_of(const HardwareProfile& profile, const Rgba9& color);

}  // namespace ninebit::vectors
