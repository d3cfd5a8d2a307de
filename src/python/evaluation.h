// Programs run on planes of codes.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <optional>

#include "src/python/program_objects.h"

namespace ninebit::python {

using Codes = pybind11::array_t<s9, pybind11::array::c_style>;

// Evaluates `count` fragments. `planes` has one-dimensional arrays of uint8 or int16 by component, 'tex0.r', with
// `count` codes or one code for all; they are read in place, with any strides. The colours go into `color`, of the
// shape (4, count), and all registers after the last general combiner into `after`, of the shape (registers, 4, count),
// in the order of register_names().
void evaluate(const RunnableProgram& program, const pybind11::dict& planes, std::size_t count, const Codes& color,
              const std::optional<Codes>& after);

// The registers that may be given, by their short names: const0, const1, fog, primary, …
[[nodiscard]] std::vector<std::string> register_names();

// Every step of one fragment as a dictionary. `registers` has whole numbers by component.
[[nodiscard]] pybind11::object traced(const RunnableProgram& program, const pybind11::dict& registers);

}  // namespace ninebit::python
