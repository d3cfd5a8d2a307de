// The register combiners' state exactly as GL holds it, with GL's defaults. Plain data: nothing here is checked.
#pragma once

#include <array>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

inline constexpr int kMaxGeneralCombiners = 8;

struct CombinerInput {
  Register reg = Register::zero;
  InputMapping mapping = InputMapping::unsigned_identity;
  ComponentUsage usage = ComponentUsage::rgb;
  friend constexpr bool operator==(const CombinerInput&, const CombinerInput&) = default;
};

struct PortionOutput {
  Register ab = Register::discard;
  Register cd = Register::discard;
  Register sum = Register::spare0;
  Scale scale = Scale::none;
  Bias bias = Bias::none;
  bool ab_dot_product = false;
  bool cd_dot_product = false;
  bool mux_sum = false;  // the third output is mux(AB, CD) instead of AB + CD
  friend constexpr bool operator==(const PortionOutput&, const PortionOutput&) = default;
};

struct Portion {
  CombinerInput a, b, c, d;
  PortionOutput out;
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

using ColorF = std::array<float, 4>;  // red, green, blue, alpha as GL stores them: clamped to [0, 1]

struct GeneralCombiner {
  Portion rgb = default_portion(PortionName::rgb);
  Portion alpha = default_portion(PortionName::alpha);
  ColorF constant0{};  // used instead of the global ones while per_stage_constants is set
  ColorF constant1{};
  friend constexpr bool operator==(const GeneralCombiner&, const GeneralCombiner&) = default;
};

// RGB = A·B + (1 - A)·C + D, alpha = G. The defaults are colour sum and fog.
struct FinalCombiner {
  CombinerInput a{Register::fog, InputMapping::unsigned_identity, ComponentUsage::alpha};
  CombinerInput b{Register::spare0_plus_secondary, InputMapping::unsigned_identity, ComponentUsage::rgb};
  CombinerInput c{Register::fog, InputMapping::unsigned_identity, ComponentUsage::rgb};
  CombinerInput d, e, f;
  CombinerInput g{Register::spare0, InputMapping::unsigned_identity, ComponentUsage::alpha};
  friend constexpr bool operator==(const FinalCombiner&, const FinalCombiner&) = default;
};

struct CombinerState {
  int num_general_combiners = 1;
  bool color_sum_clamp = true;
  bool per_stage_constants = false;
  ColorF constant0{};
  ColorF constant1{};
  std::array<GeneralCombiner, kMaxGeneralCombiners> general{};
  FinalCombiner final_combiner{};
  friend constexpr bool operator==(const CombinerState&, const CombinerState&) = default;
};

}  // namespace ninebit
