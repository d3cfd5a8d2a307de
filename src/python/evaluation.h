// Programs run on planes of codes.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <string>
#include <vector>

#include "src/python/program_objects.h"

namespace ninebit::python {

// Evaluates `count` fragments. `planes` has one-dimensional arrays of uint8 or int16 by component, 'tex0.r', with
// `count` codes or one code for all; they are read in place, with any strides. The colours go into `color`, of the
// shape (4, count) and with any strides, too, and the registers after the last general combiner into the arrays of
// `after`, if there are any, in the order of register_names(). If a code is out of range, nothing is written.
void evaluate(const RunnableProgram& program, const pybind11::dict& planes, std::size_t count,
              const pybind11::array& color, const std::vector<pybind11::array>& after);

// The same in real numbers, 1.0 for full intensity: exact, or in 32-bit floats where the profile computes in those. The
// arrays are of doubles.
void evaluate_real(const RunnableProgram& program, const pybind11::dict& planes, std::size_t count,
                   pybind11::array_t<double>& color, std::vector<pybind11::array_t<double>>& after);

// Runs texture-shader stages on `count` fragments. `planes` has one-dimensional arrays of float32 by coordinate,
// 'at0.s', and of uint8 by byte of a texel, 'texel0.r', with `count` numbers or one for all. Gives what the combiners
// read, an array of the shape (16, count) from tex0.r to tex3.a; which fragments are culled; the depths that replace
// theirs, or NaN; and why stages are inconsistent, a list of texts.
[[nodiscard]] pybind11::tuple run_stages(const RunnableProgram& program, const pybind11::dict& planes,
                                         std::size_t count);

// The registers that may be given, by their short names: const0, const1, fog, primary, …
[[nodiscard]] std::vector<std::string> register_names();

// Every step of one fragment as a dictionary. `registers` has whole numbers by component, `given` coordinates and bytes
// of texels. Stages that do more than read their textures run first, unless a texture's register is given.
[[nodiscard]] pybind11::object traced(const RunnableProgram& program, const pybind11::dict& registers,
                                      const pybind11::dict& given);

}  // namespace ninebit::python
