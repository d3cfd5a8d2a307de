// How far each operation of the datapath is from exact arithmetic, over all of its inputs.
//
// Nothing is sampled. A sum of products depends on its wide value alone, so that a wide value is evaluated once and
// counted as often as inputs give it: a dot product's 511^6 inputs have 390,151 wide values.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Errors are in real numbers, a result's code / one minus the exact value clamped as the extension clamps.
struct OperationError {
  std::string profile;
  std::string operation;      // "mapping", "product", "dot product", …
  std::string form;           // the mapping, or the output's scale and bias; empty where there is none
  std::uint64_t cases = 0;    // inputs, each counted once
  std::uint64_t exact = 0;    // those with an error of 0
  std::uint64_t distinct = 0;  // different codes that come out
  double max_error = 0.0;     // largest size of an error
  double mean_error = 0.0;    // mean size
  double mean_bias = 0.0;     // mean with its sign
  std::string worst;          // inputs with the largest error, as codes: the first such case
  int worst_code = 0;         // what comes out there
  double worst_exact = 0.0;   // and what should
};

// On how many inputs two profiles whose codes stand for the same numbers give different codes.
struct OperationDifference {
  std::string first, second;  // the profiles
  std::string operation;
  std::string form;
  std::uint64_t cases = 0;
  std::uint64_t differ = 0;
};

struct DatapathErrors {
  std::vector<OperationError> errors;           // by profile, in the order given
  std::vector<OperationDifference> differences;  // of each pair of profiles with the same `one`
};

// Measures every operation of every profile with integer arithmetic; the others have no errors of operations to count.
// `progress` is told how much is done, 0 to 1, and answers whether to go on; may be empty. Reports Fault::cancelled.
[[nodiscard]] Result<DatapathErrors> measure_datapath(std::span<const HardwareProfile> profiles,
                                                      const std::function<bool(double done)>& progress);

}  // namespace ninebit
