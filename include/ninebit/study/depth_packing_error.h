// The error of a depth after a round trip through bytes: every packing of depth_packing.h, over all depths of 16 and 24
// bits and over floats, in every storage.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/frame/depth_packing.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// Depths in [0, 1] in rising order, including 0 and 1.
enum class DepthSet : std::uint8_t {
  bits16,  // n / 65535 as floats: the values of a 16-bit depth buffer
  bits24,  // n / 16777215 as floats
  floats   // every nth float32 from 0, and 1: denser towards 0
};

// All sets.
inline constexpr std::array kDepthSets{DepthSet::bits16, DepthSet::bits24, DepthSet::floats};

// "16", "24", "floats".
[[nodiscard]] std::string_view name_of(DepthSet set);

// The number of depths in a set, and its i-th depth. float_step is 1 or more: DepthSet::floats takes every
// float_step-th float.
[[nodiscard]] std::uint64_t depth_count(DepthSet set, std::uint32_t float_step);
[[nodiscard]] float depth_at(DepthSet set, std::uint32_t float_step, std::uint64_t i);

// An error is the value read back minus the depth: both are floats, the difference is exact.
struct RoundTripError {
  std::uint64_t depths = 0;      // number of depths in the set
  std::uint64_t exact = 0;       // depths that are read back to the bit
  std::uint64_t distinct = 0;    // different floats read back
  std::uint64_t inversions = 0;  // neighbours in the set that are read back in the wrong order
  double max_error = 0.0;        // largest absolute error of the depths below 1
  double mean_error = 0.0;       // mean absolute error of the depths below 1
  double mean_bias = 0.0;        // mean signed error of the depths below 1
  float worst_depth = 0.0F;      // the first depth with max_error
  float worst_back = 0.0F;       // the value read back for worst_depth
  float zero_back = 0.0F;        // the value read back for 0
  float one_back = 0.0F;         // the value read back for 1
};

// Measures all depths of a set, with the same result for any number of threads. Reports Fault::cancelled if go_on
// returns false.
[[nodiscard]] Result<RoundTripError> measure_round_trip(const DepthPacking& packing, ChannelStorage storage,
                                                        DepthSet set, std::uint32_t float_step, const GoOn& go_on);

// The stored form of a depth with two digits in base 256, `highest` and `second`: (highest + second / 256) / 256.
struct TwoDigits {
  int highest_byte = 0;  // the most significant component as stored, 0 to 255
  int second_byte = 0;   // the next component as stored, 0 to 255
  double shift = 0.0;    // the error in steps of the second digit, 1/65536
};

// The stored form of one depth in a packing of at least two digits.
[[nodiscard]] TwoDigits store_two_digits(const DepthPacking& packing, ChannelStorage storage, int highest, int second);

// The study covers all combinations of the lists.
struct DepthPackingOptions {
  std::vector<std::string> packings;     // names of depth_packings()
  std::vector<ChannelStorage> storages;  // of storage_rules()
  std::vector<DepthSet> sets;            // which depths
  std::uint32_t float_step = 256;        // of DepthSet::floats, 1 or more
};

// Options with all packings and sets, components rounded and truncated.
[[nodiscard]] DepthPackingOptions all_depth_packings();

// One unit with one row for each packing, storage and set; one more unit for each packing and storage, with the 256
// depths whose highest digit is 128 in the table "second_digit". Reports an unknown packing, an empty list, step 0.
[[nodiscard]] Result<std::unique_ptr<Study>> make_depth_packing_study(const DepthPackingOptions& options);

}  // namespace ninebit
