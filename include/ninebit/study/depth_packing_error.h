// What a depth is after a round trip through bytes: every packing of depth_packing.h, over all depths of 16 and 24 bits
// and over floats, each stored by rounding and by cutting.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/shadow/depth_packing.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// Depths in [0, 1] in rising order, 0 and 1 among them.
enum class DepthSet : std::uint8_t {
  bits16,  // n / 65535 as floats: what a 16-bit depth buffer can hold
  bits24,  // n / 16777215
  floats   // every nth float32 from 0 on, and 1: denser the nearer to 0
};
inline constexpr std::array kDepthSets{DepthSet::bits16, DepthSet::bits24, DepthSet::floats};

// "16", "24", "floats".
[[nodiscard]] std::string_view name_of(DepthSet set);
// "round", "truncate".
[[nodiscard]] std::string_view name_of(ChannelStorage storage);

// How many depths a set has, and one of them. float_step is 1 or more: every how many-th float belongs to `floats`.
[[nodiscard]] std::uint64_t depth_count(DepthSet set, std::uint32_t float_step);
[[nodiscard]] float depth_at(DepthSet set, std::uint32_t float_step, std::uint64_t i);

// An error is what a depth reads as, less the depth: both are floats, the difference is exact.
struct RoundTripError {
  std::uint64_t depths = 0;      // how many the set has
  std::uint64_t exact = 0;       // those that come back to the bit
  std::uint64_t distinct = 0;    // different floats that come back
  std::uint64_t inversions = 0;  // neighbours of the set of which the larger one comes back as the smaller
  double max_error = 0.0;        // largest size of an error of depths below 1
  double mean_error = 0.0;       // their mean size
  double mean_bias = 0.0;        // their mean with its sign
  float worst_depth = 0.0F;      // the first of them with that error
  float worst_back = 0.0F;       // what it reads as
  float zero_back = 0.0F;        // what 0 reads as
  float one_back = 0.0F;         // what 1 reads as
};

// Over all depths of a set. The same for any number of threads. Reports Fault::cancelled where go_on says no.
[[nodiscard]] Result<RoundTripError> measure_round_trip(const DepthPacking& packing, ChannelStorage storage,
                                                        DepthSet set, std::uint32_t float_step, const GoOn& go_on);

// What becomes of a depth of two digits in base 256, `highest` and `second`: (highest + second / 256) / 256.
struct TwoDigits {
  int highest_byte = 0;  // the most significant component as it is stored
  int second_byte = 0;   // likewise the next one
  double shift = 0.0;    // the error in steps of the second digit, 1/65536
};
[[nodiscard]] TwoDigits store_two_digits(const DepthPacking& packing, ChannelStorage storage, int highest, int second);

// What the study is made over: all combinations of the lists.
struct DepthPackingOptions {
  std::vector<std::string> packings;     // names of depth_packings()
  std::vector<ChannelStorage> storages;  // how components become bytes
  std::vector<DepthSet> sets;            // which depths
  std::uint32_t float_step = 64;         // of DepthSet::floats, 1 or more
};

// Everything: all packings, storages and sets.
[[nodiscard]] DepthPackingOptions all_depth_packings();

// A unit for each packing, storage and set, with one row; and one for each packing and storage with the 256 depths
// whose highest digit is 128, in the table "second_digit". Reports an unknown packing, a list without entries, a step
// of 0.
[[nodiscard]] Result<std::unique_ptr<Study>> make_depth_packing_study(const DepthPackingOptions& options);

}  // namespace ninebit
