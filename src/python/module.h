// What the parts of the Python module share. `import ninebit` is the package in src/python/ninebit; this is its module
// _ninebit.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::python {

// What the package raises for wrong programs, states and files: ninebit.Error, a ValueError.
struct Error {
  std::string message;
};

// The shipped profile of a name, or Error.
[[nodiscard]] const HardwareProfile& profile_named(const std::string& name);

void add_programs(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_studies(pybind11::module_& module);

}  // namespace ninebit::python
