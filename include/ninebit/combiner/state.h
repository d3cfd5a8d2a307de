// The register combiners' state exactly as GL holds it, with GL's defaults, and what the NV2A's registers add to it.
// Plain data: nothing here is checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The largest number of general combiners that a profile may have: that of NV_register_combiners2's chips.
inline constexpr int kMaxGeneralCombiners = 8;

// The source of one variable, as CombinerInputNV and FinalCombinerInputNV set it.
struct CombinerInput {
  Register reg = Register::zero;                           // what is read
  InputMapping mapping = InputMapping::unsigned_identity;  // applied before the multiplication
  ComponentUsage usage = ComponentUsage::rgb;              // which of its components
  friend constexpr bool operator==(const CombinerInput&, const CombinerInput&) = default;
};

// The outputs of a portion, as CombinerOutputNV sets them.
struct PortionOutput {
  Register ab = Register::discard;  // the register that gets A·B
  Register cd = Register::discard;  // the register that gets C·D
  Register sum = Register::spare0;  // the register that gets the third output: AB + CD or the mux
  Scale scale = Scale::none;        // of all three outputs
  Bias bias = Bias::none;           // of all three outputs, added before the scale
  bool ab_dot_product = false;      // A·B is the sum over red, green and blue; RGB portions only
  bool cd_dot_product = false;      // the same for C·D
  bool mux_sum = false;             // the third output is mux(AB, CD) instead of AB + CD
  // NV2A, not in GL, RGB portions only: the alpha of AB's (CD's) register gets the blue that is written to it, unless
  // the alpha portion writes that alpha (rule 23).
  bool ab_blue_to_alpha = false;
  bool cd_blue_to_alpha = false;
  friend constexpr bool operator==(const PortionOutput&, const PortionOutput&) = default;
};

// A portion of a general combiner: two products and their outputs.
struct Portion {
  CombinerInput a, b, c, d;  // the factors of A·B and C·D
  PortionOutput out;         // where the products and the third output go
  friend constexpr bool operator==(const Portion&, const Portion&) = default;
};

// The default portion of either name: spare0 = primary * 1 + 0.
[[nodiscard]] constexpr Portion default_portion(PortionName name) {
  const ComponentUsage usage = name == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
  Portion portion;
  portion.a = {Register::primary, InputMapping::unsigned_identity, usage};
  portion.b = {Register::zero, InputMapping::unsigned_invert, usage};
  portion.c = {Register::zero, InputMapping::unsigned_identity, usage};
  portion.d = {Register::zero, InputMapping::unsigned_identity, usage};
  return portion;
}

// Red, green, blue, alpha as GL stores them: clamped to [0, 1].
using ColorF = std::array<float, 4>;

// One general combiner. Both portions read the registers as the previous stage left them.
struct GeneralCombiner {
  Portion rgb = default_portion(PortionName::rgb);      // writes red, green and blue
  Portion alpha = default_portion(PortionName::alpha);  // writes alpha
  ColorF constant0{};                                   // replaces the global constant 0 if per_stage_constants is set
  ColorF constant1{};                                   // the same for constant 1
  friend constexpr bool operator==(const GeneralCombiner&, const GeneralCombiner&) = default;
};

// RGB = A·B + (1 - A)·C + D, alpha = G. The defaults are colour sum and fog.
struct FinalCombiner {
  CombinerInput a{Register::fog, InputMapping::unsigned_identity, ComponentUsage::alpha};  // the weight of the mix
  CombinerInput b{Register::spare0_plus_secondary, InputMapping::unsigned_identity,
                  ComponentUsage::rgb};  // the result of the mix if A is 1
  CombinerInput c{Register::fog, InputMapping::unsigned_identity,
                  ComponentUsage::rgb};  // the result of the mix if A is 0
  CombinerInput d, e, f;                 // D is added to the mix; E and F are the factors of E·F
  CombinerInput g{Register::spare0, InputMapping::unsigned_identity, ComponentUsage::alpha};  // alpha
  friend constexpr bool operator==(const FinalCombiner&, const FinalCombiner&) = default;
};

// Constants by place: of each general combiner, then, last, of the final combiner; constant 0 and 1.
template <class T>
using ByConstant = std::array<std::array<T, 2>, kMaxGeneralCombiners + 1>;
// The place of the final combiner's constants.
inline constexpr std::size_t kFinalConstants = kMaxGeneralCombiners;

// Colours that a program may read as constants: const0 to const15, then constant 0 and 1 of each general combiner that
// has constants of its own. OpenGL's programs have const0 and const1; Direct3D's c0 to c15 are const0 to const15.
inline constexpr std::size_t kConstantNames = 16 + 2 * kMaxGeneralCombiners;
// The number of such a colour, from 0 to kConstantNames - 1.
using ConstantName = std::uint8_t;

// Where a constant that a program reads comes from.
struct ConstantOrigin {
  bool unset = false;                  // nobody gave its colour: the state holds 0, and proofs take it as an input
  std::optional<ConstantName> name{};  // that the program's text has for it; empty: the one of its place
  friend constexpr bool operator==(const ConstantOrigin&, const ConstantOrigin&) = default;
};

// The whole state: the values that GL's Get calls would return.
struct CombinerState {
  int num_general_combiners = 1;            // GL_NUM_GENERAL_COMBINERS_NV: 1 to the profile's number
  bool color_sum_clamp = true;              // GL_COLOR_SUM_CLAMP_NV: spare0 + secondary is clamped to [0, 1]
  bool color_sum_invert_spare0 = false;     // NV2A, not in GL: spare0 goes into the colour sum as 1 - x
  bool color_sum_invert_secondary = false;  // the same for the secondary colour
  bool per_stage_constants = false;         // GL_PER_STAGE_CONSTANTS_NV, of NV_register_combiners2
  bool mux_by_lowest_bit = false;           // NV2A, not in GL: muxes test the lowest bit of spare0's alpha
  ColorF constant0{};                       // GL_CONSTANT_COLOR0_NV
  ColorF constant1{};                       // GL_CONSTANT_COLOR1_NV
  std::array<GeneralCombiner, kMaxGeneralCombiners>
      general{};                        // those past num_general_combiners are kept but do nothing
  FinalCombiner final_combiner{};       // computes the colour
  ByConstant<ConstantOrigin> origin{};  // of the constants that are read; set by parsers
  friend constexpr bool operator==(const CombinerState&, const CombinerState&) = default;
};

// "const0", "const15"; "stage2.const0" for constant 0 of general combiner 2.
[[nodiscard]] std::string name_of_constant(ConstantName name);
// The number of a name; empty: it does not name a constant.
[[nodiscard]] std::optional<ConstantName> constant_called(std::string_view name);

// The name of a constant at a place: the one that the program's text has for it or, without one, that of the colour
// which is read there.
[[nodiscard]] constexpr ConstantName constant_name(const CombinerState& state, std::size_t place, std::size_t which) {
  if (state.origin[place][which].name) return *state.origin[place][which].name;
  const bool own = state.per_stage_constants && place != kFinalConstants;
  return static_cast<ConstantName>(own ? 16 + 2 * place + which : which);
}

// Which constants are read where, by the inputs that are used.
[[nodiscard]] ByConstant<bool> constants_read(const CombinerState& state);

// Makes the constants of a name unset, wherever they are read; whether there are any.
bool free_constant(CombinerState& state, ConstantName name);

// Whether a constant is unset that is not a general combiner's own. `which`: 0 or 1.
[[nodiscard]] bool is_shared_constant_unset(const CombinerState& state, std::size_t which);

// Marks the constants that are read and not given as unset. `given`: by place; last are the constants that all general
// combiners share unless per_stage_constants is set.
void mark_unset_constants(CombinerState& state, const ByConstant<bool>& given);

}  // namespace ninebit
