// Shared by the combiner tests: short names for state, a printer, and `judged`, which runs a state by every path.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
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

// The outputs of a portion that writes A·B alone, or its third output alone.
constexpr PortionOutput ab_to(Register to, Scale scale = Scale::none, Bias bias = Bias::none) {
  return {.ab = to, .sum = Register::discard, .scale = scale, .bias = bias};
}
constexpr PortionOutput sum_to(Register to, Scale scale = Scale::none, Bias bias = Bias::none) {
  return {.sum = to, .scale = scale, .bias = bias};
}
constexpr PortionOutput mux_to(Register to) {
  return {.sum = to, .mux_sum = true};
}

// A valid state of so many stages in which no portion writes; the final combiner gives 0 and spare0's alpha.
CombinerState silent_state(int stages);

// The same with one stage, whose RGB portion is this.
CombinerState rgb_stage(const Portion& rgb);

// A portion as an alpha portion: each input reads alpha.
Portion of_alpha(Portion portion);

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

// One fragment of a batch.
void put(RegisterBatch& batch, std::size_t lane, const RegisterFile& registers);
RegisterFile lane_of(const RegisterBatch& batch, std::size_t lane);
Rgba9 lane_of(const OutputBatch& out, std::size_t lane);

// The oracle's outputs for the wide values from `low` to `high`, which count parts of 1 / one².
std::vector<s9> outputs_by_oracle(const HardwareProfile& p, Scale scale, Bias bias, int low, int high, int step = 1);

// A batch and its colours.
struct Lanes {
  std::unique_ptr<RegisterBatch> registers = std::make_unique<RegisterBatch>();
  std::unique_ptr<OutputBatch> out = std::make_unique<OutputBatch>();

  // Runs a program on every SIMD target; difference() must then be 0: the bits that are not as expected.
  void expect_on_every_target(const BatchProgram& program, std::size_t count, const HardwareProfile& p,
                              const std::function<int()>& difference);
};

struct Fragment {
  RegisterFile registers;  // after the last general combiner
  Rgba9 color;             // what leaves the final combiner
};

// Runs the state over one fragment by the oracle, by the reference and by the batch evaluator, with integer arithmetic
// on every SIMD target. Fails the test, with all inputs, if the state is invalid or if any two differ. Returns what the
// oracle says.
Fragment judged(const CombinerState& state, const HardwareProfile& profile, const RegisterFile& initial);

// The same for many fragments, in batches of kBatchSize. With `oracle_every`, the oracle judges one in so many, and the
// reference the others.
std::vector<Fragment> judged(const CombinerState& state, const HardwareProfile& profile,
                             const std::vector<RegisterFile>& initial, std::size_t oracle_every = 1);

}  // namespace ninebit::test
