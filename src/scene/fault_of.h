// Diagnostics for faults of a scene file; the reader adds the file's name.
#pragma once

#include <string>
#include <utility>

#include "ninebit/numerics/result.h"

namespace ninebit {

inline Diagnostic fault_of(std::string message) {
  return {std::move(message), "", 0, Fault::invalid_input};
}

}  // namespace ninebit
