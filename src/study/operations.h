// The operations of the datapath as lists of cases.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ninebit/numerics/datapath.h"

namespace ninebit {

// One operation in one form. A case stands for all inputs that give the same intermediate value.
struct Operation {
  std::string name;
  std::string form;
  std::size_t cases = 0;
  std::function<std::uint64_t(std::size_t)> weight;                // inputs that a case stands for
  std::function<int(const Datapath&, std::size_t)> code;           // what the datapath gives
  std::function<double(std::size_t)> exact;                        // what the extension's real numbers give, clamped
  std::function<std::string(std::size_t)> inputs;                  // one of the inputs, as codes
};

// All operations on registers whose 1.0 is the code `one`.
[[nodiscard]] std::vector<Operation> datapath_operations(int one);

}  // namespace ninebit
