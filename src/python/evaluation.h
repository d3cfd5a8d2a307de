// Programs run on dictionaries of registers.
#pragma once

#include <pybind11/numpy.h>

#include "src/python/program_objects.h"

namespace ninebit::python {

// The methods of ninebit.Program; src/python/ninebit/__init__.pyi declares their arguments and results.
[[nodiscard]] pybind11::array_t<s9> evaluate(const RunnableProgram& program, const pybind11::dict& inputs);
[[nodiscard]] pybind11::dict evaluate_registers(const RunnableProgram& program, const pybind11::dict& inputs);
[[nodiscard]] pybind11::object traced(const RunnableProgram& program, const pybind11::dict& registers);

}  // namespace ninebit::python
