// Shared by the combiner tests: short names for state, a printer, and `judged`, which runs a state by every path.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/oracle/combiner_oracle.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

inline constexpr CombinerInput kZero{Register::zero, InputMapping::unsigned_identity, ComponentUsage::rgb};
inline constexpr CombinerInput kOne{Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
inline constexpr CombinerInput kMinusOne{Register::zero, InputMapping::expand_normal, ComponentUsage::rgb};
inline constexpr CombinerInput kZeroAlpha{Register::zero, InputMapping::unsigned_identity, ComponentUsage::alpha};
inline constexpr CombinerInput kOneAlpha{Register::zero, InputMapping::unsigned_invert, ComponentUsage::alpha};

// The pairs of scale and bias that the extension allows.
inline constexpr std::array<std::pair<Scale, Bias>, 6> kScaleBias{{{Scale::none, Bias::none},
                                                                   {Scale::by_two, Bias::none},
                                                                   {Scale::by_four, Bias::none},
                                                                   {Scale::by_one_half, Bias::none},
                                                                   {Scale::none, Bias::by_negative_one_half},
                                                                   {Scale::by_two, Bias::by_negative_one_half}}};

// The shipped integer profiles, and two with the rivals of assumed rules: lowest value -256 and expand 2v - 256; early
// narrowing to nearest.
std::vector<HardwareProfile> profiles_and_rivals();

// A register's red, green and blue, or its alpha.
constexpr CombinerInput rgb_of(Register r, InputMapping mapping = InputMapping::unsigned_identity) {
  return {r, mapping, ComponentUsage::rgb};
}
constexpr CombinerInput alpha_of(Register r, InputMapping mapping = InputMapping::unsigned_identity) {
  return {r, mapping, ComponentUsage::alpha};
}
constexpr CombinerInput blue_of(Register r, InputMapping mapping = InputMapping::unsigned_identity) {
  return {r, mapping, ComponentUsage::blue};
}

// A valid state of so many stages in which no portion writes; the final combiner gives 0 and spare0's alpha.
CombinerState silent_state(int stages);

// The article's two stages: spare0 = (primary - texture 0) × scale, spare1 = (spare0 · spare0) × scale. Alpha =
// spare1's blue: 0 means that the indices are equal and the fragment is lit.
CombinerState index_comparison(Scale scale = Scale::by_four);

// A final combiner whose output is register `r` itself.
FinalCombiner final_of(Register r);

// A colour of bytes as GL holds it.
constexpr ColorF color_of(int red, int green, int blue, int alpha) {
  return {static_cast<float>(red / 255.0), static_cast<float>(green / 255.0), static_cast<float>(blue / 255.0),
          static_cast<float>(alpha / 255.0)};
}

constexpr Rgba9 codes(int red, int green, int blue, int alpha) {
  return {static_cast<s9>(red), static_cast<s9>(green), static_cast<s9>(blue), static_cast<s9>(alpha)};
}

// The state and the profile's fields as text, enough to build the case again by hand.
std::string describe(const CombinerState& state, const HardwareProfile& profile);
std::string describe(const RegisterFile& registers);
std::string describe(const Rgba9& color);

oracle::Registers to_oracle(const RegisterFile& registers);
RegisterFile from_oracle(const oracle::Registers& registers);
Rgba9 from_oracle(const oracle::Codes& color);

struct Fragment {
  RegisterFile registers;  // after the last general combiner
  Rgba9 color;             // what leaves the final combiner
};

// Runs the state over one fragment by the oracle, by the reference and by the batch evaluator, with integer arithmetic
// on every SIMD target. Fails the test, with all inputs, if the state is invalid or if any two differ. Returns what the
// oracle says.
Fragment judged(const CombinerState& state, const HardwareProfile& profile, const RegisterFile& initial);

// The same for many fragments (at most kBatchSize).
std::vector<Fragment> judged(const CombinerState& state, const HardwareProfile& profile,
                             const std::vector<RegisterFile>& initial);

}  // namespace ninebit::test
