// The groups of a pack, and the programs in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/system/hashing/splitmix.h"

namespace ninebit::vectors {

class VectorRandom {
 public:
  // Case `index` of a run with `seed`; it needs no earlier case.
  VectorRandom(std::uint64_t seed, std::uint64_t index) : state_(seed) {
    state_ = next() ^ (index * 0xD1342543DE82EF95U);
  }

  std::uint64_t next() {
    const std::uint64_t out = splitmix(state_);
    state_ += kSplitMixStep;
    return out;
  }
  // A whole number in [0, count), count > 0.
  int below(int count) { return static_cast<int>((next() >> 32) % static_cast<std::uint64_t>(count)); }
  bool one_in(int count) { return below(count) == 0; }

 private:
  std::uint64_t state_;
};

// Makes one program of a group.
class Maker {
 public:
  // `number`: of the program in its group. `index`: of the random numbers, another one for each program.
  Maker(const HardwareProfile& of, std::uint64_t seed, std::uint64_t index, std::size_t number)
      : profile(of), random(seed, index), rest_(number) {}

  // A choice of `count`. The programs of a group go through all combinations of their choices, the first choice
  // changing fastest.
  int of(int count) {
    const auto n = static_cast<std::size_t>(count);
    const auto chosen = static_cast<int>(rest_ % n);
    rest_ /= n;
    return chosen;
  }
  template <class T>
  T of(std::span<const T> values) {
    return values[static_cast<std::size_t>(of(static_cast<int>(values.size())))];
  }

  // A register that a fragment's inputs fill, but for fog: textures, primary and secondary colour.
  Register source();
  Register random_source();
  // One that a general combiner may write.
  Register random_target();
  // A constant colour, often with 0, 1, 127, 128, 254 and 255.
  ColorF color();

  const HardwareProfile& profile;
  VectorRandom random;

 private:
  std::size_t rest_;
};

// The start registers of a group's fragments.
enum class Inputs {
  bytes,         // codes from 0
  signed_texels  // textures with negative codes, too; only NV20 class chips have them
};

struct Group {
  const char *name, *rules, *what;
  int weight;  // its share of a pack's programs
  Inputs inputs;
  CombinerState (*make)(Maker& maker);
  bool (*exists)(const HardwareProfile& profile) = nullptr;  // null: in every profile
};

// Whether a profile's chip has NV20's words.
[[nodiscard]] constexpr bool is_nv20(const HardwareProfile& profile) {
  return profile.per_stage_constants.value;
}

[[nodiscard]] constexpr bool has_stages(const HardwareProfile& profile) {
  return profile.general_combiners.value > 1;
}

// The groups in the order in which they stand in a pack. A group depends on what the groups before it test, and on one
// thing more: a mistake fails first in its own group.
[[nodiscard]] std::span<const Group> input_groups();
[[nodiscard]] std::span<const Group> order_groups();
[[nodiscard]] std::span<const Group> mapping_groups();
[[nodiscard]] std::span<const Group> output_groups();
[[nodiscard]] std::span<const Group> stage_groups();
[[nodiscard]] std::span<const Group> final_groups();
[[nodiscard]] std::span<const Group> mixed_groups();

// Those that a profile has, in the order of a pack.
[[nodiscard]] std::vector<Group> groups_of(const HardwareProfile& profile);

// ---- Parts of programs ----------------------------------------------------------------------------------------------

// An input of an RGB portion or of A to F: its components, or its alpha.
[[nodiscard]] constexpr CombinerInput rgb_of(Register reg, InputMapping mapping = InputMapping::unsigned_identity) {
  return {reg, mapping, ComponentUsage::rgb};
}
[[nodiscard]] constexpr CombinerInput alpha_of(Register reg, InputMapping mapping = InputMapping::unsigned_identity) {
  return {reg, mapping, ComponentUsage::alpha};
}
[[nodiscard]] constexpr CombinerInput blue_of(Register reg, InputMapping mapping = InputMapping::unsigned_identity) {
  return {reg, mapping, ComponentUsage::blue};
}
// 1 and -1, from zero.
inline constexpr CombinerInput kPlusOne{Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
inline constexpr CombinerInput kMinusOne{Register::zero, InputMapping::expand_normal, ComponentUsage::rgb};
inline constexpr CombinerInput kNothing{};

// The same input in an alpha portion, which reads alpha where the RGB portion reads RGB. Fog's alpha cannot be read
// there: its blue is.
[[nodiscard]] constexpr CombinerInput for_alpha(CombinerInput in) {
  in.usage = in.reg == Register::fog ? ComponentUsage::blue : ComponentUsage::alpha;
  return in;
}

// A program whose final combiner shows spare0.
[[nodiscard]] CombinerState shows_spare0();

// Sets A to D of both portions of a stage: the alpha portion reads alpha.
void set_inputs(GeneralCombiner& stage, const CombinerInput& a, const CombinerInput& b,
                const CombinerInput& c = kNothing, const CombinerInput& d = kNothing);

// Sets scale and bias of both portions of a stage.
void set_scale(GeneralCombiner& stage, Scale scale, Bias bias = Bias::none);

// A stage that writes nothing, and one that makes spare0 = -spare0, so that the final combiner shows negative results.
[[nodiscard]] GeneralCombiner idle_stage();
[[nodiscard]] GeneralCombiner negating_stage();

// Sets A to D of the final combiner.
void set_final(CombinerState& state, const CombinerInput& a, const CombinerInput& b, const CombinerInput& c,
               const CombinerInput& d = kNothing);

}  // namespace ninebit::vectors
